//! A mesh that stands, answers and grows: runs of questions and of changes, in all contexts side by side.
//!
//! The words of a run come in, and the words of its answer go out. Each question is a walk through the visit pipeline
//! of the insertion engine, which inserts nothing meanwhile. Behind the walk, a `Nearest` goes round vertices. Each
//! `InsertAs` is an insertion of that engine, and each `Delete` begins there and ends in the blocks of
//! [`engine::holes`](crate::engine::holes). A `Move` is a `Delete` that writes a point, or goes on as an `InsertAs`.
//! [`Questions`] and [`Changes`] draw their blocks.

mod change_ends;
mod changes;
mod checked_item;
mod item_dealer;
mod item_queues;
mod late_events;
mod late_points;
mod named_vertices;
mod near_search;
mod next_item;
mod part_beat;
mod part_queue;
mod question_step;
mod questions;
mod queue_counts;
mod return_line;
mod run_answer;
mod run_gate;
mod run_port;
mod standing_view;
pub mod types;
mod vertex_bits;
mod vertex_check;

pub use change_ends::ChangeEnds;
pub use changes::Changes;
pub use item_queues::ItemQueues;
pub use late_events::LateEvents;
pub use late_points::LatePoints;
pub use near_search::NearSearch;
pub use next_item::NextItem;
pub use part_queue::PartQueue;
pub use question_step::QuestionStep;
pub use questions::Questions;
pub use return_line::ReturnLine;
pub use run_gate::RunGate;
pub use run_port::{RunPort, RunState};
pub use standing_view::StandingView;
pub use vertex_check::{CheckState, VertexCheck};
