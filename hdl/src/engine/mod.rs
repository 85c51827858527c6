//! The insertion engine: visits, cavity, commit, and the phases of an insertion.

mod types;

pub use types::*;
