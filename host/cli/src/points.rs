//! The points of a file, with their places in the file.

use std::fmt;

/// The kind of places at which the points of a table stand.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Origin {
    /// One point in a text row; the list has the row of each point, counted from 1.
    Rows(Vec<u32>),
    /// One point in an item of this name; items are counted from 1.
    Items(&'static str),
}

/// The points of a file, each with its place for messages.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTable {
    /// All points in the order of the file; every value is finite.
    pub points: Vec<[f64; 2]>,
    origin: Origin,
    columns: [usize; 2],
}

impl PointTable {
    /// Makes an empty table of text rows whose coordinates stand in these columns, counted from 1.
    pub fn of_rows(columns: [usize; 2]) -> Self {
        Self { points: Vec::new(), origin: Origin::Rows(Vec::new()), columns }
    }

    /// Makes an empty table of items of this name, such as `vertex` or `feature`.
    pub fn of_items(name: &'static str) -> Self {
        Self { points: Vec::new(), origin: Origin::Items(name), columns: [1, 2] }
    }

    /// Adds a point of this row. Rows are counted from 1; a table of items ignores them.
    pub fn push(&mut self, point: [f64; 2], row: usize) {
        // Adding zero turns minus zero into zero.
        self.points.push([point[0] + 0.0, point[1] + 0.0]);
        if let Origin::Rows(rows) = &mut self.origin {
            rows.push(u32::try_from(row).unwrap_or(u32::MAX));
        }
    }

    /// The place of coordinate `axis`, 0 or 1, of the point at `index`, for messages.
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
        /// The name of the kind of item.
        name: &'static str,
        /// The number of the item.
        number: usize,
        /// The coordinate, `x` or `y`.
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
