//! Runs `DatagramMatch` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramMatch;
use incircle_testkit::SplitMix64;

named_ports!(DatagramMatch, [head_valid, index, byte_data, session_byte, session], [head], clock);

/// The beginning of a datagram, and the state of the link that it meets.
#[derive(Clone, Copy, Debug)]
struct Case {
    kind: u8,
    number: u32,
    session: u64,
    /// Address and port of the sender are those of the session, and so is the number.
    is_host: bool,
    is_session: bool,
    expected: u32,
}

impl Case {
    fn random(random: &mut SplitMix64) -> Self {
        let expected = [0, 1, 255, 256, 0xffff_fffe, random.below(1 << 32) as u32][random.below(6) as usize];
        let near = [0, 0, 0, 1, u32::MAX, 256, 0xffff_ff00, random.below(1 << 32) as u32][random.below(8) as usize];
        Self {
            kind: random.below(256) as u8,
            number: expected.wrapping_add(near),
            session: if random.below(4) == 0 { 0 } else { 1 << random.below(64) },
            is_host: random.below(4) > 0,
            is_session: random.below(4) > 0,
            expected,
        }
    }

    /// The byte of a datagram at an index, and that of the session with the same meaning.
    fn bytes(self, index: usize, differs_at: [usize; 2], random: &mut SplitMix64) -> (u8, u8) {
        let byte = match index {
            12 => self.kind,
            16..20 => self.number.to_le_bytes()[index - 16],
            20..28 => self.session.to_le_bytes()[index - 20],
            _ => random.below(256) as u8,
        };
        let differs = index == differs_at[0] && !self.is_host || index == differs_at[1] && !self.is_session;
        let is_compared = matches!(index, 6..12 | 20..28);
        (byte, if is_compared { byte ^ u8::from(differs) } else { random.below(256) as u8 })
    }
}

#[test]
fn match_compares_the_beginning_of_datagrams() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("udp_datagram_match", DatagramMatch::default(), 1);
    let mut counts = [0; 4];
    for _ in 0..6000 {
        let case = Case::random(&mut random);
        // One byte differs if the sender or the session does.
        let differs_at = [6 + random.below(6) as usize, 20 + random.below(8) as usize];
        block.set("is_open", true);
        block.set("expected", case.expected);
        let mut index = 0;
        while index < 32 {
            let passes = random.below(4) > 0;
            let (byte, session_byte) = case.bytes(index, differs_at, &mut random);
            block.set("head_valid", passes);
            block.set("index", index as u32);
            block.set("byte_data", byte);
            block.set("session_byte", session_byte);
            block.settle();
            block.edge();
            index += usize::from(passes);
        }
        let is_next = case.number == case.expected;
        let flags = [
            ("is_of_session", case.is_host && case.is_session),
            ("names_session", case.session != 0),
            ("is_next", is_next),
            ("is_less", case.number < case.expected),
        ];
        block.set("head_valid", false);
        block.settle();
        block.expect("kind", case.kind);
        for ((port, flag), count) in flags.into_iter().zip(&mut counts) {
            *count += usize::from(flag);
            block.expect(port, flag);
        }
    }
    assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
}

#[test]
fn wave_of_the_kind_and_the_number_of_a_datagram() {
    // The kind 5 at index 12, and the number 3 at indices 16 to 19 where 3 is awaited.
    let mut stimuli = Vec::new();
    for (clock, (index, byte)) in
        [(11, 0), (12, 5), (15, 0), (16, 3), (17, 0), (18, 0), (19, 0)].into_iter().enumerate()
    {
        stimuli.extend([(clock + 1, "head_valid", 1), (clock + 1, "index", index), (clock + 1, "byte_data", byte)]);
    }
    stimuli.extend((0..10).map(|clock| (clock, "session_expected", 3)));
    let lanes = [
        ("head_valid", "head_valid", 0, 1, When::Always),
        ("index", "index", 0, 5, When::If("head_valid")),
        ("byte_data", "byte_data", 0, 8, When::If("head_valid")),
        ("head.kind", "head_kind", 0, 8, When::At(&[3, 4, 5, 6, 7, 8, 9])),
        ("head.is_next", "head_is_next", 0, 1, When::At(&[8, 9])),
        ("head.is_less", "head_is_less", 0, 1, When::At(&[8, 9])),
    ];
    draw("udp_datagram_match", DatagramMatch::default(), &stimuli, 10, &lanes).assert_drawn_in("datagram_match");
}
