//! Decides, when a visit completes, what its context does next.
//!
//! ```text
//! visit, record, verdict -> VisitCase -> AttemptStep -> AttemptLists -> entries, inner triangles, locks, jobs: CommitPath
//!                              |            ^   |           ^
//!                              |            |   v           |
//!                              |        AttemptStore    AttemptPoints
//!                              v        (cavity)        (point of each context)
//!                          NextVisits -> up to three visits: PushPort
//! ```
//! One insertion walks to the triangle of its point, locks it, and digs the cavity by tests, many of them in flight. Its whole state is
//! one word of [`AttemptStore`], which is read a clock before one of its visits completes, and changed and written back in the clock in
//! which the visit does. So the visits of all contexts may complete in any order, one in each clock.
//!
//! Lock rules (see `docs/engine.md`): L1, an attempt that meets a foreign lock drains and releases ([`VisitCase`], [`AttemptStep`],
//! [`Aftermath`]); L2, the holder of the priority asks again instead ([`VisitCase`]); L5, the located triangle is visited once more
//! under its lock ([`VisitCase`], [`NextVisits`]); L6, a walk visits its triangle again while its context's last commit or
//! release is due ([`VisitCase`]); L7, a walk visits a record again that was not written ([`VisitCase`]).

mod aftermath;
mod attempt_lists;
mod attempt_points;
mod attempt_step;
mod attempt_store;
mod attempts;
mod context_address;
mod next_visits;
mod visit_case;

pub use aftermath::Aftermath;
pub use attempt_lists::AttemptLists;
pub use attempt_points::AttemptPoints;
pub use attempt_step::AttemptStep;
pub use attempt_store::{AttemptStore, Held};
pub use attempts::Attempts;
pub use context_address::ContextAddress;
pub use next_visits::NextVisits;
pub use visit_case::VisitCase;
