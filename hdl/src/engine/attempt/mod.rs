//! Decides, when a visit completes, what its context does next.
//!
//! ```text
//! visit, record, verdict -> VisitCase -> AttemptStep -> AttemptLists -> entries, inner records, locks: CommitPath
//!                              |            ^   |           ^
//!                              |            |   v           |
//!                              |        AttemptStore    AttemptPoints
//!                              v        (cavity)        (point of each context)
//!                          NextVisits -> up to three visits: PushPort
//! ```
//! An insertion walks to a record that conflicts with its point, locks this root, and digs the cavity by tests, many of
//! which are in flight at once. The whole state of an attempt is one word of [`AttemptStore`]. The word is read a clock
//! before one of the visits completes, and is changed and written back in the clock in which the visit completes. So
//! visits of different contexts may complete in any mixture, one in each clock.
//!
//! Lock rules (see `docs/engine.md`): L1, an attempt that meets a foreign lock drains and releases ([`VisitCase`],
//! [`AttemptStep`], [`Aftermath`]); L2, the context with the priority visits the record again instead ([`VisitCase`]);
//! L5, the root that the walk found is visited once more under its lock ([`VisitCase`], [`NextVisits`]); L6, a walk
//! visits that record again while the last commit or release of its context is due ([`VisitCase`]); L7, a walk visits a
//! record again that was not written or was being written ([`VisitCase`]); L10, the walk ends at the first record that
//! conflicts with the point ([`VisitCase`]).

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
