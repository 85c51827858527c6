//! The domain: the parts into which fixed edges cut the plane, and which of them are wanted.
//!
//! A flood across free edges gives each part a label. The part outside the hull is the first, and no ring runs around
//! it. From a part to the next, across a piece, the number of rings around changes by the constraints of that piece. As
//! the constraints of the boundary begin at each point as often as they end there, the number of a part does not depend
//! on the way to it.

use alloc::vec;
use alloc::vec::Vec;

use super::error::Error;
use super::fixed_mesh::FixedMesh;
use super::locate::Found;
use super::network::Network;
use super::pieces::Pieces;
use crate::living::plane::Side;
use crate::pages::zeros;
use crate::plan::{Domain, Mark, Plan};
use crate::site::Site;

/// Marks a triangle that no flood has met.
const NONE: u32 = u32::MAX;

/// The parts of the plane.
pub(super) struct Parts {
    /// The part of each triangle, by its number.
    pub of: Vec<u32>,
    /// The number of times that the rings run around each part.
    turns: Vec<i64>,
}

/// The constraints, as far as labelling the parts needs them.
pub(super) struct Boundary<'a> {
    pub pieces: &'a Pieces,
    /// The ends of each constraint, under the lowest indices of their places.
    pub ends: &'a [[u32; 2]],
    /// The number of constraints, from the first on, that bound the domain.
    pub count: usize,
    pub domain: Domain,
}

impl Boundary<'_> {
    /// Checks that the constraints of the boundary form rings, if the domain needs that.
    pub fn check(&self, points: usize) -> Result<(), Error> {
        if !matches!(self.domain, Domain::EvenOdd | Domain::NonZero) {
            return Ok(());
        }
        let mut begin = vec![0usize; points];
        let mut end = vec![0usize; points];
        for &[from, to] in &self.ends[..self.count] {
            begin[from as usize] += 1;
            end[to as usize] += 1;
        }
        let all = || (0u32..).zip(begin.iter().zip(&end));
        if self.domain == Domain::EvenOdd {
            let odd = all().find(|(_, (begin, end))| (*begin + *end) % 2 != 0);
            return odd.map_or(Ok(()), |(point, (begin, end))| Err(Error::Open { point, count: begin + end }));
        }
        let unbalanced = all().find(|(_, (begin, end))| begin != end);
        unbalanced.map_or(Ok(()), |(point, (&begin, &end))| Err(Error::Unbalanced { point, begin, end }))
    }

    /// By how much the number of turns at the left of an edge exceeds that at its right.
    fn turns<S: Site>(&self, [from, to]: [u32; 2], site: impl Fn(u32) -> S) -> i64 {
        let rises = |[from, to]: [u32; 2]| site(from) < site(to);
        let own = self.pieces.of_edge([from, to]).iter().filter(|&&constraint| (constraint as usize) < self.count);
        match self.domain {
            // A piece goes along its constraint, so both rise or both fall.
            Domain::NonZero => own
                .map(|&constraint| if rises(self.ends[constraint as usize]) == rises([from, to]) { 1 } else { -1 })
                .sum(),
            _ => own.count() as i64,
        }
    }
}

impl Parts {
    /// Gives all triangles to one part, whatever cuts them.
    pub fn one<S: Site>(network: &Network<'_, S>) -> Self {
        Self { of: zeros(network.plane.end() as usize), turns: vec![0] }
    }

    /// Labels all triangles. With [`Domain::All`] the outside of the hull is no part of its own: floods do not go
    /// through ghost triangles. O(n + p log p) for `p` pieces.
    pub fn of<S: Site>(network: &Network<'_, S>, boundary: &Boundary<'_>) -> Self {
        let mut parts = Self { of: vec![NONE; network.plane.end() as usize], turns: vec![] };
        let mut borders = Vec::new();
        if boundary.domain == Domain::All {
            for (triangle, _) in network.plane.iter().filter(|&(triangle, _)| !network.is_ghost(triangle)) {
                parts.flood(network, triangle, 0, &mut borders);
            }
            return parts;
        }
        parts.flood(network, network.plane.ghost, 0, &mut borders);
        while let Some(border) = borders.pop() {
            let beyond = network.plane.across(border).triangle();
            if parts.of[beyond as usize] == NONE {
                let own = parts.turns[parts.of[border.triangle() as usize] as usize];
                let turns = own - boundary.turns(network.plane.ends(border), |vertex| network.site(vertex));
                parts.flood(network, beyond, turns, &mut borders);
            }
        }
        parts
    }

    /// Labels the part of a triangle, unless it is labelled. Adds the sides of its fixed edges to the borders.
    fn flood<S: Site>(&mut self, network: &Network<'_, S>, first: u32, turns: i64, borders: &mut Vec<Side>) {
        if self.of[first as usize] != NONE {
            return;
        }
        let (label, has_ghosts) = (self.turns.len() as u32, network.is_ghost(first));
        self.turns.push(turns);
        self.of[first as usize] = label;
        let mut open = vec![first];
        let spares_ghosts = !has_ghosts;
        while let Some(triangle) = open.pop() {
            for slot in 0..3 {
                let side = Side::new(triangle, slot);
                if network.is_fixed(side) {
                    borders.push(side);
                    continue;
                }
                let beyond = network.plane.across(side).triangle();
                // Only the outside has ghost triangles, and where it is a part of its own its flood comes first.
                if self.of[beyond as usize] == NONE && !(spares_ghosts && network.is_ghost(beyond)) {
                    self.of[beyond as usize] = label;
                    open.push(beyond);
                }
            }
        }
    }

    /// For each part, whether it belongs to the domain.
    pub fn chosen<S: Site>(&self, network: &Network<'_, S>, plan: &Plan<'_, u32>) -> Result<Vec<bool>, Error> {
        let mut chosen: Vec<bool> = match plan.domain {
            Domain::All => vec![true; self.turns.len()],
            Domain::Holes => (0..self.turns.len()).map(|part| part != 0).collect(),
            Domain::EvenOdd => self.turns.iter().map(|turns| turns % 2 != 0).collect(),
            Domain::NonZero => self.turns.iter().map(|&turns| turns != 0).collect(),
        };
        if plan.domain == Domain::Holes {
            for part in self.marked(network, Mark::Hole, plan.holes)? {
                *chosen.get_mut(part as usize).ok_or(Error::NoMesh)? = false;
            }
        }
        Ok(chosen)
    }

    /// The parts of places.
    pub fn marked<S: Site>(&self, network: &Network<'_, S>, kind: Mark, places: &[u32]) -> Result<Vec<u32>, Error> {
        let mut near = 0;
        let part = |(number, &place): (usize, &u32)| match network.locate(network.site(place), near) {
            Found::Inside(triangle) => {
                near = triangle;
                Ok(self.of[triangle as usize])
            }
            Found::OnFixed(edge) => Err(Error::OnConstraint { kind, number, edge }),
            Found::Outside => Err(Error::Outside { kind, number }),
        };
        places.iter().enumerate().map(part).collect()
    }
}
