//! The PCIe transport before a card in memory: jobs, each class of faults, and cards that lie.

use std::time::{Duration, Instant};

use crate::common::card::{MemoryCard, Mischief};
use incircle::pcie::{PcieFault, PcieTransport};
use incircle::transports::AnswerHead;
use incircle::{Device, Error, ErrorKind, Mesh, Options, Point, Solution, Transport, TransportError};
use incircle_protocol::{
    answer_head, Command, Config, Opcode, RecordRange, StreamRegister, IDENTITY_WORDS, INSERT_REPORT_WORDS,
    LATENCY_BUCKETS, SMALL,
};
use proptest::prelude::*;

/// Beginning of the answer to a greeting.
const HELLO: AnswerHead = answer_head(Opcode::Hello, IDENTITY_WORDS as u32);
/// Time limit of a job.
const LIMIT: Duration = Duration::from_secs(20);

fn points(count: u32, seed: u32) -> Vec<Point> {
    let at = |k: u32| Point::new(k.wrapping_mul(seed | 1).wrapping_mul(2_654_435_761) >> 16, k * 40_503 % 65_521);
    (0..count).map(at).collect()
}

fn transport(beat_bits: u32, mischief: Mischief) -> Result<PcieTransport, Error> {
    PcieTransport::new("pcie:memory".to_owned(), MemoryCard::new(SMALL, beat_bits, mischief).files())
}

fn triangulate(transport: PcieTransport, points: &[Point]) -> Result<Solution, Error> {
    let options = Options::default().timeout(LIMIT);
    Device::from_transport(Box::new(transport)).session_within(LIMIT)?.triangulate_with(points, &options)
}

/// Checks that the mesh is the one that the CPU triangulator gives.
fn assert_is_right(mesh: &Mesh, points: &[Point]) {
    let right = incircle::triangulate(points).unwrap();
    assert_eq!((&mesh.triangles, &mesh.hull), (&right.triangles, &right.hull));
}

#[test]
#[should_panic(expected = "assertion `left == right` failed")]
fn another_mesh_is_not_taken_for_the_right_one() {
    let points = points(300, 3);
    let mesh = triangulate(transport(64, Mischief::default()).unwrap(), &points).unwrap();
    assert_is_right(&mesh.mesh, &[&points[..299], &[Point::new(9, 9)]].concat());
}

/// Checks that a job on a card with these faults ends with the right mesh.
fn must_be_right(beat_bits: u32, mischief: Mischief, what: &str) {
    let points = points(300, 3);
    let transport = transport(beat_bits, mischief).unwrap();
    let solution = triangulate(transport, &points).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(solution.mesh.triangles, incircle::triangulate(&points).unwrap().triangles, "{what}");
}

/// Checks that a job on a card with these faults ends with this kind of error, in time.
fn must_fail(mischief: Mischief, kind: ErrorKind, sentence: &str) {
    let begun = Instant::now();
    let error = transport(64, mischief).and_then(|card| triangulate(card, &points(300, 3))).expect_err(sentence);
    assert_eq!(error.kind(), kind, "{error}");
    assert!(error.to_string().contains(sentence), "{error}");
    assert!(begun.elapsed() < LIMIT, "{error}");
}

#[test]
fn jobs_through_beats_of_both_widths() {
    for bits in [64, 128] {
        must_be_right(bits, Mischief::default(), "a sound card");
        for short in [16, 48, 1008] {
            must_be_right(bits, Mischief { short: Some(short), ..Mischief::default() }, "short reads");
        }
    }
}

#[test]
fn a_session_does_job_after_job() {
    let mut device = Device::from_transport(Box::new(transport(128, Mischief::default()).unwrap()));
    let mut session = device.session().unwrap();
    for count in [0, 2, 3, 5, 1024, 100] {
        let points = points(count, 7);
        let solution = session.triangulate(&points).unwrap();
        assert_eq!(solution.mesh.triangles, incircle::triangulate(&points).unwrap().triangles);
    }
    let points = points(1025, 7);
    let solution = session.triangulate(&points).unwrap();
    assert_eq!(solution.mesh.triangles, incircle::triangulate(&points).unwrap().triangles);
    assert!(solution.report.parts > 1);
}

#[test]
fn an_engine_that_times_out_once_costs_no_job() {
    for errno in [5, 512] {
        for number in 0..5 {
            let bad = Some((number, errno));
            must_be_right(64, Mischief { bad_read: bad, ..Mischief::default() }, "a failed read");
            must_be_right(64, Mischief { bad_write: bad, ..Mischief::default() }, "a failed write");
        }
    }
}

#[test]
fn a_reset_between_reads_costs_no_job() {
    for number in 0..5 {
        let card = transport(64, Mischief { reset: Some(number), ..Mischief::default() }).unwrap();
        let points = points(300, 3);
        // The card forgot the command under way, or the records before it, so the job was done once more.
        let solution = triangulate(card, &points).unwrap_or_else(|error| panic!("read {number}: {error}"));
        assert_eq!(solution.mesh.triangles, incircle::triangulate(&points).unwrap().triangles);
    }
}

