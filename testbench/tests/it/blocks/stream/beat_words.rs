//! Runs `BeatWords` in Rust and in Verilog beside plain code: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use crate::rig::stream_bits::{set_bits, wide};
use incircle_hdl::stream::BeatWords;
use incircle_testkit::SplitMix64;

named_ports!([const W: usize] BeatWords<W>,
    [reset, beat_valid, beat_data, command.ready], [takes, command.valid, command.data, is_held], clock);

fn cuts<const W: usize>(name: &'static str) {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new(name, BeatWords::<W>::new(), 1);
    let mut held: VecDeque<u32> = VecDeque::new();
    let mut words = 0;
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(500) == 0;
        let valid = random.below([1, 5][clock / 600 % 2]) == 0;
        let ready = random.below([1, 4][clock / 1200 % 2]) == 0;
        let beat: Vec<u32> = (0..W / 32).map(|_| random.below(1 << 32) as u32).collect();
        set_bits(&mut block, &[("reset", reset), ("beat_valid", valid), ("command_ready", ready)]);
        block.set("beat_data", wide(&beat));
        block.settle();
        let loads = valid && (held.is_empty() || held.len() == 1 && ready);
        if clock > 0 {
            block.expect("command_valid", !held.is_empty());
            block.expect("is_held", !held.is_empty());
            block.expect("takes", loads);
            if let Some(word) = held.front() {
                block.expect("command_data", *word);
            }
        }
        block.edge();
        if ready && held.pop_front().is_some() {
            words += 1;
        }
        if loads {
            held.extend(beat);
        }
        if reset {
            held.clear();
        }
    }
    assert!(words > 2000, "{words} words");
}

#[test]
fn beats_are_cut_into_words() {
    cuts::<64>("stream_beat_words_64");
    cuts::<128>("stream_beat_words_128");
}

#[test]
fn beat_words_show_the_wave_of_their_header() {
    let mut block = Stepper::new("stream_beat_words_64", BeatWords::<64>::new(), 1);
    let mut wave = Wave::default();
    let mut beats: VecDeque<u32> = [1, 3].into();
    for clock in 0..9 {
        let valid = clock > 0 && !beats.is_empty();
        let ready = clock != 3;
        set_bits(&mut block, &[("reset", clock == 0), ("beat_valid", valid), ("command_ready", ready)]);
        let first = beats.front().copied().unwrap_or(0);
        block.set("beat_data", wide(&[first, first + 1]));
        block.settle();
        let takes = valid && block.is("takes");
        let gives = clock > 0 && block.is("command_valid");
        wave.take(&[
            ("beat_valid", Cell::Bit(valid)),
            ("takes", Cell::Bit(takes)),
            ("command_valid", Cell::Bit(gives)),
            ("command_ready", Cell::Bit(ready)),
            ("command_data", if gives { Cell::Number(block.get("command_data")) } else { Cell::Open }),
        ]);
        block.edge();
        if takes {
            beats.pop_front();
        }
    }
    wave.assert_drawn_in("beat_words");
}
