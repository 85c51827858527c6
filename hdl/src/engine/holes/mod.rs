//! The deletion of vertices, and their moves. [`Holes`] draws its blocks.
//!
//! Rules of a mesh that lives (see `docs/living-mesh.md`): M2, M8 ([`NamedVertex`]); M3 ([`StarOutcome`]); M4, M5
//! ([`StarCase`], [`StarStep`]); M6 ([`HoleWriter`]); M8 ([`HoleRecords`]); M12 ([`KeptEdges`], [`StarStep`]).

mod first_challenge;
mod hole_fill;
mod hole_merge;
mod hole_records;
mod hole_ring;
mod hole_step;
mod hole_writer;
#[allow(clippy::module_inception)]
mod holes;
mod kept_edges;
mod late_point;
mod moved_vertex;
mod named_vertex;
mod next_interval;
mod next_place;
mod star_case;
mod star_outcome;
mod star_step;
mod star_store;
mod star_visits;
mod test_visit;

pub use first_challenge::FirstChallenge;
pub use hole_fill::{FillState, HoleFill};
pub use hole_merge::HoleMerge;
pub use hole_records::HoleRecords;
pub use hole_ring::HoleRing;
pub use hole_step::HoleStep;
pub use hole_writer::HoleWriter;
pub use holes::Holes;
pub use kept_edges::KeptEdges;
pub use late_point::LatePoint;
pub use moved_vertex::MovedVertex;
pub use named_vertex::NamedVertex;
pub use next_interval::NextInterval;
pub use next_place::NextPlace;
pub use star_case::StarCase;
pub use star_outcome::StarOutcome;
pub use star_step::StarStep;
pub use star_store::StarStore;
pub use star_visits::StarVisits;
pub use test_visit::TestVisit;
