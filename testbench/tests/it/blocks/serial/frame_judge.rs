//! Runs `FrameJudge` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::asked::{CLOSES, DROPS, GAP, HEARS, HELLO, NO_SESSION, OPENS, POLLS, RATE, REPEATS, TAKES};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::{Asked, FrameJudge};
use incircle_testkit::SplitMix64;

named_ports!(FrameJudge, [reset, head, header_comes, comes, is_sound, open, free], [takes_payload, asked], clock);

/// A header, and the state of the link that it meets.
#[derive(Clone, Copy, Debug)]
struct Case {
    session: u8,
    kind: u8,
    number: u8,
    length: u16,
    is_open: bool,
    open_session: u8,
    expected: u8,
    free: u16,
}

impl Case {
    fn random(random: &mut SplitMix64) -> Self {
        let open_session = 1 + random.below(255) as u8;
        let expected = random.below(256) as u8;
        let near = [0, 0, 1, 5, 127, 128, 129, 255, random.below(256) as u8][random.below(9) as usize];
        let length = [0, 4, 4, 3, 5, 1024, 8, random.below(1025) as u16][random.below(8) as usize];
        Self {
            session: [open_session, open_session, open_session, 0, random.below(256) as u8][random.below(5) as usize],
            kind: if random.below(9) == 0 { random.below(256) as u8 } else { random.below(8) as u8 },
            number: expected.wrapping_add(near),
            length,
            is_open: random.below(5) > 0,
            open_session,
            expected,
            free: [0, length, length.saturating_sub(1), 2048, 32768][random.below(5) as usize],
        }
    }

    fn is_this_session(self) -> bool {
        self.is_open && self.session == self.open_session
    }

    fn is_fit(self) -> bool {
        match self.kind {
            1 | 4 | 6 => self.length == 0,
            2 => self.length == 0 && self.session != 0,
            3 => self.length == 4,
            5 => self.length != 0 && self.length.is_multiple_of(4),
            _ => false,
        }
    }

    fn takes(self) -> bool {
        self.kind == 5
            && self.is_fit()
            && self.is_this_session()
            && self.number == self.expected
            && self.free >= self.length
    }

    fn asked(self, is_sound: bool, takes: bool) -> u32 {
        if !is_sound || !self.is_fit() {
            return DROPS;
        }
        let behind = self.expected.wrapping_sub(self.number);
        HEARS
            | match self.kind {
                1 => HELLO,
                2 => OPENS,
                _ if !self.is_open => NO_SESSION,
                _ if !self.is_this_session() => 0,
                3 => RATE,
                4 => POLLS,
                6 => CLOSES,
                _ if takes => TAKES,
                _ if (1..=128).contains(&behind) => REPEATS,
                _ => GAP,
            }
    }
}

#[test]
fn judge_says_what_a_frame_asks_for() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("serial_frame_judge", FrameJudge::default(), 1);
    let mut counts = [0; 11];
    for run in 0..12_000 {
        let mut case = Case::random(&mut random);
        let is_sound = random.below(5) > 0;
        // Room that comes after the first byte of the payload comes too late.
        let was_open = case.is_open;
        // In every other run the session ends, in each of the clocks in turn.
        let ends_at = (run % 2 == 1).then_some(run / 2 % 24);
        let is_open = |clock: i32| was_open && ends_at.is_none_or(|end| clock < end);
        let takes = Case { is_open: is_open(5), ..case }.takes();
        for clock in 0..24 {
            case.is_open = is_open(clock);
            if clock == 8 && random.below(3) == 0 {
                case.free = 32768;
            }
            for (port, value) in [
                ("session", case.session.into()),
                ("kind", case.kind.into()),
                ("head_number", case.number.into()),
                ("length", case.length),
                ("is_open", case.is_open.into()),
                ("open_number", case.open_session.into()),
                ("expected", case.expected.into()),
                ("free", case.free),
                ("reset", (run == 0 && clock < 2).into()),
                ("header_comes", (clock == 4).into()),
                ("comes", (clock == 20).into()),
                ("is_sound", is_sound.into()),
            ] {
                block.set(port, value);
            }
            block.settle();
            if run > 0 {
                block.expect("takes_payload", takes && (7..=20).contains(&clock));
                let at_end = Case { is_open: is_open(20), ..case };
                let asked = if clock == 21 { at_end.asked(is_sound, takes) } else { 0 };
                block.expect("asked", asked);
                (0..11).for_each(|field| counts[field] += asked >> field & 1);
            }
            block.edge();
        }
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    assert_eq!(<Asked as rust_hdl_core::prelude::Synth>::BITS, counts.len());
}
