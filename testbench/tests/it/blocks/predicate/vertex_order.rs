//! `VertexOrder` and `SortKey`: Rust, Verilog and plain integer arithmetic agree clock by clock.

use crate::rig::stepper::named_ports;
use crate::rig::visit_points::{order_flags, run_visits, ORDER_FLAGS};
use incircle_hdl::predicate::VertexOrder;

named_ports!([] VertexOrder, [corners, p], [flags], clock);

#[test]
fn vertex_order_sorts_by_x_then_y() {
    run_visits("vertex_order", VertexOrder::new(1), &ORDER_FLAGS, 1, order_flags);
}
