//! One pass of a triangle record through the pipeline, from the request of a visit to its verdict.
//!
//! ```text
//! Attempts, Dispatcher, Solo
//!    |
//!    v
//! PushPort -> Issue -> TriangleStore (record) -> VisitReader -> VertexStore -> VisitJudge -----> verdict
//!             queue    LockStore (lock)          turns the      corners        VisitPredicates,  to Attempts,
//!                                                record                        VerdictLogic      Solo, Seeder
//! clock       0        1 and 2                   3 and 4        5              5 to 15           16
//! ```
//! All contexts share one pipeline, because the read port of the triangle memory limits the speed of the core: a record
//! should be read in every clock. Each visit takes the same time. So visits complete in the order in which they were
//! issued, and no arbiter is needed. [`VerdictLogic`] also takes the step of a walk: its verdict names the neighbour
//! nearer to the point.
//!
//! Lock rules (see `docs/engine.md`): L7, the visit of a record that is not written yet, or is being written in the
//! same clock, is marked `again` ([`VisitPipeline`]). The locks themselves, with their holders
//! (L9), lie in [`LockStore`](crate::mesh::LockStore). L10, the side that faces the point decides a tie
//! ([`VerdictLogic`]).

mod issue;
mod moved_star;
mod near_corner;
mod near_logic;
mod push_port;
mod test_corners;
mod verdict_logic;
mod visit_judge;
mod visit_pipeline;
mod visit_reader;

pub use issue::Issue;
pub use moved_star::MovedStar;
pub use near_corner::NearCorner;
pub use near_logic::NearLogic;
pub use push_port::PushPort;
pub use test_corners::TestCorners;
pub use verdict_logic::VerdictLogic;
pub use visit_judge::VisitJudge;
pub use visit_pipeline::VisitPipeline;
pub use visit_reader::VisitReader;
