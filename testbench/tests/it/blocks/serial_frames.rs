//! The serial link from frames to what they ask for: reading, judging, sessions, receipts. Rust, Verilog and plain code agree.

use crate::rig::serial_host::{crc32, host_frame};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::serial::{Asked, FrameJudge, FrameReader, Replies, SessionState};

named_ports!(
    FrameReader,
    [reset, data_valid, data, frame_ends, is_broken], [head, header_comes, payload_valid, payload, value, comes, is_sound],
    clock
);
named_ports!(
    FrameJudge,
    [reset, head, header_comes, comes, is_sound, open, free], [takes_payload, asked],
    clock
);
named_ports!(
    SessionState,
    [reset, asked, session, fails], [open, saw_gap, forgets, settles],
    clock
);
named_ports!(Replies, [reset, asked, saw_gap, fails, starts], [is_due, kind, acknowledges, closes], clock);

/// The fields of `Asked` as bits.
const HEARS: u32 = 1;
const HELLO: u32 = 1 << 1;
const OPENS: u32 = 1 << 2;
const RATE: u32 = 1 << 3;
const POLLS: u32 = 1 << 4;
const CLOSES: u32 = 1 << 5;
const TAKES: u32 = 1 << 6;
const REPEATS: u32 = 1 << 7;
const GAP: u32 = 1 << 8;
const NO_SESSION: u32 = 1 << 9;
const DROPS: u32 = 1 << 10;

/// One clock of a reader.
fn reader_clock(block: &mut Stepper<FrameReader>, byte: Option<u8>, end: Option<bool>) {
    block.set("data_valid", byte.is_some());
    block.set("data", byte.unwrap_or(0x33));
    block.set("frame_ends", end.is_some());
    block.set("is_broken", end.unwrap_or(true));
    block.settle();
}

#[test]
fn reader_gives_payload_as_it_comes_and_says_which_frames_are_sound() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("serial_frame_reader", FrameReader::default(), 1);
    block.set("reset", true);
    reader_clock(&mut block, None, None);
    block.edge();
    block.set("reset", false);
    let mut judged = [0; 2];
    for run in 0..150 {
        let length = [0, 4, 1024, random.below(40) as usize][run % 4];
        let payload: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
        let mut frame = host_frame(random.below(256) as u8, random.below(256) as u8, random.below(256) as u8, &payload);
        let mut is_broken = false;
        match run % 7 {
            1 => frame.truncate(random.below(frame.len() as u64) as usize),
            2 => frame.push(random.below(256) as u8),
            3 => {
                let place = random.below(frame.len() as u64) as usize;
                frame[place] ^= 1 << random.below(8);
            }
            4 => is_broken = true,
            5 => {
                // Too long, and with a good check sum.
                frame = host_frame(1, 5, 0, &vec![7; 1025 + random.below(200) as usize]);
            }
            _ => {}
        }
        let mut seen = Vec::new();
        let mut headers = 0;
        for place in 0..=frame.len() {
            let byte = frame.get(place).copied();
            reader_clock(&mut block, byte, byte.is_none().then_some(is_broken));
            let mut gap = 15 + random.below(3);
            loop {
                assert!(!block.is("comes"));
                block.edge();
                reader_clock(&mut block, None, None);
                if block.is("payload_valid") {
                    seen.push(block.get("payload") as u8);
                }
                headers += usize::from(block.is("header_comes"));
                if byte.is_none() || gap == 0 {
                    break;
                }
                gap -= 1;
            }
        }
        let said = |low: usize| frame.get(low).copied();
        let length = said(3).zip(said(4)).map(|(low, high)| usize::from(low) | usize::from(high) << 8);
        let is_short_enough = length.is_some_and(|length| length <= 1024);
        let held = length.filter(|_| is_short_enough).unwrap_or(0).min(frame.len().saturating_sub(5));
        let held = &frame[frame.len().min(5)..][..held];
        let is_sound = !is_broken
            && is_short_enough
            && frame.len() == 9 + length.expect("a length")
            && frame[frame.len() - 4..] == crc32(&frame[..frame.len() - 4]).to_le_bytes();
        assert_eq!(seen, held, "run {run}");
        assert_eq!(headers, usize::from(is_short_enough));
        assert!(block.is("comes"));
        block.expect("is_sound", is_sound);
        if is_short_enough {
            for (port, place) in [("session", 0), ("kind", 1), ("number", 2)] {
                block.expect(port, frame[place]);
            }
            block.expect("length", length.expect("a length") as u64);
        }
        if let Some(last) = held.last_chunk::<4>() {
            block.expect("value", u32::from_le_bytes(*last));
        }
        judged[usize::from(is_sound)] += 1;
        for _ in 0..random.below(20) {
            block.edge();
            reader_clock(&mut block, None, None);
            assert!(!block.is("comes"));
        }
        block.edge();
    }
    assert!(judged.iter().all(|count| *count > 30), "{judged:?} frames dropped and sound");
}

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

