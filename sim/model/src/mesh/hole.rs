//! The hole that the star of a deleted vertex leaves: its ring, and the triangles that fill it.

/// One edge of the ring around a vertex, counter-clockwise from `from` to that of the next edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingEdge {
    pub(super) from: u32,
    /// The record of the star on this edge.
    pub(super) record: u32,
    /// The record across the edge, which stays, and the slot in which it names `record`.
    pub(super) outside: u32,
    pub(super) slot: u8,
}

/// The other side of an edge of a triangle that fills a hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Across {
    /// The ring edge of this number.
    Ring(u8),
    /// This slot of the filling triangle of this number.
    Filling(u8, u8),
}

/// A triangle that fills a part of the hole. Its corners are numbers of ring edges, and stand for their `from`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filling {
    pub(super) corners: [u8; 3],
    /// `across[k]` is the other side of the edge opposite corner `k`.
    pub(super) across: [Across; 3],
}

/// A corner of a part of the hole, and the other side of the edge from it to the next corner.
pub(super) type Corner = (u8, Across);

/// The scratch memory of a deletion.
#[derive(Clone, Debug, Default)]
pub(super) struct Hole {
    pub(super) ring: Vec<RingEdge>,
    pub(super) fillings: Vec<Filling>,
    /// Parts of the hole that are still to be filled.
    pub(super) parts: Vec<Vec<Corner>>,
}
