//! The priority of each team of contexts: which context holds it, and for how long that one has waited.
//!
//! 1. Each team has one priority. A context that aborts while the priority of its team is free takes it, and returns it
//!    when its point is finished or needs a solo insertion (L2). No other context of the team ever waits while it holds
//!    locks. Contexts of other teams work on other meshes, and meet none of these locks.
//! 2. Contexts that abort and retry in step with the waiting one could keep its locks taken for ever. So when the
//!    waiting context has met 8 foreign locks, no other context of its team retries until the priority is returned
//!    (L3). New points may start: they are finished, or abort and then rest, so some point is always finished in the
//!    end.
//! 3. In the first round of the pointer (`planned`), the teams are written down and their priorities become free. No
//!    visit completes then.
//! 4. A visit that asks for the priority neither waits nor returns it.
//!
//! Latency: none from a context to `holds_priority` and `may_retry`; 1 clock from `outcome`. The context of `outcome`
//! is the `early_context` of two clocks before.
//!
//! Two teams of two contexts. Context 0 takes the priority of its team, waits once, and returns it; context 1 belongs
//! to the other team:
//! ```text
//! early_context       0  1  0  0  2  0  0  1  0  2  0  0  0  0
//! asks_for_priority ____________/^^\__________________________
//! waits             _____________________/^^\_________________
//! returns_priority  ______________________________/^^\________
//! takes_priority    ____________/^^\__________________________
//! holds_priority    _______________/^^^^^\__/^^\__/^^\________
//! ```

use super::fill_priority::FillPriority;
use super::next_point::{Passed, Planned};
use crate::engine::types::{context_bits, ContextId, FillEnd, Outcome, Priority, CONTEXT_BITS, PRIORITY_BITS};
use crate::leaf::{LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Priorities {
    pub clock: Signal<In, Clock>,
    /// A context and its team, in the first round of the pointer.
    pub planned: Signal<In, Planned>,
    /// The context of the visit that completes in the next clock; it holds the priority of its team.
    pub early_context: Signal<In, ContextId>,
    pub holds_priority: Signal<Out, Bit>,
    /// The consequences of a completed visit for its context, a clock after the visit; the context takes the priority.
    pub outcome: Signal<In, Outcome>,
    pub takes_priority: Signal<Out, Bit>,
    /// The context that the pointer has left; no other context of its team has waited for so long that it may not
    /// retry.
    pub passed: Signal<In, Passed>,
    pub may_retry: Signal<Out, Bit>,
    /// In a core with changes: an item ends with its hole, and its context returns the priority if it holds it.
    pub fill_end: Vec<Signal<In, FillEnd>>,
    fill: Vec<FillPriority>,
    early_team: DFF<ContextId>,
    team: DFF<ContextId>,
    /// The team of each context, and the priority of each team, once for each place that reads it.
    teams: LutMemory<CONTEXT_BITS, CONTEXT_BITS>,
    of_early: LutMemory<CONTEXT_BITS, PRIORITY_BITS>,
    of_outcome: LutMemory<CONTEXT_BITS, PRIORITY_BITS>,
    of_passed: LutMemory<CONTEXT_BITS, PRIORITY_BITS>,
    early: Unpack<Priority, PRIORITY_BITS>,
    held: Unpack<Priority, PRIORITY_BITS>,
    barring: Unpack<Priority, PRIORITY_BITS>,
    changed: Signal<Local, Priority>,
    written: Signal<Local, Bits<PRIORITY_BITS>>,
    written_team: Signal<Local, ContextId>,
    writes: Signal<Local, Bit>,
    waits: Signal<Local, Bits<4>>,
    other_waits: Signal<Local, Bits<4>>,
    one: Signal<Local, Bits<4>>,
    takes: Signal<Local, Bit>,
    returns: Signal<Local, Bit>,
    is_barred: Signal<Local, Bit>,
}

impl Priorities {
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        let priorities = || LutMemory::new(bits, PRIORITY_BITS);
        Self {
            teams: LutMemory::new(bits, CONTEXT_BITS),
            of_early: priorities(),
            of_outcome: priorities(),
            of_passed: priorities(),
            ..Self::default()
        }
    }

    /// The priorities of a core with changes.
    pub fn with_changes(config: Config) -> Self {
        Self { fill_end: vec![Signal::default()], fill: vec![FillPriority::default()], ..Self::new(config) }
    }
}

impl Logic for Priorities {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, early_team, team);
        clock!(self, clock, teams, of_early, of_outcome, of_passed);
        self.one.next = 1.into();
        self.teams.write_address.next = self.planned.val().context;
        self.teams.write_data.next = self.planned.val().team;
        self.teams.write_enable.next = self.planned.val().valid;
        self.teams.read_address.next = self.early_context.val();
        self.early_team.d.next = self.teams.read_data.val();
        self.team.d.next = self.early_team.q.val();

        self.of_early.read_address.next = self.teams.read_data.val();
        self.early.bits.next = self.of_early.read_data.val();
        self.holds_priority.next =
            self.early.value.val().is_held & (self.early.value.val().context == self.early_context.val());

        // L2: the first context of a team to ask gets its priority; if two could wait, each could wait for the other.
        self.of_outcome.read_address.next = self.team.q.val();
        self.held.bits.next = self.of_outcome.read_data.val();
        self.waits.next = self.held.value.val().waits;
        self.takes.next = self.outcome.val().asks_for_priority & (!self.held.value.val().is_held);
        self.takes_priority.next = self.takes.val();
        self.returns.next = self.outcome.val().returns_priority
            & self.held.value.val().is_held
            & (self.held.value.val().context == self.outcome.val().context);
        for i in 0..self.fill.len() {
            self.fill[i].ending.next = self.fill_end[i].val();
            self.fill[i].held.next = self.held.value.val();
            if self.fill[i].returns.val() {
                self.returns.next = true;
            }
        }
        self.changed.next = self.held.value.val();
        if self.outcome.val().waits & (!self.waits.val().get_bit(3)) {
            self.changed.next.waits = self.waits.val() + self.one.val();
        }
        if self.takes.val() {
            self.changed.next.is_held = true;
            self.changed.next.context = self.outcome.val().context;
            self.changed.next.waits = 0.into();
        }
        self.written_team.next = self.team.q.val();
        if self.planned.val().valid {
            self.written_team.next = self.planned.val().team;
        }
        if self.planned.val().valid | self.returns.val() {
            self.changed.next.is_held = false;
        }
        self.writes.next = self.planned.val().valid | self.takes.val() | self.returns.val() | self.outcome.val().waits;

        // L3: after 8 foreign locks the context with the priority has waited long, and no other of its team may retry.
        self.of_passed.read_address.next = self.passed.val().team;
        self.barring.bits.next = self.of_passed.read_data.val();
        self.other_waits.next = self.barring.value.val().waits;
        self.is_barred.next = self.barring.value.val().is_held
            & self.other_waits.val().get_bit(3)
            & (self.barring.value.val().context != self.passed.val().context);
        self.may_retry.next = !self.is_barred.val();

        self.written.next = self.changed.val().into();
        self.of_early.write_address.next = self.written_team.val();
        self.of_early.write_data.next = self.written.val();
        self.of_early.write_enable.next = self.writes.val();
        self.of_outcome.write_address.next = self.written_team.val();
        self.of_outcome.write_data.next = self.written.val();
        self.of_outcome.write_enable.next = self.writes.val();
        self.of_passed.write_address.next = self.written_team.val();
        self.of_passed.write_data.next = self.written.val();
        self.of_passed.write_enable.next = self.writes.val();
    }
}
