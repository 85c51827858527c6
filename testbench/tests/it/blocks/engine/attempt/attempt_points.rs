//! Runs `AttemptPoints` in Rust and in Verilog beside a plain statement of the rule: all
//! three must agree on random visits.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::AttemptPoints;
use incircle_protocol::SMALL;
use incircle_testkit::SplitMix64;

named_ports!(AttemptPoints, [start, now, context_id], [vertex, since], clock);

const ROUNDS: usize = 6000;

#[test]
fn attempt_points_show_the_wave_of_their_header() {
    let mut random = SplitMix64::new(55);
    let mut block = Stepper::new("attempt_points_small", AttemptPoints::new(SMALL), 3);
    let mut points = [(); 4].map(|()| None);
    let mut wave = Wave::default();
    for clock in 0..ROUNDS {
        // The clocks of the wave come first, then random ones.
        let takes = if clock < 4 { clock == 0 } else { flip(&mut random) };
        let [taker, taken_id, now, context] = match clock {
            0..4 => [1, 7, 3, 1],
            _ => [random.below(4), random.below(1 << 15), random.below(1 << 22), random.below(4)],
        };
        block.set("takes", takes);
        for (port, value) in [("start_context", taker), ("start_id", taken_id), ("now", now), ("context_id", context)] {
            block.set(port, value);
        }
        block.settle();
        // A point that was taken at the last edge cannot be read yet.
        let known: Option<[u64; 2]> =
            points[context as usize].filter(|(taken, _)| taken + 1 < clock).map(|(_, point)| point);
        if let Some([vertex, since]) = known {
            block.expect("vertex", vertex);
            block.expect("since", since);
        }
        let cell = |is_shown: bool, value: u64| if is_shown { Cell::Number(value.into()) } else { Cell::Open };
        if clock < 4 {
            wave.take(&[
                ("takes", Cell::Bit(takes)),
                ("taker", cell(takes, taker)),
                ("taken_id", cell(takes, taken_id)),
                ("now", cell(takes, now)),
                ("context_id", cell(clock == 2, context)),
                ("vertex", cell(clock == 2 && known.is_some(), 7)),
                ("since", cell(clock == 2 && known.is_some(), 3)),
            ]);
        }
        block.edge();
        if takes {
            points[taker as usize] = Some((clock, [taken_id, now]));
        }
    }
    wave.assert_drawn_in("attempt_points");
}
