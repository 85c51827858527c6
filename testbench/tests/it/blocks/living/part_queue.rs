//! Runs `PartQueue` in Rust and in Verilog beside a list of words: all three must agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::living::PartQueue;
use incircle_testkit::SplitMix64;

named_ports!(
    PartQueue,
    [reset, head, begins, came, response.ready],
    [has_room, has_two_places, response.valid, response.data, response.both, response.last, is_over],
    clock
);

/// Number of parts that may be on their way.
const PLACES: usize = 32;

/// Number, outcome, vertices and weights of a part.
type Part = (u64, u64, [u64; 3], [u64; 3]);

/// All beats that a part can have, the first words in the low halves.
fn beats((number, outcome, [v0, v1, v2], [w0, w1, w2]): Part) -> [u64; 5] {
    // A vertex that is beyond the capacity, or missing, may have any 32 bits.
    let vertex = if [6, 8].contains(&outcome) { w0 } else { v0 };
    [outcome << 24 | number | vertex << 32, v1 | v2 << 32, w0, w1, w2]
}

/// The inputs of a clock.
#[derive(Clone, Copy, Default)]
struct Inputs {
    reset: bool,
    /// Header, number of parts, and number of beats of a part.
    head: Option<(u64, u64, u64)>,
    begins: bool,
    came: Option<Part>,
    ready: bool,
}

fn set(block: &mut Stepper<PartQueue>, inputs: Inputs) {
    block.set("reset", inputs.reset);
    block.set("head_valid", inputs.head.is_some());
    let (header, parts, beats) = inputs.head.unwrap_or((3, 4, 7));
    block.set("head_header", header);
    block.set("head_length", 2 * beats * parts);
    block.set("head_parts", parts);
    block.set("head_last_beat", beats - 1);
    block.set("begins", inputs.begins);
    block.set("came_valid", inputs.came.is_some());
    let (number, outcome, [v0, v1, v2], [w0, w1, w2]) = inputs.came.unwrap_or((1, 2, [3, 4, 5], [6, 7, 8]));
    block.set("came_part_number", number);
    block.set("came_part_finding_outcome", outcome);
    block.set("came_part_finding_v0", v0);
    block.set("came_part_finding_v1", v1);
    block.set("came_part_finding_v2", v2);
    block.set("came_part_finding_w0", w0);
    block.set("came_part_finding_w1", w1);
    block.set("came_part_finding_w2", w2);
    block.set("response_ready", inputs.ready);
    block.settle();
}

#[test]
fn part_queue_gives_all_parts_in_their_order() {
    let mut random = SplitMix64::new(64);
    let mut block = Stepper::new("living_part_queue", PartQueue::default(), 1);
    set(&mut block, Inputs { reset: true, ..Inputs::default() });
    block.edge();
    let mut fullest = 0;
    for run in 0..400 {
        let count = [0, 1, 2, 40, 90][run % 5];
        let patience = [1, 2, 9][run % 3];
        let beats_of_part = [2, 5, 1, 2, 5, 5, 2][run % 7];
        let header = random.bits(32);
        let mut due = VecDeque::from([header | (count * beats_of_part * 2) << 32]);
        // Items that are still to begin, that have begun, and places that are taken.
        let (mut left, mut begun, mut places, mut sent) = (count, 0u64, 0usize, 0);
        set(&mut block, Inputs { head: Some((header, count, beats_of_part)), ..Inputs::default() });
        block.expect("is_over", true);
        block.edge();
        let mut clocks = 0;
        while sent < 1 + beats_of_part * count {
            let came = (begun > 0 && random.once_in(2)).then(|| {
                (
                    random.bits(24),
                    random.bits(4),
                    [15, 15, 15].map(|n| random.bits(n)),
                    [32, 32, 32].map(|n| random.bits(n)),
                )
            });
            let begins = left > 0 && places < PLACES && random.once_in(2);
            let ready = random.once_in(patience);
            set(&mut block, Inputs { begins, came, ready, ..Inputs::default() });
            block.expect("is_over", false);
            // The place of a part is free when its last beat is on offer, at the latest when it is taken.
            if places < PLACES {
                block.expect("has_room", true);
            }
            if places + 1 < PLACES {
                block.expect("has_two_places", true);
            }
            let is_given = block.is("response_valid");
            if is_given {
                block.expect("response_data", *due.front().expect("a beat that is due"));
                block.expect("response_both", true);
                block.expect("response_last", sent == beats_of_part * count);
            }
            block.edge();
            clocks += 1;
            assert!(clocks < 10_000, "the answer ends");
            if let Some(part) = came {
                due.extend(&beats(part)[..beats_of_part as usize]);
                begun -= 1;
            }
            if begins {
                left -= 1;
                begun += 1;
                places += 1;
            }
            if is_given && ready {
                due.pop_front();
                sent += 1;
                places -= usize::from(sent > 1 && (sent - 1) % beats_of_part == 0);
            }
            fullest = fullest.max(places);
        }
        set(&mut block, Inputs::default());
        block.expect("is_over", true);
        block.expect("response_valid", false);
        block.edge();
    }
    assert_eq!(fullest, PLACES, "the test fills all places");
}

#[test]
fn part_queue_has_room_for_32_parts() {
    let mut block = Stepper::new("living_part_queue", PartQueue::default(), 1);
    set(&mut block, Inputs { reset: true, ..Inputs::default() });
    block.edge();
    for place in 0..=PLACES {
        set(&mut block, Inputs { begins: place < PLACES, ..Inputs::default() });
        block.expect("has_room", place < PLACES);
        block.expect("has_two_places", place + 1 < PLACES);
        block.edge();
    }
}

#[test]
fn part_queue_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("living_part_queue", PartQueue::default(), 2);
    set(&mut block, Inputs { reset: true, ..Inputs::default() });
    block.edge();
    let mut wave = Wave::default();
    for clock in 0..11 {
        let inputs = Inputs {
            reset: false,
            head: (clock == 0).then_some((85, 1, 2)),
            begins: clock == 1,
            came: (clock == 3).then_some((6, 0, [1, 7, 2], [9; 3])),
            ready: clock >= 5,
        };
        set(&mut block, inputs);
        let valid = block.is("response_valid");
        let low = if valid { Cell::Number(block.get_masked("response_data", 0x7f)) } else { Cell::Open };
        wave.take(&[
            ("head", Cell::Bit(inputs.head.is_some())),
            ("begins", Cell::Bit(inputs.begins)),
            ("came", Cell::Bit(inputs.came.is_some())),
            ("response_valid", Cell::Bit(valid)),
            ("response_ready", Cell::Bit(inputs.ready)),
            ("response_last", Cell::Bit(valid && block.is("response_last"))),
            ("low", low),
            ("is_over", Cell::Bit(block.is("is_over"))),
        ]);
        block.edge();
    }
    wave.assert_drawn_in("part_queue");
}
