//! The model of the serial link, rule by rule.

use super::*;
use crate::{ClockModel, CommandModel};
use incircle_protocol::{clear_word, command_word, Opcode, SILENCE_MS, SMALL, TINY};

const CLOCK: u32 = 125_000_000;
const LINK: LinkConfig = LinkConfig { clock_hz: CLOCK, fifo_bytes: 4096, silence_ms: SILENCE_MS };
/// Number of clocks that a byte takes.
const BYTE: u64 = 104;

fn board() -> SerialModel<Instantly> {
    let core = Instantly::of(SMALL).unwrap();
    SerialModel::new(LINK, core.identity(), core)
}

fn frame(kind: HostFrame, number: u8, words: &[u32]) -> FromHost {
    FromHost { session: 5, kind, number, payload: words.iter().flat_map(|word| word.to_le_bytes()).collect() }
}

fn send(board: &mut SerialModel<impl WordDevice>, frame: &FromHost) {
    frame.to_line().into_iter().for_each(|byte| board.take(byte));
}

/// All frames that the board sends until it has been silent for long.
fn listen(board: &mut SerialModel<impl WordDevice>) -> Vec<FromDevice> {
    let (mut line, mut silent) = (Vec::new(), 0);
    while silent < 100 {
        board.pass(BYTE);
        silent += 1;
        if let Some(byte) = board.give() {
            line.push(byte);
            silent = 0;
        }
    }
    line.split(|&byte| byte == 0)
        .filter(|line| !line.is_empty())
        .map(|line| FromDevice::from_line(line).expect("a frame"))
        .collect()
}

fn ask(board: &mut SerialModel<impl WordDevice>, kind: HostFrame, number: u8, words: &[u32]) -> Vec<FromDevice> {
    send(board, &frame(kind, number, words));
    listen(board)
}

fn kinds(frames: &[FromDevice]) -> Vec<DeviceFrame> {
    frames.iter().map(|frame| frame.kind).collect()
}

fn opened() -> SerialModel<Instantly> {
    let mut board = board();
    assert_eq!(kinds(&ask(&mut board, HostFrame::Open, 0, &[])), [DeviceFrame::Opened]);
    board
}

/// The words of the answers in these frames, with their check sums checked.
fn words_of(frames: &[FromDevice]) -> Vec<u32> {
    let (mut words, mut answer) = (Vec::new(), Vec::new());
    for frame in frames {
        let is_end = frame.kind == DeviceFrame::AnswerEnd;
        if !is_end && frame.kind != DeviceFrame::Answer {
            continue;
        }
        let (header, said) = frame.body.split_at(3);
        assert_eq!(header[0], frame.answers);
        assert_eq!(u16::from_le_bytes([header[1], header[2]]) as usize, answer.len() / 4);
        let (said, crc) = said.split_at(said.len() - if is_end { 4 } else { 0 });
        answer.extend_from_slice(said);
        if is_end {
            assert_eq!(crc, Crc32::of(&answer).to_le_bytes());
            words.extend(answer.chunks(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap())));
            answer.clear();
        }
    }
    assert!(answer.is_empty());
    words
}

#[test]
fn it_greets_without_a_session() {
    let mut board = board();
    let frames = ask(&mut board, HostFrame::Hello, 0, &[]);
    assert_eq!(kinds(&frames), [DeviceFrame::Hello]);
    assert_eq!((frames[0].session, frames[0].status, frames[0].free), (0, 0, 4096));
    let words: Vec<u32> = frames[0].body.chunks(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect();
    let greeting = Greeting::from_words(words.try_into().unwrap());
    assert_eq!((greeting.magic, greeting.clock_hz, greeting.max_rate), (LINK_MAGIC, CLOCK, 15_625_000));
    assert_eq!(greeting.identity, Identity { contexts: 1, ..core_identity(SMALL) });
    assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::NoSession]);
    assert!(board.is_at_rest());
}

#[test]
fn commands_pass_in_any_pieces_and_answers_come_in_parts() {
    let points: Vec<u32> = (0..300).map(|j: u32| (j * 7 % 300) | ((j * j % 1021) << 16)).collect();
    let commands =
        [&[clear_word(0), command_word(Opcode::Insert), 300][..], &points, &[command_word(Opcode::Read), 0, 100]]
            .concat();
    let mut model = CommandModel::new(16, SMALL.points, SMALL.ring).unwrap();
    model.send(&commands);
    let mut expected = vec![0; 2000];
    let length = model.receive(&mut expected);
    expected.truncate(length);
    for piece in [1, 5, 100, 256] {
        let mut board = opened();
        let mut frames = Vec::new();
        for (number, words) in commands.chunks(piece).enumerate() {
            frames.extend(ask(&mut board, HostFrame::Data, number as u8, words));
        }
        assert_eq!(words_of(&frames), expected, "in pieces of {piece}");
        assert!(frames.iter().any(|frame| frame.kind == DeviceFrame::Answer));
        let poll = ask(&mut board, HostFrame::Poll, 0, &[]);
        assert_eq!((poll[0].answers, poll[0].status, poll[0].free), (3, STATUS_OPEN, 4096));
        let bytes: Vec<u8> = commands.iter().flat_map(|word| word.to_le_bytes()).collect();
        assert_eq!(poll[0].body, Crc32::of(&bytes).to_le_bytes());
    }
}

