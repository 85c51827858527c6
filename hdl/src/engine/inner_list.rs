//! The inner triangles of every cavity: those without an edge on the boundary, whose ids a commit gives back first.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `enable`, `owner`, `place`, `id` | in | 1, 5, 6, 15 | an inner triangle joins the list of a context |
//! | `restarts` | in | 1 | the list of another context, or another list, is read from the next clock on, from its start |
//! | `reader`, `inners` | in | 5, 7 | the context whose list is read, and its length; they stand from the clock after `restarts` |
//! | `steps` | in | 1 | the triangle on the output is used |
//! | `is_used_up` | out | 1 | none is left |
//! | `is_there` | out | 1 | `inner_id` is the next one |
//! | `inner_id` | out | 15 | it |
//!
//! 1. `steps` only while `is_there` and not `is_used_up`.
//! 2. A list is not written while it is read.
//!
//! Latency: two clocks from `restarts` or `steps` to `is_there` (block RAM with output register). There is no reset: the first
//! `restarts` makes everything known.
//!
//! A list of two, 20 and 21:
//! ```text
//! restarts        ___/^^\__________________________
//! steps           _______________/^^\_____/^^\_____
//! is_used_up        .  ._____________________/^^^^^
//! is_there          .  .______/^^^^^\_____/^^\_____
//! inner_id          .  .  .  . 20 20  .  . 21  .  .
//! ```

use super::{context_bits, ring_bits, ContextAddress, RING_ADDRESS_BITS};
use crate::leaf::BlockMemory;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The lists of inner triangles; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct InnerList {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// An inner triangle joins.
    pub enable: Signal<In, Bit>,
    /// Its context.
    pub owner: Signal<In, Bits<5>>,
    /// Its place in the list.
    pub place: Signal<In, Bits<6>>,
    /// It.
    pub id: Signal<In, Bits<15>>,
    /// A list is read from its start.
    pub restarts: Signal<In, Bit>,
    /// Its context.
    pub reader: Signal<In, Bits<5>>,
    /// Its length.
    pub inners: Signal<In, Bits<7>>,
    /// The triangle on the output is used.
    pub steps: Signal<In, Bit>,
    /// None is left.
    pub is_used_up: Signal<Out, Bit>,
    /// The next one is on the output.
    pub is_there: Signal<Out, Bit>,
    /// It.
    pub inner_id: Signal<Out, Bits<15>>,
    memory: BlockMemory<RING_ADDRESS_BITS, 15>,
    index: DFF<Bits<7>>,
    /// The address has stood for one clock, and for two.
    stood_1: DFF<Bit>,
    stood_2: DFF<Bit>,
    write_at: ContextAddress<6, RING_ADDRESS_BITS>,
    read_at: ContextAddress<6, RING_ADDRESS_BITS>,
    first_place: Signal<Local, Bits<7>>,
    one: Signal<Local, Bits<7>>,
}

impl InnerList {
    /// The lists of a configuration.
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        Self {
            memory: BlockMemory::new(context_bits(config) + bits, 15),
            write_at: ContextAddress::new(bits),
            read_at: ContextAddress::new(bits),
            ..Self::default()
        }
    }
}

impl Logic for InnerList {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, index, stood_1, stood_2);
        clock!(self, clock, memory);
        self.one.next = 1.into();
        self.first_place.next = 0.into();
        self.write_at.owner.next = self.owner.val();
        self.write_at.place.next = self.place.val();
        self.memory.write_address.next = self.write_at.address.val();
        self.memory.write_data.next = self.id.val();
        self.memory.write_enable.next = self.enable.val();

        self.read_at.owner.next = self.reader.val();
        self.read_at.place.next = self.index.q.val().get_bits::<6>(0);
        self.memory.read_address.next = self.read_at.address.val();
        self.inner_id.next = self.memory.read_data.val();
        self.is_used_up.next = self.index.q.val() == self.inners.val();
        self.is_there.next = self.stood_2.q.val();

        self.stood_1.d.next = true;
        self.stood_2.d.next = self.stood_1.q.val();
        if self.steps.val() {
            self.index.d.next = self.index.q.val() + self.one.val();
        }
        if self.restarts.val() {
            self.index.d.next = self.first_place.val();
        }
        if self.steps.val() | self.restarts.val() {
            self.stood_1.d.next = false;
            self.stood_2.d.next = false;
        }
    }
}
