//! The insertion engine: visits, cavity, commit, and the phases of an insertion.

mod cavity;
mod commit;
mod context;
mod counters;
mod issue;
mod release;
mod root_bundle;
mod seed_writes;
mod solo;
mod solo_writes;
mod types;
mod verdict_logic;
mod visit_pipeline;
mod visit_reader;
mod write_port;
mod write_request;

pub use cavity::Cavity;
pub use commit::{Commit, CommitState};
pub use context::{Context, Phase};
pub use counters::{Counters, WideCounter};
pub use issue::Issue;
pub use release::Release;
pub use root_bundle::RootBundle;
pub use seed_writes::SeedWrites;
pub use solo::{Solo, SoloState};
pub use solo_writes::SoloWrites;
pub use types::*;
pub use verdict_logic::VerdictLogic;
pub use visit_pipeline::VisitPipeline;
pub use visit_reader::VisitReader;
pub use write_port::WritePort;
pub use write_request::{LinkWrite, RecordWrite};
