//! Runs `CrossProduct` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_points::{bits_of, difference_stimuli, signed, DIFFERENCE_PORTS};
use incircle_hdl::predicate::CrossProduct;

named_ports!([] CrossProduct, [a_x, a_y, b_x, b_y], [product], clock);

#[test]
fn cross_products() {
    let mut delay = Delay::new(CrossProduct::LATENCY);
    Stepper::new("cross_product", CrossProduct::default(), 1).run(
        &DIFFERENCE_PORTS,
        &["product"],
        difference_stimuli(),
        |values| {
            let [a_x, a_y, b_x, b_y] = [0, 1, 2, 3].map(|k| signed(values[k], 18));
            vec![delay.pass(bits_of(a_x * b_y - a_y * b_x, 36))]
        },
    );
}
