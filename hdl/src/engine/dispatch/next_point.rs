//! The first vertex of a context, and the vertex that follows one it takes.
//!
//! 1. There are `jobs` jobs, one outside a batch. The first triangle of job `g` has the vertices `3g` to `3g + 2` and
//!    the records `4g` to `4g + 3`. Behind `dealt_from = 3 jobs`, point `i` of job `g` is vertex `i jobs + g`.
//! 2. The first context of team `g` has the number `g`. It takes vertex `3g + 2` first, whose arrival completes the
//!    first triangle, and then the points of its job before the 17th one by one (L8).
//! 3. Point 16 of a job and all later ones are dealt to the contexts of its team in turn. So context `k` takes vertex
//!    `16 jobs + k`, and from there on every `contexts`-th vertex.
//! 4. The flags `is_seed` (the vertex is the third of a first triangle) and `is_dealt` (the point is none of the first
//!    16) are made when the vertex is chosen, a clock ahead of the sum: a comparison in front of the sum would limit
//!    the clock of the core.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{ContextId, Deal, Plan, TriangleId, VertexId};
use incircle_protocol::FIRST_ROUND;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The context to which the pointer points.
    pub struct Pointer {
        pub turn: ContextId,
        /// The team of the context, and whether it is the first context of its team.
        pub team: ContextId,
        pub is_first: bool,
        /// The sum `3 turn + 2`: the third vertex of the first triangle, if the context is the first of its team.
        pub third: Bits<7>,
    }

    /// In the first round of the pointer: a context and its team.
    pub struct Planned {
        pub valid: bool,
        pub context: ContextId,
        pub team: ContextId,
    }

    /// The context that the pointer has left, and the vertex that it would take.
    pub struct Passed {
        pub context: ContextId,
        pub team: ContextId,
        /// The context is the first of its team.
        pub is_first: bool,
        pub id: VertexId,
        /// The vertex is the third of the first triangle; then `dealt` follows it.
        pub is_seed: bool,
        pub dealt: Bits<7>,
        /// The vertex is one of the dealt ones, behind the first round of its job.
        pub is_dealt: bool,
    }

    /// The plan of that context after it has taken its vertex.
    pub struct Following {
        /// The vertex that it takes next.
        pub id: VertexId,
        /// The first record of the context's mesh.
        pub first_record: TriangleId,
    }
}

#[derive(LogicBlock, Default)]
pub struct NextPoint {
    /// The numbers of contexts that work and of jobs.
    pub deal: Signal<In, Deal>,
    /// The context under the pointer.
    pub pointer: Signal<In, Pointer>,
    /// The vertex that the context under the pointer takes first; if that is the third of a first triangle, the vertex
    /// after it (`first_dealt`).
    pub first: Signal<Out, Plan>,
    pub first_dealt: Signal<Out, Bits<7>>,
    /// The context that the pointer has left, with the vertex that it takes; and the plan that follows.
    pub passed: Signal<In, Passed>,
    pub following: Signal<Out, Following>,
    from: Signal<Local, VertexId>,
    step: Signal<Local, VertexId>,
    wide_turn: Signal<Local, VertexId>,
    wide_team: Signal<Local, VertexId>,
    wide_jobs: Signal<Local, VertexId>,
    first_round: Signal<Local, VertexId>,
    narrow_turn: Signal<Local, Bits<7>>,
    dealt_from: Signal<Local, Bits<7>>,
    two: Signal<Local, VertexId>,
    four: Signal<Local, VertexId>,
}

// The kernel holds the number as a power of two, because rust-hdl allows no constants there. A changed protocol fails
// here.
const _: () = assert!(FIRST_ROUND == 1 << 4, "the first round of this block follows the protocol");

impl Logic for NextPoint {
    #[hdl_gen]
    fn update(&mut self) {
        self.two.next = 2.into();
        self.four.next = 4.into();
        self.wide_turn.next = bit_cast::<15, 5>(self.pointer.val().turn);
        self.wide_team.next = bit_cast::<15, 5>(self.passed.val().team);
        self.wide_jobs.next = bit_cast::<15, 5>(self.deal.val().jobs);
        self.first_round.next = self.wide_jobs.val() << self.four.val();
        self.narrow_turn.next = bit_cast::<7, 5>(self.pointer.val().turn);
        self.dealt_from.next = self.deal.val().dealt_from;
        self.first_dealt.next = self.dealt_from.val() + self.narrow_turn.val();
        // L8: of the first 16 points of its job, the first context of a team takes one after another.
        self.from.next = self.passed.val().id;
        self.step.next = self.wide_jobs.val();
        if self.passed.val().is_dealt {
            self.step.next = bit_cast::<15, 5>(self.deal.val().contexts);
        }
        if self.passed.val().is_seed {
            self.from.next = bit_cast::<15, 7>(self.passed.val().dealt);
            self.step.next = 0.into();
        }
        self.following.next.id = self.from.val() + self.step.val();
        // L11: the first walk of a context starts in the mesh of its own job.
        self.following.next.first_record = self.wide_team.val() << self.two.val();
        self.first.next.id = self.wide_turn.val() + self.first_round.val();
        if self.pointer.val().is_first {
            self.first.next.id = bit_cast::<15, 7>(self.pointer.val().third);
        }
        self.first.next.is_seed = self.pointer.val().is_first;
    }
}
