//! The first vertex of a context, and the vertex that follows one it takes.
//!
//! 1. Context 0 takes vertex 2, whose arrival completes the first triangle, and then the vertices below 16
//!    one by one (L8).
//! 2. From vertex 16 on points are dealt: vertex `j` belongs to context `(j - 16) mod contexts`.
//! 3. In a batch, context `c` takes vertex `3c + 2` first, the third of its own first triangle, whose first record is
//!    `4c`. From `dealt_from = 3 contexts` on, vertex `j` belongs to context `(j - dealt_from) mod contexts`. The flag
//!    `is_seed` says that a vertex is such a third one. The flag is made when the vertex is chosen, a clock ahead of
//!    the sum: a comparison with `dealt_from` in front of the sum would limit the clock of the core.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{ContextId, Deal, Plan, TriangleId, VertexId};
use incircle_protocol::FIRST_ROUND;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The context to which the pointer points.
    pub struct Pointer {
        pub turn: ContextId,
        /// The sum `3 turn + 2`: in a batch, the third vertex of the context's own first triangle.
        pub third: Bits<7>,
    }

    /// The context that the pointer has left, and the vertex that it would take.
    pub struct Passed {
        pub context: ContextId,
        pub id: VertexId,
        /// The vertex is the third of the context's own first triangle, in a batch; then `dealt` follows it.
        pub is_seed: bool,
        pub dealt: Bits<7>,
    }

    /// The plan of that context after it has taken its vertex.
    pub struct Following {
        /// The vertex that it takes is one of the dealt ones, behind the first round.
        pub is_dealt: bool,
        /// The vertex that it takes next.
        pub id: VertexId,
        /// The first record of the context's mesh.
        pub first_record: TriangleId,
    }
}

#[derive(LogicBlock, Default)]
pub struct NextPoint {
    /// The number of contexts that work, and whether each has a mesh of its own.
    pub deal: Signal<In, Deal>,
    /// The context under the pointer.
    pub pointer: Signal<In, Pointer>,
    /// The vertex that the context under the pointer takes first; in a batch, the one after that (`first_dealt`).
    pub first: Signal<Out, Plan>,
    pub first_dealt: Signal<Out, Bits<7>>,
    /// The context that the pointer has left, with the vertex that it takes; and the plan that follows.
    pub passed: Signal<In, Passed>,
    pub following: Signal<Out, Following>,
    taken: Signal<Local, VertexId>,
    is_batch: Signal<Local, Bit>,
    is_early: Signal<Local, Bit>,
    is_dealt: Signal<Local, Bit>,
    rounds: Signal<Local, Bits<11>>,
    from: Signal<Local, VertexId>,
    step: Signal<Local, VertexId>,
    wide_turn: Signal<Local, VertexId>,
    wide_taker: Signal<Local, VertexId>,
    narrow_turn: Signal<Local, Bits<7>>,
    dealt_from: Signal<Local, Bits<7>>,
    first_round: Signal<Local, VertexId>,
    first_context: Signal<Local, ContextId>,
    one: Signal<Local, VertexId>,
    two: Signal<Local, VertexId>,
}

// The kernel writes the number as a literal, because rust-hdl takes no constants of Rust; a change in the
// protocol must come here.
const _: () = assert!(FIRST_ROUND == 16, "the first round of this block follows the protocol");

impl Logic for NextPoint {
    #[hdl_gen]
    fn update(&mut self) {
        self.first_round.next = 16.into();
        self.first_context.next = 0.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.is_batch.next = self.deal.val().is_batch;
        self.taken.next = self.passed.val().id;
        self.wide_turn.next = bit_cast::<15, 5>(self.pointer.val().turn);
        self.wide_taker.next = bit_cast::<15, 5>(self.passed.val().context);
        self.narrow_turn.next = bit_cast::<7, 5>(self.pointer.val().turn);
        self.dealt_from.next = self.deal.val().dealt_from;
        self.first_dealt.next = self.dealt_from.val() + self.narrow_turn.val();
        // A comparison with 16 would be a carry chain in front of the sum, so the upper bits are tested instead.
        self.rounds.next = self.taken.val().get_bits::<11>(4);
        self.is_dealt.next = self.rounds.val().any();
        self.following.next.is_dealt = self.is_dealt.val();
        // L8: below the first round the next vertex belongs to context 0 again.
        self.is_early.next = (!self.is_dealt.val()) & (!self.is_batch.val());
        self.from.next = self.taken.val();
        self.step.next = bit_cast::<15, 5>(self.deal.val().contexts);
        if self.is_early.val() {
            self.step.next = self.one.val();
        }
        if self.passed.val().is_seed {
            self.from.next = bit_cast::<15, 7>(self.passed.val().dealt);
            self.step.next = 0.into();
        }
        self.following.next.id = self.from.val() + self.step.val();
        self.following.next.first_record = 0.into();
        if self.is_batch.val() {
            self.following.next.first_record = self.wide_taker.val() << self.two.val();
        }
        self.first.next.id = self.wide_turn.val() + self.first_round.val();
        // Context 0 takes vertex 2 first in either case.
        if self.is_batch.val() | (self.pointer.val().turn == self.first_context.val()) {
            self.first.next.id = bit_cast::<15, 7>(self.pointer.val().third);
        }
        self.first.next.is_seed = self.is_batch.val();
    }
}
