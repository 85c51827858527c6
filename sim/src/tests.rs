//! The two streams against a device that echoes, and the first words of every core.

use incircle::Transport;
use incircle_protocol::{
    answer_header, command_word, Config, Identity, Opcode, Status, CORE_COORD_BITS, IDENTITY_WORDS, MAGIC, NAMED,
    SMALL, TINY,
};

use crate::{models, Awaited, SimDevice, SimError, SimTransport};

fn echo() -> SimDevice {
    SimDevice::of(models::echo()).unwrap()
}

#[test]
fn words_come_back_in_order() {
    let mut device = echo();
    let words: Vec<u32> = (0..100).map(|n| n * n).collect();
    device.send(&words, 1000).unwrap();
    let mut answers = vec![0; 200];
    device.receive(&mut answers, 1000).unwrap();
    let expected: Vec<u32> = words.iter().flat_map(|word| [word + 1, word + 1]).collect();
    assert_eq!(answers, expected);
}

#[test]
fn equal_words_in_a_row_are_as_many_words() {
    let mut device = echo();
    device.send(&[7, 7, 7], 100).unwrap();
    device.send(&[7], 100).unwrap();
    let mut answers = [0; 8];
    device.receive(&mut answers, 100).unwrap();
    assert_eq!(answers, [8; 8]);
    let error = device.receive(&mut [0], 50).unwrap_err();
    assert!(matches!(error, SimError::Timeout { done: 0, .. }), "{error}");
}

/// A simulation is as slow as the machine is busy, so its limits of time are not those of a real core.
#[test]
fn limits_of_time_are_those_of_a_slow_device() {
    let pace = SimTransport::new(echo(), "echo").capabilities().pace;
    assert_eq!((pace.slow, pace.words_per_second), (20, None));
}

#[test]
fn every_word_has_the_clock_in_which_it_came() {
    let mut device = echo();
    assert_eq!(device.answer_clock(), None);
    device.send(&[1, 2, 3], 100).unwrap();
    // The answers wait in the device, and keep the clocks at which they came.
    device.receive(&mut [0; 6], 100).unwrap();
    let last = device.answer_clock().unwrap();
    assert!(last <= device.clocks());
    device.receive(&mut [0], 50).unwrap_err();
    assert_eq!(device.answer_clock(), Some(last));
    let mut clocks = Vec::new();
    device.send(&[4, 5, 6], 100).unwrap();
    device.receive(&mut [0; 2], 100).unwrap();
    clocks.push(device.answer_clock().unwrap());
    let after = device.clocks();
    device.receive(&mut [0; 4], 100).unwrap();
    clocks.push(device.answer_clock().unwrap());
    assert!(last + 50 < clocks[0] && clocks[0] < clocks[1], "{last} {clocks:?}");
    assert!(clocks[0] <= after && clocks[1] <= device.clocks(), "{clocks:?} {after}");
}

#[test]
fn nothing_takes_no_time() {
    let mut device = echo();
    let before = device.clocks();
    device.send(&[], 0).unwrap();
    device.receive(&mut [], 0).unwrap();
    assert_eq!(device.clocks(), before);
}

#[test]
fn a_deaf_device_is_a_timeout_with_its_figures() {
    let mut device = echo();
    let before = device.clocks();
    let error = device.send(&[1, u32::MAX, 2, 3], 500).unwrap_err();
    let expected =
        SimError::Timeout { awaited: Awaited::CommandWords, done: 2, wanted: 4, clocks: 500, total: before + 500 };
    assert_eq!(error, expected);
    assert!(error.to_string().contains("took 2 of 4 words in 500 clocks"), "{error}");
}

#[test]
fn sending_in_slices_of_any_length_loses_and_doubles_nothing() {
    let words: Vec<u32> = (0..30).map(|n| n / 3).collect();
    let expected: Vec<u32> = words.iter().flat_map(|word| [word + 1, word + 1]).collect();
    for slice in 1..9 {
        for listens in [false, true] {
            let mut device = echo();
            let mut sent = 0;
            for _ in 0..200 {
                match device.send(&words[sent..], slice) {
                    Ok(()) => sent = words.len(),
                    Err(SimError::Timeout { done, .. }) => sent += done,
                    Err(error) => panic!("{error}"),
                }
                if listens {
                    // The call asks for far more answers than come, so clocks pass, and the offered word may be taken.
                    device.receive(&mut [0; 100], slice / 2).unwrap_err();
                }
            }
            assert_eq!(sent, words.len(), "in slices of {slice}");
            let mut answers = vec![0; expected.len()];
            device.receive(&mut answers, 10).unwrap();
            assert_eq!(answers, expected, "in slices of {slice}");
            device.receive(&mut [0], 10).unwrap_err();
        }
    }
}

