//! Decides which context starts next and with which point, and says whether anything is left to do.
//!
//! ```text
//! outcome of a visit -> ContextFlags -> asleep, retrying, busy -> Starter -> a walk starts: PushPort
//!                       priority,                                 |    ^
//!                       solo insertion                            v    |
//!                                                  DueCheck, PlanTable, NextPoint: is it due, with which point?
//! finished points -> FinishedPoints -> quiet
//!                       |
//!                       +-----> Watchdog -> stuck
//! ```
//! A pointer goes round the contexts, one a clock, and starts the context it points to if that context is due. The
//! round costs an insertion a few clocks, but avoids a search over all contexts, which would be the slowest path of the
//! core. [`Watchdog`] reports `stuck` if no point is finished for `incircle_protocol::patience` clocks; commands are
//! then answered with `Stuck`.
//!
//! Lock rules (see `docs/engine.md`): L1, a context whose attempt aborted rests until a fourth round of the pointer
//! ([`DueCheck`]); L2, there is one priority ([`ContextFlags`]); L3, when the context with the priority has met 8
//! foreign locks, no other context retries until its point is finished ([`ContextFlags`], [`DueCheck`]); L8, the first
//! points go to context 0 ([`DueCheck`], [`Starter`], [`NextPoint`]).

mod context_flags;
mod dispatcher;
mod due_check;
mod finished_points;
mod next_point;
mod plan_table;
mod start_pointer;
mod starter;
mod watchdog;

pub use context_flags::ContextFlags;
pub use dispatcher::Dispatcher;
pub use due_check::DueCheck;
pub use finished_points::FinishedPoints;
pub use next_point::{Following, NextPoint, Passed, Pointer};
pub use plan_table::{PlanTable, PlanWrite};
pub use start_pointer::StartPointer;
pub use starter::{Candidate, Starter};
pub use watchdog::Watchdog;
