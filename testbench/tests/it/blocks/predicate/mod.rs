//! Tests of the blocks in `hdl/src/predicate`.

mod corner_pairs;
mod cross_product;
mod dot_product;
mod edge_signs;
mod point_difference;
mod side_delay;
mod vertex_order;
mod visit_predicates;
mod wide_product;
