//! Runs `DatagramHeader` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramHeader;
use incircle_testkit::SplitMix64;

named_ports!(DatagramHeader, [reset, starts, state, drops, kind, index], [byte_data, digest], clock);

/// The bytes of a header that a datagram keeps, beside its kind.
#[derive(Clone, Copy, Debug)]
struct Kept {
    status: u8,
    free_bytes: u16,
    expected: u32,
    digest: u32,
}

#[test]
fn headers_say_what_was_true_when_the_datagram_began() {
    let mut random = SplitMix64::new(12);
    let mut block = Stepper::new("udp_datagram_header", DatagramHeader::default(), 1);
    let (mut kept, mut has_dropped): (Option<Kept>, bool) = (None, false);
    let mut counts = [0; 2];
    for clock in 0..30_000 {
        let reset = clock == 0 || random.below(400) == 0;
        let (starts, drops) = (random.below(10) == 0, random.below(20) == 0);
        let (is_open, is_busy) = (random.below(2) == 0, random.below(2) == 0);
        let [expected, digest] = [(); 2].map(|()| random.next_u64() as u32);
        // The largest FIFO has 32,768 bytes.
        let free_words = [0, 1, 8192, random.below(8193) as u16][random.below(4) as usize];
        let (kind, index) = (random.below(256) as u8, random.below(8) as usize);
        for (port, flag) in [("reset", reset), ("starts", starts), ("drops", drops)] {
            block.set(port, flag);
        }
        block.set("state_is_open", is_open);
        block.set("state_is_busy", is_busy);
        block.set("state_expected", expected);
        block.set("state_free", free_words);
        block.set("state_digest", digest);
        block.set("kind", kind);
        block.set("index", index as u32);
        block.settle();
        if let Some(kept) = kept {
            let numbers = [kept.expected.to_le_bytes(), [kind, kept.status, 0, 0]].concat();
            let byte = if index < 6 { numbers[index] } else { kept.free_bytes.to_le_bytes()[index - 6] };
            block.expect("byte_data", byte);
            block.expect("digest", kept.digest);
        }
        block.edge();
        if starts && clock > 0 {
            let status = u8::from(is_open) | u8::from(has_dropped) << 2 | u8::from(is_busy) << 3;
            kept = Some(Kept { status, free_bytes: 4 * free_words, expected, digest });
            counts[usize::from(has_dropped)] += 1;
            has_dropped = false;
        }
        has_dropped = (has_dropped || drops) && !reset;
    }
    assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
}

#[test]
fn wave_of_the_status_behind_a_datagram_that_was_dropped() {
    let mut stimuli = vec![(1, "drops", 1), (2, "starts", 1), (4, "drops", 1), (4, "starts", 1), (6, "starts", 1)];
    for clock in 0..9 {
        stimuli.extend([(clock, "kind", 3), (clock, "state_is_open", 1), (clock, "state_free", 10 + clock as u128)]);
        stimuli.push((clock, "index", if clock == 7 { 6 } else { 5 }));
    }
    let lanes = [
        ("drops", "drops", 0, 1, When::Always),
        ("starts", "starts", 0, 1, When::Always),
        ("state.free", "state_free", 0, 8, When::Always),
        ("index", "index", 0, 3, When::Always),
        ("byte_data", "byte_data", 0, 8, When::At(&[3, 4, 5, 6, 7, 8])),
    ];
    draw("udp_datagram_header", DatagramHeader::default(), &stimuli, 9, &lanes).assert_drawn_in("datagram_header");
}
