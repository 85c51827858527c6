use super::*;
use incircle_protocol::{command_word, Opcode, PADDING, SMALL};

fn device(beat_bits: u32) -> StreamModel<ModelCore> {
    StreamModel::new(ModelCore::of(SMALL).unwrap(), beat_bits)
}

/// The words of commands as beats, filled up with padding.
fn beats(words: &[u32], beat_bits: u32) -> Vec<u8> {
    let mut words = words.to_vec();
    words.resize(words.len().next_multiple_of(beat_bits as usize / 32), PADDING);
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// The next answer, without the padding of its last beat.
fn answer(device: &mut StreamModel<ModelCore>) -> Vec<u32> {
    let mut bytes = vec![0; 1 << 16];
    let given = device.give(&mut bytes);
    assert!(given.is_end && given.bytes.is_multiple_of(device.beat_bytes()), "{given:?}");
    let mut words: Vec<u32> =
        bytes[..given.bytes].chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    let length = HEAD_WORDS + words[1] as usize;
    assert!(words.len() - length < device.width && words[length..].iter().all(|&word| word == 0), "{words:x?}");
    words.truncate(length);
    words
}

#[test]
fn answers_begin_at_a_beat_and_end_one() {
    for bits in [64, 128] {
        let mut device = device(bits);
        let (hello, clear) = (command_word(Opcode::Hello), command_word(Opcode::Clear));
        // The first command ends in the middle of a beat, and the next begins there.
        let commands = beats(&[hello, clear, hello], bits);
        assert_eq!(device.take(&commands), commands.len());
        assert_eq!(device.read(StreamRegister::Status.offset()), Ok(STREAM_STATUS_RUNS | STREAM_STATUS_BUSY));
        assert_eq!(answer(&mut device).len(), 9);
        assert_eq!(answer(&mut device), [clear, 0]);
        assert_eq!(answer(&mut device).len(), 9);
        assert_eq!(device.give(&mut [0; 64]), Given::default());
        assert_eq!(device.read(StreamRegister::Status.offset()), Ok(STREAM_STATUS_RUNS));
        assert_eq!(device.read(StreamRegister::Answers.offset()), Ok(3));
        assert_eq!(device.read(StreamRegister::CommandBeats.offset()), Ok(if bits == 64 { 2 } else { 1 }));
    }
}

#[test]
fn words_wait_where_there_is_no_room() {
    let mut device = device(64);
    let commands = beats(&[command_word(Opcode::Latencies); 4096], 64);
    // Each command has 130 words of answer, and as many as fill a FIFO stay in the device.
    let taken = device.take(&commands);
    assert!((4096..8192).contains(&taken), "{taken}");
    let mut left = &commands[taken..];
    for _ in 0..4096 {
        assert_eq!(answer(&mut device).len(), 130);
        left = &left[device.take(left)..];
    }
    assert!(left.is_empty() && !device.is_busy());
}

#[test]
fn errors_stay_until_they_are_cleared() {
    let mut device = device(64);
    let status = |device: &mut StreamModel<ModelCore>| device.read(StreamRegister::Status.offset()).unwrap();
    assert_eq!(device.take(&[1, 2, 3]), 3);
    assert_eq!(device.read(StreamRegister::Errors.offset()), Ok(ERROR_PARTIAL_BEAT));
    assert_eq!(status(&mut device), STREAM_STATUS_RUNS | STREAM_STATUS_ERROR);
    let read = beats(&[command_word(Opcode::Read), 0, 1], 64);
    device.take(&read);
    assert_eq!(answer(&mut device), [0x0402_0000, 0]);
    assert_eq!(device.read(StreamRegister::Fault.offset()), Ok(0x0402_0000));
    assert_eq!(device.write(StreamRegister::Errors.offset(), ERROR_PARTIAL_BEAT), Ok(()));
    assert_eq!(device.read(StreamRegister::Errors.offset()), Ok(ERROR_ANSWER_STATUS));
    device.write(StreamRegister::Errors.offset(), ERROR_ANSWER_STATUS).unwrap();
    assert_eq!(status(&mut device), STREAM_STATUS_RUNS);
}

#[test]
fn a_reset_drops_what_is_under_way() {
    let mut device = device(128);
    let half = beats(&[command_word(Opcode::Hello), command_word(Opcode::Insert), 5, 1], 128);
    device.take(&half);
    assert!(device.is_busy());
    device.write(StreamRegister::Control.offset(), CONTROL_RESET).unwrap();
    assert!(!device.is_busy());
    assert_eq!(device.give(&mut [0; 64]), Given::default());
    device.take(&beats(&[command_word(Opcode::Hello)], 128));
    assert_eq!(answer(&mut device).len(), 9);
}

#[test]
fn registers_that_are_none_are_refused() {
    let mut device = device(64);
    for offset in [0x28, 0x3c, 0x50, 0x9c, 0xffc] {
        assert_eq!(device.read(offset), Err(BusError));
        assert_eq!(device.write(offset, 0), Err(BusError));
    }
    for register in StreamRegister::ALL {
        let is_written = matches!(register, StreamRegister::Control | StreamRegister::Errors);
        assert_eq!(device.write(register.offset(), 0).is_ok(), is_written, "{register:?}");
        assert!(device.read(register.offset()).is_ok());
    }
}
