//! Chips of several engines: every job of a batch gets the mesh that it gets alone, whichever engine does it, and a
//! stuck engine costs no job.

use std::time::Instant;

use crate::common::batches::{alone, bare, batch, check_cancelled};
use crate::common::{assert_right, Random};
use incircle::transports::{AnswerHead, Capabilities, ClockTransport};
use incircle::{Config, Device, Error, ErrorKind, Mesh, Options, Point, Transport, TransportError};
use incircle_model::{ChipModel, Defect};
use incircle_protocol::{command_tag, Command, Opcode, DUAL, QUAD, SMALL};

/// Nine in ten jobs below 300 points, the others up to `most`, with points of all kinds.
fn mixed(random: &mut Random, count: usize, most: u32) -> Vec<Vec<Point>> {
    let mut jobs = Vec::new();
    for job in 0..count {
        let limit = if job % 10 == 0 { most } else { 300 };
        let points = random.below(limit + 1) as usize;
        let side = [2, 5, 40, 300, 1 << 16, 1 << 16][random.below(6) as usize];
        jobs.push(match job % 11 {
            0 => random.points(job % 4, side),
            1 => (0..points as u32).map(|k| Point::new(3 * k, 2 * k)).collect(),
            2 => (0..points as u32).map(|k| Point::new(k % 17, k / 17)).collect(),
            3 => (0..points as u32).map(|k| Point::new(k, k * k % 65_521)).collect(),
            _ => random.points(points, side),
        });
    }
    jobs
}

#[test]
fn every_job_of_a_batch_gets_its_mesh_on_two_and_on_four_engines() {
    for (config, count) in [(QUAD, 400), (DUAL, 200)] {
        let mut random = Random(u64::from(config.engines));
        let jobs = mixed(&mut random, count, config.points);
        let right = alone(&jobs);
        let mut device = Device::clock_model(config).expect("a named configuration");
        let meshes = batch(&mut device, &jobs, &Options::default()).expect("meshes");
        for (job, (mesh, right)) in meshes.iter().zip(&right).enumerate() {
            assert!(mesh == right, "job {job} of {}, {} points", config.name, jobs[job].len());
        }
        // A second batch shows that the session is in step.
        let again = batch(&mut device, &jobs[..30], &Options::default().contexts(3)).expect("meshes");
        assert!(again == right[..30]);
    }
}

#[test]
fn jobs_one_by_one_go_to_all_engines() {
    let mut device = Device::clock_model(QUAD).expect("a named configuration");
    let mut random = Random(3);
    let jobs: Vec<_> = (0..9).map(|_| random.points(150, 1 << 16)).collect();
    let right = alone(&jobs);
    let mut session = device.session().expect("a session");
    assert_eq!((session.identity().engines, session.identity().capacity), (4, 2048));
    for (points, right) in jobs.iter().zip(right) {
        let solution = session.triangulate(points).expect("a mesh");
        assert_eq!((solution.report.engines, solution.report.stuck_engines.len()), (4, 0));
        assert_eq!(solution.report.counters.expect("a core").insertions, 150);
        assert_eq!(solution.mesh, right);
    }
    let solution = session.triangulate(&random.points(2500, 1 << 16)).expect("more than an engine holds");
    assert!(solution.report.parts > 1 && solution.report.clocks.is_some());
    assert_right(&solution);
}

#[test]
fn a_small_batch_leaves_no_engine_idle() {
    let mut random = Random(5);
    let jobs: Vec<_> = (0..8).map(|_| random.points(500, 1 << 16)).collect();
    let clocks = |engines, count| {
        let mut device = Device::clock_model(Config { engines, ..QUAD }).expect("possible");
        let mut session = device.session().expect("a session");
        let before = session.clocks().expect("clocks");
        session.triangulate_batch(&jobs[..count], &Options::default()).expect("meshes");
        session.clocks().expect("clocks") - before
    };
    // Each engine gets two jobs. Beside one engine with two jobs, only the words of all share a stream.
    let (one, four) = (clocks(1, 2), clocks(4, 8));
    assert!(10 * four < 14 * one, "{one} {four}");
}

#[test]
fn a_chip_is_quicker_by_the_number_of_its_engines() {
    let mut random = Random(4);
    let jobs: Vec<_> = (0..320).map(|_| random.points(100, 1 << 16)).collect();
    let clocks = |engines| {
        let mut device = Device::clock_model(Config { engines, ..QUAD }).expect("possible");
        let mut session = device.session().expect("a session");
        let before = session.clocks().expect("clocks");
        session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
        (session.clocks().expect("clocks") - before) as f64
    };
    let [one, two, four] = [1, 2, 4].map(clocks);
    assert!(one / two > 1.9 && one / four > 3.6, "{one} {two} {four}");
}

#[test]
fn a_batch_is_cancelled_in_step() {
    let mut random = Random(5);
    let jobs = mixed(&mut random, 120, 2048);
    let right = alone(&jobs);
    let mut device = Device::clock_model(QUAD).expect("a named configuration");
    for patience in [1, 3000, 12_000] {
        check_cancelled(&mut device, &jobs, &right, patience);
    }
}

/// A chip of these engines, of which some take their own locks for those of another context and get stuck.
fn broken(config: Config, engines: &[usize]) -> Device {
    let sound = ChipModel::new(config).expect("possible");
    let defect = Defect::TakesOwnForForeign;
    let model = engines.iter().fold(sound, |model, &engine| model.with_defect(engine, defect));
    Device::from_transport(Box::new(ClockTransport::around(model, config)))
}

