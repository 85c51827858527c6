//! Solo insertion: a point whose boundary is longer than its list is inserted by flips, while all other contexts sleep.
//!
//! ```text
//! Dispatcher -> Solo -> visit -> PushPort           SoloSteps: locates the point, then goes round its star
//!                |
//!                +-> SoloStar -> SoloWrites -> WritePort     the located record is split, then edges are flipped
//!                       |
//!                       +-> SoloVisit: the visit that follows
//! ```
//! The state is constant however large the star becomes, so no list can overflow. A solo insertion is slow and rare.
//!
//! Lock rules: none. No other visit is in flight and no lock is held during a solo insertion;
//! [`ContextFlags`](super::ContextFlags) and [`Starter`](super::Starter) see to that.

#[expect(clippy::module_inception, reason = "the room carries the name of its main block")]
mod solo;
mod solo_star;
mod solo_steps;
mod solo_visit;
mod solo_writes;
mod star_state;

pub use solo::Solo;
pub use solo_star::SoloStar;
pub use solo_steps::{SoloState, SoloSteps};
pub use solo_visit::SoloVisit;
pub use solo_writes::SoloWrites;
pub use star_state::{Beyond, SoloPhase, SoloTurn, StarTriangle};