#[test]
fn a_word_once_offered_is_sent_before_others() {
    let mut device = echo();
    // The device refuses a word in its first clock.
    device.send(&[5, 6], 1).unwrap_err();
    device.send(&[], 1).unwrap();
    device.send(&[9], 20).unwrap();
    let mut answers = [0; 4];
    device.receive(&mut answers, 20).unwrap();
    assert_eq!(answers, [6, 6, 10, 10]);
    device.receive(&mut [0], 20).unwrap_err();
}

#[test]
fn a_missing_answer_is_a_timeout_that_loses_nothing() {
    let mut device = echo();
    device.send(&[41], 100).unwrap();
    let mut answers = [0; 3];
    let error = device.receive(&mut answers, 60).unwrap_err();
    assert!(
        matches!(error, SimError::Timeout { awaited: Awaited::AnswerWords, done: 2, wanted: 3, clocks: 60, .. }),
        "{error}"
    );
    assert_eq!(answers, [0; 3]);
    device.send(&[1], 100).unwrap();
    device.receive(&mut answers, 60).unwrap();
    assert_eq!(answers, [42, 42, 2]);
}

#[test]
fn a_configuration_that_was_not_built_is_refused() {
    let other = Config { ring: 31, ..SMALL };
    let error = SimDevice::new(other).unwrap_err();
    assert_eq!(
        error.to_string(),
        "there is no simulated core \"small\" of 1024 points with 16 contexts and 31 boundary edges: \
         choose one of tiny, small, full, large, dual, quad"
    );
}

#[test]
fn a_waveform_is_written() {
    let folder = std::env::temp_dir().join(format!("incircle-sim-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("echo.vcd");
    let mut device = echo();
    device.trace_to(&path).unwrap();
    device.send(&[1, 2, 3], 100).unwrap();
    drop(device);
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(text.contains("command_ready") && text.contains("#100\n"), "{text}");
}

#[test]
fn a_full_disk_ends_a_waveform_with_an_error() {
    let mut device = echo();
    device.trace_to("/dev/full").unwrap();
    let error = device.send(&[1, 2, 3], 100).unwrap_err();
    assert!(matches!(error, SimError::Trace(_)) && error.to_string().contains("make room on the disk"), "{error}");
}

#[test]
fn a_waveform_of_a_job_needs_a_traced_core_a_job_and_a_file() {
    let path = std::env::temp_dir().join(format!("incircle-sim-{}-missing", std::process::id())).join("job.vcd");
    let error = SimDevice::new(TINY).unwrap().trace_job(&path, 1).unwrap_err();
    assert!(matches!(error, SimError::NotTraced { name: "core_tiny" }), "{error}");
    let mut device = SimDevice::traced(TINY).unwrap();
    assert_eq!(device.trace_job(&path, 0), Err(SimError::NoJob));
    device.trace_job(&path, 1).unwrap();
    // The job ends within the call in which its waveform could not begin.
    let error = device.send(&[command_word(Opcode::Clear); 2], 100_000).unwrap_err();
    assert!(matches!(error, SimError::Trace(_)), "{error}");
}

#[test]
fn every_named_configuration_says_who_it_is() {
    for config in NAMED {
        let mut device = SimDevice::new(config).unwrap();
        // After a reset a core clears its memories, one triangle in each clock. The queue of an engine of a chip takes
        // the word before that.
        device.send(&[command_word(Opcode::Hello)], 100_000).unwrap();
        let mut answer = [0; 2 + IDENTITY_WORDS];
        device.receive(&mut answer, 100_000).unwrap();
        let [header, length, identity @ ..] = answer;
        assert_eq!(header, answer_header(Opcode::Hello as u8, Status::Ok));
        assert_eq!(length as usize, IDENTITY_WORDS);
        let identity = Identity::from_words(identity);
        assert_eq!(identity.magic, MAGIC);
        assert_eq!(identity.coord_bits, CORE_COORD_BITS);
        assert_eq!(
            (identity.capacity, identity.ring_capacity, identity.contexts, identity.engines),
            (config.points, config.ring, config.contexts, config.engines),
            "{}",
            config.name
        );
    }
}
