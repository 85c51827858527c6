//! The serial link from bytes to what a frame asks for: COBS, frames, sessions, receipts. Rust, Verilog and plain code agree.

mod block_ports;
mod serial_host;
mod stepper;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::serial::{Asked, CobsDecoder, CobsEncoder, FrameJudge, FrameReader, Replies, SessionState};
use serial_host::{cobs, crc32, host_frame, reverse_cobs};
use stepper::{named_ports, Cell, Stepper, Wave};

named_ports!(CobsDecoder, [reset, byte_valid, byte_data, noise], [data_valid, data, frame_ends, is_broken], clock);
named_ports!(
    CobsEncoder,
    [reset, data_valid, data, ends, cuts, byte_ready],
    [data_ready, ended, byte_valid, byte_data],
    clock
);
named_ports!(
    FrameReader,
    [reset, data_valid, data, frame_ends, is_broken],
    [session, kind, number, length, header_comes, payload_valid, payload, value, comes, is_sound],
    clock
);
named_ports!(
    FrameJudge,
    [reset, session, kind, number, length, header_comes, comes, is_sound, is_open, open_session, expected, free],
    [takes_payload, asked],
    clock
);
named_ports!(
    SessionState,
    [reset, asked, session, fails],
    [is_open, number, expected, saw_gap, forgets, settles],
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

/// Bytes with runs of zeros and of others, up to beyond the longest piece of COBS.
fn bytes(random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..1 + random.below(4) {
        let count = [0, 1, random.below(20), 253, 254, 255, random.below(600)][random.below(7) as usize];
        let zeros = [0, 2, 16, 256][random.below(4) as usize];
        bytes.extend((0..count).map(|_| if random.below(256) < zeros { 0 } else { 1 + random.below(255) as u8 }));
    }
    bytes
}

/// What a decoder gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Decoded {
    Byte(u8),
    End { is_broken: bool },
}

/// A frame out of COBS, piece by piece; `lacks` if a byte of it was lost on the line.
fn decoded(mut encoded: &[u8], lacks: bool) -> Vec<Decoded> {
    let mut seen = Vec::new();
    let (mut owes_zero, mut is_broken) = (false, lacks);
    while let [length, rest @ ..] = encoded {
        if owes_zero {
            seen.push(Decoded::Byte(0));
        }
        owes_zero = *length != 255;
        let whole = usize::from(*length) - 1;
        let piece = &rest[..whole.min(rest.len())];
        is_broken |= piece.len() < whole;
        seen.extend(piece.iter().map(|byte| Decoded::Byte(*byte)));
        encoded = &rest[piece.len()..];
    }
    seen.push(Decoded::End { is_broken });
    seen
}

/// One clock of a decoder, and what it gives in it.
fn decoder_clock(block: &mut Stepper<CobsDecoder>, byte: Option<u8>, noise: bool) -> Option<Decoded> {
    block.set("byte_valid", byte.is_some());
    block.set("byte_data", byte.unwrap_or(0x55));
    block.set("noise", noise);
    block.settle();
    let mut seen = None;
    if block.clocks() > 0 {
        if block.is("data_valid") {
            seen = Some(Decoded::Byte(block.get("data") as u8));
        }
        if block.is("frame_ends") {
            assert_eq!(seen, None);
            seen = Some(Decoded::End { is_broken: block.is("is_broken") });
        }
    }
    block.edge();
    seen
}

fn new_decoder() -> Stepper<CobsDecoder> {
    let mut block = Stepper::new("serial_cobs_decoder", CobsDecoder::default(), 1);
    block.set("reset", true);
    decoder_clock(&mut block, None, false);
    block.set("reset", false);
    block
}

#[test]
fn decoder_takes_frames_out_of_cobs_and_tells_broken_ones() {
    let mut random = SplitMix64::new(1);
    let mut block = new_decoder();
    let mut ends = [0; 2];
    for run in 0..300 {
        let mut line = match run % 4 {
            0 | 1 => cobs(&bytes(&mut random)),
            2 => cobs(&bytes(&mut random)).into_iter().filter(|byte| *byte == 0 || random.below(40) > 0).collect(),
            _ => (0..random.below(60)).map(|_| 1 + random.below(255) as u8).chain([0]).collect(),
        };
        if line.len() == 1 {
            // Nothing between two zeros: no frame.
            line.push(0);
        }
        let noise_at = (run % 5 == 4).then(|| random.below(line.len() as u64) as usize);
        let mut seen = Vec::new();
        for (place, byte) in line.iter().enumerate() {
            if noise_at == Some(place) {
                seen.extend(decoder_clock(&mut block, None, true));
            }
            seen.extend(decoder_clock(&mut block, Some(*byte), false));
            for _ in 0..random.below(3) {
                seen.extend(decoder_clock(&mut block, None, false));
            }
        }
        seen.extend(decoder_clock(&mut block, None, false));
        let frame = line.split(|byte| *byte == 0).next().expect("what stands before the first zero");
        let is_hit = noise_at.is_some_and(|place| place > 0 && place <= frame.len());
        let expected = if frame.is_empty() { Vec::new() } else { decoded(frame, is_hit) };
        assert_eq!(seen, expected, "run {run}");
        if let Some(Decoded::End { is_broken }) = seen.last() {
            ends[usize::from(*is_broken)] += 1;
        }
    }
    assert!(ends.iter().all(|count| *count > 50), "{ends:?} frames whole and broken");
}

