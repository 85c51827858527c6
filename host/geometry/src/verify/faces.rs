//! The validator's faces: the parts into which pieces of constraints cut the plane, and which of them are the domain.
//!
//! The sides of pieces that follow one another around a face are joined. Where the pieces form several groups that do
//! not touch, the outside of a group is a side of the piece directly below its leftmost point, or the unbounded face.

use alloc::vec;
use alloc::vec::Vec;

use super::error::VerifyError;
use super::exact::ExactPoint;
use super::fixed::{Piece, Pieces, Under};
use super::sites::Sites;
use crate::plan::{Domain, Mark};

/// Items in groups. The leader of a group is its smallest item.
struct Groups(Vec<usize>);

impl Groups {
    fn of(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn leader(&mut self, mut item: usize) -> usize {
        while self.0[item] != item {
            self.0[item] = self.0[self.0[item]];
            item = self.0[item];
        }
        item
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.leader(one), self.leader(other));
        self.0[one.max(other)] = one.min(other);
    }

    fn leaders(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|item| self.leader(item)).collect()
    }
}

/// The ends of a side. Side `2 k` is piece `k` from its smaller end on, and side `2 k + 1` is the way back.
fn ends(pieces: &[Piece], side: usize) -> [u32; 2] {
    let Piece { from, to, .. } = pieces[side / 2];
    if side.is_multiple_of(2) {
        [from, to]
    } else {
        [to, from]
    }
}

/// The face at the left of each side, and behind the last side the unbounded face.
pub(super) struct Faces(Vec<usize>);

impl Faces {
    /// Joins the sides of all faces. O(p log p).
    pub(super) fn of<P: ExactPoint>(sites: &Sites<'_, P>, Pieces { list: pieces, under, .. }: &Pieces) -> Self {
        let from = |side: usize| ends(pieces, side)[0];
        // The sides that leave each point, counter-clockwise from the one that points down. Those to the right are
        // first.
        let mut leaving: Vec<usize> = (0..2 * pieces.len()).collect();
        leaving.sort_unstable_by(|&one, &other| {
            let ([at, p], [_, q]) = (ends(pieces, one), ends(pieces, other));
            let turn = || P::orient2d(sites.at(at), sites.at(q), sites.at(p));
            at.cmp(&from(other)).then_with(|| (one % 2).cmp(&(other % 2))).then_with(turn)
        });
        let mut faces = Groups::of(2 * pieces.len() + 1);
        for around in leaving.chunk_by(|&one, &other| from(one) == from(other)) {
            // The face at the left of a side that arrives goes on at the right neighbour of the way back.
            let before = around.iter().cycle().skip(around.len() - 1);
            around.iter().zip(before).for_each(|(&side, &before)| faces.join(side ^ 1, before));
        }
        let mut groups = Groups::of(sites.points.len());
        pieces.iter().for_each(|piece| groups.join(piece.from as usize, piece.to as usize));
        let groups = groups.leaders();
        let mut is_known = vec![false; sites.points.len()];
        for &point in &sites.distinct {
            let group = groups[point as usize];
            let first = leaving.partition_point(|&side| from(side) < point);
            let lowest = leaving.get(first).filter(|&&side| from(side) == point);
            let Some(&lowest) = lowest.filter(|_| !is_known[group]) else { continue };
            is_known[group] = true;
            // No piece runs to the left from the leftmost point of a group.
            let face = match under[point as usize] {
                Under::Piece(piece) => 2 * piece,
                Under::On(_) | Under::Nothing => 2 * pieces.len(),
            };
            faces.join(lowest ^ 1, face);
        }
        Self(faces.leaders())
    }

    /// Whether the faces at the left and at the right of each piece belong to the domain. The marks of the pieces are
    /// holes.
    pub(super) fn chosen(
        &self,
        Pieces { list: pieces, marks, .. }: &Pieces,
        domain: Domain,
    ) -> Result<Vec<[bool; 2]>, VerifyError> {
        let unbounded = self.0[2 * pieces.len()];
        let mut is_in: Vec<bool> = match domain {
            Domain::All => vec![true; self.0.len()],
            Domain::Holes => (0..self.0.len()).map(|face| face != unbounded).collect(),
            _ => {
                let turns = self.turns(pieces, domain);
                turns.iter().map(|turns| if domain == Domain::EvenOdd { turns % 2 != 0 } else { *turns != 0 }).collect()
            }
        };
        if domain == Domain::Holes {
            for (number, &under) in marks.iter().enumerate() {
                let face = match under {
                    Under::Piece(piece) => 2 * piece,
                    Under::Nothing => 2 * pieces.len(),
                    Under::On(piece) => {
                        let Piece { from, to, .. } = pieces[piece];
                        return Err(VerifyError::MarkOnConstraint { kind: Mark::Hole, number, edge: [from, to] });
                    }
                };
                is_in[self.0[face]] = false;
            }
        }
        Ok((0..pieces.len()).map(|piece| [2 * piece, 2 * piece + 1].map(|side| is_in[self.0[side]])).collect())
    }

    /// How often the boundary runs around each face, by the leader of the face.
    fn turns(&self, pieces: &[Piece], domain: Domain) -> Vec<i64> {
        let mut beside: Vec<(usize, usize, i64)> = Vec::new();
        for (number, piece) in pieces.iter().enumerate() {
            let [left, right] = [self.0[2 * number], self.0[2 * number + 1]];
            let more = if domain == Domain::NonZero { piece.turns } else { piece.count };
            beside.extend([(right, left, more), (left, right, -more)]);
        }
        beside.sort_unstable();
        let unbounded = self.0[2 * pieces.len()];
        let mut turns = vec![None; self.0.len()];
        turns[unbounded] = Some(0);
        let mut open = vec![unbounded];
        while let Some(face) = open.pop() {
            let first = beside.partition_point(|&(from, ..)| from < face);
            for &(_, next, more) in beside[first..].iter().take_while(|&&(from, ..)| from == face) {
                if turns[next].is_none() {
                    turns[next] = turns[face].map(|own| own + more);
                    open.push(next);
                }
            }
        }
        turns.into_iter().map(Option::unwrap_or_default).collect()
    }
}
