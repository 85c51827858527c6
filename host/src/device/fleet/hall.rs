//! The state that the threads of a fleet share: the devices that have opened, the parts that wait, those under way, and
//! those that are done.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use incircle_geometry::cpu::SolvedPart;
use incircle_protocol::Identity;

use crate::error::Error;
use crate::job::Share;
use crate::limit::Limit;

/// The longest time between two looks at the state.
const LOOK: Duration = Duration::from_millis(50);
/// Most parts that a device takes at a time.
const MOST_TAKEN: usize = 64;

/// A device that is open and has given its identity.
#[derive(Clone)]
pub(super) struct Greeted {
    pub(super) name: String,
    pub(super) identity: Identity,
    /// The factor by which the device is slower than real hardware.
    pub(super) slow: u32,
}

/// The state of the work, for the leader.
pub(super) struct Seen {
    /// Points of the parts that are done.
    pub(super) points: usize,
    /// Devices that are at work.
    pub(super) devices: usize,
    pub(super) is_over: bool,
}

struct State {
    /// The greeting of each device; `None` before it, and once the device is left out.
    greetings: Vec<Option<Greeted>>,
    /// The number of devices that have neither greeted nor been left out.
    silent: usize,
    /// The number of devices that have greeted and have not been left out.
    at_work: usize,
    shares: Vec<Share>,
    /// Parts that wait for a device.
    waiting: VecDeque<usize>,
    /// For each device, the parts that it is working on.
    taken: Vec<Vec<usize>>,
    solved: Vec<SolvedPart>,
    /// The time limit of the set; `None` before the parts are there.
    limit: Option<Limit>,
    /// Points of the parts that are done.
    points: usize,
    /// The error of the device that was left out last.
    failure: Option<Error>,
}

pub(super) struct Hall {
    state: Mutex<State>,
    changed: Condvar,
    is_closed: AtomicBool,
}

impl Hall {
    pub(super) fn new(names: Vec<String>) -> Self {
        let shares: Vec<Share> = names.into_iter().map(|device| Share { device, ..Share::default() }).collect();
        let state = State {
            greetings: shares.iter().map(|_| None).collect(),
            taken: shares.iter().map(|_| Vec::new()).collect(),
            silent: shares.len(),
            at_work: 0,
            shares,
            waiting: VecDeque::new(),
            solved: Vec::new(),
            limit: None,
            points: 0,
            failure: None,
        };
        Self { state: Mutex::new(state), changed: Condvar::new(), is_closed: AtomicBool::new(false) }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a change, at most [`LOOK`].
    fn wait<'s>(&self, state: MutexGuard<'s, State>) -> MutexGuard<'s, State> {
        self.changed.wait_timeout(state, LOOK).unwrap_or_else(PoisonError::into_inner).0
    }

    /// Tells all devices to end.
    pub(super) fn close(&self) {
        self.is_closed.store(true, Ordering::Relaxed);
        self.changed.notify_all();
    }

    pub(super) fn is_closed(&self) -> bool {
        self.is_closed.load(Ordering::Relaxed)
    }

    /// Takes the greeting of a device.
    pub(super) fn greet(&self, place: usize, greeted: Greeted) {
        let mut state = self.state();
        state.shares[place].device.clone_from(&greeted.name);
        state.greetings[place] = Some(greeted);
        state.silent -= 1;
        state.at_work += 1;
        self.changed.notify_all();
    }

    /// Leaves a device out, for this error. Its parts wait for other devices.
    pub(super) fn leave_out(&self, place: usize, error: Error) {
        let mut state = self.state();
        match state.greetings[place].take() {
            Some(_) => state.at_work -= 1,
            None => state.silent -= 1,
        }
        state.shares[place].left_out = Some(error.to_string());
        state.failure = Some(error);
        let parts = std::mem::take(&mut state.taken[place]);
        state.waiting.extend(parts);
        self.changed.notify_all();
    }

    /// The devices that have greeted, once every device has greeted or been left out. If some are still silent, the
    /// call first waits for a change, at most [`LOOK`], and then returns `None` if some still are.
    pub(super) fn greetings(&self) -> Option<Vec<Greeted>> {
        let mut state = self.state();
        if state.silent > 0 {
            state = self.wait(state);
        }
        (state.silent == 0).then(|| state.greetings.iter().flatten().cloned().collect())
    }

    /// Makes all parts available to the devices.
    pub(super) fn begin(&self, parts: usize, limit: Limit) {
        let mut state = self.state();
        state.waiting.extend(0..parts);
        state.limit = Some(limit);
        self.changed.notify_all();
    }

    /// The next parts for a device, and the time limit of the set. Waits while there are none, because the parts of
    /// another device may come back. `None` once the hall is closed.
    pub(super) fn next(&self, place: usize) -> Option<(Vec<usize>, Limit)> {
        let mut state = self.state();
        loop {
            if self.is_closed() {
                return None;
            }
            if let (Some(limit), false) = (state.limit, state.waiting.is_empty()) {
                // The fewer parts are left, the fewer a device takes, so that all end at about the same time.
                let most = (state.waiting.len() / (2 * state.at_work.max(1))).clamp(1, MOST_TAKEN);
                let taken: Vec<usize> = state.waiting.drain(..most).collect();
                state.taken[place].clone_from(&taken);
                return Some((taken, limit));
            }
            state = self.wait(state);
        }
    }

    /// Takes parts that a device has done, with the number of their points.
    pub(super) fn done(&self, place: usize, solved: Vec<SolvedPart>, points: usize) {
        let mut state = self.state();
        state.taken[place].clear();
        state.shares[place].parts += solved.len();
        state.shares[place].points += points;
        state.points += points;
        state.solved.extend(solved);
        self.changed.notify_all();
    }

    /// Waits for a change and says how far the work is.
    pub(super) fn look(&self) -> Seen {
        let state = self.state();
        let is_over = |state: &State| state.waiting.is_empty() && state.taken.iter().all(Vec::is_empty);
        let state = if is_over(&state) { state } else { self.wait(state) };
        Seen { points: state.points, devices: state.at_work, is_over: is_over(&state) }
    }

    pub(super) fn shares(&self) -> Vec<Share> {
        self.state().shares.clone()
    }

    pub(super) fn take_solved(&self) -> Vec<SolvedPart> {
        std::mem::take(&mut self.state().solved)
    }

    pub(super) fn take_failure(&self) -> Option<Error> {
        self.state().failure.take()
    }
}
