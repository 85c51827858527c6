//! Finds the signals with named states in exported Verilog, so that waveforms can show the names.

use std::collections::{BTreeMap, BTreeSet};

/// A line for each signal that is compared with, or assigned, a constant of an enumeration. The words of a line are the
/// path of the module (its instances with `$` between them, without the root; `.` is the root itself), the signal, the
/// name of the enumeration, and its states, such as `Idle=0`. For a register the signal is its output, `state$q`.
pub fn named_states(verilog: &str) -> BTreeSet<String> {
    let mut lines = BTreeSet::new();
    for module in verilog.split("\nmodule ").skip(1) {
        let name = module.split(['(', ' ']).next().unwrap_or_default();
        let path = name.split_once('$').map_or(".", |(_, path)| path);
        let states = states(module);
        for (signal, enumeration) in signals(module, &states) {
            let names: Vec<String> = states
                .iter()
                .filter(|state| state.0 == enumeration)
                .map(|(_, name, at)| format!("{name}={at}"))
                .collect();
            lines.insert(format!("{path} {signal} {enumeration} {}", names.join(" ")));
        }
    }
    lines
}

/// Enumeration, name and value of all states that the module declares, such as `localparam CommitState$Idle = 0;`.
fn states(module: &str) -> Vec<(&str, &str, u64)> {
    let state = |line: &str| {
        let (constant, value) = line.trim().strip_prefix("localparam ")?.strip_suffix(';')?.split_once(" = ")?;
        let (constant, value) = (module_part(module, constant)?, value.parse().ok()?);
        let (enumeration, name) = constant.split_once('$')?;
        Some((enumeration, name, value))
    };
    module.lines().filter_map(state).collect()
}

/// The same text as a part of the module, which lives longer than a line of it.
fn module_part<'a>(module: &'a str, text: &str) -> Option<&'a str> {
    module.find(text).and_then(|at| module.get(at..at + text.len()))
}

/// The signals that take states, with the enumeration of each.
fn signals<'a>(module: &'a str, states: &[(&'a str, &'a str, u64)]) -> BTreeMap<String, &'a str> {
    let mut signals = BTreeMap::new();
    let mut chosen = "";
    for line in module.lines().map(str::trim).filter(|line| !line.starts_with("localparam")) {
        chosen = line.strip_prefix("case (").and_then(|rest| rest.strip_suffix(')')).unwrap_or(chosen);
        let words: Vec<&str> = line.split_whitespace().map(|word| word.trim_matches(['(', ')', ';', '~'])).collect();
        for (place, word) in words.iter().enumerate() {
            let of = word.trim_end_matches(':').split_once('$');
            let known = states.iter().find(|state| of == Some((state.0, state.1)));
            let signal = match words.get(..place) {
                Some([.., signal, "=" | "==" | "!="]) => signal,
                Some([]) if word.ends_with(':') => chosen,
                _ => continue,
            };
            let is_name = !signal.is_empty() && !signal.contains(['[', '(', '\'']);
            if let (Some(state), true) = (known, is_name) {
                let output = signal.strip_suffix("$d").map_or(signal.to_owned(), |register| format!("{register}$q"));
                signals.insert(output, state.0);
            }
        }
    }
    signals
}
