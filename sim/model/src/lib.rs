//! Bit-exact software model of the incircle core.
//!
//! The model comes in two forms. [`CommandModel`] takes whole commands and is fast; the back end `model` of the host
//! library runs it. [`ClockModel`] predicts every root port of the core at every clock, and lock-step tests compare it
//! with the Verilog. Both give the same mesh, but the ids of its records may differ, because several contexts finish
//! their insertions in another order. [`ChipModel`] is several engines of the form clock by clock, with what stands
//! between them and the two streams.
//!
//! The algorithm is incremental insertion: a visibility walk, a Bowyer-Watson cavity whose boundary is a ring
//! that is split in place, and a commit that reuses the ids of the removed triangles. Ties follow the tie rule (see
//! [`predicate`]).

mod chip;
mod clock;
mod command;
mod link;
mod mesh;
pub mod predicate;
pub mod serial;
pub mod stream;
pub mod udp;

pub use chip::ChipModel;
pub use clock::{
    Activity, ClockModel, ContextView, Defect, Inputs, LivingDefect, Outputs, RunCounts, VisitView, Write,
};
pub use command::{CommandModel, ModelError};
pub use mesh::{Approach, Changed, Counts, Insertion, Mesh, Record};
