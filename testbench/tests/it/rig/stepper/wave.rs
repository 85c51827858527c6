//! Waves as the heads of blocks draw them.

use std::fs;
use std::path::Path;

/// Least number of columns for a name, so that a space follows the longest name of a wave.
const NAME: usize = 16;

/// The drawing of a signal in one clock.
#[derive(Clone, Copy, Debug)]
pub enum Cell {
    Bit(bool),
    /// A number below 100.
    Number(u128),
    /// A value that does not matter.
    Open,
}

/// A wave: a line for each signal, three columns for each clock.
#[derive(Default)]
pub struct Wave {
    lines: Vec<String>,
    before: Vec<bool>,
}

impl Wave {
    /// Draws one clock. Every call must have the same signals in the same order.
    pub fn take(&mut self, signals: &[(&str, Cell)]) {
        if self.lines.is_empty() {
            let longest = signals.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
            let width = NAME.max(longest + 1);
            self.lines = signals.iter().map(|(name, _)| format!("{name:width$}")).collect();
            self.before = vec![false; signals.len()];
        }
        for (((_, cell), line), before) in signals.iter().zip(&mut self.lines).zip(&mut self.before) {
            line.push_str(&match (*cell, *before) {
                (Cell::Bit(true), true) => "^^^".to_string(),
                (Cell::Bit(true), false) => "/^^".to_string(),
                (Cell::Bit(false), true) => "\\__".to_string(),
                (Cell::Bit(false), false) => "___".to_string(),
                (Cell::Number(number), _) => format!("{number:3}"),
                (Cell::Open, _) => "  .".to_string(),
            });
            *before = matches!(cell, Cell::Bit(true));
        }
    }

    /// Checks that the head of the block's source file holds the wave, line by line. The file is found by its
    /// name in any folder of `hdl/src`.
    pub fn assert_drawn_in(self, block: &str) {
        let drawn: String = self.lines.iter().map(|line| format!("//! {line}\n")).collect();
        let sources = sources_of(block, &Path::new(env!("CARGO_MANIFEST_DIR")).join("../hdl/src"));
        assert!(!sources.is_empty(), "hdl/src has no {block}.rs");
        assert!(
            sources.iter().any(|source| source.contains(&drawn)),
            "the header of {block}.rs does not hold:\n{drawn}"
        );
    }
}

/// Text of each file of this name below the folder.
fn sources_of(block: &str, folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut sources = Vec::new();
    for entry in entries {
        let path = entry.expect("an entry of a folder").path();
        if path.is_dir() {
            sources.extend(sources_of(block, &path));
        } else if path.extension().is_some_and(|end| end == "rs") && path.file_stem().is_some_and(|stem| stem == block)
        {
            sources.push(fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())));
        }
    }
    sources
}
