//! The text of a layout for GTKWave, and of the files with names of states.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::header::Signal;
use super::named_state::NamedState;

/// Scope in which Verilator puts the ports of the root module.
const PORTS: &str = "TOP";
/// The part of the screen for the waves, in the steps of GTKWave's ruler, of 200 pixels each.
const STEPS: f64 = 5.0;
/// The form in which GTKWave shows a signal: as bits, in hexadecimal, or by the names of a file.
const AS_BITS: &str = "@28";
const IN_HEXADECIMAL: &str = "@22";
const BY_NAMES: &str = "@2022";

/// Path and text of each file of the layout of this waveform; the layout itself is first.
pub(super) fn files(
    waveform: &Path,
    signals: &[Signal],
    states: &[NamedState],
    times: (u64, u64),
) -> Vec<(PathBuf, String)> {
    let shown: Vec<(&Signal, &NamedState)> = shown(signals, states);
    let mut names = BTreeMap::new();
    for (signal, state) in &shown {
        names.insert(state.enumeration, (waveform.with_extension(format!("{}.txt", state.enumeration)), signal, state));
    }
    let mut text = head(waveform, times);
    text += "@200\n-Ports\n";
    for signal in signals.iter().filter(|signal| signal.scope == PORTS) {
        let form = if signal.width == 1 { AS_BITS } else { IN_HEXADECIMAL };
        text += &format!("{form}\n{}\n", signal.full_name());
    }
    text += "@200\n-States\n";
    for (signal, state) in &shown {
        if let Some((file, ..)) = names.get(state.enumeration) {
            text += &format!("{BY_NAMES}\n^1 {}\n+{{{}}} {}\n", name_of(file), short_name(signal), signal.full_name());
        }
    }
    let names = names.into_values().map(|(file, signal, state)| (file, names_of_states(signal, state)));
    [(waveform.with_extension("gtkw"), text)].into_iter().chain(names).collect()
}

/// The signals of the waveform that have named states.
fn shown<'a>(signals: &'a [Signal], states: &'a [NamedState]) -> Vec<(&'a Signal, &'a NamedState)> {
    let state_of = |signal: &Signal| {
        // Scopes are those of the ports, the root module, the core in it, and the blocks of the core.
        let path = signal.scope.splitn(4, '.').nth(3).map_or(".".to_owned(), |path| path.replace('.', "$"));
        states.iter().find(|state| state.path == path && state.signal == signal.name)
    };
    signals.iter().filter_map(|signal| Some((signal, state_of(signal)?))).collect()
}

/// The name by which the viewer shows a signal with states: the last two blocks and the register. GTKWave
/// cuts a name at its last dot, so there is none.
fn short_name(signal: &Signal) -> String {
    let blocks: Vec<&str> = signal.scope.rsplit('.').take(2).collect();
    let register = signal.name.strip_suffix("$q").unwrap_or(&signal.name);
    blocks.into_iter().rev().chain([register]).collect::<Vec<_>>().join("/")
}

/// The lines of a layout before its signals: the waveform, and how much of it is on the screen.
fn head(waveform: &Path, (first, last): (u64, u64)) -> String {
    let zoom = (last.saturating_sub(first).max(1) as f64 / STEPS).log2();
    let marks = " -1".repeat(26);
    format!(
        "[*] Written by incircle-sim.\n[dumpfile] \"{}\"\n[timestart] {first}\n[size] 1400 700\n[pos] -1 -1\n\
         *{:.6} {first}{marks}\n[sst_expanded] 0\n[signals_width] 260\n",
        name_of(waveform),
        -zoom
    )
}

/// A line for each state: its value as GTKWave shows it in hexadecimal, and its name.
fn names_of_states(signal: &Signal, state: &NamedState) -> String {
    let digits = signal.width.div_ceil(4) as usize;
    state.states.iter().map(|(name, value)| format!("{value:0digits$x} {name}\n")).collect()
}

/// The name of the file without its folder: the files of a layout lie beside each other.
fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
