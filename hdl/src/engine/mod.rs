//! The insertion engine: visits, cavity, commit, and the phases of an insertion.

mod counters;
mod issue;
mod seed_writes;
mod seeder;
mod solo;
mod solo_visit;
mod solo_writes;
mod star_id;
mod types;
mod verdict_logic;
mod visit_judge;
mod visit_pipeline;
mod visit_reader;
mod write_port;
mod write_request;

pub use counters::{Counters, WideCounter};
pub use issue::Issue;
pub use seed_writes::SeedWrites;
pub use seeder::Seeder;
pub use solo::{Solo, SoloState};
pub use solo_visit::SoloVisit;
pub use solo_writes::SoloWrites;
pub use star_id::StarId;
pub use types::*;
pub use verdict_logic::VerdictLogic;
pub use visit_judge::VisitJudge;
pub use visit_pipeline::VisitPipeline;
pub use visit_reader::VisitReader;
pub use write_port::WritePort;
pub use write_request::{LinkWrite, RecordWrite};
