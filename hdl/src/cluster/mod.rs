//! What stands between the two streams of words and the engines of a chip that has several.
//!
//! ```text
//! commands -> JobRouter --> CommandQueue -> Core --> AnswerCollector -> answers
//!                      \--> CommandQueue -> Core --/
//! ```
//! A queue and its engine are an `EngineSlot`. `Dual` has two slots, `Quad` has four.

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
