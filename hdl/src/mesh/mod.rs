//! The memories that hold the mesh.

mod triangle_store;
mod vertex_store;

pub use triangle_store::TriangleStore;
pub use vertex_store::VertexStore;
