//! Places in a file, for messages.

use std::fmt;

/// A place in a file, all numbers counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A value in a text row.
    Cell {
        /// The row (line) of the file.
        row: usize,
        /// The column (value) of the row.
        column: usize,
    },
    /// A coordinate of an item.
    Item {
        /// The name of the kind of item.
        name: &'static str,
        /// The number of the item.
        number: usize,
        /// The coordinate, `x`, `y` or `z`.
        axis: char,
    },
}

impl Place {
    /// The row or the item without the coordinate, for messages.
    pub fn item(&self) -> String {
        match self {
            Self::Cell { row, .. } => format!("row {row}"),
            Self::Item { name, number, .. } => format!("{name} {number}"),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cell { row, column } => write!(f, "row {row}, column {column}"),
            Self::Item { name, number, axis } => write!(f, "{name} {number}, {axis}"),
        }
    }
}

/// The places at which the points of a table stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// One point in a text row.
    Rows(Rows),
    /// One point in an item of this name; items are counted from 1.
    Items(&'static str),
}

/// The rows of points. A list of runs is enough, because most points stand in the row after the previous one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Rows {
    /// The index of the first point of each run, and its row.
    runs: Vec<(usize, usize)>,
    /// The row that continues the last run.
    next: usize,
}

impl Rows {
    /// Adds the row of the point at `index`, the next one.
    pub(super) fn push(&mut self, index: usize, row: usize) {
        if self.runs.is_empty() || row != self.next {
            self.runs.push((index, row));
        }
        self.next = row + 1;
    }

    /// The row of the point at `index`.
    pub(super) fn of(&self, index: usize) -> usize {
        let run = self.runs.partition_point(|&(first, _)| first <= index).checked_sub(1);
        run.map_or(index + 1, |run| self.runs[run].1 + (index - self.runs[run].0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_again() {
        let all = [2, 3, 4, 9, 11, 12];
        let mut rows = Rows::default();
        all.iter().enumerate().for_each(|(index, &row)| rows.push(index, row));
        let found: Vec<_> = (0..all.len()).map(|index| rows.of(index)).collect();
        assert_eq!(found, all);
        assert_eq!(rows.runs.len(), 3);
    }
}
