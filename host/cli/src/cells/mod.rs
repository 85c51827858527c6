//! Voronoi cells of a file of points, and the files that they are written to.
//!
//! `frame` turns exact corners on the grid into coordinates of the file, rounded once. `text` writes GeoJSON and JSON,
//! and `picture` SVG.

mod format;
mod frame;
mod picture;
mod text;
mod view;

pub use format::CellFormat;
pub use frame::Frame;
pub use picture::write_picture;
pub use text::{write_geojson, write_json};
pub use view::CellView;
