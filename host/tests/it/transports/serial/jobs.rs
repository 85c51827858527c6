//! The serial protocol against a board in virtual time: sound lines, faults of every kind at every place, and
//! errors that end a job.

use std::time::Duration;

use crate::common::board::CAPACITY;
use crate::common::by_cpu;
use crate::common::rig::{Fate, Rig};
use crate::common::Random;
use incircle::serial::SerialFault;
use incircle::transports::parts::Params;
use incircle::{Device, Error, ErrorKind, Point, Solution, TransportError};
use incircle_protocol::{Command, Layout, RecordRange, RunKind, ShortIds};

const HELLO: Command<&[u32]> = Command::Hello;
const LAYOUT: Layout = Layout::of(16, CAPACITY);

fn insert(count: u32) -> Command<Vec<u32>> {
    let words = points(count as usize).iter().map(|point| point.x | point.y << 16).collect();
    Command::Insert { count, points: words }
}

fn read(count: u32) -> Command<[u32; 0]> {
    Command::Read(RecordRange { first: 0, count })
}

/// The commands that read these records with their links, without them, and with short ids.
fn reads(first: u32, count: u32) -> [Command<[u32; 0]>; 4] {
    let range = RecordRange { first, count };
    let [ten, twelve] = [ShortIds::Ten, ShortIds::Twelve].map(|ids| Command::ShortTriangles(range, ids));
    [Command::Read(range), Command::Triangles(range), ten, twelve]
}

fn rig() -> Rig {
    Rig::new(Params::with_rate(12_000_000), 4096)
}

fn points(count: usize) -> Vec<Point> {
    Random(3).points(count, 1 << 16)
}

/// Does a whole job over the rig.
fn triangulate(rig: Rig, points: &[Point]) -> Result<Solution, Error> {
    let mut device = Device::from_transport(Box::new(rig));
    let mut session = device.session()?;
    session.triangulate(points)
}

/// Does a whole job, and checks that it ends in this list of triangles. `what` names the case in a failure.
fn ends_right(rig: Rig, points: &[Point], expected: &[[u32; 3]], what: &str) {
    let solution = triangulate(rig, points).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(solution.mesh.triangles, expected, "{what}");
}

fn expected(points: &[Point]) -> Solution {
    by_cpu(points)
}

fn fault(result: Result<Vec<u32>, TransportError>) -> SerialFault {
    match result {
        Err(error) => error.fault::<SerialFault>().cloned().unwrap_or_else(|| panic!("no fault: {error:?}")),
        Ok(answer) => panic!("no fault: {answer:?}"),
    }
}

#[test]
fn a_sound_line_carries_a_job_at_the_rate_that_was_asked_for() {
    let mut rig = rig();
    let answer = rig.ask(&HELLO).expect("a sound line");
    assert_eq!(answer[..3], [1 << 24, 7, 0x696e_4369]);
    assert_eq!(rig.protocol.rate(), 12_000_000);
    assert!(rig.board.rate.abs_diff(12_000_000) < 10, "{}", rig.board.rate);
    let points = points(2000);
    let solution = triangulate(rig, &points).expect("a sound line");
    assert_eq!(solution.mesh.triangles, expected(&points).mesh.triangles);
}

#[test]
fn nothing_is_sent_twice_on_a_sound_line() {
    for (rate, fifo, appetite) in [(12_000_000, 4096, 1 << 20), (3_000_000, 16_384, 1 << 20), (12_000_000, 2048, 300)] {
        let mut rig = Rig::new(Params::with_rate(rate), fifo);
        rig.board.appetite = appetite;
        let count = 8000;
        let insert = insert(count);
        let answer = rig.ask(&insert).expect("a sound line");
        let records = answer[6];
        for read in reads(0, records) {
            let answer = rig.ask(&read).expect("a sound line");
            assert_eq!(answer.len() as u64, 2 + read.payload_words(LAYOUT));
        }
        assert_eq!(rig.board.overflows, 0);
        let statistics = rig.protocol.statistics();
        assert_eq!(
            (statistics.frames_resent, statistics.answers_repeated, statistics.frames_broken),
            (0, 0, 0),
            "{rate} {fifo} {appetite}: {statistics:?}"
        );
    }
}

