//! The states of the attempts of all contexts. The state of a context is at hand in the clock in which one of its
//! visits completes, and changes in the same clock, because the next visit of the context may complete a clock later.
//!
//! 1. `early_visit` announces every visit in the clock before its own. There may be pauses.
//! 2. A visit sees the effects of all visits before it, also of a test in the clock before. The visit that opens a
//!    cavity is the only one of its context, so the next one comes later.
//! 3. A cavity opens with three tests, of the neighbours of the root, and with one lock.
//! 4. `is_last`, `is_full` and `edge_was_passed` repeat what `attempt` says, but are ready sooner.
//!
//! Latency: 1 clock from `early_visit` to `held`. A state that is written in one clock can be read in the next.
//!
//! Source: a memory in LUTs that is read a clock ahead, with a bypass around it.

use crate::engine::types::{
    context_bits, ring_bits, Attempt, Case, RingCount, RingEntry, Step, Visit, ATTEMPT_BITS, CONTEXT_BITS, ENTRY_BITS,
};
use crate::leaf::{LutMemory, Parameter, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

crate::packed! {
    /// An attempt, with flags that are ready sooner because they are kept apart from it.
    pub struct Held {
        pub attempt: Attempt,
        /// Only one visit of the attempt is in flight; or the list has no room for another entry (`is_full`).
        pub is_last: bool,
        pub is_full: bool,
        /// The bit of `attempt.half_open` for the visit's `cavity_entry`.
        pub edge_was_passed: bool,
        /// The bit of the visit's `cavity_entry` alone.
        pub entry_bit: Bits<64>,
    }
}

#[derive(LogicBlock, Default)]
pub struct AttemptStore {
    pub clock: Signal<In, Clock>,
    /// The number of entries that a ring can have, a constant.
    pub ring_capacity: Signal<In, RingCount>,
    /// The visit that completes in the next clock, and the one that completes in this clock. Only
    /// `context` and `cavity_entry` count.
    pub early_visit: Signal<In, Visit>,
    pub visit: Signal<In, Visit>,
    /// The attempt of the visit of this clock.
    pub held: Signal<Out, Held>,
    /// The case of the visit, and the step of its attempt. If the step passes the second edge of the root, bit
    /// 1 of `half_open` rises.
    pub found: Signal<In, Case>,
    pub step: Signal<In, Step>,
    /// The state after a test.
    pub after: Signal<In, Attempt>,
    states: LutMemory<CONTEXT_BITS, ATTEMPT_BITS>,
    flags: LutMemory<CONTEXT_BITS, 2>,
    stored: Unpack<Attempt, ATTEMPT_BITS>,
    written: Signal<Local, Attempt>,
    written_bits: Signal<Local, Bits<ATTEMPT_BITS>>,
    written_flags: Signal<Local, Bits<2>>,
    state: DFF<Attempt>,
    flag_bits: DFF<Bits<2>>,
    /// The bit of `half_open`, in the bypassed state and in the stored one; `went_round` tells which of the two counts.
    kept_passed: DFF<Bit>,
    stored_passed: DFF<Bit>,
    went_round: DFF<Bit>,
    named_entry: DFF<Bits<64>>,
    goes_round: Signal<Local, Bit>,
    is_same_entry: Signal<Local, Bit>,
    is_second_entry: Signal<Local, Bit>,
    kept_edges: Signal<Local, Bits<64>>,
    edges_after: Signal<Local, Bits<64>>,
    stored_edges: Signal<Local, Bits<64>>,
    entry: Signal<Local, RingEntry>,
    wide_entry: Signal<Local, Bits<64>>,
    first_bit: Signal<Local, Bits<64>>,
    becomes_last: Signal<Local, Bit>,
    becomes_full: Signal<Local, Bit>,
    last_flag: Signal<Local, Bits<2>>,
    full_flag: Signal<Local, Bits<2>>,
    opens_full: Signal<Local, Bit>,
    flags_after: Signal<Local, Bits<2>>,
    outstanding: Signal<Local, RingCount>,
    count: Signal<Local, RingCount>,
    before_full: Signal<Local, RingCount>,
    two: Signal<Local, RingCount>,
    three: Signal<Local, RingCount>,
    one: Signal<Local, RingCount>,
    second_entry: Signal<Local, RingEntry>,
    /// A bit for each entry that a ring of this configuration can have: the memory does not store the bits above.
    all_entries: Parameter<Bits<64>>,
}

impl AttemptStore {
    /// Builds the store of a configuration.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        let entries = 1 << ring_bits(config);
        let kept = ATTEMPT_BITS - (1 << ENTRY_BITS) + entries;
        Self {
            states: LutMemory::new(bits, kept),
            flags: LutMemory::new(bits, 2),
            all_entries: Parameter::new(Bits::<64>::mask() >> (64 - entries as u64)),
            ..Self::default()
        }
    }
}

