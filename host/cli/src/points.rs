//! The points of a file, with the places they came from.

use std::fmt;

/// Where in a file the points of a table stand.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Origin {
    /// A point per text row; the row of each, counted from 1.
    Rows(Vec<u32>),
    /// A point per item of this name, counted from 1.
    Items(&'static str),
}

/// Points as a file gives them, and where each one stands in it.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTable {
    /// All points in the order of the file; every value is finite.
    pub points: Vec<[f64; 2]>,
    origin: Origin,
    columns: [usize; 2],
}

impl PointTable {
    /// An empty table of text rows whose coordinates stand in these columns, counted from 1.
    pub fn of_rows(columns: [usize; 2]) -> Self {
        Self { points: Vec::new(), origin: Origin::Rows(Vec::new()), columns }
    }

    /// An empty table of items of this name (`vertex`, `feature`).
    pub fn of_items(name: &'static str) -> Self {
        Self { points: Vec::new(), origin: Origin::Items(name), columns: [1, 2] }
    }

    /// Adds a point that stands in this row (rows count from 1; ignored for items).
    pub fn push(&mut self, point: [f64; 2], row: usize) {
        // Minus zero is zero; the sum turns one into the other.
        self.points.push([point[0] + 0.0, point[1] + 0.0]);
        if let Origin::Rows(rows) = &mut self.origin {
            rows.push(u32::try_from(row).unwrap_or(u32::MAX));
        }
    }

    /// Where coordinate `axis` (0 or 1) of the point at `index` stands, as messages say it.
    pub fn place(&self, index: usize, axis: usize) -> Place {
        match &self.origin {
            Origin::Rows(rows) => Place::Cell {
                row: rows.get(index).map_or(index + 1, |&row| row as usize),
                column: self.columns[axis.min(1)],
            },
            Origin::Items(name) => Place::Item { name, number: index + 1, axis: if axis == 0 { 'x' } else { 'y' } },
        }
    }
}

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
        /// What the item is.
        name: &'static str,
        /// Its number.
        number: usize,
        /// The coordinate.
        axis: char,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cell { row, column } => write!(f, "row {row}, column {column}"),
            Self::Item { name, number, axis } => write!(f, "{name} {number}, {axis}"),
        }
    }
}
