//! Runs `DatagramSums` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw_range, When};
use crate::rig::ethernet_frames::frame_sum;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramSums;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramSums,
    [reset, moves, at, is_last, byte_data, awaits, is_cut],
    [out_valid, out_data, out_is_last, out_drops, is_busy],
    clock
);

/// Parts of a datagram with sums of their own: words, check sum, digest of an answer.
const WORDS: u32 = 4;
const SUM: u32 = 5;
const DIGEST: u32 = 7;

/// A byte of a datagram: its part, what the block is given, and what must go out.
#[derive(Clone, Copy, Debug)]
struct Byte {
    part: u32,
    index: usize,
    given: u8,
    sent: u8,
    is_last: bool,
}

/// A datagram whose parts are given; `answer` has the bytes of the words of the answer, and gets those of this part.
fn datagram(random: &mut SplitMix64, parts: &[(u32, usize)], answer: &mut Vec<u8>) -> Vec<Byte> {
    let (mut bytes, mut body): (Vec<Byte>, Vec<u8>) = (Vec::new(), Vec::new());
    for (part, count) in parts {
        let sums = match *part {
            SUM => frame_sum(&body),
            DIGEST => frame_sum(answer),
            _ => [0; 4],
        };
        for place in 0..*count {
            let given = random.below(256) as u8;
            let sum = sums.get(place).filter(|_| [SUM, DIGEST].contains(part));
            let sent = sum.copied().unwrap_or(given);
            if *part == WORDS {
                answer.push(sent);
            }
            // The addresses of the receiver belong to no sum.
            if bytes.len() >= 12 {
                body.push(sent);
            }
            bytes.push(Byte { part: *part, index: bytes.len(), given, sent, is_last: *part == SUM && place == 3 });
        }
    }
    bytes
}

/// The block, and what is on its way through it.
struct Rig {
    block: Stepper<DatagramSums>,
    random: SplitMix64,
    awaits: bool,
    /// The bytes whose places passed one clock and two clocks ago, and whether a datagram was cut a clock ago.
    first: Option<Byte>,
    second: Option<Byte>,
    was_cut: bool,
    sent: usize,
}

impl Rig {
    /// Passes a clock. While a datagram is under way, `next` is the next byte of it.
    fn clock(&mut self, next: Option<Byte>, moves: bool, is_cut: bool, reset: bool) {
        let place = next.map_or(self.random.below(1 << 10) as u32, |byte| byte.part | (byte.index as u32 % 128) << 3);
        let noise = self.random.below(256) as u8;
        self.block.set("reset", reset);
        self.block.set("moves", moves);
        self.block.set("at", place);
        self.block.set("is_last", next.is_some_and(|byte| moves && byte.is_last && !is_cut));
        self.block.set("byte_data", self.first.map_or(noise, |byte| byte.given));
        self.block.set("awaits", self.awaits);
        self.block.set("is_cut", is_cut);
        self.block.settle();
        self.block.expect("out_valid", self.second.is_some());
        self.block.expect("out_drops", self.was_cut);
        self.block.expect("is_busy", self.first.is_some() || self.second.is_some() || self.was_cut);
        if let Some(byte) = self.second {
            self.block.expect("out_is_last", byte.is_last);
            let out = self.block.get("out_data");
            assert_eq!(out, byte.sent.into(), "byte {} in part {}", byte.index, byte.part);
            self.sent += 1;
        }
        self.block.edge();
        let goes_on = !is_cut && !reset;
        self.second = self.first.filter(|_| goes_on);
        self.first = next.filter(|_| moves && goes_on);
        self.was_cut = is_cut && !reset;
    }

    fn rest(&mut self, clocks: u64) {
        (0..clocks).for_each(|_| self.clock(None, false, false, false));
    }

    /// Sends a datagram, of which the words may wait; returns whether it went out to its end.
    fn send(&mut self, bytes: &[Byte], cut_at: Option<usize>) -> bool {
        let (mut come, mut clock) = (0, 0);
        while come < bytes.len() {
            let moves = bytes[come].part != WORDS || self.random.below(3) > 0;
            let is_cut = cut_at == Some(clock);
            self.clock(Some(bytes[come]), moves, is_cut, false);
            if is_cut {
                return false;
            }
            come += usize::from(moves);
            clock += 1;
        }
        true
    }
}

