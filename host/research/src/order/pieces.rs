//! The recursion of all curves that look at the points: pieces of the plane, which are ranges of a list, are divided
//! until each has one point.

use incircle_geometry::Point;

/// Flag of an orientation: both axes run backwards.
const TURNED: u8 = 1;
/// Flag of an orientation: the axes are swapped.
const SWAPPED: u8 = 2;
/// Flag of an orientation of Peano's copies: the first axis runs backwards.
const MIRROR_U: u8 = 4;
/// Flag of an orientation of Peano's copies: the second axis runs backwards.
const MIRROR_V: u8 = 8;

/// The orientation of a copy of a curve in the plane, with axes `u` and `v` instead of x and y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Orientation(u8);

impl Orientation {
    /// The orientation with its axes swapped: a curve along the first axis then runs along the second.
    pub(super) fn swapped(self) -> Self {
        Self(self.0 ^ SWAPPED)
    }

    /// The orientation with its axes swapped and both reversed.
    pub(super) fn swapped_and_turned(self) -> Self {
        Self(self.0 ^ SWAPPED ^ TURNED)
    }

    /// The orientation mirrored in one axis or both.
    pub(super) fn mirrored(self, in_u: bool, in_v: bool) -> Self {
        Self(self.0 ^ if in_u { MIRROR_U } else { 0 } ^ if in_v { MIRROR_V } else { 0 })
    }

    /// The coordinates of a point in this orientation.
    pub(super) fn see(self, point: Point) -> [i64; 2] {
        let sign = |bits: u8| if self.0 & bits == 0 { 1 } else { -1 };
        let (x, y) = (i64::from(point.x) * sign(TURNED), i64::from(point.y) * sign(TURNED));
        let [u, v] = if self.0 & SWAPPED == 0 { [x, y] } else { [y, x] };
        [u * sign(MIRROR_U), v * sign(MIRROR_V)]
    }
}

/// A piece of the plane: a range of the list, and the orientation of the curve through the piece.
pub(super) type Piece = (std::ops::Range<usize>, Orientation);

/// Divides pieces until each has one point or only equal points, which leaves the list in the order of the curve.
///
/// `divide` puts the points of a piece into the order of its parts, and returns the end of each part with the
/// orientation of the curve through the part. Pieces whose points are all equal are never divided.
pub(super) fn order(
    points: &[Point],
    mut divide: impl FnMut(&mut [u32], Orientation) -> Vec<(usize, Orientation)>,
) -> Vec<u32> {
    let mut list: Vec<u32> = (0..=u32::MAX).take(points.len()).collect();
    let mut open: Vec<Piece> = vec![(0..points.len(), Orientation::default())];
    while let Some((range, orientation)) = open.pop() {
        let piece = &mut list[range.clone()];
        let Some((&first, rest)) = piece.split_first() else {
            continue;
        };
        if rest.iter().all(|&index| points[index as usize] == points[first as usize]) {
            continue;
        }
        let mut start = range.start;
        for (end, orientation) in divide(piece, orientation) {
            let end = range.start + end;
            if end - start > 1 {
                open.push((start..end, orientation));
            }
            start = end;
        }
    }
    list
}

/// The columns and rows of a grid over the points of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    pub(super) columns: usize,
    pub(super) rows: usize,
}

/// A way through the cells of a grid, which visits each cell once: column, row, and the orientation of the
/// curve through the cell.
pub(super) type Way = Vec<(usize, usize, Orientation)>;

/// Puts the points of a piece into the order of the way through their cells; returns where the points of each cell end.
pub(super) fn distribute(
    piece: &mut [u32],
    cells: Cells,
    way: &Way,
    cell_of: impl Fn(u32) -> (usize, usize),
) -> Vec<(usize, Orientation)> {
    let mut turn = vec![0; cells.columns * cells.rows];
    for (place, &(column, row, _)) in way.iter().enumerate() {
        turn[column * cells.rows + row] = place;
    }
    let places: Vec<usize> = piece
        .iter()
        .map(|&index| {
            let (column, row) = cell_of(index);
            turn[column * cells.rows + row]
        })
        .collect();
    let mut ends = vec![0; way.len()];
    places.iter().for_each(|&place| ends[place] += 1);
    let mut sum = 0;
    let mut slots = ends;
    for slot in &mut slots {
        sum += std::mem::replace(slot, sum);
    }
    let unordered = piece.to_vec();
    for (index, place) in unordered.into_iter().zip(places) {
        piece[slots[place]] = index;
        slots[place] += 1;
    }
    slots.into_iter().zip(way).map(|(end, &(_, _, orientation))| (end, orientation)).collect()
}

/// Hilbert's way through two columns of any number of rows: up the left column and down the right one.
pub(super) fn hilbert_way(rows: usize, orientation: Orientation) -> Way {
    let up = (0..rows).map(|row| (0, row, if row + 1 == rows { orientation } else { orientation.swapped() }));
    let down = (0..rows)
        .rev()
        .map(|row| (1, row, if row + 1 == rows { orientation } else { orientation.swapped_and_turned() }));
    up.chain(down).collect()
}

/// The way through curves beside each other. One of Hilbert's curves ends where the next one begins.
pub(super) fn row_way(columns: usize, orientation: Orientation) -> Way {
    (0..columns).map(|column| (column, 0, orientation)).collect()
}

/// Peano's way: up and down the columns, mirrored so that ends meet. The numbers of columns and rows are odd.
pub(super) fn peano_way(cells: Cells, orientation: Orientation) -> Way {
    let way = (0..cells.columns).flat_map(|column| {
        (0..cells.rows).map(move |step| {
            let row = if column % 2 == 0 { step } else { cells.rows - 1 - step };
            (column, row, orientation.mirrored(row % 2 == 1, column % 2 == 1))
        })
    });
    way.collect()
}

/// The values that split points into `parts` parts of about the same size, by one coordinate in an orientation and then
/// by the other. The result has the first value of each part but the first.
///
/// The least value of all is not in the result, unless all values are equal. So some points always come before a value
/// of the result, and the division of pieces comes to an end, however many points are equal.
pub(super) fn quantiles(seen: impl Iterator<Item = [i64; 2]>, parts: usize) -> Vec<[i64; 2]> {
    let mut values: Vec<[i64; 2]> = seen.collect();
    let mut firsts = Vec::with_capacity(parts);
    for part in 1..parts {
        let place = part * values.len() / parts;
        let (before, &mut value, behind) = values.select_nth_unstable(place);
        let is_least = before.iter().all(|&other| other == value);
        let next = behind.iter().copied().filter(|&other| other > value).min();
        firsts.push(if is_least { next.unwrap_or(value) } else { value });
    }
    firsts
}

/// The number of the part that a value belongs to.
pub(super) fn part_of(value: [i64; 2], firsts: &[[i64; 2]]) -> usize {
    firsts.iter().filter(|&&first| value >= first).count()
}