impl Logic for AttemptStore {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, flag_bits, kept_passed, stored_passed, went_round, named_entry);
        clock!(self, clock, states, flags);
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.three.next = 3.into();
        self.second_entry.next = 1.into();
        self.held.next.attempt = self.state.q.val();
        self.held.next.is_last = self.flag_bits.q.val().get_bit(0);
        self.held.next.is_full = self.flag_bits.q.val().get_bit(1);
        self.held.next.edge_was_passed = self.stored_passed.q.val();
        if self.went_round.q.val() {
            self.held.next.edge_was_passed = self.kept_passed.q.val();
        }

        // The flags come from registers and not from `after`, whose sums would make the path longer.
        self.outstanding.next = self.state.q.val().outstanding;
        self.count.next = self.state.q.val().count;
        self.before_full.next = self.ring_capacity.val() - self.one.val();
        self.becomes_last.next = self.outstanding.val() == self.two.val();
        self.becomes_full.next = self.flag_bits.q.val().get_bit(1);
        if self.found.val().revisits {
            self.becomes_last.next = self.flag_bits.q.val().get_bit(0);
        }
        if self.found.val().splits {
            self.becomes_last.next = false;
            self.becomes_full.next = self.count.val() == self.before_full.val();
        }
        self.last_flag.next = 0.into();
        self.full_flag.next = 0.into();
        if self.becomes_last.val() {
            self.last_flag.next = 1.into();
        }
        if self.becomes_full.val() {
            self.full_flag.next = 2.into();
        }
        self.flags_after.next = self.last_flag.val() | self.full_flag.val();

        // A test writes the state after it; the visit that opens a cavity writes a new state.
        self.written.next = self.after.val();
        self.written_flags.next = self.flags_after.val();
        self.opens_full.next = self.ring_capacity.val() == self.three.val();
        if self.found.val().opens {
            self.written.next.drains = false;
            self.written.next.outstanding = 3.into();
            self.written.next.count = 3.into();
            self.written.next.inners = 0.into();
            self.written.next.logged = 1.into();
            self.written.next.half_open = 0.into();
            self.written_flags.next = 0.into();
            if self.opens_full.val() {
                self.written_flags.next = 2.into();
            }
        }
        self.written_bits.next = self.written.val().into();

        self.states.write_address.next = self.visit.val().context;
        self.states.write_data.next = self.written_bits.val();
        self.states.write_enable.next = self.found.val().is_test | self.found.val().opens;
        self.states.read_address.next = self.early_visit.val().context;
        self.flags.write_address.next = self.visit.val().context;
        self.flags.write_data.next = self.written_flags.val();
        self.flags.write_enable.next = self.found.val().is_test | self.found.val().opens;
        self.flags.read_address.next = self.early_visit.val().context;
        self.stored.bits.next = self.states.read_data.val();

        // The bit of `half_open` is chosen a clock ahead. The test of this clock may change that bit, so the bypassed
        // state is tried beside the stored one.
        self.entry.next = self.early_visit.val().cavity_entry;
        self.first_bit.next = 1.into();
        self.wide_entry.next = bit_cast::<64, 6>(self.early_visit.val().cavity_entry);
        self.named_entry.d.next = self.first_bit.val() << self.wide_entry.val();
        self.held.next.entry_bit = self.named_entry.q.val() & self.all_entries.val();
        self.kept_edges.next = self.state.q.val().half_open;
        self.stored_edges.next = self.stored.value.val().half_open;
        self.is_same_entry.next = self.early_visit.val().cavity_entry == self.visit.val().cavity_entry;
        self.is_second_entry.next = self.early_visit.val().cavity_entry == self.second_entry.val();
        self.stored_passed.d.next = self.stored_edges.val().get_bit(self.entry.val().index());
        self.kept_passed.d.next = self.kept_edges.val().get_bit(self.entry.val().index())
            | (self.found.val().splits & self.is_same_entry.val())
            | (self.step.val().passes_root & self.is_second_entry.val());

        self.edges_after.next = self.after.val().half_open;

        // The memory shows a write only in the next clock. Tests of one context in consecutive clocks
        // therefore need the bypass.
        self.goes_round.next = self.found.val().is_test & (self.early_visit.val().context == self.visit.val().context);
        self.went_round.d.next = self.goes_round.val();
        self.state.d.next = self.stored.value.val();
        self.flag_bits.d.next = self.flags.read_data.val();
        if self.goes_round.val() {
            self.state.d.next = self.after.val();
            self.state.d.next.half_open = self.edges_after.val() & self.all_entries.val();
            self.flag_bits.d.next = self.flags_after.val();
        }
    }
}
