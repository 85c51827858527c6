//! The first step: each process reads its slice of the points, a range of the indices of the whole set.

use std::ops::Range;
use std::path::{Path, PathBuf};

use incircle::Point;
use incircle_cli::formats::npy::Rows;
use incircle_cli::{Coordinates, Extent, Failure, Input};

use crate::world::{Halt, World};

/// The most points of a set: each index fits 32 bits, and two values stay free.
const MOST_POINTS: u64 = u32::MAX as u64 - 1;

/// The points that one process reads.
pub struct Slice {
    /// The number of points of the whole set.
    pub total: u64,
    /// The index of the first point.
    pub first: u64,
    /// The points, in steps of the lattice of the whole set, counted from the smallest x and y.
    pub points: Vec<Point>,
}

/// Reads the slice of this process. The sequence of the inputs numbers the points.
///
/// # Errors
/// An input cannot be read, has no lattice of at most 32 bits in common with the others, or changes meanwhile.
pub fn read(world: &World, inputs: &[PathBuf]) -> Result<Slice, Halt> {
    let counts = world.agree(count(world, inputs))?;
    let counts = in_turns(&world.gather(&counts), inputs.len());
    let total = counts.iter().try_fold(0u64, |sum, &count| sum.checked_add(count));
    let total = total.filter(|&total| total <= MOST_POINTS).ok_or_else(|| {
        Failure::input(format!("the inputs have more than {MOST_POINTS} points, which is the most of one set"))
    });
    let total = world.agree(total)?;
    let range = range_of(total, world.rank(), world.size());
    let (pieces, own) = world.agree(pieces(inputs, &counts, &range))?;
    let mut extent = Extent::default();
    let all = world.gather(&own.to_words());
    let ground = all.iter().try_for_each(|words| extent.add_words(words)).and_then(|()| extent.ground());
    let ground = world.agree(ground)?;
    let mut points = Vec::with_capacity((range.end - range.start) as usize);
    let laid = pieces.into_iter().try_for_each(|piece| ground.lay(&piece, &mut points));
    // The lattice was made of these points, so all of them are on it.
    world.agree(laid.ok_or_else(|| Failure::input("the lattice of the set does not have all of its points")))?;
    Ok(Slice { total, first: range.start, points })
}

/// The indices of the points of a process, of `total`.
fn range_of(total: u64, rank: usize, size: usize) -> Range<u64> {
    let before = |rank: usize| (u128::from(total) * rank as u128 / size as u128) as u64;
    before(rank)..before(rank + 1)
}

/// The numbers of points of some inputs. Each process opens some, so that a file server is not asked for every file by
/// every process.
fn count(world: &World, inputs: &[PathBuf]) -> Result<Vec<u64>, Failure> {
    let own = inputs.iter().skip(world.rank()).step_by(world.size());
    own.map(|path| {
        let is_array = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npy"));
        if !is_array {
            return Err(Failure::usage("only .npy files that are not packed are read: convert the points")
                .in_file(path.display()));
        }
        Ok(open(path)?.count() as u64)
    })
    .collect()
}

/// Puts the numbers of [`count`] into the sequence of the inputs.
fn in_turns(lists: &[Vec<u64>], count: usize) -> Vec<u64> {
    let at = |input: usize| lists.get(input % lists.len())?.get(input / lists.len()).copied();
    (0..count).map(|input| at(input).unwrap_or(0)).collect()
}

/// Opens an input. Failures name it.
fn open(path: &Path) -> Result<Rows, Failure> {
    Input::open(path, true).and_then(Rows::open).map_err(|failure| failure.in_file(path.display()))
}

/// Reads the points with these indices, and finds their extent.
fn pieces(inputs: &[PathBuf], counts: &[u64], range: &Range<u64>) -> Result<(Vec<Coordinates>, Extent), Failure> {
    let (mut pieces, mut extent, mut first) = (Vec::new(), Extent::default(), 0);
    for (path, &count) in inputs.iter().zip(counts) {
        let place = |index: u64| (index.clamp(first, first + count) - first) as usize;
        let own = place(range.start)..place(range.end);
        first += count;
        if own.is_empty() {
            continue;
        }
        let in_file = |failure: Failure| failure.in_file(path.display());
        let mut rows = open(path)?;
        if rows.count() as u64 != count {
            return Err(in_file(Failure::input("the file has changed since the run began: leave the inputs alone")));
        }
        rows.each(own, &mut |piece| {
            extent.add(&piece)?;
            pieces.push(piece);
            Ok(())
        })
        .map_err(in_file)?;
    }
    Ok((pieces, extent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_equal_and_leave_nothing_out() {
        for (total, size) in [(0, 3), (1, 4), (10, 3), (MOST_POINTS, 7)] {
            let ranges: Vec<_> = (0..size).map(|rank| range_of(total, rank, size)).collect();
            assert_eq!((ranges[0].start, ranges[size - 1].end), (0, total));
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = || ranges.iter().map(|range| range.end - range.start);
            assert!(lengths().max() <= lengths().min().map(|least| least + 1));
        }
    }

    #[test]
    fn numbers_of_points_come_back_in_the_sequence_of_the_inputs() {
        assert_eq!(in_turns(&[vec![1, 4, 7], vec![2, 5], vec![3, 6]], 7), [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(in_turns(&[vec![9], vec![], vec![]], 1), [9]);
    }
}
