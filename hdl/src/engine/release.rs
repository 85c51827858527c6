//! Logs every lock that an insertion sets, and releases them all. After reset it clears the whole lock memory.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset empties the log and starts the sweep |
//! | `last_id` | in | 15 | the highest record id, a constant |
//! | `takes_locks` | in | 1 | visits that complete belong to an insertion |
//! | `done`, `token`, `turned` | in | | the visit that completes |
//! | `starts` | in | 1 | release all, after the last visit and the last write |
//! | `is_busy` | out | 1 | locks are being released |
//! | `sweeps` | out | 1 | the lock memory is being cleared after reset |
//! | `clear_id`, `clear_enable` | out | 15, 1 | a lock to clear at this edge |
//!
//! 1. A lock is logged by the visit that found it clear and set it; one that was set already is logged once all the same.
//! 2. One lock is cleared per clock. The log is empty when `is_busy` falls.
//! 3. `starts` comes with at least one lock logged, and nothing is logged while `is_busy`: an insertion locks its root, and the next
//!    one waits.
//!
//! Latency: as many clocks as locks; the sweep takes one clock for each record.
//!
//! A sweep of four records, then the release of locks 27 and 28:
//! ```text
//! reset           /^^\_________________________________________
//! sweeps          ___/^^^^^^^^^^^\_____________________________
//! done            _____________________/^^^^^\_________________
//! token.u           .  .  .  .  .  .  . 27 28  .  .  .  .  .  .
//! starts          ______________________________/^^\___________
//! is_busy         _________________________________/^^^^^\_____
//! clear_enable    ______/^^^^^^^^^^^\_________________/^^^^^\__
//! clear_id          .  .  0  1  2  3  .  .  .  .  .  . 27 28  .
//! ```

use super::{Token, Turned};
use crate::leaf::LutMemory;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The lock log; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Release {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Starts the sweep.
    pub reset: Signal<In, Bit>,
    /// Highest record id.
    pub last_id: Signal<In, Bits<15>>,
    /// Visits belong to an insertion.
    pub takes_locks: Signal<In, Bit>,
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// Release all.
    pub starts: Signal<In, Bit>,
    /// Locks are being released.
    pub is_busy: Signal<Out, Bit>,
    /// The lock memory is being cleared.
    pub sweeps: Signal<Out, Bit>,
    /// Lock to clear.
    pub clear_id: Signal<Out, Bits<15>>,
    /// Clear it.
    pub clear_enable: Signal<Out, Bit>,
    log: LutMemory<7, 15>,
    logged: DFF<Bits<7>>,
    index: DFF<Bits<15>>,
    busy: DFF<Bit>,
    sweeping: DFF<Bit>,
    cleared: DFF<Bits<15>>,
    clears: DFF<Bit>,
    takes: Signal<Local, Bit>,
    after_index: Signal<Local, Bits<15>>,
    all_logged: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<15>>,
    one_lock: Signal<Local, Bits<7>>,
}

impl Release {
    /// The log of a configuration: an insertion sets at most `2 * ring - 2` locks.
    pub fn new(config: Config) -> Self {
        Self { log: LutMemory::new(super::visit_pipeline::ring_bits(config) + 1, 15), ..Self::default() }
    }
}

impl Logic for Release {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, logged, index, busy, sweeping, cleared, clears);
        clock!(self, clock, log);
        self.one.next = 1.into();
        self.one_lock.next = 1.into();
        self.is_busy.next = self.busy.q.val();
        self.sweeps.next = self.sweeping.q.val();
        self.clear_id.next = self.cleared.q.val();
        self.clear_enable.next = self.clears.q.val();

        self.takes.next =
            self.takes_locks.val() & self.done.val() & self.token.val().locks & (!self.turned.val().was_set);
        self.log.write_address.next = self.logged.q.val();
        self.log.write_data.next = self.token.val().u;
        self.log.write_enable.next = self.takes.val();
        if self.takes.val() {
            self.logged.d.next = self.logged.q.val() + self.one_lock.val();
        }

        self.log.read_address.next = self.index.q.val().get_bits::<7>(0);
        self.after_index.next = self.index.q.val() + self.one.val();
        self.all_logged.next = bit_cast::<15, 7>(self.logged.q.val());
        self.cleared.d.next = self.log.read_data.val();
        self.clears.d.next = self.busy.q.val() | self.sweeping.q.val();
        if self.sweeping.q.val() {
            self.cleared.d.next = self.index.q.val();
            self.index.d.next = self.after_index.val();
            if self.index.q.val() == self.last_id.val() {
                self.sweeping.d.next = false;
                self.index.d.next = 0.into();
            }
        }
        if self.busy.q.val() {
            self.index.d.next = self.after_index.val();
            if self.after_index.val() == self.all_logged.val() {
                self.busy.d.next = false;
                self.index.d.next = 0.into();
                self.logged.d.next = 0.into();
            }
        } else {
            self.busy.d.next = self.starts.val();
        }
        if self.reset.val() {
            self.busy.d.next = false;
            self.sweeping.d.next = true;
            self.index.d.next = 0.into();
            self.logged.d.next = 0.into();
            self.clears.d.next = false;
        }
    }
}
