//! The validator's pieces of constraints: each constraint is cut at all points on it.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::buckets::Buckets;
use super::error::VerifyError;
use super::exact::ExactPoint;
use super::sites::Sites;

/// An edge that constraints fix. `from` is the lexicographically smaller end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub from: u32,
    pub to: u32,
    /// The number of constraints of the boundary along the piece.
    pub count: i64,
    /// The same, with those that run from `to` to `from` counted down.
    pub turns: i64,
}

/// Cuts constraints into pieces, of which each is there once, sorted by its ends. The first `boundary` constraints
/// bound the domain.
pub(super) fn pieces<P: ExactPoint>(
    sites: &Sites<'_, P>,
    constraints: &[[u32; 2]],
    boundary: usize,
) -> Result<Vec<Piece>, VerifyError> {
    let buckets = Buckets::of(sites.points, &sites.distinct);
    let mut pieces = Collected::default();
    let mut on = Vec::new();
    for (constraint, ends) in constraints.iter().enumerate() {
        let mut lowest = [0; 2];
        for (end, &index) in lowest.iter_mut().zip(ends) {
            let points = sites.points.len();
            let found = sites.lowest.get(index as usize);
            *end = *found.ok_or(VerifyError::ConstraintOutOfRange { constraint, index, points })?;
        }
        let compare = |one: &u32, other: &u32| sites.at(*one).compare(&sites.at(*other));
        let is_back = compare(&lowest[0], &lowest[1]).is_gt();
        let [a, b] = if is_back { [lowest[1], lowest[0]] } else { lowest };
        on.clear();
        on.extend([a, b]);
        buckets.along(sites.at(a), sites.at(b), |index| {
            let is_between = compare(&a, &index).is_lt() && compare(&index, &b).is_lt();
            if is_between && P::orient2d(sites.at(a), sites.at(b), sites.at(index)).is_eq() {
                on.push(index);
            }
        });
        on.sort_unstable_by(compare);
        on.dedup();
        let count = i64::from(constraint < boundary);
        let turns = if is_back { -count } else { count };
        pieces.extend(on.windows(2).map(|two| Piece { from: two[0], to: two[1], count, turns }));
        // Of edges that do not cross there are fewer than three for each point.
        if pieces.merged > 3 * sites.points.len() {
            return Err(VerifyError::ConstraintsCross { constraint });
        }
    }
    pieces.merge();
    Ok(pieces.list)
}

/// Pieces while they are collected. Those with the same ends are merged again and again, so that constraints that
/// overlap take no more memory than their edges.
#[derive(Debug, Default)]
struct Collected {
    list: Vec<Piece>,
    /// The number of pieces after the last merge.
    merged: usize,
}

impl Collected {
    /// The least number of pieces that are merged.
    const FEW: usize = 1 << 12;

    fn extend(&mut self, pieces: impl Iterator<Item = Piece>) {
        self.list.extend(pieces);
        if self.list.len() > 2 * self.merged + Self::FEW {
            self.merge();
        }
    }

    fn merge(&mut self) {
        self.list.sort_unstable_by_key(|piece| (piece.from, piece.to));
        self.list.dedup_by(|later, kept| {
            let is_same = (later.from, later.to) == (kept.from, kept.to);
            if is_same {
                kept.count += later.count;
                kept.turns += later.turns;
            }
            is_same
        });
        self.merged = self.list.len();
    }
}

/// Checks that the pieces of the boundary begin as often as they end at each point, or, if it only matters how many
/// there are, that their number at each point is even.
pub(super) fn check_closed(pieces: &[Piece], points: usize, is_directed: bool) -> Result<(), VerifyError> {
    let mut sums = vec![0; points];
    for piece in pieces {
        if is_directed {
            sums[piece.from as usize] += piece.turns;
            sums[piece.to as usize] -= piece.turns;
        } else {
            sums[piece.from as usize] += piece.count;
            sums[piece.to as usize] += piece.count;
        }
    }
    match sums.iter().position(|sum| if is_directed { *sum != 0 } else { sum % 2 != 0 }) {
        Some(point) => Err(VerifyError::NotClosed { point }),
        None => Ok(()),
    }
}

/// The piece directly below a place, if there is one; an error if the place is on a piece. "Below" is along a line
/// that is inclined so little that the lexicographic order is the order from left to right.
pub(super) fn below<P: ExactPoint>(
    sites: &Sites<'_, P>,
    pieces: &[Piece],
    q: P,
    is_own: impl Fn(&Piece) -> bool,
) -> Result<Option<usize>, [u32; 2]> {
    let mut nearest: Option<usize> = None;
    for (number, piece) in pieces.iter().enumerate() {
        let (a, b) = (sites.at(piece.from), sites.at(piece.to));
        let (from, to) = (a.compare(&q), b.compare(&q));
        if is_own(piece) || from.is_gt() || to.is_lt() {
            continue;
        }
        match P::orient2d(a, b, q) {
            Ordering::Equal => return Err([piece.from, piece.to]),
            // An edge that ends here is above or below by its other end, which another edge tells as well.
            Ordering::Greater if to.is_gt() => {
                let is_higher = |best: usize| is_above(sites, piece, &pieces[best]);
                if nearest.is_none_or(is_higher) {
                    nearest = Some(number);
                }
            }
            _ => {}
        }
    }
    Ok(nearest)
}

/// Whether one of two pieces that do not cross, and that have places on one upright line, is above the other.
fn is_above<P: ExactPoint>(sites: &Sites<'_, P>, one: &Piece, other: &Piece) -> bool {
    let side = |piece: &Piece, end: u32| P::orient2d(sites.at(piece.from), sites.at(piece.to), sites.at(end));
    let compare = |one: u32, other: u32| sites.at(one).compare(&sites.at(other));
    let at_start = match compare(one.from, other.from) {
        Ordering::Greater => side(other, one.from),
        Ordering::Less => side(one, other.from).reverse(),
        Ordering::Equal => Ordering::Equal,
    };
    at_start
        .then_with(|| match compare(one.to, other.to) {
            Ordering::Less => side(other, one.to),
            _ => side(one, other.to).reverse(),
        })
        .is_gt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_constraints_that_overlap_take_the_memory_of_their_edges() {
        let mut collected = Collected::default();
        let edge =
            |from: u32| Piece { from, to: from + 1, count: 1, turns: if from.is_multiple_of(2) { 1 } else { -1 } };
        for _ in 0..5000 {
            collected.extend((0..100).map(edge));
        }
        collected.merge();
        assert_eq!((collected.list.len(), collected.list[7].count, collected.list[7].turns), (100, 5000, -5000));
        assert!(collected.list.capacity() < 4 * Collected::FEW, "{}", collected.list.capacity());
    }
}