#[test]
fn both_directions_carry_nine_tenths_of_what_the_line_can() {
    for rate in [3_000_000, 12_000_000] {
        let mut rig = Rig::new(Params::with_rate(rate), 4096);
        rig.ask(&HELLO).expect("a sound line");
        let count = 8192;
        let insert = insert(count);
        let goodput = |bytes: usize, time: Duration| 10.0 * bytes as f64 / time.as_secs_f64() / f64::from(rate);
        let since = rig.now;
        let answer = rig.ask(&insert).expect("a sound line");
        let there = goodput(4 * insert.words(), rig.now - since);
        println!("{rate} bits per second: {there:.3} of what the line carries are words there");
        assert!(there > 0.9, "{rate}: {there}");
        for read in reads(0, answer[6]) {
            let since = rig.now;
            let answer = rig.ask(&read).expect("a sound line");
            let back = goodput(4 * answer.len(), rig.now - since);
            println!("{rate} bits per second: {back:.3} are words of {read:?}");
            assert!(back > 0.9, "{rate}: {back}, {read:?}");
        }
    }
}

/// One frame after another is lost, changed, doubled or overtaken. The job ends with the same
/// mesh as without the fault.
#[test]
fn a_fault_of_any_frame_leaves_no_trace() {
    let points = points(300);
    let expected = expected(&points).mesh.triangles;
    for fate in [Fate::Lost, Fate::Changed, Fate::Twice, Fate::Overtaken] {
        for direction in [false, true] {
            for place in 0..40 {
                let mut rig = rig();
                rig.faults = Box::new(
                    move |to_host, frame| if to_host == direction && frame == place { fate } else { Fate::Passes },
                );
                ends_right(rig, &points, &expected, &format!("{fate:?} {direction} {place}"));
            }
        }
    }
}

/// Ranges are asked for in parts, and lost parts again. The parts of each form are the vertices that whole records
/// have.
#[test]
fn parts_of_an_answer_fit_together_in_every_form() {
    let ask =
        |rig: &mut Rig, command: &Command<[u32; 0]>| rig.ask(command).expect("a line of few faults")[2..].to_vec();
    let mut sound = rig();
    let records = sound.ask(&insert(900)).expect("a sound line")[6];
    let whole = ask(&mut sound, &read(records));
    let vertices = |record: usize| LAYOUT.record_from_words(&whole[3 * record..]).0;
    for (seed, (first, count)) in (0..).zip([(0, records), (0, records - 1), (3, 802), (8, 803), (5, 1), (5, 0)]) {
        for command in reads(first, count) {
            let mut rig = rig();
            rig.ask(&insert(900)).expect("a sound line");
            let mut random = Random(seed);
            rig.faults = Box::new(move |_, _| [Fate::Lost, Fate::Passes][usize::from(random.below(8) > 0)]);
            let words = ask(&mut rig, &command);
            assert_eq!(words.len() as u64, command.payload_words(LAYOUT), "{command:?}");
            for record in 0..count as usize {
                let expected = vertices(first as usize + record);
                let (found, expected) = match command {
                    Command::Read(_) => (LAYOUT.record_from_words(&words[3 * record..]).0, expected),
                    Command::ShortTriangles(_, ids) => {
                        (ids.vertices_from_words(&words, count as usize, record), expected.map(|id| ids.infinite(id)))
                    }
                    _ => (LAYOUT.vertices_from_words(&words, record), expected),
                };
                assert_eq!(found, expected, "record {record} of {command:?}");
            }
        }
    }
}

/// A simulated board answers a `Poll` before the `Poll` would have left a real line. Such an answer still tells which
/// frames before it were lost.
#[test]
fn a_lost_frame_goes_again_also_where_answers_come_sooner_than_the_rate_allows() {
    let points = points(300);
    let expected = expected(&points).mesh.triangles;
    for place in 0..20 {
        let mut rig = rig();
        (rig.is_instant, rig.delay) = (true, Duration::ZERO);
        rig.faults = Box::new(move |to_host, frame| if !to_host && frame == place { Fate::Lost } else { Fate::Passes });
        ends_right(rig, &points, &expected, &format!("frame {place}"));
    }
}

/// All kinds of faults at once, each for a few per cent of the frames.
#[test]
fn many_faults_leave_no_trace_either() {
    let points = points(700);
    let expected = expected(&points).mesh.triangles;
    for seed in 0..60 {
        let mut rig = rig();
        let mut random = Random(seed);
        rig.faults = Box::new(move |_, _| match random.below(40) {
            0 => Fate::Lost,
            1 => Fate::Changed,
            2 => Fate::Twice,
            3 => Fate::Overtaken,
            _ => Fate::Passes,
        });
        ends_right(rig, &points, &expected, &format!("seed {seed}"));
    }
}

/// Whether noise alone can end in this fault.
fn is_of_noise(fault: &SerialFault) -> bool {
    use SerialFault::{Lost, Noise, Reset, Silent};
    matches!(fault, Silent | Noise { .. } | Lost { .. } | Reset { .. })
}

