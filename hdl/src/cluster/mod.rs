//! The blocks between the two streams of words and the engines of a chip that has several engines.
//!
//! ```text
//! commands -> JobRouter --> CommandQueue -> Core --> AnswerCollector -> answers
//!                      \--> CommandQueue -> Core --/
//! ```
//! An `EngineSlot` holds a queue and its engine, and counts the answers that the engine owes. `Dual` has two slots, and
//! `Quad` has four. The router and the collector each choose the next engine in turn by an `EngineChoice`, and the
//! router finds the beginnings of commands by a `WordPlace`.

mod answer_collector;
mod command_queue;
mod dual;
mod engine_choice;
mod engine_slot;
mod job_router;
mod quad;
pub mod types;
mod word_place;

pub use answer_collector::AnswerCollector;
pub use command_queue::CommandQueue;
pub use dual::Dual;
pub use engine_choice::EngineChoice;
pub use engine_slot::EngineSlot;
pub use job_router::JobRouter;
pub use quad::Quad;
pub use word_place::{Place, WordPlace};
