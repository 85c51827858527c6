//! Runs `DatagramJudge` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramJudge;
use incircle_testkit::SplitMix64;

named_ports!(DatagramJudge, [head, comes, verdict, session, has_room, place_is_taken], [asks], clock);

/// Fields of `asks`; `reply` takes four bits.
const HEARS: u32 = 1;
const REPLIES: u32 = 1 << 1;
const REPLY: u32 = 2;
const OPENS: u32 = 1 << 6;
const CLOSES: u32 = 1 << 7;
const POLLS: u32 = 1 << 8;
const TAKES: u32 = 1 << 9;
const REPEATS: u32 = 1 << 10;
const GAP: u32 = 1 << 11;
const DROPS: u32 = 1 << 12;
/// All of them but `reply`.
const WITHOUT_REPLY: u128 = 0x1fff & !(15 << REPLY);

/// A datagram, and the state of the link that it meets.
#[derive(Clone, Copy, Debug)]
struct Case {
    kind: u8,
    number: u32,
    names_session: bool,
    is_of_session: bool,
    is_open: bool,
    expected: u32,
    /// Number of words; `None` if it is no whole number.
    words: Option<usize>,
    counts: bool,
    is_sound: bool,
    is_to_all: bool,
    has_room: bool,
    place_is_taken: bool,
}

impl Case {
    fn random(random: &mut SplitMix64) -> Self {
        let expected = [0, 1, 255, 256, 0xffff_fffe, random.below(1 << 32) as u32][random.below(6) as usize];
        let near = [0, 0, 0, 1, u32::MAX, 256, 0xffff_ff00, random.below(1 << 32) as u32][random.below(8) as usize];
        let kind = if random.below(9) == 0 { random.below(256) as u8 } else { 1 + random.below(6) as u8 };
        let right = match kind {
            1 => 14,
            5 => 1 + random.below(360) as usize,
            _ => 0,
        };
        let words =
            [Some(right), Some(right), Some(right), Some(0), Some(14), Some(361), None][random.below(7) as usize];
        let mut one_in = |count: u64| random.below(count) == 0;
        let (counts, is_sound) = (!one_in(9), !one_in(9));
        Self {
            kind,
            number: expected.wrapping_add(near),
            is_of_session: !one_in(4),
            is_open: !one_in(4),
            expected,
            words,
            counts,
            is_sound: counts && is_sound && words.is_some(),
            is_to_all: one_in(7),
            has_room: !one_in(6),
            place_is_taken: one_in(6),
            names_session: !one_in(8),
        }
    }

    fn verdict(self) -> u32 {
        let words = |least: usize, most: usize| self.words.is_some_and(|words| (least..=most).contains(&words));
        let flags = [self.counts, self.is_sound, self.is_to_all, words(0, 0), words(14, 14), words(1, 360)];
        flags.iter().enumerate().map(|(place, flag)| u32::from(*flag) << place).sum()
    }

    /// Rule by rule, in the order of the page.
    fn asks(self) -> u32 {
        let fits = match (self.kind, self.words) {
            (1, Some(14)) | (2 | 4 | 6, Some(0)) => true,
            (5, Some(words)) => (1..=360).contains(&words),
            _ => false,
        };
        if !self.counts {
            return 0;
        }
        if !self.is_sound || !fits {
            return DROPS;
        }
        if self.is_to_all && self.kind != 1 {
            return 0;
        }
        if self.kind == 2 && !self.names_session {
            return DROPS;
        }
        let is_ours = self.is_open && self.is_of_session;
        let reply = |kind: u32| if self.place_is_taken { 0 } else { REPLIES | kind << REPLY };
        match self.kind {
            1 => reply(1),
            2 if self.place_is_taken => 0,
            2 if is_ours => HEARS | reply(2),
            2 if self.is_open => reply(9),
            2 => HEARS | OPENS | reply(2),
            _ if !self.is_open => reply(7),
            _ if !is_ours => 0,
            4 => HEARS | POLLS,
            6 if self.place_is_taken => 0,
            6 => CLOSES | reply(8),
            _ if self.number == self.expected && self.has_room => HEARS | TAKES,
            _ if self.number < self.expected => HEARS | REPEATS,
            _ => HEARS | GAP,
        }
    }
}

#[test]
fn judge_says_what_a_datagram_asks_for() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("udp_datagram_judge", DatagramJudge::default(), 1);
    let mut counts = [0; 13];
    for _ in 0..8000 {
        let case = Case::random(&mut random);
        for (port, value) in [
            ("comes", 0),
            ("is_open", case.is_open.into()),
            ("expected", case.expected),
            ("has_room", case.has_room.into()),
            ("place_is_taken", case.place_is_taken.into()),
        ] {
            block.set(port, value);
        }
        for (port, value) in [
            ("kind", u32::from(case.kind)),
            ("is_of_session", case.is_of_session.into()),
            ("names_session", case.names_session.into()),
            ("is_next", (case.number == case.expected).into()),
            ("is_less", (case.number < case.expected).into()),
        ] {
            block.set(port, value);
        }
        block.set("comes", true);
        block.set("verdict", case.verdict());
        block.settle();
        block.edge();
        block.set("comes", false);
        block.settle();
        let expected = case.asks();
        // Without an answer its kind means nothing.
        let mask = if expected & REPLIES == 0 { WITHOUT_REPLY } else { 0x1fff };
        block.expect_masked("asks", mask, expected);
        (0..13).for_each(|field| counts[field] += expected >> field & 1);
        block.edge();
        block.settle();
        block.expect_masked("asks", WITHOUT_REPLY, 0u32);
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn wave_of_data_that_is_taken_and_data_behind_a_gap_and_data_that_is_damaged() {
    let mut stimuli = vec![(1, "comes", 1), (4, "comes", 1), (7, "comes", 1), (1, "head_is_next", 1)];
    for clock in 0..10 {
        stimuli.extend([(clock, "head_kind", 5), (clock, "head_is_of_session", 1), (clock, "head_names_session", 1)]);
        stimuli.extend([(clock, "session_is_open", 1), (clock, "has_room", 1), (clock, "verdict_counts", 1)]);
        stimuli.extend([(clock, "verdict_is_data", 1), (clock, "verdict_is_sound", u128::from(clock < 6))]);
    }
    let lanes = [
        ("comes", "comes", 0, 1, When::Always),
        ("head.is_next", "head_is_next", 0, 1, When::If("comes")),
        ("verdict.is_sound", "verdict_is_sound", 0, 1, When::If("comes")),
        ("asks.hears", "asks_hears", 0, 1, When::Always),
        ("asks.takes", "asks_takes", 0, 1, When::Always),
        ("asks.gap", "asks_gap", 0, 1, When::Always),
        ("asks.drops", "asks_drops", 0, 1, When::Always),
    ];
    draw("udp_datagram_judge", DatagramJudge::default(), &stimuli, 10, &lanes).assert_drawn_in("datagram_judge");
}
