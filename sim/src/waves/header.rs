//! The head of a VCD waveform: its signals.

use std::io::BufRead;

/// A signal of a waveform.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Scopes from the outermost one, with dots between them.
    pub scope: String,
    /// Name within the scope.
    pub name: String,
    /// Number of bits.
    pub width: u32,
    /// Range of the bits, such as `[31:0]`; empty for a single bit.
    pub range: String,
}

impl Signal {
    /// The name by which a viewer finds the signal: scope, name and range.
    pub fn full_name(&self) -> String {
        format!("{}.{}{}", self.scope, self.name, self.range)
    }
}

/// The signals of a waveform in the order of its head; `None` if the head does not end.
pub(super) fn signals(file: impl BufRead) -> Result<Option<Vec<Signal>>, std::io::Error> {
    let mut scopes: Vec<String> = Vec::new();
    let mut signals = Vec::new();
    for line in file.split(b'\n') {
        let line = line?;
        let line = String::from_utf8_lossy(&line);
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["$scope", _, name, "$end"] => scopes.push(name.to_owned()),
            ["$upscope", "$end"] => {
                scopes.pop();
            }
            ["$var", _, width, _, name, ref range @ .., "$end"] => signals.push(Signal {
                scope: scopes.join("."),
                name: name.to_owned(),
                width: width.parse().unwrap_or(1),
                range: range.concat(),
            }),
            ["$enddefinitions", ..] => return Ok(Some(signals)),
            _ => {}
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_have_scope_width_and_range() {
        let head =
            "$version x $end\n $scope module TOP $end\n  $var wire 1 a clock $end\n  $scope module core $end\n   \
                    $var wire 3 b state$q [2:0] $end\n  $upscope $end\n $upscope $end\n$enddefinitions $end\n#0\n";
        let found = signals(head.as_bytes()).unwrap().unwrap();
        let names: Vec<String> = found.iter().map(Signal::full_name).collect();
        assert_eq!(names, ["TOP.clock", "TOP.core.state$q[2:0]"]);
        assert_eq!(found[1].width, 3);
        assert_eq!(signals("$scope module TOP $end\n".as_bytes()).unwrap(), None);
    }
}
