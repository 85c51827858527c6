//! The first triangle of a mesh, and its three ghost triangles.
//!
//! ```text
//! points that have come -> Seeder <- verdict on the first three points
//!                             |
//!                             +-> SeedWrites -> WritePort: four records
//! ```
//! Every later insertion walks through a mesh that exists, so the first triangle is a special case. In a batch the
//! seeder makes the first triangle of each job in turn.
//!
//! Lock rules: none. No other context works before the first triangle is in the mesh.

mod seed_writes;
mod seeder;

pub use seed_writes::SeedWrites;
pub use seeder::Seeder;
