//! The validator's view of the input: the distinct points, their hull, and the index that stands for each place.

use alloc::vec;
use alloc::vec::Vec;

use crate::point::Duplicate;

use super::exact::ExactPoint;

/// The points of an input, sorted, with the lowest index of each place.
pub(super) struct Sites<'a, P> {
    pub(super) points: &'a [P],
    /// Lowest index of each distinct point, in lexicographic order of the points.
    pub(super) distinct: Vec<u32>,
    /// For each input index, the lowest index of the same coordinates.
    pub(super) lowest: Vec<u32>,
}

impl<'a, P: ExactPoint> Sites<'a, P> {
    /// Sorts the points and finds the lowest index of each place. O(n log n).
    pub(super) fn of(points: &'a [P]) -> Self {
        let mut distinct: Vec<u32> = (0..points.len() as u32).collect();
        let compare = |one: u32, other: u32| points[one as usize].compare(&points[other as usize]);
        distinct.sort_unstable_by(|&one, &other| compare(one, other).then(one.cmp(&other)));
        let mut lowest = vec![0; points.len()];
        distinct.dedup_by(|later, kept| {
            let equal = compare(*later, *kept).is_eq();
            lowest[*later as usize] = if equal { *kept } else { *later };
            equal
        });
        if let Some(&first) = distinct.first() {
            lowest[first as usize] = first;
        }
        Self { points, distinct, lowest }
    }

    pub(super) fn at(&self, index: u32) -> P {
        self.points[index as usize]
    }

    /// Whether there are fewer than three distinct points, or all lie on one line.
    pub(super) fn are_collinear(&self) -> bool {
        let [first, second, rest @ ..] = &self.distinct[..] else {
            return true;
        };
        let (a, b) = (self.at(*first), self.at(*second));
        rest.iter().all(|&index| P::orient2d(a, b, self.at(index)).is_eq())
    }

    /// The hull by Andrew's monotone chain, counter-clockwise from its lowest index, with the points in the middle of
    /// its edges. Collinear points give all distinct points in lexicographic order. O(n).
    pub(super) fn hull(&self) -> Vec<u32> {
        if self.are_collinear() {
            return self.distinct.clone();
        }
        let mut hull = self.chain(self.distinct.iter().copied());
        hull.extend(self.chain(self.distinct.iter().rev().copied()));
        let start = (0..hull.len()).min_by_key(|&place| hull[place]);
        hull.rotate_left(start.unwrap_or(0));
        hull
    }

    /// One side of the hull, which has no right turn, without its last point.
    fn chain(&self, sorted: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut chain: Vec<u32> = Vec::new();
        for next in sorted {
            while let [.., before, last] = chain[..] {
                if P::orient2d(self.at(before), self.at(last), self.at(next)).is_ge() {
                    break;
                }
                chain.pop();
            }
            chain.push(next);
        }
        chain.pop();
        chain
    }

    /// The first of some places that lies outside the hull of points that are not all on one line. O(n), and O(log n)
    /// for each place.
    pub(super) fn outside(&self, places: &[P]) -> Option<usize> {
        let (Some(&first), Some(&last)) = (self.distinct.first(), self.distinct.last()) else { return Some(0) };
        if places.is_empty() {
            return None;
        }
        let mut lower = self.chain(self.distinct.iter().copied());
        lower.push(last);
        let mut upper = self.chain(self.distinct.iter().rev().copied());
        upper.push(first);
        upper.reverse();
        let is_outside = |place: &P| {
            let is_before = |&index: &u32| self.at(index).compare(place).is_lt();
            // The turn from the edge of a chain at this place to the place.
            let turn = |chain: &[u32]| {
                let end = chain.partition_point(is_before).clamp(1, chain.len() - 1);
                P::orient2d(self.at(chain[end - 1]), self.at(chain[end]), *place)
            };
            let is_beyond = place.compare(&self.at(first)).is_lt() || place.compare(&self.at(last)).is_gt();
            is_beyond || turn(&lower).is_lt() || turn(&upper).is_gt()
        };
        places.iter().position(is_outside)
    }

    /// The input points with the coordinates of an earlier one, sorted by index.
    pub(super) fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        let all = (0..).zip(self.lowest.iter());
        all.filter(|(index, of)| index != *of).map(|(index, &of)| Duplicate { index, of })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::Point;

    fn points(raw: &[(u32, u32)]) -> Vec<Point> {
        raw.iter().map(|&pair| pair.into()).collect()
    }

    #[test]
    fn the_hull_of_a_block_has_its_edge_points_and_not_its_middle() {
        let block: Vec<Point> = (0..9).map(|k| Point::new(k / 3, k % 3)).collect();
        assert_eq!(Sites::of(&block).hull(), [0, 3, 6, 7, 8, 5, 2, 1]);
    }

    #[test]
    fn the_hull_starts_at_its_lowest_index() {
        let square = points(&[(5, 5), (9, 9), (0, 9), (9, 0), (0, 0)]);
        assert_eq!(Sites::of(&square).hull(), [1, 2, 4, 3]);
    }

    #[test]
    fn collinear_points_are_their_own_hull() {
        for raw in [&[][..], &[(1, 1)], &[(1, 1), (1, 1)], &[(3, 3), (1, 1), (2, 2)]] {
            let points = points(raw);
            let sites = Sites::of(&points);
            assert!(sites.are_collinear());
            assert_eq!(sites.hull(), sites.distinct);
        }
    }

    #[test]
    fn duplicates_point_to_the_lowest_index() {
        let points = points(&[(1, 1), (0, 0), (1, 1), (0, 0), (1, 1)]);
        let pairs: Vec<(u32, u32)> = Sites::of(&points).duplicates().map(|d| (d.index, d.of)).collect();
        assert_eq!(pairs, [(2, 0), (3, 1), (4, 0)]);
    }
}