#[test]
fn a_reset_in_the_middle_of_the_points_costs_no_job() {
    // The reset moves a beat at a time, through the commands before the points and through the first points, which the
    // card then takes for commands.
    for beat in 5..120 {
        must_be_right(64, Mischief { reset_after: Some(8 * beat), ..Mischief::default() }, "a reset");
    }
}

/// Resets a card of so many engines at many moments of a batch, whose meshes must all be right.
fn reset_within_a_batch(engines: u32, jobs: &[Vec<Point>]) {
    let config = Config { points: 512, contexts: 4, engines, ..SMALL };
    let between = (0..24).map(|number| Mischief { reset: Some(number), ..Mischief::default() });
    let within = (5..600).step_by(17).map(|beat| Mischief { reset_after: Some(8 * beat), ..Mischief::default() });
    // Reads of 48 bytes at most, so that the reset cuts answers short.
    let short =
        (0..400).step_by(31).map(|number| Mischief { reset: Some(number), short: Some(48), ..Mischief::default() });
    for mischief in between.chain(within).chain(short) {
        let what = format!("{mischief:?}");
        let files = MemoryCard::new(config, 64, mischief).files();
        let card =
            PcieTransport::new("pcie:memory".to_owned(), files).unwrap_or_else(|error| panic!("{what}: {error}"));
        let mut device = Device::from_transport(Box::new(card));
        let options = Options::default().timeout(LIMIT);
        let mut session = device.session_within(LIMIT).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_eq!(session.identity().engines, engines);
        let solutions = session.triangulate_batch(jobs, &options).unwrap_or_else(|error| panic!("{what}: {error}"));
        for (solution, points) in solutions.iter().zip(jobs) {
            assert_is_right(&solution.mesh, points);
        }
    }
}

#[test]
fn a_reset_within_a_batch_costs_no_job() {
    let of_many_sizes: Vec<_> = (0..12).map(|job| points(100 + 20 * job, job + 3)).collect();
    // The answers to a job that the reset has left out are as long as those to the job after it.
    let of_one_size: Vec<_> = (0..12).map(|job| points(300, 2 * job + 3)).collect();
    // Most of the time goes into waiting for cards that have forgotten everything.
    std::thread::scope(|scope| {
        for (engines, jobs) in [1, 2].into_iter().flat_map(|count| [(count, &of_many_sizes), (count, &of_one_size)]) {
            scope.spawn(move || reset_within_a_batch(engines, jobs));
        }
    });
}

#[test]
fn cards_that_are_gone_or_silent_are_typed_errors() {
    for number in 0..5 {
        must_fail(Mischief { gone: Some(number), ..Mischief::default() }, ErrorKind::Link, "the card is gone");
    }
    must_fail(Mischief { silent: Some(2), ..Mischief::default() }, ErrorKind::Link, "errno 512");
    let other = Mischief { bad_read: Some((1, 1)), ..Mischief::default() };
    must_fail(other, ErrorKind::Link, "the reading of answers failed with");
}

#[test]
fn registers_that_no_sound_card_has_are_refused() {
    use StreamRegister as Of;
    for (register, value, kind, sentence) in [
        (Of::Magic, u32::MAX, ErrorKind::Link, "the card is gone"),
        (Of::Magic, 0x1234, ErrorKind::DeviceNotFound, "begin with 0x00001234"),
        (
            Of::StreamVersion,
            2 << 16,
            ErrorKind::Device,
            "2.0 of the stream device, but this library has 1.0: update this program",
        ),
        (Of::StreamVersion, 9, ErrorKind::Device, "update the card"),
        (Of::ProtocolVersion, 9 << 16, ErrorKind::Device, "version 9.0 of the protocol"),
        (Of::ProtocolVersion, 1 << 16, ErrorKind::Device, "version 1.0 of the protocol"),
        (Of::CoordBits, 32, ErrorKind::Device, "32 coordinate bits"),
        (Of::Capacity, u32::MAX, ErrorKind::Device, "4294967295 points"),
        (Of::Contexts, 0, ErrorKind::Device, "0 contexts"),
        (Of::BeatBits, 96, ErrorKind::Device, "bits of a beat reads 96"),
        (Of::FifoBeats, 0, ErrorKind::Device, "beats of a FIFO reads 0"),
    ] {
        must_fail(Mischief { register: Some((register, value)), ..Mischief::default() }, kind, sentence);
    }
    // With another capacity than the core's own, answers have other lengths than the transport awaits.
    let lie = Mischief { register: Some((Of::Capacity, 100_000)), ..Mischief::default() };
    let points = points(300, 3);
    match triangulate(transport(64, lie).unwrap(), &points) {
        Ok(mesh) => assert_is_right(&mesh.mesh, &points),
        Err(error) => assert!(matches!(error.kind(), ErrorKind::Device | ErrorKind::Link), "{error}"),
    }
}