#[test]
fn the_core_by_clocks_says_the_same_through_its_link() {
    let commands = [command_word(Opcode::Insert), 4, 0, 4, 0x0004_0004, 0x0004_0000, command_word(Opcode::Hello)];
    let mut board = SerialModel::new(LINK, core_identity(TINY), ClockModel::new(TINY).unwrap());
    ask(&mut board, HostFrame::Open, 0, &[]);
    send(&mut board, &frame(HostFrame::Data, 0, &commands[..3]));
    let half = listen(&mut board);
    assert_eq!((kinds(&half), half[0].status), (vec![DeviceFrame::Ack], STATUS_OPEN));
    // The insertion is not complete: the core waits for more points.
    let poll = ask(&mut board, HostFrame::Poll, 0, &[]);
    assert_eq!(poll[0].status, STATUS_OPEN | STATUS_BUSY);
    let rest = ask(&mut board, HostFrame::Data, 1, &commands[3..]);
    let words = words_of(&rest);
    assert_eq!(words[..7], [0x0300_0000, 5, 4, 4, 0, 0, 6]);
    assert_eq!(words[9..], core_identity(TINY).to_words());
    let poll = ask(&mut board, HostFrame::Poll, 0, &[]);
    assert_eq!(poll[0].status, STATUS_OPEN);
}

#[test]
fn old_data_is_acknowledged_and_a_gap_named_once() {
    let mut board = opened();
    let hello = [command_word(Opcode::Hello)];
    assert_eq!(kinds(&ask(&mut board, HostFrame::Data, 1, &hello)), [DeviceFrame::Nak]);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Data, 2, &hello)), []);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::Nak]);
    let frames = ask(&mut board, HostFrame::Data, 0, &hello);
    assert_eq!(kinds(&frames), [DeviceFrame::Ack, DeviceFrame::AnswerEnd]);
    let again = ask(&mut board, HostFrame::Data, 0, &hello);
    assert_eq!((kinds(&again), again[0].expected), (vec![DeviceFrame::Ack], 1));
    assert_eq!(kinds(&ask(&mut board, HostFrame::Data, 129, &hello)), [DeviceFrame::Ack]);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Data, 128, &hello)), [DeviceFrame::Nak]);
    assert_eq!(words_of(&frames).len(), 9);
}

#[test]
fn what_finds_no_room_is_refused_and_taken_later() {
    let mut board = opened();
    // The core gets no clock, so no word leaves the FIFO.
    let words = [&[command_word(Opcode::Insert), 2000][..], &[7; 254]].concat();
    for number in 0..4 {
        send(&mut board, &frame(HostFrame::Data, number, &words));
    }
    send(&mut board, &frame(HostFrame::Data, 4, &[1]));
    let mut line: Vec<u8> = std::iter::from_fn(|| board.give()).collect();
    line.pop();
    let nak = FromDevice::from_line(&line).unwrap();
    assert_eq!((nak.kind, nak.expected, nak.free), (DeviceFrame::Nak, 4, 0));
    board.pass(100);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Data, 4, &[1])), [DeviceFrame::Ack]);
}

#[test]
fn a_broken_frame_is_told_once() {
    let mut board = opened();
    let mut line = frame(HostFrame::Poll, 0, &[]).to_line();
    line[4] ^= 1;
    line.into_iter().for_each(|byte| board.take(byte));
    assert_eq!(listen(&mut board), []);
    let poll = ask(&mut board, HostFrame::Poll, 0, &[]);
    assert_eq!(poll[0].status, STATUS_OPEN | STATUS_DROPPED);
    assert_eq!(ask(&mut board, HostFrame::Poll, 0, &[])[0].status, STATUS_OPEN);
    // Between frames noise has no effect.
    board.spoil();
    assert_eq!(ask(&mut board, HostFrame::Poll, 0, &[])[0].status, STATUS_OPEN);
    let line = frame(HostFrame::Poll, 0, &[]).to_line();
    let (first, rest) = line.split_at(3);
    first.iter().for_each(|&byte| board.take(byte));
    board.spoil();
    rest.iter().for_each(|&byte| board.take(byte));
    assert_eq!(listen(&mut board), []);
    assert_eq!(ask(&mut board, HostFrame::Poll, 0, &[])[0].status, STATUS_OPEN | STATUS_DROPPED);
}

