//! The states of the attempts of all contexts, each at hand in the clock in which a visit of its context completes.
//!
//! 1. Every visit is announced by `early_visit` in the clock before its own. There may be pauses.
//! 2. A visit sees what all visits before it have left, also a test of the clock before. The visit that opens an attempt is the only one
//!    of its context: the next one comes later.
//! 3. An attempt begins with the three tests of the root's neighbours and its one lock.
//! 4. `is_last`, `is_full` and `edge_was_passed` say nothing that is not in `attempt`; they are ready sooner.
//!
//! Latency: 1 clock from `early_visit` to `held`. What is written in a clock is seen in the next.
//!
//! Source: a memory in LUTs, read a clock ahead, with a way round it.

use crate::engine::types::{
    context_bits, ring_bits, Attempt, Case, RingCount, RingEntry, Step, Visit, ATTEMPT_BITS, CONTEXT_BITS, ENTRY_BITS,
};
use crate::leaf::{LutMemory, Parameter, Unpack};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

crate::packed! {
    /// An attempt, and what is ready sooner because it stands beside it.
    pub struct Held {
        pub attempt: Attempt,
        /// One visit is out; the list holds as many entries as it can.
        pub is_last: bool,
        pub is_full: bool,
        /// `attempt.half_open` at `cavity_entry` of the visit.
        pub edge_was_passed: bool,
        /// `cavity_entry` of the visit, a bit each.
        pub entry_bit: Bits<64>,
    }
}

/// The states of all attempts; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AttemptStore {
    pub clock: Signal<In, Clock>,
    /// Entries a boundary list holds, a constant.
    pub ring_capacity: Signal<In, RingCount>,
    /// The visit that completes in the next clock, and the one of this clock: context and `cavity_entry` count.
    pub early_visit: Signal<In, Visit>,
    pub visit: Signal<In, Visit>,
    /// The attempt of the visit of this clock.
    pub held: Signal<Out, Held>,
    /// What the visit means, and what it makes of its attempt: if the second edge of the root is passed, bit 1 of `half_open` goes up.
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
    /// Whether the edge has been passed, in the state that goes round and in the one that was stored, and which of the two counts.
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
    /// A bit for each entry that a list of this configuration may have: those above are never kept.
    all_entries: Parameter<Bits<64>>,
}

impl AttemptStore {
    /// The states of a configuration.
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

        // The flags after a test, from what stands in registers.
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

        // What is written: that, or the state of an attempt that begins.
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

        // The memory.
        self.states.write_address.next = self.visit.val().context;
        self.states.write_data.next = self.written_bits.val();
        self.states.write_enable.next = self.found.val().is_test | self.found.val().opens;
        self.states.read_address.next = self.early_visit.val().context;
        self.flags.write_address.next = self.visit.val().context;
        self.flags.write_data.next = self.written_flags.val();
        self.flags.write_enable.next = self.found.val().is_test | self.found.val().opens;
        self.flags.read_address.next = self.early_visit.val().context;
        self.stored.bits.next = self.states.read_data.val();

        // The edge that the next visit asks for.
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

        // What the next visit sees: the memory, or what goes into it now.
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
