//! The visits of the living engine.

/// What a visit is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ask {
    /// A step of a walk.
    Walk,
    /// The root of an attempt, under its lock.
    Root,
    /// Whether a record conflicts with the point that is inserted, under its lock.
    Test {
        /// The entry of the ring, the entry after it, and the entry that stands for the cavity record.
        entry: u8,
        after: u8,
        cavity_entry: u8,
    },
    /// A record of the star, under its lock; `left` says that the visits go round counter-clockwise. `carried` is the
    /// corner of the record before that this one does not have.
    Star { left: bool, carried: u32 },
    /// The record across the edge of the star's record at this place, under its lock.
    Outside { place: i8 },
    /// No record: a test of four vertices, or whether `corners` with the new point conflicts.
    Corners { corners: [u32; 3], other: u32 },
    /// A record around the vertex that is the nearest so far.
    Around { left: bool },
    /// The ghost triangle before one that sees the place.
    Hull,
}

impl Ask {
    /// Whether the visit takes the lock of its record.
    pub(super) fn locks(self) -> bool {
        matches!(self, Self::Root | Self::Test { .. } | Self::Star { .. } | Self::Outside { .. })
    }
}

/// One visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Visit {
    pub context: usize,
    pub ask: Ask,
    pub record: u32,
    /// The record from which the visit came, for those that turn their record by it.
    pub from: u32,
}

impl Visit {
    pub(super) fn new(context: usize, ask: Ask, record: u32) -> Self {
        Self { context, ask, record, from: record }
    }

    /// A visit that comes from a record across an edge.
    pub(super) fn across(context: usize, ask: Ask, record: u32, from: u32) -> Self {
        Self { context, ask, record, from }
    }
}

/// One to three visits that enter the queue in one clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bundle([Option<Visit>; 3]);

impl Bundle {
    pub(super) fn add(&mut self, visit: Visit) {
        if let Some(place) = self.0.iter_mut().find(|place| place.is_none()) {
            *place = Some(visit);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0[0].is_none()
    }

    pub(super) fn visits(&self) -> impl Iterator<Item = Visit> + '_ {
        self.0.iter().copied().flatten()
    }
}
