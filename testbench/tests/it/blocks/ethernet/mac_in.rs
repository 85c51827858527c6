//! Runs `MacIn` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::ethernet_frames::sealed;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::MacIn;
use incircle_testkit::SplitMix64;

named_ports!(
    MacIn,
    [reset, data_valid, data_error, data],
    [begins, byte_valid, byte_data, place, ends, is_sound],
    clock
);

#[test]
fn frames_come_out_and_only_sound_ones_count() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("ethernet_mac_in", MacIn::default(), 1);
    for (port, value) in [("reset", true), ("data_valid", false), ("data_error", false)] {
        block.set(port, value);
    }
    block.set("data", 0u8);
    block.settle();
    block.edge();
    block.set("reset", false);
    // After a reset the block awaits a clock without data.
    block.settle();
    block.edge();
    let mut counts = [0; 2];
    for run in 0..160 {
        let length = [60, 61, 1514, 1515, 59, 3, 60 + random.below(80)][run % 7] as usize;
        let mut frame: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
        let is_short = length < 60;
        frame = if is_short { frame } else { sealed(frame) };
        let mut error_at = None;
        let mut is_right = !is_short && frame.len() <= 1518;
        match run % 5 {
            1 => {
                let place = random.below(frame.len() as u64) as usize;
                frame[place] ^= 1 << random.below(8);
                is_right = false;
            }
            2 => {
                error_at = Some(random.below(frame.len() as u64) as usize);
                is_right = false;
            }
            _ => {}
        }
        let preamble = random.below(8) as usize;
        let spoils = run % 11 == 3;
        let mut line: Vec<u8> = [vec![0x55; preamble], vec![if spoils { 0xd4 } else { 0xd5 }]].concat();
        line.extend(&frame);
        let (mut seen, mut begun, mut verdict) = (Vec::new(), 0, None);
        for clock in 0..line.len() + 3 {
            let byte = line.get(clock);
            block.set("data_valid", byte.is_some());
            block.set("data", byte.copied().unwrap_or(0xd5));
            block.set("data_error", error_at.is_some_and(|at| clock == at + preamble + 1));
            block.settle();
            let shown = [block.is("begins"), block.is("byte_valid"), block.is("ends")];
            assert!(shown.iter().filter(|shows| **shows).count() <= 1, "two at once");
            begun += usize::from(shown[0]);
            if shown[1] {
                block.expect("place", seen.len() as u64);
                seen.push(block.get("byte_data") as u8);
            }
            if shown[2] {
                verdict = Some(block.is("is_sound"));
            }
            block.edge();
        }
        if spoils {
            assert!(begun == 0 && seen.is_empty() && verdict.is_none(), "something of what is no frame came out");
            continue;
        }
        assert_eq!((begun, verdict), (1, Some(is_right)), "run {run}, {length} bytes");
        assert!(seen == frame[..frame.len().min(1518)], "run {run}");
        counts[usize::from(is_right)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 30), "{counts:?}");
}

#[test]
fn wave_of_a_short_frame() {
    let valid = |clock| (clock, "data_valid", 1);
    let stimuli = [
        valid(1),
        valid(2),
        valid(3),
        valid(4),
        valid(5),
        (1, "data", 0x55),
        (2, "data", 0xd5),
        (3, "data", 7),
        (4, "data", 8),
        (5, "data", 9),
    ];
    let lanes = [
        ("data_valid", "data_valid", 0, 1, When::Always),
        ("begins", "begins", 0, 1, When::Always),
        ("byte_valid", "byte_valid", 0, 1, When::Always),
        ("place", "place", 0, 11, When::If("byte_valid")),
        ("ends", "ends", 0, 1, When::Always),
        ("is_sound", "is_sound", 0, 1, When::Always),
    ];
    draw("ethernet_mac_in", MacIn::default(), &stimuli, 9, &lanes).assert_drawn_in("mac_in");
}
