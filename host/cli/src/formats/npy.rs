//! `.npy`, the arrays of NumPy: points as an array of n rows and two or three columns, meshes as one of m rows and
//! three.
//!
//! Integers are taken as whole numbers and floats as the doubles that they are, in either byte order and in C or
//! Fortran order. An array of records has the fields `x`, `y` and perhaps `z`.

use std::ops::Range;

use crate::failure::Failure;
use crate::formats::array::{Cells, Layout, Pieces, Source, Wanted};
use crate::formats::pieces::{Take, TakeTriangle};
use crate::input::Input;
use crate::memory::Memory;
use crate::points::{Coordinates, Place, PointTable, Unit};
use crate::text;

const POINTS: Wanted =
    Wanted { item: "point", widths: &[2, 3], shapes: "(n, 2) or (n, 3)", fields: (&["x", "y", "z"], 2) };
const TRIANGLES: Wanted = Wanted { item: "triangle", widths: &[3], shapes: "(m, 3)", fields: (&[], 0) };

/// Reads the points of an array. The third column is z.
pub fn read_points(mut source: Source<'_>) -> Result<PointTable, Failure> {
    let layout = source.open(&POINTS, Memory::check_points)?;
    let certain = source.certain_rows(&layout);
    let is_whole = |axis| layout.columns().any(|column| column.axis == axis && column.item.is_integer());
    let mut heights = Vec::new();
    let coordinates = if is_whole(0) && is_whole(1) {
        let mut steps = with_room(certain)?;
        source.read(&layout, |cells| match cells.axis {
            2 => keep_heights(&mut heights, cells),
            _ => keep_integers(&mut steps, cells),
        })?;
        Coordinates::Steps { steps, unit: Unit::of_digits(0) }
    } else {
        let mut points = with_room(certain)?;
        source.read(&layout, |cells| match cells.axis {
            2 => keep_heights(&mut heights, cells),
            _ => keep_doubles(&mut points, cells),
        })?;
        Coordinates::Doubles(points)
    };
    Ok(PointTable::of_coordinates("point", coordinates).with_heights(heights))
}

/// The number of points of a piece.
const PIECE: usize = 1 << 16;

/// The number of points of an array, by its header.
pub fn count_points(input: Input) -> Result<u64, Failure> {
    Pieces::open(input, &POINTS).map(|pieces| pieces.layout().rows as u64)
}

/// Calls `take` with the coordinates of the points, piece by piece. The memory holds one piece, however large the array
/// is.
pub fn read_pieces(input: Input, take: Take<'_>) -> Result<(), Failure> {
    let mut rows = Rows::open(input)?;
    rows.each(0..rows.count(), &mut |piece| take(&piece))
}

/// The points of an array that is open for reading. Any range of them can be read.
pub struct Rows {
    pieces: Pieces,
    is_whole: bool,
}

impl Rows {
    /// Reads the header of an array. A packed array is unpacked into the memory as a whole.
    ///
    /// # Errors
    /// The header cannot be read, is not that of points, or promises more bytes than the file has.
    pub fn open(input: Input) -> Result<Self, Failure> {
        let pieces = Pieces::open(input, &POINTS)?;
        let is_whole = |axis| pieces.layout().columns().any(|one| one.axis == axis && one.item.is_integer());
        let is_whole = is_whole(0) && is_whole(1);
        Ok(Self { pieces, is_whole })
    }

    /// The number of points.
    pub fn count(&self) -> usize {
        self.pieces.layout().rows
    }

    /// Calls `take` with the coordinates of the points of a range, in pieces of up to 65,536 points. The part of the
    /// range beyond the last point is left out.
    ///
    /// # Errors
    /// The file cannot be read or has a number that no point may have, or `take` fails.
    pub fn each(
        &mut self,
        range: Range<usize>,
        take: &mut dyn FnMut(Coordinates) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let end = range.end.min(self.count());
        for first in (range.start..end).step_by(PIECE) {
            let (mut steps, mut points) = (Vec::new(), Vec::new());
            let is_whole = self.is_whole;
            self.pieces.read(first, PIECE.min(end - first), |cells| match (cells.axis, is_whole) {
                (2, _) => Ok(()),
                (_, true) => keep_integers(&mut steps, cells),
                (_, false) => keep_doubles(&mut points, cells),
            })?;
            take(match is_whole {
                true => Coordinates::Steps { steps, unit: Unit::of_digits(0) },
                false => Coordinates::Doubles(points),
            })?;
        }
        Ok(())
    }
}

/// Reads the triangles of an array of integers.
pub fn read_mesh(mut source: Source<'_>) -> Result<Vec<[u32; 3]>, Failure> {
    let layout = source.open(&TRIANGLES, Memory::check_triangles)?;
    check_integers(&layout)?;
    let mut triangles: Vec<[u32; 3]> = with_room(source.certain_rows(&layout))?;
    source.read(&layout, |cells| keep_corners(&mut triangles, cells))?;
    Ok(triangles)
}

/// Calls `take` with the triangles of an array of integers, which is read in pieces.
///
/// # Errors
/// The file cannot be read or holds other numbers, or `take` fails.
pub fn each_triangle(input: Input, take: TakeTriangle<'_>) -> Result<(), Failure> {
    let mut pieces = Pieces::open(input, &TRIANGLES)?;
    check_integers(pieces.layout())?;
    let (end, mut triangles) = (pieces.layout().rows, Vec::new());
    for first in (0..end).step_by(PIECE) {
        triangles.clear();
        pieces.read(first, PIECE.min(end - first), |cells| keep_corners(&mut triangles, cells))?;
        triangles.iter().try_for_each(|&triangle| take(triangle))?;
    }
    Ok(())
}