#[test]
fn a_stuck_engine_costs_no_job() {
    let config = Config { points: 256, contexts: 4, ..QUAD };
    let mut random = Random(6);
    let mut job = || {
        let count = 20 + random.below(230) as usize;
        random.points(count, 1 << 16)
    };
    let jobs: Vec<_> = (0..60).map(|_| job()).collect();
    let right = alone(&jobs);
    for bad in [&[2][..], &[0, 3], &[0, 1, 3]] {
        let mut device = broken(config, bad);
        let solutions = device.session().and_then(|mut session| session.triangulate_batch(&jobs, &Options::default()));
        let solutions = solutions.expect("meshes");
        let mut stuck: Vec<u32> = solutions.iter().flat_map(|solution| solution.report.stuck_engines.clone()).collect();
        stuck.sort_unstable();
        stuck.dedup();
        let expected: Vec<u32> = bad.iter().map(|&engine| engine as u32).collect();
        assert_eq!(stuck, expected, "the report names the engines");
        let meshes: Vec<Mesh> = solutions.into_iter().map(bare).collect();
        assert!(meshes == right, "{bad:?}");
        // Single jobs find an engine as well.
        let mut session = device.session().expect("a session");
        for (points, right) in jobs.iter().zip(&right).take(6) {
            assert_eq!(session.triangulate(points).expect("a mesh").mesh, *right);
        }
    }
}

#[test]
fn a_single_job_goes_on_from_a_stuck_engine() {
    let config = Config { points: 256, contexts: 4, ..DUAL };
    let mut random = Random(7);
    // The first job goes to engine 1.
    let points = random.points(200, 1 << 16);
    let mut device = broken(config, &[1]);
    let solution = device.session().and_then(|mut session| session.triangulate(&points)).expect("a mesh");
    assert_eq!(solution.report.stuck_engines, [1]);
    assert_eq!(solution.mesh, alone(&[points])[0]);
}

#[test]
fn a_chip_without_a_sound_engine_is_an_error() {
    let config = Config { points: 256, contexts: 4, ..DUAL };
    let mut random = Random(8);
    // Three points are a first triangle, over which no engine gets stuck.
    let jobs: Vec<_> = (0..6).map(|job| random.points(if job == 4 { 200 } else { 3 }, 1 << 16)).collect();
    let mut device = broken(config, &[0, 1]);
    let error = batch(&mut device, &jobs, &Options::default()).expect_err("stuck");
    assert_eq!(error.kind(), ErrorKind::Device, "{error}");
    assert!(error.to_string().contains("each of its 2 engines got stuck"), "{error}");
    assert!(matches!(error, Error::InJob { job: 4, .. }), "{error}");
}

/// A transport that takes answers in their order only, one job at a time, and checks that each job has another tag than
/// the one before it.
struct InOrder {
    transport: ClockTransport,
    last_tag: u8,
}

impl InOrder {
    fn new(config: Config) -> Self {
        Self { transport: ClockTransport::new(config).expect("a named configuration"), last_tag: 0 }
    }
}

impl Transport for InOrder {
    fn name(&self) -> String {
        "in order".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        for command in commands.iter().filter(|command| command.opcode() == Opcode::Clear) {
            let (head, _) = command.head();
            let last = std::mem::replace(&mut self.last_tag, command_tag(head[0]));
            assert!(self.last_tag != 0 && self.last_tag != last, "{last} before {:08x}", head[0]);
        }
        self.transport.submit(commands, deadline)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        self.transport.receive(head, payload, deadline)
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { any_order: false, ..self.transport.capabilities() }
    }
}

#[test]
fn a_transport_that_knows_nothing_of_engines_does_one_job_at_a_time() {
    let mut random = Random(9);
    let jobs = mixed(&mut random, 60, 1024);
    let mut device = Device::from_transport(Box::new(InOrder::new(QUAD)));
    assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
}

/// A chip that changes the headers of its answers.
struct Liar {
    transport: ClockTransport,
    /// Headers that stay true, and the bits that change in the next one.
    left: usize,
    flips: u32,
}

impl Transport for Liar {
    fn name(&self) -> String {
        "liar".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        self.transport.submit(commands, deadline)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        self.transport.receive(head, payload, deadline)
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let [header, length] = self.transport.receive_next(words_of, payload, deadline)?;
        let flips = if self.left == 0 { self.flips } else { 0 };
        self.left = self.left.wrapping_sub(1);
        Ok([header ^ flips, length])
    }

    fn capabilities(&self) -> Capabilities {
        self.transport.capabilities()
    }
}

#[test]
fn lies_about_engines_and_jobs_are_found() {
    let mut random = Random(10);
    let jobs: Vec<_> = (0..200).map(|_| random.points(50, 1 << 16)).collect();
    for flips in [0x8000, 0x0400, 0x0080, 0x0100_0000, 0x0009_0000] {
        for left in [0, 1, 7] {
            let transport = ClockTransport::new(QUAD).expect("a named configuration");
            let mut device = Device::from_transport(Box::new(Liar { transport, left, flips }));
            let error = batch(&mut device, &jobs, &Options::default()).expect_err("a lie");
            assert!(matches!(error, Error::Device { .. }), "{flips:#x} after {left}: {error}");
        }
    }
}

#[test]
fn jobs_in_a_row_have_different_tags_on_one_engine_too() {
    let jobs = mixed(&mut Random(11), 600, SMALL.points);
    let mut device = Device::from_transport(Box::new(InOrder::new(SMALL)));
    assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
}