#[test]
fn noise_ends_in_the_right_mesh_or_in_an_error_of_its_own() {
    const JOBS: usize = 200;
    let points = points(100);
    let expected = expected(&points).mesh.triangles;
    for (noise, least) in [(1e-6, JOBS), (1e-5, JOBS), (1e-4, JOBS), (1e-3, JOBS / 2), (1e-2, 0)] {
        let (mut right, mut flipped) = (0, 0);
        for seed in 0..JOBS {
            let mut rig = rig();
            rig.noise = noise;
            rig.random = Random(seed as u64);
            let count = rig.flipped.clone();
            match triangulate(rig, &points) {
                Ok(solution) => {
                    assert_eq!(solution.mesh.triangles, expected, "{noise} {seed}");
                    right += 1;
                }
                Err(Error::Timeout { .. }) => {}
                Err(Error::Link { source, .. }) => assert!(source.fault().is_some_and(is_of_noise), "{source}"),
                Err(error) => panic!("{noise} {seed}: {error}"),
            }
            flipped += count.get();
        }
        println!("{noise}: {right} of {JOBS} right, {flipped} bits changed");
        assert!(right >= least && flipped > 0, "{noise}: {right} of {JOBS}, {flipped} bits changed");
    }
}

#[test]
fn a_rate_that_does_not_work_is_left_for_a_lower_one() {
    for (usable, found) in [(4_000_000, 3_000_000), (2_000_000, 1_000_000), (500_000, 115_200)] {
        let mut rig = rig();
        rig.board.usable = usable;
        rig.ask(&HELLO).unwrap_or_else(|error| panic!("{usable}: {error}"));
        assert_eq!(rig.protocol.rate(), found);
    }
    // The greeting tells the device's own limit, so higher rates are not tried.
    let mut rig = rig();
    rig.board.greeting[4] = 2_000_000;
    rig.ask(&HELLO).expect("a sound line");
    assert_eq!(rig.protocol.rate(), 1_000_000);
    assert!(rig.now < Duration::from_secs(6));
}

#[test]
fn a_cut_line_is_told_in_time() {
    for is_open in [false, true] {
        let mut rig = rig();
        if is_open {
            rig.ask(&HELLO).expect("a sound line");
        }
        rig.cut_at = rig.now;
        let since = rig.now;
        let fault = fault(rig.ask(&HELLO));
        assert_eq!(fault.kind(), if is_open { ErrorKind::Link } else { ErrorKind::DeviceNotFound }, "{fault}");
        assert!(rig.now - since < Duration::from_secs(4), "{:?}", rig.now - since);
    }
}

#[test]
fn a_device_that_was_reset_is_told() {
    for delay in [0, 3, 20] {
        let mut rig = rig();
        rig.ask(&HELLO).expect("a sound line");
        rig.reset_at = Some(rig.now + Duration::from_millis(delay));
        let fault = fault(rig.ask(&insert(8192)));
        assert_eq!(fault, SerialFault::Reset { silence_ms: 2000 }, "{delay}");
    }
    // At the first rate the device itself says that it has no session.
    let mut rig = Rig::new(Params { rates: vec![], session: 0 }, 4096);
    rig.ask(&HELLO).expect("a sound line");
    rig.board.reset();
    let since = rig.now;
    assert_eq!(fault(rig.ask(&HELLO)), SerialFault::Reset { silence_ms: 2000 });
    assert!(rig.now - since < Duration::from_secs(1));
}

#[test]
fn a_line_that_another_host_took_is_told() {
    let mut rig = rig();
    rig.ask(&HELLO).expect("a sound line");
    // The long silence stands for the other host, which keeps the session alive.
    rig.board.reset();
    rig.board.session = 99;
    rig.board.greeting[5] = 60_000;
    assert_eq!(fault(rig.ask(&HELLO)), SerialFault::Taken { session: 99 });
}

#[test]
fn digests_are_compared_both_ways() {
    let mut one = rig();
    one.ask(&HELLO).expect("a sound line");
    one.board.lies[0] = 1;
    let payload = fault(one.ask(&HELLO));
    assert!(matches!(payload, SerialFault::PayloadDigest { found, expected } if found ^ expected == 1), "{payload}");
    let mut other = rig();
    other.board.lies[1] = 1;
    let answer = fault(other.ask(&HELLO));
    assert!(matches!(answer, SerialFault::AnswerDigest { found, expected } if found ^ expected == 1), "{answer}");
    assert_eq!((payload.kind(), answer.kind()), (ErrorKind::Device, ErrorKind::Device));
}

