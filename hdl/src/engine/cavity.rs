//! The growing cavity: splits ring entries on conflicts, keeps final edges, counts visits out.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets the cavity |
//! | `ring` | in | 7 | entries the list holds, a constant |
//! | `is_root`, `is_cavity`, `is_drain` | in | 1 | phase of the context |
//! | `root_visits` | in | 2 | visits that the phase `Root` pushes at this edge |
//! | `done`, `token`, `turned`, `verdict` | in | | the visit that completes |
//! | `split`, `split_bundle` | out | 1, Bundle | a test passed through its edge: two visits to make |
//! | `overflows` | out | 1 | a test would pass through its edge, and the list is full |
//! | `nothing_is_out` | out | 1 | every visit has completed |
//! | `count`, `inner_count` | out | 7 | ring entries; cavity triangles without a boundary edge |
//! | `entry_pointer`, `entry` | in, out | 6, Entry | the list, read at once |
//! | `inner_pointer`, `inner_id` | in, out | 6, 15 | the inner triangles, read at once |
//!
//! 1. Entries are allocated in the order of conflicts: cavity + 2 of them, no garbage.
//! 2. An entry is written once, when the test of its edge finds no conflict.
//! 3. The order in which tests complete does not matter to the ring: a split changes its own entry only.
//!
//! ```text
//!           c                         c
//!          / \                       ^ \
//!         /   \      conflict     X /   \ Y       X = (a -> c), Y = (c -> b), both with u behind them
//!        /  u  \     ------->      /     v
//!       a ----> b                 a       b
//!           p                         p
//! ```
//! Latency: none from `done` to `split`; entries can be read in the next clock.
//!
//! A root whose first test finds a conflict; the edge across entry 0 becomes entries 0 and 3:
//! ```text
//! is_root         ___/^^^^^^^^\_____________________________
//! root_visits       .  1  2  1  .  .  .  .  .  .  .  .  .  .
//! is_cavity       ____________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! done            ____________/^^^^^\__/^^^^^\__/^^^^^\_____
//! token.rotates     .  .  .  .___/^^  ./^^^^^  ./^^^^^  .  .
//! token.x           .  .  .  .  0  0  .  1  2  .  0  3  .  .
//! conflict          .  .  .  .___/^^  .______  .______  .  .
//! split           _______________/^^\_______________________
//! count             .  .  .  .  3  3  4  4  4  4  4  4  4  4
//! nothing_is_out  /^^^^^\_____________________________/^^^^^
//! ```

use super::visit_pipeline::ring_bits;
use super::{Bundle, Entry, Token, Turned, Verdict, ENTRY_WORD_BITS};
use crate::leaf::{LutMemory, Unpack};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The cavity; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Cavity {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets the cavity.
    pub reset: Signal<In, Bit>,
    /// Entries the list holds.
    pub ring: Signal<In, Bits<7>>,
    /// The root is being tested.
    pub is_root: Signal<In, Bit>,
    /// The cavity grows.
    pub is_cavity: Signal<In, Bit>,
    /// Visits run out after an overflow.
    pub is_drain: Signal<In, Bit>,
    /// Visits pushed for the root at this edge.
    pub root_visits: Signal<In, Bits<2>>,
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// A test passed through its edge.
    pub split: Signal<Out, Bit>,
    /// The visits behind it.
    pub split_bundle: Signal<Out, Bundle>,
    /// A conflict finds the list full.
    pub overflows: Signal<Out, Bit>,
    /// Every visit has completed.
    pub nothing_is_out: Signal<Out, Bit>,
    /// Ring entries.
    pub count: Signal<Out, Bits<7>>,
    /// Inner triangles.
    pub inner_count: Signal<Out, Bits<7>>,
    /// Entry to read.
    pub entry_pointer: Signal<In, Bits<6>>,
    /// It.
    pub entry: Signal<Out, Entry>,
    /// Inner triangle to read.
    pub inner_pointer: Signal<In, Bits<6>>,
    /// Its id.
    pub inner_id: Signal<Out, Bits<15>>,
    list: LutMemory<6, ENTRY_WORD_BITS>,
    listed: Unpack<Entry, ENTRY_WORD_BITS>,
    inner: LutMemory<6, 15>,
    entries: DFF<Bits<7>>,
    inners: DFF<Bits<7>>,
    outstanding: DFF<Bits<7>>,
    /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three and uses
    /// bits 0 and 1.
    half_open: DFF<Bits<64>>,
    new_entry: Signal<Local, Entry>,
    new_entry_bits: Signal<Local, Bits<ENTRY_WORD_BITS>>,
    is_test: Signal<Local, Bit>,
    is_conflict: Signal<Local, Bit>,
    is_full: Signal<Local, Bit>,
    splits: Signal<Local, Bit>,
    edge_was_passed: Signal<Local, Bit>,
    root_keeps_an_edge: Signal<Local, Bit>,
    passes_last_edge: Signal<Local, Bit>,
    y: Signal<Local, Bits<6>>,
    f_entry: Signal<Local, Bits<6>>,
    pushed: Signal<Local, Bits<7>>,
    raised: Signal<Local, Bits<7>>,
    one: Signal<Local, Bits<7>>,
    zero: Signal<Local, Bits<7>>,
    root_entry: Signal<Local, Bits<6>>,
}

