//! The third step: every point goes to the process of its tile.

use std::ops::Range;

use incircle::Point;

use crate::cuts::Cuts;
use crate::slice::Slice;
use crate::world::World;

/// The numbers of 32 bits of a point on its way: index, x, y.
const ROW: usize = 3;

/// The points of the tiles of one process.
pub struct Tiles {
    /// The lists of all processes, by rank: the number of points of each tile, then all rows, tile by tile.
    lists: Vec<Vec<u32>>,
    /// The place in each list at which the next tile begins.
    at: Vec<usize>,
    /// The number of tiles that were taken.
    taken: usize,
    /// The number of points of all tiles.
    pub points: u64,
}

/// Sends all points to the processes of their tiles.
pub fn exchange(world: &World, slice: Slice, cuts: &Cuts) -> Tiles {
    let stretches = stretches(&cuts.owners, world.size());
    let lists = world.exchange(lists(slice, cuts, &stretches));
    let own = stretches[world.rank()].len();
    let points = lists.iter().map(|list| (list.len() - own.min(list.len())) / ROW).sum::<usize>() as u64;
    Tiles { at: vec![own; lists.len()], lists, taken: 0, points }
}

/// The tiles of each process.
fn stretches(owners: &[usize], size: usize) -> Vec<Range<usize>> {
    let before = |rank: usize| owners.partition_point(|&owner| owner < rank);
    (0..size).map(|rank| before(rank)..before(rank + 1)).collect()
}

/// The lists for all processes. Within a tile, indices ascend.
fn lists(slice: Slice, cuts: &Cuts, stretches: &[Range<usize>]) -> Vec<Vec<u32>> {
    let tiles: Vec<u32> = slice.points.iter().map(|&point| cuts.tree.tile_of(point) as u32).collect();
    let mut counts = vec![0u32; cuts.owners.len()];
    for &tile in &tiles {
        counts[tile as usize] += 1;
    }
    let mut places = vec![0; counts.len()];
    let mut lists: Vec<Vec<u32>> = Vec::with_capacity(stretches.len());
    for stretch in stretches {
        let mut length = stretch.len();
        for tile in stretch.clone() {
            places[tile] = length;
            length += counts[tile] as usize * ROW;
        }
        let mut list = vec![0; length];
        list[..stretch.len()].copy_from_slice(&counts[stretch.clone()]);
        lists.push(list);
    }
    // An index of a set fits 32 bits.
    for (index, (point, tile)) in (slice.first as u32..).zip(slice.points.iter().zip(tiles)) {
        let place = &mut places[tile as usize];
        lists[cuts.owners[tile as usize]][*place..*place + ROW].copy_from_slice(&[index, point.x, point.y]);
        *place += ROW;
    }
    lists
}

impl Tiles {
    /// The points of the next tile of this process, with their indices, which ascend.
    pub fn next(&mut self) -> (Vec<u32>, Vec<Point>) {
        let (mut ids, mut points) = (Vec::new(), Vec::new());
        for (list, at) in self.lists.iter().zip(&mut self.at) {
            let count = list.get(self.taken).map_or(0, |&count| count as usize);
            for row in list[*at..*at + count * ROW].chunks_exact(ROW) {
                ids.push(row[0]);
                points.push(Point::new(row[1], row[2]));
            }
            *at += count * ROW;
        }
        self.taken += 1;
        (ids, points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_without_a_tile_has_an_empty_stretch() {
        assert_eq!(stretches(&[0, 0, 2], 4), [0..2, 2..2, 2..3, 3..3]);
    }
}
