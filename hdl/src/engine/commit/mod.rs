//! Replaces a cavity by the star of its point, and releases the locks of attempts that are over. A *ring* is the closed
//! boundary of a cavity.
//!
//! ```text
//! entries, rings -> RingReader -> Commit -----------------> WritePort
//!                   JobQueue      FreshIds, InnerList         |
//!                   RingList         |                        v
//!                                    | last write        triangle memory
//!                                    v
//! locks, aborts -----------------> Release -> LockStore: one lock cleared in each clock
//!                                  JobQueue
//! ```
//! A ring is written in one pass, a record or a link in each clock, while its context already walks with the next
//! point. The star overwrites the records of the cavity under their old ids and takes two new ids.
//!
//! Lock rules (see `docs/engine.md`): L1, the locks of an aborted attempt are released when its visits have completed
//! ([`Release`]); L4, the locks of a ring are released after its last write ([`CommitPath`], [`Release`]); L7, new ids
//! count as not written until their commit has ended ([`FreshIds`]).

#[expect(clippy::module_inception, reason = "the room carries the name of its main block")]
mod commit;
mod commit_path;
mod commit_steps;
mod fresh_ids;
mod inner_list;
mod job_queue;
mod kept_ids;
mod release;
mod ring_list;
mod ring_reader;
mod star_id;

pub use commit::Commit;
pub use commit_path::CommitPath;
pub use commit_steps::{CommitState, CommitSteps};
pub use fresh_ids::FreshIds;
pub use inner_list::InnerList;
pub use job_queue::JobQueue;
pub use kept_ids::KeptIds;
pub use release::Release;
pub use ring_list::RingList;
pub use ring_reader::RingReader;
pub use star_id::StarId;