#[test]
fn decoder_shows_the_wave_of_its_header() {
    let mut block = new_decoder();
    let mut wave = Wave::default();
    let line = [None, Some(2), None, Some(11), Some(2), Some(22), Some(0), Some(0), None, Some(5), Some(33), Some(0)];
    for byte in line.into_iter().chain([None; 4]) {
        let seen = decoder_clock(&mut block, byte, false);
        let number = |byte: Option<u8>| byte.map_or(Cell::Open, |byte| Cell::Number(byte.into()));
        let data = if let Some(Decoded::Byte(data)) = seen { Some(data) } else { None };
        wave.take(&[
            ("byte_valid", Cell::Bit(byte.is_some())),
            ("byte_data", number(byte)),
            ("data_valid", Cell::Bit(data.is_some())),
            ("data", number(data)),
            ("frame_ends", Cell::Bit(matches!(seen, Some(Decoded::End { .. })))),
            ("is_broken", Cell::Bit(matches!(seen, Some(Decoded::End { is_broken: true })))),
        ]);
    }
    wave.assert_drawn_in(include_str!("../../hdl/src/serial/cobs_decoder.rs"));
}

/// One clock of an encoder: the byte it gives, whether it takes the one it is offered, whether the frame is over.
fn encoder_clock(
    block: &mut Stepper<CobsEncoder>,
    offered: Option<u8>,
    [ends, cuts, is_ready]: [bool; 3],
) -> (Option<u8>, bool, bool) {
    block.set("data_valid", offered.is_some());
    block.set("data", offered.unwrap_or(0));
    for (port, bit) in [("ends", ends), ("cuts", cuts), ("byte_ready", is_ready)] {
        block.set(port, bit);
    }
    block.settle();
    let mut seen = (None, false, false);
    if block.clocks() > 0 {
        let gives = block.is("byte_valid");
        seen.0 = (gives && is_ready).then(|| block.get("byte_data") as u8);
        seen.1 = offered.is_some() && block.is("data_ready");
        seen.2 = block.is("ended");
    }
    block.edge();
    seen
}

fn new_encoder() -> Stepper<CobsEncoder> {
    let mut block = Stepper::new("serial_cobs_encoder", CobsEncoder::default(), 1);
    block.set("reset", true);
    encoder_clock(&mut block, None, [false; 3]);
    block.set("reset", false);
    block
}

#[test]
fn encoder_puts_frames_into_reverse_cobs_under_any_back_pressure() {
    let mut random = SplitMix64::new(2);
    let mut block = new_encoder();
    for run in 0..200 {
        let frame = bytes(&mut random);
        let cut_at = (run % 4 == 3).then(|| random.below(frame.len() as u64 + 1) as usize);
        let (idle, busy) = ([1, 3][run % 2], [1, 4][run / 2 % 2]);
        let (mut next, mut offers, mut line) = (0, false, Vec::new());
        loop {
            let is_cut = cut_at.is_some_and(|place| next >= place);
            offers = !is_cut && next < frame.len() && (offers || random.below(idle) == 0);
            let offered = offers.then(|| frame[next]);
            let ends = is_cut || next == frame.len();
            let (byte, is_taken, ended) = encoder_clock(&mut block, offered, [ends, is_cut, random.below(busy) == 0]);
            line.extend(byte);
            if is_taken {
                (next, offers) = (next + 1, false);
            }
            if ended {
                break;
            }
        }
        if cut_at.is_some() {
            let whole = reverse_cobs(&frame[..next]);
            assert_eq!(line[..line.len() - 1], whole[..whole.len() - 2], "run {run}");
            assert_eq!(line.last(), Some(&0));
        } else {
            assert_eq!(line, reverse_cobs(&frame), "run {run}");
        }
    }
}

#[test]
fn encoder_shows_the_wave_of_its_header() {
    let mut block = new_encoder();
    let mut wave = Wave::default();
    let frame = [11, 0, 22];
    let mut next = 0;
    for clock in 0..14 {
        let is_begun = (1..13).contains(&clock);
        let offered = frame.get(next).copied().filter(|_| is_begun);
        let ends = is_begun && offered.is_none();
        let is_ready = clock % 2 == 0;
        let (byte, is_taken, ended) = encoder_clock(&mut block, offered, [ends, false, is_ready]);
        next += usize::from(is_taken);
        let number = |byte: Option<u8>| byte.map_or(Cell::Open, |byte| Cell::Number(byte.into()));
        wave.take(&[
            ("data_valid", Cell::Bit(offered.is_some())),
            ("data", number(offered)),
            ("data_ready", Cell::Bit(is_taken)),
            ("ends", Cell::Bit(ends)),
            ("byte_ready", Cell::Bit(is_ready)),
            ("byte_data", number(byte)),
            ("ended", Cell::Bit(ended)),
        ]);
        if ended {
            next = usize::MAX;
            break;
        }
    }
    assert_eq!(next, usize::MAX, "the frame is over");
    wave.assert_drawn_in(include_str!("../../hdl/src/serial/cobs_encoder.rs"));
}

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
    for run in 0..8000 {
        let mut case = Case::random(&mut random);
        let is_sound = random.below(5) > 0;
        // Room that comes after the first byte of the payload comes too late.
        let takes = case.takes();
        for clock in 0..24 {
            if clock == 8 && random.below(3) == 0 {
                case.free = 32768;
            }
            for (port, value) in [
                ("session", case.session.into()),
                ("kind", case.kind.into()),
                ("number", case.number.into()),
                ("length", case.length),
                ("is_open", case.is_open.into()),
                ("open_session", case.open_session.into()),
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
                let asked = if clock == 21 { case.asked(is_sound, takes) } else { 0 };
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
