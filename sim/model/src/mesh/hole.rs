//! The hole that the star of a deleted vertex leaves: its ring, and the triangles that fill it.
//!
//! Both models fill a hole in the same way, and each brings the tests of its own: by command they are made at once,
//! clock by clock each is a visit.

/// One edge of the ring around a vertex, counter-clockwise from `from` to that of the next edge.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RingEdge {
    pub(crate) from: u32,
    /// The record of the star on this edge.
    pub(crate) record: u32,
    /// The record across the edge, which stays, and the slot in which it names `record`.
    pub(crate) outside: u32,
    pub(crate) slot: u8,
    /// Whether the record across the edge is a ghost triangle.
    pub(crate) ghost_outside: bool,
}

/// The other side of an edge of a triangle that fills a hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Across {
    /// The ring edge of this number.
    Ring(u8),
    /// This slot of the filling triangle of this number.
    Filling(u8, u8),
}

/// A triangle that fills a part of the hole. Its corners are numbers of ring edges, and stand for their `from`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filling {
    pub(crate) corners: [u8; 3],
    /// `across[k]` is the other side of the edge opposite corner `k`.
    pub(crate) across: [Across; 3],
}

/// A corner of a part of the hole, and the other side of the edge from it to the next corner.
pub(crate) type Corner = (u8, Across);

/// The scratch memory of a deletion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hole {
    pub(crate) ring: Vec<RingEdge>,
    pub(crate) fillings: Vec<Filling>,
    /// Parts of the hole that are still to be filled.
    parts: Vec<Vec<Corner>>,
}

impl Hole {
    /// Begins to fill the hole inside the ring.
    pub(crate) fn open(&mut self) {
        self.fillings.clear();
        self.parts.clear();
        self.parts.push((0..self.ring.len() as u8).map(|edge| (edge, Across::Ring(edge))).collect());
    }

    /// A part that is still to be filled, turned so that its first two corners are finite unless it has only three.
    pub(crate) fn next_part(&mut self, infinite: u32) -> Option<Vec<Corner>> {
        let mut part = self.parts.pop()?;
        // The infinite vertex is on two edges, and a part has at least three.
        let is_finite = |pair: &[Corner]| pair.iter().all(|corner| self.vertex(corner) != infinite);
        let base = part.windows(2).position(is_finite).unwrap_or(part.len() - 1);
        part.rotate_left(base);
        Some(part)
    }

    /// The vertex of a corner.
    pub(crate) fn vertex(&self, &(edge, _): &Corner) -> u32 {
        self.ring[usize::from(edge)].from
    }

    /// Puts the triangle on the first edge of a part, with the corner at place `apex` as its third, and adds what is
    /// left of the part to the parts.
    pub(crate) fn put(&mut self, part: &[Corner], apex: usize) {
        let number = self.fillings.len() as u8;
        let corners = [0, 1, apex].map(|place| part[place].0);
        let mut across = [part[1].1, part[part.len() - 1].1, part[0].1];
        let ahead = apex > 2;
        let behind = apex < part.len() - 1;
        if behind {
            across[1] = Across::Filling(number, 1);
            let rest = part[apex..].iter().copied().chain([(part[0].0, across[1])]);
            self.parts.push(rest.collect());
        }
        if ahead {
            across[0] = Across::Filling(number, 0);
            let rest = part[1..apex].iter().copied().chain([(part[apex].0, across[0])]);
            self.parts.push(rest.collect());
        }
        // A side that is open for now is corrected by the triangle that is put there later.
        for (slot, side) in (0..).zip(across) {
            match side {
                Across::Filling(other, theirs) if other != number => {
                    self.fillings[usize::from(other)].across[usize::from(theirs)] = Across::Filling(number, slot);
                }
                _ => {}
            }
        }
        self.fillings.push(Filling { corners, across });
    }

    /// Whether no finite triangle is left beside the star and the hole is filled by ghost triangles alone, so that all
    /// other points lie on one line.
    pub(crate) fn is_flat(&self, infinite: u32) -> bool {
        let is_ghost =
            |filling: &Filling| filling.corners.iter().any(|&corner| self.ring[usize::from(corner)].from == infinite);
        let is_lonely = |(place, edge): (usize, &RingEdge)| {
            let ends = [edge.from, self.ring[(place + 1) % self.ring.len()].from];
            ends.contains(&infinite) || edge.ghost_outside
        };
        self.fillings.iter().all(is_ghost) && self.ring.iter().enumerate().all(is_lonely)
    }

    /// The ids of the triangles that fill the hole, and the two that are left over.
    ///
    /// A triangle on the ring keeps the id of the star's record on its first ring edge, so that the record outside need
    /// not be told. The others take ids that no triangle keeps.
    pub(crate) fn ids(&self) -> (Vec<u32>, Vec<u32>) {
        let mut left: Vec<Option<u32>> = self.ring.iter().map(|edge| Some(edge.record)).collect();
        let kept: Vec<Option<u32>> = self
            .fillings
            .iter()
            .map(|filling| {
                let mut edges = filling.across.iter().filter_map(|&across| match across {
                    Across::Ring(edge) => Some(usize::from(edge)),
                    Across::Filling(..) => None,
                });
                edges.next().and_then(|edge| left[edge].take())
            })
            .collect();
        let mut left = left.into_iter().flatten();
        let ids = kept.into_iter().filter_map(|id| id.or_else(|| left.next())).collect();
        (ids, left.collect())
    }
}
