//! Waves as block headers draw them.

/// Columns of a name, and of a clock.
const NAME: usize = 16;

/// What a signal shows in a clock.
#[derive(Clone, Copy, Debug)]
pub enum Cell {
    Bit(bool),
    /// A number below 100.
    Number(u128),
    /// Nothing that counts.
    Open,
}

/// A wave: a line for each signal, three columns for each clock.
#[derive(Default)]
pub struct Wave {
    lines: Vec<String>,
    before: Vec<bool>,
}

impl Wave {
    /// Draws one clock; the same signals in the same order at each.
    pub fn take(&mut self, signals: &[(&str, Cell)]) {
        if self.lines.is_empty() {
            self.lines = signals.iter().map(|(name, _)| format!("{name:NAME$}")).collect();
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

    /// The header of this source must hold the wave, line by line.
    pub fn assert_drawn_in(self, source: &str) {
        let drawn: String = self.lines.iter().map(|line| format!("//! {line}\n")).collect();
        assert!(source.contains(&drawn), "the header does not hold this wave:\n{drawn}");
    }
}