/// The acknowledgement of the only frame of a command is lost. The answer acknowledges the frame as well, but is not
/// believed before the digest has come.
#[test]
fn no_answer_is_believed_before_the_digest() {
    let mut rig = rig();
    rig.ask(&HELLO).expect("a sound line");
    let acknowledgement = rig.frames[1];
    rig.faults =
        Box::new(move |to_host, frame| if to_host && frame == acknowledgement { Fate::Lost } else { Fate::Passes });
    let polls = rig.protocol.statistics().polls;
    rig.ask(&HELLO).expect("one frame is lost");
    assert_eq!(rig.protocol.statistics().polls, polls + 1);
}

#[test]
fn other_devices_are_refused_with_what_to_do() {
    let refused = |place: usize, value: u32| {
        let mut rig = rig();
        rig.board.greeting[place] = value;
        fault(rig.ask(&HELLO))
    };
    assert!(matches!(refused(0, 7), SerialFault::Magic { found: 7, .. }));
    let newer = refused(1, 2 << 16).to_string();
    assert!(newer.contains("2.0") && newer.contains("update the host's incircle"), "{newer}");
    let older = refused(1, 7).to_string();
    assert!(older.contains("0.7") && older.contains("update the device"), "{older}");
    assert!(matches!(refused(3, 64), SerialFault::Greeting { found: 64, .. }));
    assert!(matches!(refused(4, 300), SerialFault::Greeting { found: 300, .. }));
    for (place, value) in [(6, 0), (7, 0), (9, 40), (10, u32::MAX), (11, 0)] {
        assert!(matches!(refused(place, value), SerialFault::Identity(_)), "{place}");
    }
}

#[test]
fn a_host_that_was_killed_leaves_a_device_that_the_next_one_finds() {
    let mut rig = rig();
    rig.ask(&HELLO).expect("a sound line");
    let killed =
        std::mem::replace(&mut rig.protocol, incircle::transports::parts::SerialProtocol::new(Params::default()));
    assert_eq!(killed.rate(), 12_000_000);
    let since = rig.now;
    rig.ask(&HELLO).expect("after the silence");
    assert!(rig.now - since < Duration::from_millis(2500));
    assert!(rig.board.rate.abs_diff(3_000_000) < 10, "{}", rig.board.rate);
}

#[test]
fn closing_brings_the_device_back_at_once() {
    let mut rig = rig();
    rig.ask(&HELLO).expect("a sound line");
    let since = rig.now;
    rig.protocol.close(rig.now);
    let until = rig.now + Duration::from_secs(1);
    assert!(rig.run(until, |protocol| protocol.is_closed()));
    assert!(rig.now - since < Duration::from_millis(10));
    assert_eq!((rig.board.rate, rig.board.session, rig.protocol.rate()), (115_200, 0, 115_200));
    // The next command opens a session again.
    rig.ask(&HELLO).expect("a sound line");
}

#[test]
fn a_pause_between_jobs_is_no_matter_and_one_within_a_job_is_told() {
    for pause in [1_000, 1_700, 2_100, 60_000] {
        let mut rig = rig();
        rig.ask(&HELLO).expect("a sound line");
        rig.now += Duration::from_millis(pause);
        rig.ask(&HELLO).unwrap_or_else(|error| panic!("{pause}: {error}"));
        rig.now += Duration::from_millis(pause);
        let result = rig.ask(&Command::<[u32; 0]>::Counters);
        assert_eq!(result.is_ok(), pause < 2_000, "{pause}");
        if let Err(error) = result {
            assert!(matches!(error.fault(), Some(SerialFault::Reset { .. })), "{error}");
        }
    }
}

#[test]
fn what_the_link_cannot_carry_is_refused() {
    let range = |first, count| RecordRange { first, count };
    for (command, sentence) in [
        (Command::Run { kind: RunKind::Nearest, count: 384, items: &[7; 384][..] }, "longer than the link takes"),
        (Command::Run { kind: RunKind::InsertAs, count: 1, items: &[7][..] }, "laid out for another device"),
        (Command::Read(range(u32::MAX, 1)), "goes beyond the last record number"),
        (Command::Triangles(range(u32::MAX, 1)), "goes beyond the last record number"),
        (Command::ShortTriangles(range(1, u32::MAX), ShortIds::Ten), "goes beyond the last record number"),
        (Command::Insert { count: 2, points: &[7][..] }, "laid out for another device"),
        (Command::Insert { count: 0, points: &[7][..] }, "laid out for another device"),
    ] {
        let fault = fault(rig().ask(&command));
        assert!(matches!(fault, SerialFault::Command(why) if why.contains(sentence)), "{fault}");
    }
}