/// The session as the page has it.
#[derive(Default)]
struct Session {
    number: u8,
    expected: u8,
    saw_gap: bool,
    begins: bool,
    settling: u32,
}

#[test]
fn session_opens_counts_and_ends() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("serial_session_state", SessionState::default(), 1);
    let mut session = Session::default();
    let (mut openings, mut ends) = (0, 0);
    for clock in 0..20_000 {
        let event = [TAKES, TAKES, TAKES, GAP, OPENS, CLOSES, POLLS, REPEATS][random.below(8) as usize];
        let asks = clock > 0 && random.below(3) == 0 && (event & (OPENS | CLOSES) == 0 || random.below(9) == 0);
        let asked = if asks { HEARS | event } else { 0 };
        let named = 1 + random.below(255) as u8;
        let (fails, reset) = (clock > 0 && random.below(150) == 0, clock == 0 || random.below(2000) == 0);
        block.set("asked", asked);
        block.set("session", named);
        block.set("fails", fails);
        block.set("reset", reset);
        block.settle();
        if clock > 0 {
            block.expect("is_open", session.number != 0);
            block.expect("number", session.number);
            block.expect("expected", session.expected);
            block.expect("saw_gap", session.saw_gap);
            block.expect("forgets", session.begins || session.number == 0);
            block.expect("settles", session.settling > 0);
        }
        block.edge();
        session.settling = if asks || fails || reset { 7 } else { session.settling.saturating_sub(1) };
        session.begins = asked & OPENS != 0;
        session.expected = session.expected.wrapping_add((asked & TAKES != 0).into());
        session.saw_gap = (session.saw_gap || asked & GAP != 0) && asked & TAKES == 0;
        if asked & (OPENS | CLOSES) != 0 || fails || reset {
            let opens = asked & OPENS != 0 && !reset;
            ends += usize::from(session.number != 0);
            openings += usize::from(opens);
            session.number = if opens { named } else { 0 };
            (session.expected, session.saw_gap) = (0, false);
        }
    }
    assert!(openings > 50 && ends > 50, "{openings} openings, {ends} ends");
}

#[test]
fn replies_go_in_order_and_each_once() {
    const KINDS: [u32; 5] = [0x81, 0x82, 0x88, 0x87, 0];
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_replies", Replies::default(), 1);
    // Hello, Opened, Closed, NoSession in their order; then Ack and Nak.
    let mut due = [false; 4];
    let (mut ack, mut nak) = (false, false);
    let mut sent = [0; 6];
    for clock in 0..30_000 {
        let busy = [2, 30][clock / 500 % 2];
        let events =
            [HELLO, OPENS, RATE, POLLS, CLOSES, TAKES, REPEATS, GAP, NO_SESSION, DROPS, TAKES, POLLS, GAP, RATE];
        let asked = if clock > 0 && random.below(busy) == 0 { events[random.below(14) as usize] } else { 0 };
        let (saw_gap, fails) = (random.below(2) == 0, clock > 0 && random.below(90) == 0);
        let reset = clock == 0 || random.below(3000) == 0;
        let first = due.iter().position(|is_due| *is_due).unwrap_or(4);
        let is_due = first < 4 || ack || nak;
        let starts = clock > 0 && is_due && random.below(6) == 0;
        block.set("asked", asked);
        for (port, bit) in [("saw_gap", saw_gap), ("fails", fails), ("starts", starts), ("reset", reset)] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 0 {
            block.expect("is_due", is_due);
        }
        if clock > 0 && is_due {
            let kind = if first < 4 { KINDS[first] } else { 0x83 + u32::from(nak) };
            block.expect("kind", kind);
            block.expect("acknowledges", first == 4);
            block.expect("closes", first == 2);
            if starts {
                sent[if first < 4 { first } else { 4 + usize::from(nak) }] += 1;
            }
        }
        block.edge();
        if starts {
            if first < 4 {
                due[first] = false;
            } else {
                (ack, nak) = (false, false);
            }
        }
        due[0] |= asked & HELLO != 0;
        due[3] |= asked & NO_SESSION != 0;
        ack |= asked & (RATE | REPEATS | TAKES) != 0 || asked & POLLS != 0 && !saw_gap;
        nak |= asked & GAP != 0 && !saw_gap || asked & POLLS != 0 && saw_gap;
        nak &= asked & TAKES == 0;
        if asked & (OPENS | CLOSES) != 0 || fails {
            due = [due[0], asked & OPENS != 0, asked & CLOSES != 0, false];
            (ack, nak) = (false, false);
        }
        if reset {
            (due, ack, nak) = ([false; 4], false, false);
        }
    }
    assert!(sent.iter().all(|count| *count > 20), "{sent:?}");
}