#[test]
fn frames_of_another_session_are_not_heard() {
    let mut board = opened();
    let foreign = FromHost { session: 6, ..frame(HostFrame::Data, 0, &[command_word(Opcode::Hello)]) };
    send(&mut board, &foreign);
    assert_eq!(listen(&mut board), []);
    send(&mut board, &FromHost { session: 6, ..frame(HostFrame::Open, 0, &[]) });
    let frames = listen(&mut board);
    assert_eq!((kinds(&frames), frames[0].session), (vec![DeviceFrame::Opened], 6));
    assert_eq!(ask(&mut board, HostFrame::Poll, 0, &[]), []);
}

#[test]
fn opening_again_forgets_the_command_under_way() {
    let mut board = opened();
    ask(&mut board, HostFrame::Data, 0, &[command_word(Opcode::Insert), 10, 1, 2]);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Open, 0, &[])), [DeviceFrame::Opened]);
    let frames = ask(&mut board, HostFrame::Data, 0, &[command_word(Opcode::Hello)]);
    assert_eq!(kinds(&frames), [DeviceFrame::Ack, DeviceFrame::AnswerEnd]);
}

#[test]
fn the_rate_changes_behind_the_answer() {
    let mut board = opened();
    let first = board.rate_step();
    assert_eq!(first, rate_step(FIRST_RATE, CLOCK).unwrap());
    for bad in [0, MAX_STEP + 1, u32::MAX] {
        let frames = ask(&mut board, HostFrame::Rate, 0, &[bad]);
        assert_eq!((frames[0].kind, frames[0].status), (DeviceFrame::Ack, STATUS_OPEN | STATUS_BAD_RATE));
        assert_eq!(board.rate_step(), first);
    }
    let step = rate_step(12_000_000, CLOCK).unwrap();
    send(&mut board, &frame(HostFrame::Rate, 0, &[step]));
    let mut bytes = 0;
    while board.rate_step() == first {
        board.give().expect("an answer");
        bytes += 1;
    }
    assert!(board.give().is_none());
    assert!((17..=18).contains(&bytes), "{bytes}");
    assert_eq!(board.rate_step(), step);
    assert_eq!(ask(&mut board, HostFrame::Poll, 0, &[])[0].status, STATUS_OPEN);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Close, 0, &[])), [DeviceFrame::Closed]);
    assert_eq!(board.rate_step(), first);
    assert!(board.is_at_rest());
}

#[test]
fn silence_and_a_break_end_the_session_and_frames_do_not() {
    let step = rate_step(3_000_000, CLOCK).unwrap();
    let silence = u64::from(CLOCK) / 1000 * u64::from(SILENCE_MS);
    let mut board = opened();
    ask(&mut board, HostFrame::Rate, 0, &[step]);
    for _ in 0..3 {
        board.pass(silence * 3 / 4);
        assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::Ack]);
    }
    board.pass(silence);
    assert!(board.is_at_rest());
    assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::NoSession]);
    let mut board = opened();
    ask(&mut board, HostFrame::Rate, 0, &[step]);
    board.break_line();
    assert_eq!((board.session(), board.rate_step()), (0, rate_step(FIRST_RATE, CLOCK).unwrap()));
    board.take(0);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::NoSession]);
}

#[test]
fn an_answer_that_is_cut_is_no_frame() {
    let mut board = opened();
    send(&mut board, &frame(HostFrame::Data, 0, &[command_word(Opcode::Latencies)]));
    let mut line = Vec::new();
    while line.len() < 200 {
        board.pass(BYTE);
        line.extend(board.give());
    }
    send(&mut board, &frame(HostFrame::Open, 0, &[]));
    line.extend(std::iter::from_fn(|| board.give()));
    let frames: Vec<_> = line.split(|&byte| byte == 0).filter(|line| !line.is_empty()).collect();
    let said: Vec<_> = frames.iter().map(|line| FromDevice::from_line(line).map(|frame| frame.kind)).collect();
    assert_eq!(said, [Some(DeviceFrame::Ack), None, Some(DeviceFrame::Opened)]);
}

#[test]
fn noise_is_survived() {
    let mut board = opened();
    let mut state = 9_u32;
    for _ in 0..200_000 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        board.take((state >> 24) as u8 & (state >> 16) as u8);
        board.pass(10);
        board.give();
    }
    board.take(0);
    listen(&mut board);
    assert_eq!(kinds(&ask(&mut board, HostFrame::Poll, 0, &[])), [DeviceFrame::Ack]);
}
