//! The points of a file, with their places in the file.

mod coordinates;
mod heights;
mod place;

use std::borrow::Cow;

use crate::failure::{quoted, Failure};
use crate::memory::Memory;
use crate::number::{self, Coordinate, Decimal, Number};
use crate::text;

pub use coordinates::{chosen, Coordinates, Unit};
use heights::Heights;
pub use place::Place;
use place::{Origin, Rows};

/// The mark of a text file whose coordinates are doubles. It stands in a comment, so other programs ignore it.
pub const DOUBLES: &str = "incircle: the coordinates are doubles";

/// The points of a file, each with its place for messages.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTable {
    coordinates: Coordinates,
    heights: Heights,
    origin: Origin,
    columns: [usize; 3],
    /// The message about the first whole number beyond 64 bits. Such a number is an error if all numbers are whole.
    beyond: Option<String>,
    has_fraction: bool,
    /// Whether the numbers of the text stand for the doubles nearest to them, as a mark in the file says.
    takes_doubles: bool,
    memory: Memory,
    /// Coordinates that were rounded to the nearest double when they were added.
    rounded: usize,
}

impl PointTable {
    /// Makes an empty table of text rows whose x, y and z stand in these columns, counted from 1.
    pub fn of_rows(columns: [usize; 3]) -> Self {
        Self::new(Coordinates::default(), Origin::Rows(Rows::default()), columns)
    }

    /// Makes an empty table of items of this name, such as `vertex` or `feature`.
    pub fn of_items(name: &'static str) -> Self {
        Self::of_coordinates(name, Coordinates::default())
    }

    /// Makes a table of items of this name with these coordinates, which must be finite.
    pub fn of_coordinates(name: &'static str, coordinates: Coordinates) -> Self {
        Self::new(coordinates, Origin::Items(name), [1, 2, 3])
    }

    /// Says in which columns x, y and z of the next point stand, counted from 1.
    pub fn set_columns(&mut self, columns: [usize; 3]) {
        self.columns = columns;
    }

    /// The points at these indices, which must exist, without their z.
    pub fn select(&self, indices: &[u32]) -> Self {
        Self::of_coordinates("point", self.coordinates.select(indices))
    }

    /// The first `count` points, without their z.
    pub fn first(&self, count: usize) -> Self {
        let indices: Vec<u32> = (0..count as u32).collect();
        self.select(&indices)
    }

    fn new(coordinates: Coordinates, origin: Origin, columns: [usize; 3]) -> Self {
        Self {
            coordinates,
            heights: Heights::default(),
            origin,
            columns,
            beyond: None,
            has_fraction: false,
            takes_doubles: false,
            memory: Memory::ENDLESS,
            rounded: 0,
        }
    }

    /// Takes all further numbers as the doubles nearest to them, because the file has the mark `DOUBLES`.
    pub fn take_doubles(&mut self) {
        self.takes_doubles = true;
    }

    /// Whether a text of the coordinates needs the mark `DOUBLES`. A double is written in the fewest digits that tell
    /// it from all other doubles, and the decimal that stands there is often another number.
    pub fn needs_mark(&self) -> bool {
        let is_written = |value: f64| {
            let text = Coordinate::Double(value).to_string();
            number::parse(text.as_bytes()).is_some_and(|number| number.nearest().is_exact)
        };
        match &self.coordinates {
            Coordinates::Doubles(points) => !points.iter().flatten().all(|&value| is_written(value)),
            Coordinates::Steps { .. } => false,
        }
    }

    /// The table, which refuses more points than this memory holds.
    pub fn within(self, memory: Memory) -> Self {
        Self { memory, ..self }
    }

    /// The table as a part of a larger set, whose points are counted over all files.
    pub fn into_items(self) -> Self {
        Self { origin: Origin::Items("point"), ..self }
    }

    /// Adds the points of another table behind those of this one. The set has z only if all its points have one.
    ///
    /// # Errors
    /// The points of both do not fit the memory.
    pub fn append(mut self, other: Self) -> Result<Self, Failure> {
        let (own, others) = (self.len(), other.len());
        self.memory.check_points((own + others) as u64)?;
        self.heights = self.heights.followed_by(own, &other.heights, others);
        self.rounded += other.rounded + self.coordinates.append(other.coordinates);
        Ok(self)
    }

