//! Visits: what the visit pipeline is asked for, and what it finds out.

use crate::mesh::Record;

/// The mark, in `after`, of the visit of a record outside a star.
pub(super) const OUTSIDE: usize = 32;

/// The mark, in `cavity_record`, of the test of the edge at which the chains round a star have met.
pub(super) const LAST_EDGE: u32 = 64;

/// One visit of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Visit {
    pub context: usize,
    /// Whether the record is rotated so that its neighbour `cavity_record` comes first.
    pub rotates: bool,
    /// Whether the visit takes the lock of the record.
    pub locks: bool,
    /// The entry of the ring, the entry after it, and the entry that stands for `cavity_record`.
    pub entry: usize,
    pub after: usize,
    pub cavity_entry: usize,
    pub cavity_record: u32,
    /// Id of the visited record.
    pub record: u32,
}

impl Visit {
    /// Whether this is the visit of a record outside a star, in a run of deletions or moves.
    pub(super) fn is_outside_star(&self) -> bool {
        self.locks && self.rotates && (self.entry == 0 || self.after == OUTSIDE)
    }

    /// Whether this is the visit of a record of a star, in a run of deletions or moves.
    pub(super) fn goes_round_star(&self) -> bool {
        self.locks && self.rotates && !self.is_outside_star()
    }

    /// Whether this is a test of four vertices, or of three and a place, in a run of deletions or moves.
    pub(super) fn is_hole_test(&self) -> bool {
        self.rotates && !self.locks
    }

    /// Whether this is the test of the edge at which the chains round a star have met.
    pub(super) fn is_last_edge(&self) -> bool {
        self.is_hole_test() && self.cavity_record == LAST_EDGE
    }

    /// Whether this is a root visit, which takes a lock and turns no record.
    pub(super) fn is_root(&self) -> bool {
        self.locks && !self.rotates
    }
}

/// One to three visits that one completion asks for.
///
/// The second visit is for the entry after that of the first, and the third for the entry after that of the second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Bundle {
    pub first: Visit,
    /// Number of visits, 1 to 3.
    pub count: u32,
    /// The entry after that of the second visit.
    second_after: usize,
    second_record: u32,
    third_record: u32,
}

impl Bundle {
    pub(super) fn one(first: Visit) -> Self {
        Self { first, count: 1, ..Self::default() }
    }

    /// Two visits. The second one is for the entry after that of the first.
    pub(super) fn pair(first: Visit, second_after: usize, second_record: u32) -> Self {
        Self { first, count: 2, second_after, second_record, third_record: 0 }
    }

    /// Three visits, each but the first for the entry after that of the one before.
    pub(super) fn three(first: Visit, second_after: usize, second_record: u32, third_record: u32) -> Self {
        Self { first, count: 3, second_after, second_record, third_record }
    }

    /// A visit that only reads a record.
    pub(super) fn look(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, ..Visit::default() })
    }

    /// A root visit, which takes the lock of the root.
    pub(super) fn root(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, locks: true, ..Visit::default() })
    }

    /// A visit without a lock, with the record rotated so that its neighbour `cavity_record` comes first.
    pub(super) fn turned(context: usize, cavity_record: u32, record: u32) -> Self {
        Self::one(Visit { context, rotates: true, cavity_record, record, ..Visit::default() })
    }

    /// The tests of the three neighbours of a root.
    pub(super) fn tests(root: &Completion) -> Self {
        let Visit { context, record, .. } = root.visit;
        let n = root.record.n;
        let first = Visit {
            context,
            rotates: true,
            locks: true,
            entry: 0,
            after: 1,
            cavity_entry: 0,
            cavity_record: record,
            record: n[0],
        };
        Self { first, count: 3, second_after: 2, second_record: n[1], third_record: n[2] }
    }

    /// The tests after a conflict: both halves of the edge move on to the neighbours behind it, the second half as
    /// the new entry `y`.
    pub(super) fn split(done: &Completion, y: usize) -> Self {
        let [_, n1, n2] = done.record.n;
        let first = Visit { after: y, cavity_entry: y, cavity_record: done.visit.record, record: n1, ..done.visit };
        Self { first, count: 2, second_after: done.visit.after, second_record: n2, third_record: 0 }
    }

    /// The visits of the bundle, in the order of their issue.
    pub(super) fn visits(&self) -> impl Iterator<Item = Visit> + '_ {
        (0..self.count).map(|place| self.visit(place))
    }

    /// The visit at this place of the bundle.
    pub(super) fn visit(&self, place: u32) -> Visit {
        match place {
            0 => self.first,
            1 => Visit { entry: self.first.after, after: self.second_after, record: self.second_record, ..self.first },
            _ => Visit { entry: self.second_after, after: 0, record: self.third_record, ..self.first },
        }
    }
}

/// A completed visit, with what it found out.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Completion {
    pub visit: Visit,
    /// The record as stored.
    pub stored: Record,
    /// The record, rotated if the visit asked for it.
    pub record: Record,
    /// The slot by which the record was rotated.
    pub slot: usize,
    /// Whether the visit took the lock.
    pub took: bool,
    /// Whether another context holds the lock.
    pub foreign: bool,
    /// Whether the record was not written yet, or being written, so that a walk must revisit it.
    pub again: bool,
    /// Whether the record conflicts with the context's point.
    pub conflict: bool,
    /// Whether the record holds the point, which only a solo insertion asks; and whether the point equals one of the
    /// record's vertices, and which, as the visit has read them.
    pub located: bool,
    pub falls_onto_corner: bool,
    pub corner: u32,
    /// The record at which a walk goes on.
    pub walk_next: u32,
    /// The sign of `orient2d(r[0], r[1], p)`.
    pub turn: i32,
    /// Whether the visit is one of a deletion, or of a move whose vertex is in the mesh; and one of such a move.
    pub finds: bool,
    pub moves: bool,
    /// In a run of deletions or moves: the slot of the context's vertex, if the record names it; and for a test of four
    /// vertices of a ring, whether the last one replaces the best apex.
    pub names: Option<usize>,
    pub replaces: bool,
    /// In a run of moves: whether the vertex keeps its edges at its new place, as far as this visit can tell.
    pub keeps: bool,
    /// Whether the record is free, so that its links lead on.
    pub is_free: bool,
}

impl Completion {
    /// Whether the visit has a fourth point from the vertex memory: that of a test of four vertices, or the one
    /// opposite the record before in the star of a vertex that moves.
    pub(super) fn fetches(&self) -> bool {
        match self.visit.locks {
            true => self.moves && self.visit.goes_round_star(),
            false => self.finds && self.visit.is_hole_test(),
        }
    }

    /// Whether the completion may ask for other visits, as all do but tests that find their edge final and visits
    /// outside a star. The last visit of a star that moves may ask for one more test (`is_last`).
    pub(super) fn may_ask(&self, finds: bool, is_last: bool) -> bool {
        match finds {
            true => !self.visit.is_outside_star() || self.foreign || is_last,
            false => !self.visit.rotates || self.conflict || self.foreign,
        }
    }
}
