//! Runs `DatagramParts` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw_range, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramParts;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramParts,
    [reset, starts, contents, cuts, word_byte_valid, word_byte_is_last],
    [at, moves, is_last, is_cut, is_idle],
    clock
);

/// The kinds of datagrams to a host, by what stands behind their header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Body {
    Nothing,
    Greeting,
    Digest,
    /// A part of an answer; the last one has the digest of the answer behind it.
    Answer {
        is_last: bool,
    },
}

impl Body {
    fn random(random: &mut SplitMix64) -> Self {
        let is_last = random.below(2) == 0;
        [Self::Nothing, Self::Greeting, Self::Digest, Self::Answer { is_last }][random.below(4) as usize]
    }

    /// Fields of `contents`: a greeting, a digest, words of an answer, and the end of the answer.
    fn contents(self) -> u32 {
        match self {
            Self::Nothing => 0,
            Self::Greeting => 1,
            Self::Digest => 2,
            Self::Answer { is_last } => 4 | u32::from(is_last) << 3,
        }
    }

    /// Parts of the datagram in their order, each with its bytes, as `protocol/UDP.md` has them: receiver and header 0,
    /// greeting 1, digest 2, number of answers 3, words 4, check sum 5, index of the first word 6, digest of an
    /// answer 7.
    fn parts(self, words: usize) -> Vec<(u32, usize)> {
        let body: &[(u32, usize)] = match self {
            Self::Nothing => &[],
            Self::Greeting => &[(1, 56)],
            Self::Digest => &[(3, 4), (2, 4)],
            Self::Answer { is_last: false } => &[(3, 4), (6, 4), (4, 4 * words)],
            Self::Answer { is_last: true } => &[(3, 4), (6, 4), (4, 4 * words), (7, 4)],
        };
        [&[(0, 28)], body, &[(5, 4)]].concat()
    }
}

/// Sets the inputs of a clock, and brings the outputs up to date.
fn settle(block: &mut Stepper<DatagramParts>, flags: [(&str, bool); 5]) {
    flags.into_iter().for_each(|(port, flag)| block.set(port, flag));
    block.settle();
}

/// Passes some clocks without a datagram.
fn rest(block: &mut Stepper<DatagramParts>, random: &mut SplitMix64, clocks: u64) {
    for _ in 0..clocks {
        // What the core offers, and an end of a session, mean nothing without a datagram.
        let [words, last, cuts] = [(); 3].map(|()| random.below(2) == 0);
        let flags = [("starts", false), ("cuts", cuts), ("word_byte_valid", words), ("word_byte_is_last", last)];
        settle(block, [flags[0], flags[1], flags[2], flags[3], ("reset", false)]);
        block.expect("is_idle", true);
        ["moves", "is_last", "is_cut"].into_iter().for_each(|port| block.expect(port, false));
        block.edge();
    }
}

#[test]
fn every_byte_of_a_datagram_has_its_place() {
    let mut random = SplitMix64::new(9);
    let mut block = Stepper::new("udp_datagram_parts", DatagramParts::default(), 1);
    block.set("contents", 0u32);
    let quiet = [("starts", false), ("cuts", false), ("word_byte_valid", false), ("word_byte_is_last", false)];
    settle(&mut block, [quiet[0], quiet[1], quiet[2], quiet[3], ("reset", true)]);
    block.edge();
    let mut ends = [0; 3];
    for _ in 0..400 {
        let clocks = random.below(5);
        rest(&mut block, &mut random, clocks);
        let body = Body::random(&mut random);
        let words = 1 + random.below(60) as usize;
        block.set("contents", body.contents());
        settle(&mut block, [("starts", true), quiet[1], quiet[2], quiet[3], ("reset", false)]);
        block.edge();
        let parts = body.parts(words);
        let places = parts.iter().flat_map(|(part, bytes)| (0..*bytes).map(move |at| (*part, at + 1 == *bytes)));
        let places: Vec<_> = places.enumerate().collect();
        // One datagram in four is cut, and one in eight is forgotten by a reset, both in any clock.
        let [cut_at, reset_at] =
            [4, 8].map(|one_in| (random.below(one_in) == 0).then(|| random.below(places.len() as u64 + 10)));
        let (mut come, mut clock, mut end) = (0, 0, 0);
        while come < places.len() {
            let (index, (part, ends_part)) = places[come];
            let (cuts, reset) = (cut_at == Some(clock), reset_at == Some(clock));
            let offers = random.below(3) > 0;
            let is_last_word = if part == 4 && offers { ends_part } else { random.below(2) == 0 };
            let flags = [("starts", false), ("cuts", cuts), ("word_byte_valid", offers)];
            settle(&mut block, [flags[0], flags[1], flags[2], ("word_byte_is_last", is_last_word), ("reset", reset)]);
            let moves = part != 4 || offers;
            block.expect("is_idle", false);
            block.expect("moves", moves);
            block.expect("at_part", part);
            block.expect("at_index", index as u32 % 128);
            block.expect("is_cut", cuts);
            block.expect("is_last", moves && come + 1 == places.len() && !cuts);
            block.edge();
            come += usize::from(moves);
            clock += 1;
            if cuts || reset {
                end = 1 + usize::from(reset);
                break;
            }
        }
        ends[end] += 1;
    }
    assert!(ends.iter().all(|count| *count > 20), "{ends:?}");
}

#[test]
fn wave_of_the_end_of_an_answer_whose_last_bytes_wait_for_the_core() {
    // The header and the two numbers of an answer take 36 clocks.
    let mut stimuli = vec![(0, "starts", 1)];
    stimuli.extend((0..60).map(|clock| (clock, "contents", 0b1100)));
    stimuli.extend([37, 38, 41, 42].map(|clock| (clock, "word_byte_valid", 1)));
    stimuli.push((42, "word_byte_is_last", 1));
    let lanes = [
        ("word_byte_valid", "word_byte_valid", 0, 1, When::Always),
        ("word_byte_is_last", "word_byte_is_last", 0, 1, When::Always),
        ("at.part", "at_part", 0, 3, When::If("moves")),
        ("at.index", "at_index", 0, 7, When::If("moves")),
        ("moves", "moves", 0, 1, When::Always),
        ("is_last", "is_last", 0, 1, When::Always),
        ("is_idle", "is_idle", 0, 1, When::Always),
    ];
    let block = DatagramParts::default();
    draw_range("udp_datagram_parts", block, &stimuli, 35..53, &lanes).assert_drawn_in("datagram_parts");
}