#[test]
fn sums_cover_what_the_page_says() {
    let block = Stepper::new("udp_datagram_sums", DatagramSums::default(), 1);
    let (random, awaits) = (SplitMix64::new(17), true);
    let mut rig = Rig { block, random, awaits, first: None, second: None, was_cut: false, sent: 0 };
    rig.block.set("reset", true);
    for (port, value) in [("moves", 0u8), ("at", 0), ("is_last", 0), ("byte_data", 0), ("awaits", 1), ("is_cut", 0)] {
        rig.block.set(port, value);
    }
    rig.block.settle();
    rig.block.edge();
    let mut counts = [0; 3];
    for _ in 0..150 {
        // An answer in up to three parts, each perhaps behind another datagram.
        let (mut answer, parts) = (Vec::new(), 1 + rig.random.below(3));
        for part in 0..parts {
            let cut_at = (rig.random.below(8) == 0).then(|| rig.random.below(120) as usize);
            if rig.random.below(3) == 0 {
                let body = [vec![], vec![(1, 56)], vec![(3, 4), (2, 4)]][rig.random.below(3) as usize].clone();
                let other = [vec![(0, 28)], body, vec![(SUM, 4)]].concat();
                let bytes = datagram(&mut rig.random, &other, &mut Vec::new());
                rig.send(&bytes, None);
                let clocks = 2 + rig.random.below(4);
                rig.rest(clocks);
                counts[0] += 1;
            }
            rig.awaits = false;
            let words = 4 * (1 + rig.random.below(30) as usize);
            let digest = if part + 1 == parts { 4 } else { 0 };
            let layout = [(0, 28), (3, 4), (6, 4), (WORDS, words), (DIGEST, digest), (SUM, 4)];
            let bytes = datagram(&mut rig.random, &layout, &mut answer);
            let is_whole = rig.send(&bytes, cut_at);
            counts[1 + usize::from(!is_whole)] += 1;
            let clocks = 2 + rig.random.below(4);
            rig.rest(clocks);
            if !is_whole {
                break;
            }
        }
        rig.awaits = true;
        let clocks = 1 + rig.random.below(4);
        rig.rest(clocks);
    }
    assert!(counts.iter().all(|count| *count > 15) && rig.sent > 10_000, "{counts:?}, {} bytes", rig.sent);
}

#[test]
fn a_reset_drops_the_bytes_on_their_way() {
    let block = Stepper::new("udp_datagram_sums", DatagramSums::default(), 2);
    let (random, awaits) = (SplitMix64::new(18), true);
    let mut rig = Rig { block, random, awaits, first: None, second: None, was_cut: false, sent: 0 };
    rig.block.set("reset", true);
    rig.block.set("is_cut", false);
    rig.block.set("moves", false);
    rig.block.settle();
    rig.block.edge();
    for run in 0..60 {
        let bytes = datagram(&mut rig.random, &[(0, 28), (SUM, 4)], &mut Vec::new());
        let some = rig.random.below(32) as usize;
        rig.send(&bytes[..some], None);
        rig.clock(Some(bytes[some]), true, run % 3 == 0, true);
        let clocks = rig.random.below(3);
        rig.rest(clocks);
        assert!(rig.send(&bytes, None));
        rig.rest(3);
    }
}

#[test]
fn wave_of_the_end_of_a_datagram_and_of_one_that_is_cut() {
    // A datagram of an address and its header, all of it 0, whose sum is 0xecbb4b55.
    let mut stimuli: Vec<(usize, &'static str, u128)> = Vec::new();
    for index in 0..32usize {
        let part = if index < 28 { 0 } else { SUM };
        stimuli.extend([(index, "moves", 1), (index, "at_part", part.into()), (index, "at_index", index as u128)]);
        stimuli.push((index, "is_last", u128::from(index == 31)));
    }
    stimuli.extend((36..40).map(|clock| (clock, "moves", 1)));
    stimuli.push((39, "is_cut", 1));
    let lanes = [
        ("moves", "moves", 0, 1, When::Always),
        ("at.part", "at_part", 0, 3, When::If("moves")),
        ("is_last", "is_last", 0, 1, When::Always),
        ("is_cut", "is_cut", 0, 1, When::Always),
        ("out_valid", "out_valid", 0, 1, When::Always),
        ("out_is_last", "out_is_last", 0, 1, When::If("out_valid")),
        ("out_drops", "out_drops", 0, 1, When::Always),
        ("is_busy", "is_busy", 0, 1, When::Always),
    ];
    draw_range("udp_datagram_sums", DatagramSums::default(), &stimuli, 26..42, &lanes).assert_drawn_in("datagram_sums");
}
