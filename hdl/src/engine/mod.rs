//! The insertion engine: points come in, triangle records are kept, and up to 24 insertions share one pipeline.
//!
//! ```text
//!                        +---------------------- up to three visits -----------------------+
//!                        v                                                                 |
//! points -> dispatch -> visit -> record, verdict -> attempt -> rings, locks -> commit      |
//!              ^           ^                          |  |                       | |       |
//!              |           | locks, records           |  +-----------------------|-|-------+
//!              |           +------- write <-----------|--------------------------+ |
//!              |                      ^               |                            |
//!              +--- asleep, aborted --|---------------+                            |
//!              +--- finished, released|--------------------------------------------+
//!                                     |
//!                               seed, solo        count: what happened
//! ```
//! The folder is the instance tree. [`InsertionEngine`] holds the blocks of the rooms `visit`, `solo`, `seed` and
//! `write`, and [`Insertions`], which holds those of `dispatch`, `attempt` and `commit`, and in a core with deletions
//! those of `holes`. The core (`top/core.rs`) holds `count` beside the engine. The structs of `types` travel between
//! the rooms. Each room's page draws its blocks and names the rules L1 to L11 of `docs/engine.md` that the room carries
//! out; the code cites a rule where it carries the rule out.

mod attempt;
mod commit;
mod count;
mod dispatch;
mod holes;
mod insertion_engine;
mod insertions;
mod seed;
mod solo;
pub(crate) mod types;
mod visit;
mod write;

pub use attempt::*;
pub use commit::*;
pub use count::*;
pub use dispatch::*;
pub use holes::*;
pub use insertion_engine::InsertionEngine;
pub use insertions::Insertions;
pub use seed::*;
pub use solo::*;
pub use types::*;
pub use visit::*;
pub use write::*;
