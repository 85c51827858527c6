//! The memories that hold the mesh: triangle records, vertices, and the locks with their holders (rule L9).

mod lock_store;
mod record;
mod triangle_store;
mod vertex_store;

pub use lock_store::LockStore;
pub use record::{ReadRecord, Record};
pub use triangle_store::TriangleStore;
pub use vertex_store::VertexStore;
