//! The vertex that a context takes next, and the one after a vertex that is taken.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `turn` | in | 5 | the context |
//! | `has_begun`, `planned` | in | 1, 15 | it has had a point; what then stood on `after_taken` |
//! | `next_id` | out | 15 | the vertex it takes next |
//! | `taken` | in | 15 | a vertex that some context takes |
//! | `contexts` | in | 5 | contexts that work |
//! | `after_taken` | out | 15 | the vertex that this context takes after it |
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
    /// The one after that.
    pub planned: Signal<In, Bits<15>>,
    /// The vertex it takes next.
    pub next_id: Signal<Out, Bits<15>>,
    /// A vertex that is taken.
    pub taken: Signal<In, Bits<15>>,
    /// Contexts that work.
    pub contexts: Signal<In, Bits<5>>,
    /// The one after it.
    pub after_taken: Signal<Out, Bits<15>>,
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
        if self.taken.val() < self.first_round.val() {
            self.step.next = 1.into();
        }
        self.after_taken.next = self.taken.val() + self.step.val();
        self.next_id.next = self.planned.val();
        if !self.has_begun.val() {
            self.next_id.next = self.wide_turn.val() + self.first_round.val();
            if self.turn.val() == self.first_context.val() {
                self.next_id.next = 2.into();
            }
        }
    }
}
