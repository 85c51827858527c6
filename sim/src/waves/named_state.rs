//! The signals with named states of all cores, as the build script found them in the Verilog.

/// A signal whose states have names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NamedState {
    /// Instances from the root of the core to the module, with `$` between them; `.` is the root.
    pub(super) path: &'static str,
    pub(super) signal: &'static str,
    pub(super) enumeration: &'static str,
    /// Name and value of each state.
    pub(super) states: Vec<(&'static str, u64)>,
}

/// All signals with named states.
pub(super) fn named_states() -> Vec<NamedState> {
    include_str!(concat!(env!("OUT_DIR"), "/states.txt")).lines().filter_map(named_state).collect()
}

/// Parses a line of `states.txt`; `sim/build/states.rs` describes its form.
fn named_state(line: &'static str) -> Option<NamedState> {
    let mut words = line.split(' ');
    let (path, signal, enumeration) = (words.next()?, words.next()?, words.next()?);
    let state = |word: &'static str| {
        let (name, value) = word.split_once('=')?;
        Some((name, value.parse().ok()?))
    };
    Some(NamedState { path, signal, enumeration, states: words.filter_map(state).collect() })
}
