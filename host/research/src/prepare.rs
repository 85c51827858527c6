//! Preparation of a set: duplicates are removed, the points are ordered, and the first three are made
//! to span a triangle.

use incircle_geometry::order::{distinct, Rounds};
use incircle_geometry::{Duplicate, Point};

use crate::order::{brio_dc, brio_rounds, Order};

/// A set, ready to be inserted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Prepared {
    /// The lowest input index of each distinct point, in rounds. Points on one line are one
    /// round in lexicographic order.
    pub rounds: Rounds,
    /// For each place of the order an earlier place whose point lies near, or the place itself. Orders without guides
    /// have an empty list.
    pub guides: Vec<u32>,
    /// Input points with the coordinates of an earlier one, sorted by index.
    pub duplicates: Vec<Duplicate>,
    /// Whether there are fewer than three distinct points, or all lie on one line.
    pub is_collinear: bool,
}

/// Removes duplicates and puts the points into this order. O(n), or the time of the order if that is longer.
pub fn prepare(points: &[Point], order: Order) -> Prepared {
    let (curve, duplicates) = distinct(points);
    let distinct = curve.into_indices();
    let mut prepared = Prepared { duplicates, ..Prepared::default() };
    let in_place = |places: Rounds| Rounds {
        order: places.order.into_iter().map(|place| distinct[place as usize]).collect(),
        starts: places.starts,
    };
    let along: Vec<Point> = distinct.iter().map(|&index| points[index as usize]).collect();
    match order {
        Order::BrioDc(by) => {
            let (rounds, guides) = brio_dc(&along, by).into_rounds();
            (prepared.rounds, prepared.guides) = (in_place(rounds), guides);
        }
        Order::Brio(curve, alpha) => prepared.rounds = in_place(brio_rounds(&along, curve, alpha)),
        Order::Input => {
            let mut order = distinct.clone();
            order.sort_unstable();
            prepared.rounds = Rounds::single(order);
        }
        Order::Random | Order::Along(_) => prepared.rounds = in_place(Rounds::single(order.order(&along))),
    }
    prepared.start_with_a_triangle(points);
    prepared
}

impl Prepared {
    /// Moves the first point that is not on one line with the first two to the third place, and its guide with it.
    fn start_with_a_triangle(&mut self, points: &[Point]) {
        let Some(found) = self.rounds.start_with_a_triangle(points) else {
            self.rounds.order.sort_unstable_by_key(|&index| points[index as usize]);
            (self.rounds.starts, self.guides, self.is_collinear) = (vec![0], Vec::new(), true);
            return;
        };
        let moved = |place: u32| match place as usize {
            place if place == found => 2,
            place if (2..found).contains(&place) => place as u32 + 1,
            _ => place,
        };
        if let Some(range) = self.guides.get_mut(2..=found) {
            range.rotate_right(1);
            // A guide that now comes after its point cannot guide it, so such a point guides itself.
            let guides = (0..).zip(&mut self.guides);
            guides.for_each(|(place, guide)| *guide = moved(*guide).min(place));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::BrioDc;
    use incircle_geometry::orient2d;
    use proptest::prelude::*;

    #[test]
    fn rounds_keep_their_points_when_the_third_is_found() {
        // Points 0 to 4 lie on a line; the rounds begin at points 0, 2, 4, 6.
        let line = [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 0), (6, 6), (7, 7)].map(Point::from);
        let rounds = Rounds { order: (0..8).collect(), starts: vec![0, 2, 4, 6] };
        let mut prepared = Prepared { rounds, guides: vec![0, 0, 0, 1, 2, 4, 5, 3], ..Prepared::default() };
        prepared.start_with_a_triangle(&line);
        assert!(!prepared.is_collinear);
        assert_eq!(prepared.rounds.order, [0, 1, 5, 2, 3, 4, 6, 7]);
        assert_eq!(prepared.rounds.starts, [0, 3, 5, 6]);
        assert_eq!(prepared.guides, [0, 0, 2, 0, 1, 3, 2, 4]);
    }

    #[test]
    fn guides_are_vertices_before_and_near() {
        let points: Vec<Point> = (0..900).map(|k| Point::new(k * 7919 % 10_007, k * 104_729 % 9973)).collect();
        for by in BrioDc::ALL {
            let prepared = prepare(&points, Order::BrioDc(by));
            let at = |place: usize| points[prepared.rounds.order[place] as usize];
            let apart = |p: Point, q: Point| p.x.abs_diff(q.x).max(p.y.abs_diff(q.y));
            assert!((3..900).all(|place| (prepared.guides[place] as usize) < place));
            // A nearest of 899 vertices is far nearer than any.
            let last = 800..900;
            assert!(last.clone().all(|place| apart(at(place), at(prepared.guides[place] as usize)) < 1000));
            assert!(last.clone().any(|place| apart(at(place), at(place - 700)) > 3000));
        }
    }

    proptest! {
        #[test]
        fn every_distinct_point_is_there_once_under_its_lowest_index(
            raw in prop::collection::vec((0u32..6, 0u32..6), 0..60),
            order in prop::sample::select(Order::all()),
            shift in prop::sample::select(vec![0u32, 20]),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x << shift, y << shift)).collect();
            let prepared = prepare(&points, order);
            let lowest = |index: u32| points.iter().position(|p| *p == points[index as usize]);
            for &index in &prepared.rounds.order {
                prop_assert_eq!(lowest(index), Some(index as usize));
            }
            for pair in prepared.duplicates.windows(2) {
                prop_assert!(pair[0].index < pair[1].index);
            }
            for duplicate in &prepared.duplicates {
                prop_assert!(duplicate.of < duplicate.index);
                prop_assert_eq!(lowest(duplicate.index), Some(duplicate.of as usize));
            }
            let mut all: Vec<u32> = prepared.rounds.order.clone();
            all.extend(prepared.duplicates.iter().map(|d| d.index));
            all.sort_unstable();
            prop_assert!(all.iter().copied().eq(0..points.len() as u32));
            let is_guided = matches!(order, Order::BrioDc(_)) && !prepared.is_collinear;
            prop_assert_eq!(prepared.guides.len(), if is_guided { prepared.rounds.order.len() } else { 0 });
            prop_assert!((0..).zip(&prepared.guides).all(|(place, &guide)| guide <= place));
            if let ([a, b, c, ..], false) = (&prepared.rounds.order[..], prepared.is_collinear) {
                let at = |index: u32| points[index as usize];
                prop_assert!(orient2d(at(*a), at(*b), at(*c)) != 0);
            }
        }
    }
}