    /// Adds a point as it is written. Rows are counted from 1; a table of items ignores them. Anything but two finite
    /// numbers is refused with its place.
    pub fn push(&mut self, point: [&[u8]; 2], row: usize) -> Result<(), Failure> {
        let number = |axis: usize| number_at(point[axis], || self.next_place(axis, row));
        let numbers = [number(0)?, number(1)?];
        if self.takes_doubles {
            return self.push_doubles(numbers.map(|number| number.nearest().value), row);
        }
        for (axis, number) in numbers.iter().enumerate() {
            match number {
                Number::Decimal(decimal) => self.has_fraction |= decimal.digits > 0,
                Number::Beyond(_) if self.beyond.is_none() => self.beyond = Some(self.beyond_at(point, axis, row)),
                Number::Beyond(_) => {}
                Number::Double(_) => self.has_fraction = true,
            }
        }
        self.add_row(row)?;
        self.rounded += self.coordinates.push(numbers);
        Ok(())
    }

    /// Adds a point of decimals, from a text row.
    #[inline]
    pub fn push_decimals(&mut self, point: [Decimal; 2], row: usize) -> Result<(), Failure> {
        self.has_fraction |= point[0].digits | point[1].digits > 0;
        self.add_row(row)?;
        self.rounded += self.coordinates.push(point.map(Number::Decimal));
        Ok(())
    }

    /// Adds an item of two numbers.
    pub fn push_numbers(&mut self, point: [Number; 2]) -> Result<(), Failure> {
        self.has_fraction |= point.iter().any(|number| !matches!(number, Number::Decimal(it) if it.digits == 0));
        self.add_row(0)?;
        self.rounded += self.coordinates.push(point);
        Ok(())
    }

    /// Adds a point of doubles, from a file that stores doubles. Values that are not finite are refused.
    pub fn push_doubles(&mut self, point: [f64; 2], row: usize) -> Result<(), Failure> {
        if let Some(axis) = point.iter().position(|value| !value.is_finite()) {
            return Err(text::not_finite(&format!("'{}'", point[axis]), self.next_place(axis, row)));
        }
        self.has_fraction = true;
        self.add_row(row)?;
        self.rounded += self.coordinates.push_doubles(point);
        Ok(())
    }

    /// Gives the last point its z as it is written, as the nearest double. Anything but a finite number is refused. If
    /// one point has no z, no point of the table has one.
    pub fn push_height(&mut self, z: Option<&[u8]>, row: usize) -> Result<(), Failure> {
        let index = self.len().saturating_sub(1);
        let Some(text) = z else {
            self.heights.skip(index);
            return Ok(());
        };
        let height = number_at(text, || self.place_in(row, index, 2))?.nearest().value;
        self.heights.push(height);
        Ok(())
    }

    /// The table with the z of its points, which must be finite; an empty list if they have none.
    pub fn with_heights(mut self, heights: Vec<f64>) -> Self {
        self.heights = Heights::of(heights);
        self
    }

    /// The sentence about a z that only some points have, and that is left out for that reason.
    pub fn left_out(&self) -> Option<String> {
        let index = self.heights.missing()?;
        Some(format!("z is left out: {} has none", self.place(index, 2).item()))
    }

    /// The table, once all points are in it. Whole numbers beyond 64 bits are refused unless the set has fractions.
    pub fn complete(self) -> Result<Self, Failure> {
        match &self.beyond {
            Some(message) if !self.has_fraction => Err(Failure::input(message)),
            _ => Ok(self),
        }
    }

    /// Takes the points out of the table, for tiles. The next point is the first of a table that knows what the numbers
    /// before it were.
    ///
    /// # Errors
    /// A whole number is beyond 64 bits, or a coordinate was rounded. Tiles take no set that has such numbers.
    pub fn take_exact(&mut self) -> Result<Coordinates, Failure> {
        if let Some(message) = &self.beyond {
            return Err(Failure::input(message));
        }
        self.check_exact()?;
        self.heights = Heights::default();
        if let Origin::Rows(rows) = &mut self.origin {
            *rows = Rows::default();
        }
        Ok(std::mem::take(&mut self.coordinates))
    }

