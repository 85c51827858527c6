//! Forcing all constraints into a mesh, and listing what each becomes.

use alloc::vec::Vec;

use super::error::Error;
use super::force::{step, Stop};
use super::network::Network;
use super::pieces::Pieces;
use super::repeats::{by_ends, Repeats};
use crate::pages;
use crate::site::Site;

/// A function that is called from time to time, and whose error ends the work.
pub(super) type GoOn<'a, E> = &'a mut dyn FnMut() -> Result<(), E>;

/// Entries that the list of the constraints of all pieces may have. They take 3 GiB, so lists stay below 32 bits, too.
pub(super) const MOST_PARTS: usize = 1 << 28;
/// The number of pieces after which the caller is asked whether the work goes on.
const PIECES_PER_LOOK: usize = 64;

/// The number of constraints with an end at each vertex.
struct Crowds(Vec<u32>);

impl Crowds {
    /// Constraints at a vertex that may all turn around it.
    const FEW: u32 = 8;

    fn of(ends: &[[u32; 2]], vertices: usize) -> Self {
        let mut counts = pages::zeros(vertices);
        ends.as_flattened().iter().for_each(|&end| counts[end as usize] += 1);
        Self(counts)
    }

    /// The ends of a constraint, so that it does not begin where very many others do. Finding the way from a vertex
    /// takes time in proportion to its neighbours, and a vertex with many constraints has as many neighbours.
    fn turned(&self, [from, to]: [u32; 2]) -> [u32; 2] {
        let [own, other] = [from, to].map(|end| self.0[end as usize]);
        if own > Self::FEW && other < own {
            [to, from]
        } else {
            [from, to]
        }
    }
}

/// The pieces of constraints, each with the number of one constraint; its repeats are added at the end.
struct Listing {
    parts: Vec<([u32; 2], u32)>,
    repeats: Repeats,
    /// The number of entries, repeats included.
    entries: usize,
}

impl Listing {
    fn new(repeats: Repeats, constraints: usize) -> Self {
        Self { parts: Vec::with_capacity(constraints), repeats, entries: 0 }
    }

    /// Counts pieces of a constraint and of its repeats, and refuses more than `MOST_PARTS`.
    fn count(&mut self, count: usize, constraint: u32) -> Result<(), Error> {
        let more = count.saturating_mul(1 + self.repeats.of(constraint).len());
        self.entries = self.entries.saturating_add(more);
        match self.entries <= MOST_PARTS {
            true => Ok(()),
            false => Err(Error::TooManyPieces { max: MOST_PARTS }),
        }
    }

    fn push(&mut self, [a, b]: [u32; 2], constraint: u32) {
        self.parts.push(([a.min(b), a.max(b)], constraint));
    }

    fn pieces(self) -> Pieces {
        Pieces::of(self.parts, &self.repeats)
    }
}

/// Forces all constraints into the mesh, in their order. If two of them cross, their numbers come in place of the
/// pieces, the smaller one first.
///
/// # Errors
/// There are too many pieces, the triangles are no mesh, or `go_on` ends the work.
pub(super) fn force_all<S: Site, E: From<Error>>(
    network: &mut Network<'_, S>,
    ends: &[[u32; 2]],
    go_on: GoOn<'_, E>,
) -> Result<Result<Pieces, [u32; 2]>, E> {
    let crowds = Crowds::of(ends, network.sites.len());
    let mut listing = Listing::new(Repeats::in_order(&by_ends(ends)), ends.len());
    let is_repeat = listing.repeats.flags(ends.len());
    for (constraint, &ends) in (0..).zip(ends).filter(|(constraint, _)| !is_repeat[*constraint as usize]) {
        let [mut at, to] = crowds.turned(ends);
        while at != to {
            let next = match step(network, at, to) {
                Ok(next) => next,
                Err(Stop::NoMesh) => return Err(Error::NoMesh.into()),
                Err(Stop::Crossing(edge)) => {
                    let other = listing.parts.iter().find(|(piece, _)| *piece == edge);
                    // Every fixed edge is a piece.
                    let &(_, other) = other.ok_or(Error::NoMesh)?;
                    return Ok(Err([other, constraint]));
                }
            };
            listing.count(1, constraint)?;
            listing.push([at, next], constraint);
            if listing.parts.len().is_multiple_of(PIECES_PER_LOOK) {
                go_on()?;
            }
            at = next;
        }
    }
    Ok(Ok(listing.pieces()))
}

/// The pieces of constraints between points of one line, which has no triangles. `hull` has its points in order.
///
/// # Errors
/// There are too many pieces, which are counted before any is listed, or a point is not on the line.
pub(super) fn pieces_on_line<S: Site>(places: &[S], hull: &[u32], ends: &[[u32; 2]]) -> Result<Pieces, Error> {
    let site = |index: u32| places.get(index as usize).ok_or(Error::NoMesh);
    let line: Vec<&S> = hull.iter().map(|&index| site(index)).collect::<Result<_, _>>()?;
    let (mut spans, mut entries) = (Vec::with_capacity(ends.len()), 0usize);
    for &pair in ends {
        let mut ranks = [0; 2];
        for (rank, end) in ranks.iter_mut().zip(pair) {
            *rank = line.binary_search(&site(end)?).map_err(|_| Error::NoMesh)?;
        }
        let [low, high] = [ranks[0].min(ranks[1]), ranks[0].max(ranks[1])];
        entries = entries.saturating_add(high - low);
        spans.push([low, high]);
    }
    if entries > MOST_PARTS {
        return Err(Error::TooManyPieces { max: MOST_PARTS });
    }
    Ok(Pieces::along(hull, &spans))
}