impl Cavity {
    /// The cavity of a configuration.
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        Self { list: LutMemory::new(bits, ENTRY_WORD_BITS), inner: LutMemory::new(bits, 15), ..Self::default() }
    }
}

impl Logic for Cavity {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, entries, inners, outstanding, half_open);
        clock!(self, clock, list, inner);
        self.one.next = 1.into();
        self.zero.next = 0.into();
        self.root_entry.next = 0.into();

        // What a completing test asks for.
        self.is_test.next = self.done.val() & self.token.val().rotates & self.is_cavity.val();
        self.is_conflict.next = self.is_test.val() & self.verdict.val().conflict;
        self.is_full.next = self.entries.q.val() == self.ring.val();
        self.splits.next = self.is_conflict.val() & (!self.is_full.val());
        self.split.next = self.splits.val();
        self.overflows.next = self.is_conflict.val() & self.is_full.val();
        self.y.next = self.entries.q.val().get_bits::<6>(0);
        self.split_bundle.next.is_pair = true;
        self.split_bundle.next.rotates = true;
        self.split_bundle.next.locks = true;
        self.split_bundle.next.x = self.token.val().x;
        self.split_bundle.next.after = self.y.val();
        self.split_bundle.next.f_entry = self.y.val();
        self.split_bundle.next.f = self.token.val().u;
        self.split_bundle.next.u = self.turned.val().n1;
        self.split_bundle.next.second_x = self.y.val();
        self.split_bundle.next.second_after = self.token.val().after;
        self.split_bundle.next.second_u = self.turned.val().n2;

        // A final edge.
        self.new_entry.next.a = self.turned.val().v2;
        self.new_entry.next.u = self.token.val().u;
        self.new_entry.next.slot = self.turned.val().slot;
        self.new_entry.next.f = self.token.val().f;
        self.new_entry.next.after = self.token.val().after;
        self.new_entry_bits.next = self.new_entry.val().into();
        self.list.write_address.next = self.token.val().x;
        self.list.write_data.next = self.new_entry_bits.val();
        self.list.write_enable.next = self.is_test.val() & (!self.verdict.val().conflict);
        self.list.read_address.next = self.entry_pointer.val();
        self.listed.bits.next = self.list.read_data.val();
        self.entry.next = self.listed.value.val();

        // Does the cavity triangle behind the edge keep another one?
        self.f_entry.next = self.token.val().f_entry;
        self.edge_was_passed.next = self.half_open.q.val().get_bit(self.f_entry.val().index());
        self.root_keeps_an_edge.next =
            (self.f_entry.val() == self.root_entry.val()) & (!self.half_open.q.val().get_bit(1));
        self.passes_last_edge.next = self.edge_was_passed.val() & (!self.root_keeps_an_edge.val());
        self.inner.write_address.next = self.inners.q.val().get_bits::<6>(0);
        self.inner.write_data.next = self.token.val().f;
        self.inner.write_enable.next = self.splits.val() & self.passes_last_edge.val();
        self.inner.read_address.next = self.inner_pointer.val();
        self.inner_id.next = self.inner.read_data.val();
        if self.splits.val() {
            self.entries.d.next = self.entries.q.val() + self.one.val();
            self.half_open.d.next = self.half_open.q.val().replace_bit(self.f_entry.val().index(), true);
            if self.edge_was_passed.val() & self.root_keeps_an_edge.val() {
                self.half_open.d.next = self.half_open.q.val().replace_bit(1, true);
            }
            if self.passes_last_edge.val() {
                self.inners.d.next = self.inners.q.val() + self.one.val();
            }
        }
        self.count.next = self.entries.q.val();
        self.inner_count.next = self.inners.q.val();

        // Visits out.
        self.pushed.next = 0.into();
        if self.splits.val() {
            self.pushed.next = 2.into();
        }
        if self.is_root.val() {
            self.pushed.next = bit_cast::<7, 2>(self.root_visits.val());
        }
        self.raised.next = self.outstanding.q.val() + self.pushed.val();
        self.outstanding.d.next = self.raised.val();
        if self.done.val() & (self.is_cavity.val() | self.is_drain.val()) {
            self.outstanding.d.next = self.raised.val() - self.one.val();
        }
        self.nothing_is_out.next = self.outstanding.q.val() == self.zero.val();

        if self.is_root.val() {
            self.entries.d.next = 3.into();
            self.inners.d.next = 0.into();
            self.half_open.d.next = 0.into();
        }
        if self.reset.val() {
            self.outstanding.d.next = 0.into();
        }
    }
}