    /// Refuses coordinates that are neither doubles nor steps of one length, which tiles do not take.
    pub fn check_exact(&self) -> Result<(), Failure> {
        if matches!(self.coordinates, Coordinates::Steps { .. }) || self.rounded == 0 {
            return Ok(());
        }
        Err(Failure::input(format!(
            "{} of its coordinates are not exact as doubles, and there is no common step of up to 64 bits: tiles take \
             points on a lattice of at most 32 bits, so round the numbers to fewer digits",
            self.rounded
        )))
    }

    #[inline]
    fn add_row(&mut self, row: usize) -> Result<(), Failure> {
        let index = self.len();
        if let Origin::Rows(rows) = &mut self.origin {
            rows.push(index, row);
        }
        self.memory.check_points(index as u64 + 1)
    }

    fn beyond_at(&self, point: [&[u8]; 2], axis: usize, row: usize) -> String {
        format!(
            "{}: {} is beyond 64 bits: whole numbers go from {} to {}; a number with an exponent, as in 1e20, is \
             taken as a double",
            self.next_place(axis, row),
            quoted(point[axis]),
            i64::MIN,
            i64::MAX
        )
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.coordinates.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The coordinates of all points, in the order of the file.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// The coordinate of the point at `index` on axis 0 or 1, in the numbers of the file.
    pub fn coordinate(&self, index: usize, axis: usize) -> Coordinate {
        self.coordinates.coordinate(index, axis)
    }

    /// The coordinates of all points as the nearest doubles.
    pub fn doubles(&self) -> Cow<'_, [[f64; 2]]> {
        self.coordinates.doubles()
    }

    /// The number of coordinates that are rounded in [`doubles`](Self::doubles). Those of a file that stores doubles
    /// are not.
    pub fn rounded(&self) -> usize {
        self.rounded + self.coordinates.count_no_doubles()
    }

    /// The z of the points; empty if they have none.
    pub fn heights(&self) -> &[f64] {
        self.heights.of_all(self.len())
    }

    /// The place of coordinate `axis`, 0 to 2, of the point at `index`, for messages.
    pub fn place(&self, index: usize, axis: usize) -> Place {
        let row = match &self.origin {
            Origin::Rows(rows) => rows.of(index),
            Origin::Items(_) => 0,
        };
        self.place_in(row, index, axis)
    }

    /// The place of a coordinate of the next point, which stands in this row.
    fn next_place(&self, axis: usize, row: usize) -> Place {
        self.place_in(row, self.len(), axis)
    }

    fn place_in(&self, row: usize, index: usize, axis: usize) -> Place {
        match self.origin {
            Origin::Rows(_) => Place::Cell { row, column: self.columns[axis.min(2)] },
            Origin::Items(name) => Place::Item { name, number: index + 1, axis: ['x', 'y', 'z'][axis.min(2)] },
        }
    }
}

/// Reads the number at a place. Any finite number is taken, with spaces around it or without.
pub fn number_at(value: &[u8], place: impl Fn() -> Place) -> Result<Number, Failure> {
    let trimmed = value.trim_ascii();
    match number::parse(trimmed) {
        Some(Number::Double(nearest) | Number::Beyond(nearest)) if !nearest.value.is_finite() => {
            Err(text::not_finite(&quoted(trimmed), place()))
        }
        Some(number) => Ok(number),
        None => Err(text::not_a_number(trimmed, place())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(points: &[[&str; 2]]) -> Result<PointTable, Failure> {
        let mut table = PointTable::of_rows([1, 2, 3]);
        for (index, point) in points.iter().enumerate() {
            table.push(point.map(str::as_bytes), index + 1)?;
        }
        table.complete()
    }

    #[test]
    fn coordinates_are_finite_numbers() {
        assert!(table(&[[" 2147483647 ", "1e300"]]).is_ok());
        for bad in ["nan", "-inf", "1e999", "", "1,5", "0x10"] {
            let failure = table(&[["1", "2"], ["3", bad]]).expect_err(bad);
            assert!(failure.message.starts_with("row 2, column 2: "), "{failure}");
        }
    }

    #[test]
    fn whole_numbers_end_at_64_bits() {
        let beyond = "9223372036854775808";
        let failure = table(&[["1", "2"], [beyond, "4"]]).expect_err("beyond 64 bits");
        assert!(failure.message.starts_with("row 2, column 1: '9223372036854775808' is beyond 64 bits"), "{failure}");
        // A fraction makes the set one of doubles.
        assert!(table(&[["0.5", "2"], [beyond, "4"]]).is_ok());
    }
}
