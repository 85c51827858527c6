//! The one write port of the triangle memory.
//!
//! ```text
//! Commit, Solo, Seeder -> RecordWrite, LinkWrite -> Write -> WritePort -> TriangleStore
//! ```
//! A write is a whole record or one *link*, the id of one neighbour in a record. The three sources never write in the
//! same clock, so the port only merges their requests and adds a register.
//!
//! Lock rules: none. `Commit` holds the locks of all records that it writes. `Solo` and `Seeder` need none: they write
//! while no other context works.

mod write_port;
mod write_request;

pub use write_port::WritePort;
pub use write_request::{LinkWrite, RecordWrite};
