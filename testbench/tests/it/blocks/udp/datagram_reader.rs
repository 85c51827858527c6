//! Runs `DatagramReader` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::drawing::{draw_range, When};
use crate::rig::ethernet_frames::frame_sum;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramReader;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramReader,
    [reset, entry_valid, entry, holds],
    [
        entry_pop,
        begins,
        head_valid,
        index,
        byte_data,
        word_valid,
        word,
        payload_valid,
        payload,
        comes,
        verdict,
        settles
    ],
    clock
);

/// Clocks behind an end in which no entry is taken.
const PAUSE: usize = 6;

/// What the block says of a datagram.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Said {
    head: Vec<u8>,
    words: Vec<u32>,
    payload: Vec<u8>,
    begins: usize,
}

/// The bytes of a datagram with its sender, of which some are damaged or cut.
fn datagram(random: &mut SplitMix64) -> Vec<u8> {
    let words = [0, 0, 1, 14, 2, 359, 360, 361, 363, random.below(360) as usize][random.below(10) as usize];
    let mut body: Vec<u8> = (0..16 + 4 * words).map(|_| random.below(256) as u8).collect();
    body.extend(frame_sum(&body));
    let sender: Vec<u8> = (0..12).map(|_| random.below(256) as u8).collect();
    let mut bytes = [sender, body].concat();
    match random.below(8) {
        0 => {
            let place = random.below(bytes.len() as u64) as usize;
            bytes[place] ^= 1 << random.below(8);
        }
        1 => bytes.truncate(1 + random.below(bytes.len() as u64 - 1) as usize),
        2 => bytes.insert(12 + random.below(bytes.len() as u64 - 12) as usize, 0),
        _ => {}
    }
    bytes
}

/// The fields of the verdict that plain code finds, and which of them must be compared.
fn verdict(bytes: &[u8], end: u16) -> (u128, u128) {
    let body = bytes.get(12..).unwrap_or_default();
    let is_sound = body.len() >= 4 && body.len() % 4 == 0 && {
        let (said, sum) = body.split_at(body.len() - 4);
        frame_sum(said) == sum
    };
    let counts = end & 1 == 1;
    let words = |least: usize, most: usize| (20 + 4 * least..=20 + 4 * most).contains(&body.len());
    let flags = [counts, counts && is_sound, end >> 1 & 1 == 1, words(0, 0), words(14, 14), words(1, 360)];
    let value = flags.iter().enumerate().map(|(place, flag)| u128::from(*flag) << place).sum();
    // The length means nothing unless the datagram is sound.
    (value, if counts && is_sound { 0b11_1111 } else { 0b111 })
}

#[test]
fn reader_gives_the_words_of_datagrams_and_says_whether_they_are_sound() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("udp_datagram_reader", DatagramReader::default(), 1);
    let mut entries: VecDeque<(u16, usize)> = VecDeque::new();
    let mut sent: Vec<(Vec<u8>, u16)> = Vec::new();
    let (mut said, mut next, mut sound) = (Said::default(), 0, 0);
    let mut pause: usize = 0;
    while next < 300 {
        if entries.is_empty() {
            let (bytes, end) = (datagram(&mut random), 0x100 | [1, 1, 1, 3, 0][random.below(5) as usize]);
            entries.extend(bytes.iter().map(|byte| (u16::from(*byte), sent.len())));
            entries.push_back((end, sent.len()));
            sent.push((bytes, end));
        }
        let clock = block.clocks();
        let offers = random.below([1, 6][clock / 9000 % 2]) == 0;
        let (reset, holds) = (clock == 0, random.below(9) == 0);
        block.set("reset", reset);
        block.set("holds", holds);
        block.set("entry_valid", offers);
        block.set("entry", if offers { entries[0].0 } else { random.below(512) as u16 });
        block.settle();
        if !reset {
            block.expect("entry_pop", offers && !holds && pause == 0);
            block.expect("settles", pause > 0);
            said.begins += usize::from(block.is("begins"));
            if block.is("head_valid") {
                block.expect("index", said.head.len() as u128);
                said.head.push(block.get("byte_data") as u8);
            }
            if block.is("word_valid") {
                said.words.push(block.get("word") as u32);
            }
            if block.is("payload_valid") {
                said.payload.push(block.get("payload") as u8);
            }
            if block.is("comes") {
                let (bytes, end) = &sent[next];
                let (value, mask) = verdict(bytes, *end);
                block.expect_masked("verdict", mask, value & mask);
                sound += usize::from(value & 2 != 0);
                // The last word stays behind: it is the check sum, whole or cut.
                let payload = bytes.get(28..bytes.len().saturating_sub(4).max(28)).unwrap_or_default();
                let words =
                    payload.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
                let expected = Said {
                    head: bytes[..bytes.len().min(32)].to_vec(),
                    words: words.collect(),
                    payload: payload.to_vec(),
                    begins: 1,
                };
                if bytes.len() % 4 == 0 {
                    assert_eq!(said, expected, "datagram {next}");
                }
                said = Said::default();
                next += 1;
            }
        }
        let pops = !reset && offers && !holds && pause == 0;
        block.edge();
        pause = pause.saturating_sub(1);
        if pops {
            let (entry, _) = entries.pop_front().expect("an entry");
            pause = if entry >> 8 == 1 { PAUSE } else { 0 };
        }
    }
    assert!(sound > 100, "{sound} datagrams were sound");
}

#[test]
fn wave_of_the_end_of_a_datagram_of_one_word() {
    // Twelve bytes of a sender, sixteen of a header, a word and its check sum, each an entry, and the end.
    let body: Vec<u8> = [vec![0; 16], vec![21, 22, 23, 24]].concat();
    let bytes = [vec![0; 12], body.clone(), frame_sum(&body).to_vec()].concat();
    let mut stimuli: Vec<(usize, &'static str, u128)> = Vec::new();
    for (clock, byte) in bytes.iter().enumerate() {
        stimuli.extend([(clock, "entry_valid", 1), (clock, "entry", u128::from(*byte))]);
    }
    stimuli.extend([(36, "entry_valid", 1), (36, "entry", 0x101)]);
    // The next datagram waits.
    stimuli.extend((37..46).map(|clock| (clock, "entry_valid", 1)));
    let lanes = [
        ("entry_valid", "entry_valid", 0, 1, When::Always),
        ("entry[8]", "entry", 8, 1, When::If("entry_valid")),
        ("entry_pop", "entry_pop", 0, 1, When::Always),
        ("payload_valid", "payload_valid", 0, 1, When::Always),
        ("payload", "payload", 0, 8, When::If("payload_valid")),
        ("word_valid", "word_valid", 0, 1, When::Always),
        ("settles", "settles", 0, 1, When::Always),
        ("comes", "comes", 0, 1, When::Always),
        ("verdict.is_sound", "verdict_is_sound", 0, 1, When::If("comes")),
        ("begins", "begins", 0, 1, When::Always),
    ];
    let block = DatagramReader::default();
    draw_range("udp_datagram_reader", block, &stimuli, 30..46, &lanes).assert_drawn_in("datagram_reader");
}
