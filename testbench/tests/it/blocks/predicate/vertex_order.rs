//! Runs `VertexOrder` and `SortKey` in Rust and in Verilog beside plain integer arithmetic: all
//! three must agree in every clock.

use crate::rig::stepper::named_ports;
use crate::rig::visit_points::{order_flags, run_visits, ORDER_FLAGS};
use incircle_hdl::predicate::VertexOrder;

named_ports!([] VertexOrder, [corners, p], [flags], clock);

#[test]
fn vertex_order_sorts_by_x_then_y() {
    run_visits("vertex_order", VertexOrder::new(1), &ORDER_FLAGS, 1, order_flags);
}
