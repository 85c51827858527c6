mod brute;
mod holes;

pub(super) use brute::{draw, draw_clip, mesh_of, sets};
pub(super) use holes::draw_holes;
