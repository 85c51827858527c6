//! The edges of a mesh that constraints fix, with the constraints of each.

use alloc::vec;
use alloc::vec::Vec;

use super::repeats::Repeats;
use crate::pages::zeros;
use crate::sort::{sort_by_key, Entry, Keyed, Wide};

/// The pieces of constraints: the edges that must be in the mesh. A constraint is cut into pieces at each point on it.
/// Pieces that overlap are one, with the list of their constraints.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pieces {
    edges: Vec<[u32; 2]>,
    /// The end of the constraints of each piece in `constraints`.
    ends: Vec<u32>,
    constraints: Vec<u32>,
}

impl Pieces {
    /// Collects edges, each with both ends in rising order and the number of a constraint, whose repeats have the same
    /// edges. O(n) by a radix sort, and O(k log k) for each edge of `k` constraints.
    pub(crate) fn of(parts: Vec<([u32; 2], u32)>, repeats: &Repeats) -> Self {
        let entry = |([a, b], constraint): ([u32; 2], u32)| Wide::new(u64::from(a) << 32 | u64::from(b), constraint);
        let mut entries: Vec<Wide> = parts.into_iter().map(entry).collect();
        sort_by_key(&mut entries);
        let mut pieces = Self::default();
        let mut own = Vec::new();
        for piece in entries.chunk_by(|one, other| one.key() == other.key()) {
            own.clear();
            own.extend(piece.iter().map(Wide::value));
            for place in 0..own.len() {
                own.extend(repeats.of(own[place]).iter().map(|pair| pair[1]));
            }
            own.sort_unstable();
            own.dedup();
            pieces.edges.push([(piece[0].key() >> 32) as u32, piece[0].key() as u32]);
            pieces.constraints.extend_from_slice(&own);
            pieces.ends.push(pieces.constraints.len() as u32);
        }
        pieces
    }

    /// The pieces of constraints along a line of points, given the first and the last place of each on that line. There
    /// are fewer than 2^32 entries in all lists.
    pub(crate) fn along(line: &[u32], spans: &[[usize; 2]]) -> Self {
        // The number of constraints that begin at each place less those that end there, and then that along each piece.
        let mut counts = vec![0i64; line.len()];
        for &[low, high] in spans {
            counts[low] += 1;
            counts[high] -= 1;
        }
        let mut open = 0;
        for count in &mut counts {
            open += *count;
            *count = open;
        }
        let edge = |place: usize| [line[place].min(line[place + 1]), line[place].max(line[place + 1])];
        let mut order: Vec<usize> = (0..line.len()).filter(|&place| counts[place] > 0).collect();
        order.sort_unstable_by_key(|&place| edge(place));
        let mut pieces = Self { edges: order.iter().map(|&place| edge(place)).collect(), ..Self::default() };
        // The place in the list at which the next constraint of each piece is written.
        let (mut next, mut end) = (vec![0; line.len()], 0);
        for place in order {
            next[place] = end;
            end += counts[place] as usize;
            pieces.ends.push(end as u32);
        }
        pieces.constraints = zeros(end);
        for (constraint, &[low, high]) in (0..).zip(spans) {
            for place in &mut next[low..high] {
                pieces.constraints[*place] = constraint;
                *place += 1;
            }
        }
        pieces
    }

    /// The same pieces with other numbers of constraints: `of` has the new one of each. For pieces of a set that was
    /// snapped, [`Snapped::of`](super::Snapped::of) gives them the constraints of the input. O(n log n).
    #[must_use]
    pub fn renamed(&self, of: &[u32]) -> Self {
        let new = |&constraint: &u32| of.get(constraint as usize).copied().unwrap_or(constraint);
        Self::of(
            self.iter().flat_map(|(edge, own)| own.iter().map(move |own| (edge, new(own)))).collect(),
            &Repeats::default(),
        )
    }

    /// The number of pieces.
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// Whether there are no pieces.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// The pieces as pairs of points, the smaller index first, in sorted order.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The constraints of the piece at a place of [`edges`](Self::edges), in rising order; none past the last piece.
    pub fn constraints(&self, place: usize) -> &[u32] {
        let Some(&end) = self.ends.get(place) else { return &[] };
        let begin = place.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.constraints[begin as usize..end as usize]
    }

    /// The pieces with their constraints.
    pub fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[u32])> + '_ {
        self.edges.iter().enumerate().map(|(place, &edge)| (edge, self.constraints(place)))
    }

    /// The constraints of an edge, whose ends may come in either order; none if it is no piece. O(log n).
    pub fn of_edge(&self, [a, b]: [u32; 2]) -> &[u32] {
        self.edges.binary_search(&[a.min(b), a.max(b)]).map_or(&[], |place| self.constraints(place))
    }
}
