//! Runs `WideProduct` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_points::{bits_of, signed};
use incircle_hdl::predicate::WideProduct;
use incircle_testkit::SplitMix64;

named_ports!([] WideProduct, [a, b], [product], clock);

const CYCLES: usize = 10_000;

#[test]
fn wide_product_of_all_limbs() {
    let mut numbers = SplitMix64::new(14);
    let limit = 1_i64 << 33;
    let corners = [0, 1, -1, 0x1_ffff, 0x2_0000, -0x1_ffff, -0x2_0000, -0x2_0001, limit - 1, -limit, 1 - limit];
    let mut stimuli = vec![];
    for a in corners {
        stimuli.extend(corners.map(|b| [a, b]));
    }
    stimuli.extend((0..CYCLES).map(|_| [(); 2].map(|()| numbers.bits(34) as i64 - limit)));
    let words = stimuli.into_iter().map(|pair| pair.map(|factor| bits_of(factor.into(), 36) as u64).to_vec());
    let mut delay = Delay::new(WideProduct::LATENCY);
    Stepper::new("wide_product", WideProduct::default(), 1).run(&["a", "b"], &["product"], words, |values| {
        vec![delay.pass(bits_of(signed(values[0], 36) * signed(values[1], 36), 68))]
    });
}