fn check_integers(layout: &Layout) -> Result<(), Failure> {
    if layout.columns().all(|column| column.item.is_integer()) {
        return Ok(());
    }
    Err(Failure::input("the array holds floats, but triangles are integers: save array.astype('<u4')"))
}

fn keep_corners(triangles: &mut Vec<[u32; 3]>, cells: &Cells<'_>) -> Result<(), Failure> {
    let mut wrong = None;
    let mut target = rows_of(triangles, cells);
    cells.integers(|integer| {
        let Some((index, triangle)) = target.next() else { return };
        match u32::try_from(integer) {
            Ok(vertex) => triangle[cells.axis] = vertex,
            Err(_) => wrong = wrong.or(Some((index, integer))),
        }
    });
    wrong.map_or(Ok(()), |(index, integer)| {
        let shown = cells.beyond(integer).map_or(integer.to_string(), |beyond| beyond.to_string());
        Err(Failure::input(format!("triangle {}: {shown} is not a point index", index + 1)))
    })
}

/// An empty list with room for `rows` rows.
fn with_room<T>(rows: usize) -> Result<Vec<T>, Failure> {
    let mut list = Vec::new();
    list.try_reserve_exact(rows).map_err(|_| Failure::input(format!("{rows} rows do not fit the memory")))?;
    Ok(list)
}

/// The rows of the list into which `cells` go, with their indices. The list grows to hold them.
fn rows_of<'a, T: Copy + Default>(
    list: &'a mut Vec<T>,
    cells: &Cells<'_>,
) -> impl Iterator<Item = (usize, &'a mut T)> + use<'a, T> {
    if list.len() < cells.end() {
        list.resize(cells.end(), T::default());
    }
    let first = cells.first;
    list[cells.start()..].iter_mut().enumerate().map(move |(index, row)| (first + index, row))
}

fn keep_integers(steps: &mut Vec<[i64; 2]>, cells: &Cells<'_>) -> Result<(), Failure> {
    let axis = cells.axis.min(1);
    let mut lowest = 0;
    let mut target = rows_of(steps, cells);
    cells.integers(|integer| {
        lowest = lowest.min(integer);
        if let Some((_, point)) = target.next() {
            point[axis] = integer;
        }
    });
    drop(target);
    if cells.beyond(lowest).is_none() {
        return Ok(());
    }
    let mut beyond = steps.iter().enumerate().skip(cells.start());
    let found = beyond.find_map(|(index, point)| Some((index, cells.beyond(point[axis])?)));
    found.map_or(Ok(()), |(index, value)| {
        let (place, most) = (place(cells.list + index, axis), i64::MAX);
        Err(Failure::input(format!("{place}: {value} is beyond 64 bits: whole numbers go up to {most}")))
    })
}

fn keep_doubles(points: &mut Vec<[f64; 2]>, cells: &Cells<'_>) -> Result<(), Failure> {
    let axis = cells.axis.min(1);
    if cells.item.is_integer() {
        refuse_rounded(cells)?;
    }
    let mut are_finite = true;
    let mut target = rows_of(points, cells);
    cells.doubles(|value| {
        are_finite &= value.is_finite();
        if let Some((_, point)) = target.next() {
            // Adding zero turns minus zero into zero.
            point[axis] = value + 0.0;
        }
    });
    drop(target);
    if are_finite {
        return Ok(());
    }
    let mut rows = points.iter().enumerate().skip(cells.start());
    let found = rows.find(|(_, point)| !point[axis].is_finite());
    found.map_or(Ok(()), |(index, point)| {
        Err(text::not_finite(&format!("'{}'", point[axis]), place(cells.list + index, axis)))
    })
}

/// Refuses integers that no double holds, in a column whose points have a float as the other coordinate.
fn refuse_rounded(cells: &Cells<'_>) -> Result<(), Failure> {
    let mut index = cells.first;
    let mut rounded = None;
    cells.integers(|integer| {
        let exact = cells.beyond(integer).map_or(i128::from(integer), i128::from);
        if exact as f64 as i128 != exact {
            rounded = rounded.or(Some((index, exact)));
        }
        index += 1;
    });
    rounded.map_or(Ok(()), |(index, integer)| {
        let place = place(index, cells.axis);
        Err(Failure::input(format!(
            "{place}: no double is {integer}, but the other coordinate is a float, so both are taken as doubles: save \
             both as integers"
        )))
    })
}

fn keep_heights(heights: &mut Vec<f64>, cells: &Cells<'_>) -> Result<(), Failure> {
    let mut target = rows_of(heights, cells);
    cells.doubles(|value| {
        if let Some((_, height)) = target.next() {
            *height = value;
        }
    });
    drop(target);
    let found = heights.iter().enumerate().skip(cells.start()).find(|(_, height)| !height.is_finite());
    found.map_or(Ok(()), |(index, height)| Err(text::not_finite(&format!("'{height}'"), place(cells.list + index, 2))))
}

fn place(index: usize, axis: usize) -> Place {
    Place::Item { name: "point", number: index + 1, axis: ['x', 'y', 'z'][axis.min(2)] }
}
