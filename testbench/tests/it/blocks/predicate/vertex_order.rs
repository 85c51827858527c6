//! `VertexOrder` and `SortKey`: Rust, Verilog and plain integer arithmetic agree clock by clock.

use crate::rig::cosimulation::named_ports;
use crate::rig::visit_points::{order_flags, run_visits, ORDER_FLAGS};
use incircle_hdl::predicate::VertexOrder;

named_ports!([] VertexOrder, [r0, r1, r2, p],
    [p_before_r0, p_before_r1, p_before_r2, p_equals_r0, p_equals_r1, p_equals_r2, r0_before_r1, r0_before_r2,
     r1_before_r2], clock);

#[test]
fn vertex_order_sorts_by_x_then_y() {
    run_visits("vertex_order", VertexOrder::new(1), &ORDER_FLAGS, 1, order_flags);
}
