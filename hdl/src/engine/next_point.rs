//! The vertex that a context takes next.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `turn` | in | 5 | the context |
//! | `has_begun`, `id` | in | 1, 15 | it has had a point, and which one last |
//! | `contexts` | in | 5 | contexts that work |
//! | `next_id` | out | 15 | the vertex |
//!
//! 1. Context 0 takes vertex 2, whose arrival completes the first triangle, and then those below 16 one by one.
//! 2. From there on points are dealt: vertex `j` belongs to context `(j - 16) mod contexts`.
//!
//! Latency: none (combinational).

use incircle_protocol::FIRST_ROUND;
use rust_hdl_core::prelude::*;

/// The next vertex of a context; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct NextPoint {
    /// The context.
    pub turn: Signal<In, Bits<5>>,
    /// It has had a point.
    pub has_begun: Signal<In, Bit>,
    /// The last one.
    pub id: Signal<In, Bits<15>>,
    /// Contexts that work.
    pub contexts: Signal<In, Bits<5>>,
    /// The next one.
    pub next_id: Signal<Out, Bits<15>>,
    step: Signal<Local, Bits<15>>,
    wide_turn: Signal<Local, Bits<15>>,
    first_round: Signal<Local, Bits<15>>,
    first_context: Signal<Local, Bits<5>>,
}

// The kernel writes it as a literal, because rust-hdl takes no constants of Rust; a change in the protocol must come here.
const _: () = assert!(FIRST_ROUND == 16, "the first round of this block follows the protocol");

impl Logic for NextPoint {
    #[hdl_gen]
    fn update(&mut self) {
        self.first_round.next = 16.into();
        self.first_context.next = 0.into();
        self.wide_turn.next = bit_cast::<15, 5>(self.turn.val());
        self.step.next = bit_cast::<15, 5>(self.contexts.val());
        if self.id.val() < self.first_round.val() {
            self.step.next = 1.into();
        }
        self.next_id.next = self.id.val() + self.step.val();
        if !self.has_begun.val() {
            self.next_id.next = self.wide_turn.val() + self.first_round.val();
            if self.turn.val() == self.first_context.val() {
                self.next_id.next = 2.into();
            }
        }
    }
}
