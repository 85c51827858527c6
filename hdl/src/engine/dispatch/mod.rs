//! Decides which context starts next and with which point, and says whether anything is left to do.
//!
//! ```text
//! outcome of a visit -> ContextFlags -> asleep, retrying, busy -> Starter -> a walk starts: PushPort
//!         |             solo insertion                            |    ^
//!         +-----------> Priorities -> may it wait? retry?         v    |
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
//! ([`DueCheck`]); L2, each team has one priority ([`Priorities`]); L3, when the context with the priority has met 8
//! foreign locks, no other context of its team retries until its point is finished ([`Priorities`], [`DueCheck`]); L8,
//! the first points of a job go to the first context of its team ([`DueCheck`], [`OpenTeams`], [`Starter`],
//! [`NextPoint`]); L11, a walk starts in the mesh of its own job ([`NextPoint`]).

mod change_view;
mod context_flags;
mod dispatcher;
mod due_check;
mod fill_flags;
mod fill_priority;
mod finished_points;
mod next_point;
mod open_teams;
mod plan_table;
mod priorities;
mod start_pointer;
mod starter;
mod watchdog;

pub use change_view::ChangeView;
pub use context_flags::ContextFlags;
pub use dispatcher::Dispatcher;
pub use due_check::DueCheck;
pub use fill_flags::FillFlags;
pub use fill_priority::FillPriority;
pub use finished_points::FinishedPoints;
pub use next_point::{Following, NextPoint, Passed, Planned, Pointer};
pub use open_teams::OpenTeams;
pub use plan_table::{PlanTable, PlanWrite};
pub use priorities::Priorities;
pub use start_pointer::StartPointer;
pub use starter::{Candidate, Starter};
pub use watchdog::Watchdog;
