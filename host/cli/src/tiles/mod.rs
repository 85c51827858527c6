//! Sets in tiles over files: a set that no memory and no machine holds as a whole, in steps that scripts can spread.
//!
//! [`split`] reads the inputs twice and writes one file of points for each tile, and a manifest. [`local`] triangulates
//! one tile, on any machine. [`join`] joins the borders of all tiles and writes the canonical mesh. What the steps
//! compute is in [`incircle::tiles`]; here are the files.
//!
//! | file in the folder | written by | holds |
//! |---|---|---|
//! | `manifest` | `split`, as the last file | the inputs, the steps of the tree, the lattice |
//! | `K.points` | `split` | the points of tile `K` with their indices in the input |
//! | `K.local` | `local` | the final triangles of tile `K`, its border, hull and duplicates |
//!
//! Every file begins with a [`Head`](head::Head), which has the run and check sums, and is renamed to its name when it
//! is complete. `docs/tile-files.md` describes the bytes.

mod budget;
pub mod canonical;
mod deal;
mod digest;
mod disk;
mod ground;
mod head;
mod inputs;
mod join;
mod line;
mod local;
mod manifest;
mod merge;
mod opened;
mod result;
mod runs;
mod scratch;
mod split;
mod survey;
mod write;
mod written;

pub use budget::Budget;
pub use digest::{scattered, Digest};
pub use disk::{bytes_in, room_for, told, Needed};
pub use ground::{Extent, Ground, Length};
pub use inputs::{each_piece, points_again};
pub use join::{euler, join, triangles_of, JoinMemory, Joined, Order};
pub use local::{local, Outcome, TileAt};
pub use manifest::{local_path, manifest_path, points_path, Manifest};
pub use scratch::Scratch;
pub use split::{split, Plan, Summary};
pub use write::write_triangles;
