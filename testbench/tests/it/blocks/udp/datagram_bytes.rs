//! Runs `DatagramBytes` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_blocks::UDP_PAGE_LINK;
use incircle_hdl::udp::DatagramBytes;
use incircle_protocol::SMALL;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramBytes,
    [at, address_byte, header_byte, digest, answers, first_index, word_byte],
    [byte_data],
    clock
);

/// The greeting in the exchange of `protocol/UDP.md`, which is that of the core `small` behind the link of that page.
const GREETING: [u8; 56] = [
    0x75, 0x43, 0x6e, 0x69, 0x00, 0x00, 0x01, 0x00, 0x00, 0x0e, 0x27, 0x07, 0x00, 0x40, 0x00, 0x00, // link
    0xd0, 0x07, 0x00, 0x00, 0x02, 0x00, 0x00, 0x69, 0x43, 0x01, 0x00, 0x00, // silence, Ethernet address
    0x69, 0x43, 0x6e, 0x69, 0x00, 0x00, 0x02, 0x00, 0x00, 0x03, 0x00, 0x00, // core
    0x10, 0x00, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x10, 0x01, 0x00, 0x00, 0x20, 0x00, 0x02, 0x00,
];

/// Parts of a datagram, and the indices of their bytes.
const PARTS: [(u32, std::ops::Range<usize>); 6] =
    [(0, 0..28), (1, 28..84), (2, 32..36), (3, 28..32), (4, 0..128), (6, 32..36)];

#[test]
fn bytes_are_those_of_their_part_and_place() {
    let mut random = SplitMix64::new(15);
    let mut block = Stepper::new("udp_datagram_bytes", DatagramBytes::new(SMALL, UDP_PAGE_LINK), 1);
    let mut before: Option<(u32, usize, u8)> = None;
    for _ in 0..20_000 {
        let (part, indices) = PARTS[random.below(6) as usize].clone();
        let index = indices.start + random.below(indices.len() as u64) as usize;
        let [address_byte, header_byte, word_byte] = [(); 3].map(|()| random.below(256) as u8);
        let [digest, answers] = [(); 2].map(|()| random.next_u64() as u32);
        let first_index = random.below(1 << 17) as u32;
        block.set("at_part", part);
        block.set("at_index", index as u32);
        block.set("address_byte", address_byte);
        block.set("header_byte", header_byte);
        block.set("digest", digest);
        block.set("answers", answers);
        block.set("first_index", first_index);
        block.set("word_byte", word_byte);
        block.settle();
        if let Some((part, index, byte)) = before {
            assert_eq!(block.get("byte_data"), byte.into(), "byte {index} in part {part}");
        }
        block.edge();
        let byte = match part {
            // Receiver; kind, status, free bytes and number; session.
            0 if (12..20).contains(&index) => header_byte,
            0 => address_byte,
            1 => GREETING[index - 28],
            2 => (!digest).to_le_bytes()[index - 32],
            3 => answers.to_le_bytes()[index - 28],
            4 => word_byte,
            _ => first_index.to_le_bytes()[index - 32],
        };
        before = Some((part, index, byte));
    }
}

#[test]
fn wave_of_a_byte_of_each_part() {
    let places = [(0, 11), (0, 12), (0, 19), (0, 20), (1, 45), (3, 28), (6, 34), (4, 99), (2, 32)];
    let mut stimuli = Vec::new();
    for (clock, (part, index)) in places.into_iter().enumerate() {
        stimuli.extend([(clock, "at_part", part), (clock, "at_index", index)]);
        stimuli.extend([(clock, "address_byte", 30), (clock, "header_byte", 40), (clock, "word_byte", 50)]);
        stimuli.extend([(clock, "answers", 60), (clock, "first_index", 0x1_0000), (clock, "digest", 0xffff_ffb9)]);
    }
    let given = When::At(&[0, 1, 2, 3, 4, 5, 6, 7, 8]);
    let lanes = [
        ("at.part", "at_part", 0, 3, given),
        ("at.index", "at_index", 0, 7, given),
        ("address_byte", "address_byte", 0, 8, given),
        ("header_byte", "header_byte", 0, 8, given),
        ("word_byte", "word_byte", 0, 8, given),
        ("byte_data", "byte_data", 0, 8, When::At(&[1, 2, 3, 4, 5, 6, 7, 8, 9])),
    ];
    let block = DatagramBytes::new(SMALL, UDP_PAGE_LINK);
    draw("udp_datagram_bytes", block, &stimuli, 10, &lanes).assert_drawn_in("datagram_bytes");
}
