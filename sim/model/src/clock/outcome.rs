//! What a completed visit leads to, and what it has to look at for that. Insertions and deletions have this in common.

use super::attempt::Attempt;
use super::commit_job::CommitJob;
use super::defect::Defect;
use super::holes::{Hole, Star};
use super::memory::Entry;
use super::release_job::ReleaseJob;
use super::visit::{Bundle, Completion};
use super::wires::Registers;
use incircle_protocol::Config;

/// The consequences of a completing visit for its context.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Outcome {
    pub context: usize,
    /// The visits to be made next.
    pub push: Option<Bundle>,
    /// Whether no visit of the context is in flight any more.
    pub sleeps: bool,
    /// Whether the context tries its point again when it wakes.
    pub will_retry: bool,
    /// The record at which the context then starts to walk.
    pub root: Option<u32>,
    /// The attempt after this visit.
    pub attempt: Option<Attempt>,
    /// A final edge of the boundary, with its place in the list.
    pub entry: Option<(usize, Entry)>,
    /// An inner record, with its place in the list.
    pub inner: Option<(u32, u32)>,
    /// A lock that was set, with its place in the log.
    pub lock: Option<(u32, u32)>,
    pub commit: Option<CommitJob>,
    pub release: Option<ReleaseJob>,
    /// Whether the context acquires the priority, if that is free.
    pub asks_for_priority: bool,
    /// Whether the context returns the priority, if it holds it.
    pub returns_priority: bool,
    /// Whether the list has overflowed, so that the context asks for a solo insertion.
    pub overflows: bool,
    pub aborts: bool,
    pub root_changed: bool,
    /// Whether the same visit is made again, and whether that is because of a lock for which the context waits.
    pub revisits: bool,
    pub waits: bool,
    pub duplicate: bool,
    /// Whether a vertex moves without a change of edges. Then its item ends as that of a duplicate does.
    pub moves_in_place: bool,
    /// Whether the visit was the look at the first three points.
    pub looks: bool,
    /// In a run of deletions or moves: the star after this visit; the hole that is tested on; and the hole whose next
    /// apex is known, or that opens.
    pub star: Option<Star>,
    pub tests_on: Option<Hole>,
    pub opens_hole: Option<Hole>,
}

/// The surroundings that a completion sees.
pub(super) struct Around<'a> {
    pub was: &'a Registers,
    pub attempt: Attempt,
    pub vertex: u32,
    pub since: u32,
    pub config: Config,
    pub infinite: u32,
    pub defect: Option<Defect>,
    /// Whether the visit is one of a move, and whether the vertex moves to its own place.
    pub moves: bool,
    pub stays: bool,
}

impl Around<'_> {
    /// L6: whether a commit or release of the context's last point is due.
    pub(super) fn is_busy(&self, context: usize) -> bool {
        self.was.noted.busy & 1 << context != 0 && self.defect != Some(Defect::OpensWhileBusy)
    }

    /// Number of places of the list, and the place of a visit of a star in it.
    pub(super) fn places(&self) -> usize {
        (self.config.ring as usize).next_power_of_two()
    }

    pub(super) fn place(&self, entry: usize) -> usize {
        entry % self.places()
    }

    /// L2: whether the context holds the priority.
    pub(super) fn holds_priority(&self, context: usize) -> bool {
        self.was.noted.holders & 1 << context != 0
    }
}

impl Outcome {
    /// Asks for the same visit once more.
    pub(super) fn again(mut self, done: &Completion) -> Self {
        self.push = Some(Bundle::one(done.visit));
        self.revisits = true;
        self
    }

    /// Puts the context to sleep; later it tries again from this record.
    pub(super) fn abort(mut self, root: u32) -> Self {
        self.sleeps = true;
        self.will_retry = true;
        self.root = Some(root);
        self
    }

    /// L1, L2: notes the lock that a visit of an attempt took. At the lock of another context this one waits if it
    /// holds the priority. Else its attempt drains: its visits complete before its locks are released. Returns whether
    /// the visit counts.
    pub(super) fn takes_lock(&mut self, done: &Completion, around: &Around, state: &mut Attempt) -> bool {
        if done.took {
            self.lock = Some((state.logged, done.visit.record));
            state.logged += 1;
        }
        state.outstanding -= 1;
        let is_foreign = done.foreign && around.defect != Some(Defect::IgnoresForeignLocks);
        if state.drains || !is_foreign {
            return !state.drains;
        }
        if around.holds_priority(self.context) {
            *self = self.again(done);
            self.waits = true;
            state.outstanding += 1;
        } else {
            state.drains = true;
            self.aborts = true;
            self.asks_for_priority = true;
        }
        false
    }

    /// L1, L2: another context holds the lock of the root.
    pub(super) fn foreign_root(mut self, done: &Completion, around: &Around) -> Self {
        if around.holds_priority(self.context) {
            self.waits = true;
            return self.again(done);
        }
        self.aborts = true;
        self.asks_for_priority = true;
        self.abort(done.visit.record)
    }
}
