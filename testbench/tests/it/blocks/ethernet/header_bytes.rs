//! Runs `HeaderBytes` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::head_bytes::Addresses;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::HeaderBytes;
use incircle_testkit::SplitMix64;

named_ports!(HeaderBytes, [station, row, datagram_byte, ip_length, udp_length, sum, sum_is_open], [byte_data], clock);

#[test]
fn bytes_come_from_the_source_that_the_row_names() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("ethernet_header_bytes", HeaderBytes::default(), 1);
    let mut before = None;
    let mut counts = [0; 8];
    for _ in 0..20_000 {
        let addresses = Addresses::random(&mut random);
        let [datagram_byte, any] = [(); 2].map(|()| random.below(256) as u8);
        let [ip_length, udp_length] = [(); 2].map(|()| random.below(1 << 11) as u16);
        let (sum, is_open) = (random.below(1 << 16) as u16, random.below(2) == 0);
        let source = random.below(8) as usize;
        let literal = match source {
            1 => any % 16,
            7 => any % 2,
            _ => any,
        };
        block.set("station", addresses.packed());
        block.set("row_source", source as u32);
        block.set("row_literal", literal);
        block.set("datagram_byte", datagram_byte);
        block.set("ip_length", ip_length);
        block.set("udp_length", udp_length);
        block.set("sum", sum);
        block.set("sum_is_open", is_open);
        block.settle();
        if let Some(byte) = before {
            block.expect("byte_data", byte);
        }
        block.edge();
        let check_sum = if is_open { [0; 2] } else { (!sum).to_be_bytes() };
        before = Some(match source {
            0 => literal,
            1 => addresses.bytes()[usize::from(literal)],
            2 => datagram_byte,
            3 | 4 => ip_length.to_be_bytes()[source - 3],
            5 | 6 => udp_length.to_be_bytes()[source - 5],
            _ => check_sum[usize::from(literal)],
        });
        counts[source] += 1;
    }
    assert!(counts.iter().all(|count| *count > 2000), "{counts:?}");
}

#[test]
fn wave_of_each_source() {
    // Source and literal in each clock, and what goes with them.
    let rows = [(0, 69), (1, 10), (2, 0), (3, 0), (4, 0), (5, 0), (6, 0), (7, 0), (7, 1)];
    let mut stimuli = Vec::new();
    for (clock, (source, literal)) in rows.into_iter().enumerate() {
        stimuli.extend([(clock, "row_source", source), (clock, "row_literal", literal)]);
        stimuli.push((clock, "datagram_byte", 80 + clock as u128));
        stimuli.extend([(clock, "station_port", 0x3039), (clock, "sum", 0xf5f0)]);
        stimuli.extend([(clock, "ip_length", 0x21e), (clock, "udp_length", 0x20a)]);
        stimuli.push((clock, "sum_is_open", u128::from(clock == 8)));
    }
    let lanes = [
        ("source", "row_source", 0, 3, When::At(&[0, 1, 2, 3, 4, 5, 6, 7, 8])),
        ("literal", "row_literal", 0, 8, When::At(&[0, 1, 7, 8])),
        ("datagram_byte", "datagram_byte", 0, 8, When::At(&[0, 1, 2, 3, 4, 5, 6, 7, 8])),
        ("sum_is_open", "sum_is_open", 0, 1, When::Always),
        ("byte_data", "byte_data", 0, 8, When::At(&[1, 2, 3, 4, 5, 6, 7, 8, 9])),
    ];
    draw("ethernet_header_bytes", HeaderBytes::default(), &stimuli, 10, &lanes).assert_drawn_in("header_bytes");
}
