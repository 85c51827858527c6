//! Runs `SeedWrites` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::ids::LAST_ID;
use crate::rig::stepper::bundles::record_write;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::SeedWrites;

named_ports!([] SeedWrites, [step, first_vertex, first_record, turns_left, infinite], [write]);

#[test]
fn seed_writes_are_the_first_triangle_and_its_ghosts() {
    let mut stimuli = vec![];
    for step in 0..8 {
        for turns_left in [0, 1] {
            for job in [0, 1, 7, 23] {
                let infinites = [15, 2047, LAST_ID];
                stimuli.extend(infinites.map(|infinite| vec![step, turns_left, infinite, 3 * job, 4 * job]));
            }
        }
    }
    Stepper::new("seed_writes", SeedWrites::default(), 1).run(
        &["step", "turns_left", "infinite", "first_vertex", "first_record"],
        &["write"],
        stimuli,
        |values| {
            let infinite = values[2];
            let (a, first) = (values[3], values[4]);
            let (b, c) = if values[1] == 1 { (a + 1, a + 2) } else { (a + 2, a + 1) };
            let (id, v, n) = match values[0] {
                0 => (0, [a, a + 1, a + 2], [0, 0, 0]),
                1 => (0, [a, b, c], [1, 2, 3]),
                2 => (1, [c, b, infinite], [3, 2, 0]),
                3 => (2, [a, c, infinite], [1, 3, 0]),
                _ => (3, [b, a, infinite], [2, 1, 0]),
            };
            let (id, n) = (first + id, n.map(|n| first + n));
            vec![Some(record_write(id, v, n))]
        },
    );
}