#[test]
fn an_answer_without_an_end_is_refused() {
    // The noise begins with the header of an answer to `Clear` without payload, and goes on after it.
    let mut transport = transport(
        64,
        Mischief { babble: Some((0, [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0])), ..Mischief::default() },
    )
    .unwrap();
    let deadline = Instant::now() + LIMIT;
    transport.submit(&[Command::Hello], deadline).unwrap();
    let error = transport.receive(HELLO, &mut [0; IDENTITY_WORDS], deadline).expect_err("too long");
    assert!(matches!(error.fault(), Some(PcieFault::Endless { announced: 2, .. })), "{error}");
    let error = transport.submit(&[Command::Hello], deadline).expect_err("the fault stays");
    assert!(error.to_string().contains("an answer of 2 words"), "{error}");
    // A reset by another program has the same effect, so it is worth one more try.
    assert!(matches!(transport.recover(deadline), Ok(true)));
}

#[test]
fn commands_may_be_sent_ahead_and_end_within_a_beat() {
    let mut transport = transport(128, Mischief::default()).unwrap();
    let deadline = Instant::now() + LIMIT;
    // The first commands share beats, the last of which is not full. The command after them begins a beat.
    let insert = Command::Insert { count: 3, points: &[0, 4, 4 << 16][..] };
    let commands: Vec<_> = std::iter::repeat_n(Command::Latencies, 301).chain([insert]).collect();
    transport.submit(&commands, deadline).unwrap();
    transport.submit(&[Command::Hello], deadline).unwrap();
    let head = answer_head(Opcode::Latencies, LATENCY_BUCKETS as u32);
    for _ in 0..301 {
        assert_eq!(transport.receive(head, &mut [0; LATENCY_BUCKETS], deadline).unwrap(), head);
    }
    let (head, mut report) = (answer_head(Opcode::Insert, INSERT_REPORT_WORDS as u32), [0; INSERT_REPORT_WORDS]);
    assert_eq!(transport.receive(head, &mut report, deadline).unwrap(), head);
    assert_eq!(report, [3, 3, 0, 0, 4]);
    assert_eq!(transport.receive(HELLO, &mut [0; IDENTITY_WORDS], deadline).unwrap(), HELLO);
    let error = transport.receive(HELLO, &mut [], deadline).expect_err("nothing is due");
    assert!(matches!(error, TransportError::Closed { done: 0, wanted: 2 }), "{error}");
}

#[test]
fn an_answer_to_another_command_is_that_of_a_card_that_was_reset() {
    let deadline = Instant::now() + LIMIT;
    for (awaited, command) in [
        (answer_head(Opcode::Counters, 25), Command::Hello),
        // After the reset the card has no such records any more.
        (answer_head(Opcode::Read, 3), Command::Read(RecordRange { first: 0, count: 1 })),
    ] {
        let mut transport = transport(64, Mischief::default()).unwrap();
        transport.submit(&[command], deadline).unwrap();
        let error = transport.receive(awaited, &mut [0; 25], deadline).expect_err("out of step");
        assert_eq!(error.fault(), Some(&PcieFault::Forgotten), "{error}");
        assert!(transport.recover(deadline).unwrap());
        transport.submit(&[Command::Hello], deadline).unwrap();
        assert_eq!(transport.receive(HELLO, &mut [0; IDENTITY_WORDS], deadline).unwrap(), HELLO);
    }
}

#[test]
fn deadlines_are_kept() {
    // The card itself would be silent for ten minutes.
    let patience = Some(Duration::from_secs(600));
    let mut transport = transport(64, Mischief { silent: Some(0), patience, ..Mischief::default() }).unwrap();
    transport.submit(&[Command::Hello], Instant::now() + LIMIT).unwrap();
    let begun = Instant::now();
    let error = transport.receive(HELLO, &mut [], begun + Duration::from_millis(60)).expect_err("silence");
    assert!(matches!(error, TransportError::Timeout { done: 0, wanted: 2 }), "{error}");
    assert!(begun.elapsed() < Duration::from_secs(60), "{:?}", begun.elapsed());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// Whatever a card sends, the job ends in a typed error, in time and without a panic.
    #[test]
    fn noise_ends_in_a_typed_error(
        from in 0_u32..6,
        noise in any::<[u8; 16]>(),
        header in any::<bool>(),
        opcode in 1_u8..8,
        length in 0_u8..40,
    ) {
        let mut noise = noise;
        if header {
            noise[..8].copy_from_slice(&[0, 0, 0, opcode, length, 0, 0, 0]);
        }
        let mischief = Mischief { babble: Some((from, noise)), ..Mischief::default() };
        let card = transport(64, mischief).unwrap();
        let points = points(50, 5);
        let result = triangulate(card, &points);
        prop_assert!(result.is_err() || from == 5, "{result:?}");
        if let Ok(mesh) = result {
            assert_is_right(&mesh.mesh, &points);
        }
    }
}
