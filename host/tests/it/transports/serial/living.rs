//! A mesh that lives on a board at the end of a bad line: no change is lost, and none is made twice.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Instant;

use crate::common::rig::{Fate, Rig};
use incircle::transports::parts::Params;
use incircle::transports::{AnswerHead, Capabilities};
use incircle::{Device, LivingMesh, Point, Transport, TransportError, Triangulation};
use incircle_protocol::{Command, CORE_RUNS, FEATURE_RUNS};
use incircle_testkit::SplitMix64;

/// A line that tells how many commands have been sent again.
struct Told {
    rig: Rig,
    repeats: Rc<Cell<u64>>,
}

impl Transport for Told {
    fn name(&self) -> String {
        self.rig.name()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let done = self.rig.submit(commands, deadline);
        self.repeats.set(self.rig.repeats());
        done
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        self.rig.receive(head, payload, deadline)
    }

    fn capabilities(&self) -> Capabilities {
        self.rig.capabilities()
    }

    fn repeats(&self) -> u64 {
        self.rig.repeats()
    }
}

/// A board with these runs, on a line that spoils one frame in `rarity`.
fn rig(runs: u32, seed: u64, rarity: u64) -> Rig {
    let mut rig = Rig::new(Params::with_rate(12_000_000), 4096);
    rig.board = rig.board.with_runs(runs);
    let mut random = SplitMix64::new(seed);
    rig.faults = Box::new(move |_, _| match random.below(rarity) {
        0 => random.pick(&[Fate::Lost, Fate::Changed, Fate::Twice, Fate::Overtaken]),
        _ => Fate::Passes,
    });
    rig
}

/// Makes random changes and asks questions, and compares the board with the processor. Returns the number of commands
/// that were sent again.
fn compare(runs: u32, seed: u64, rarity: u64) -> u64 {
    let repeats = Rc::new(Cell::new(0));
    let told = Told { rig: rig(runs, seed, rarity), repeats: Rc::clone(&repeats) };
    let mut device = Device::from_transport(Box::new(told));
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the board has enough runs");
    let mut host = Triangulation::<Point>::new();
    let mut random = SplitMix64::new(seed + 1000);
    let side = 2 + random.below_u32(40);
    let mut point = move || Point::new(random.below_u32(side), random.below_u32(side));
    let mut random = SplitMix64::new(seed + 2000);
    for step in 0..12 {
        let count = 1 + random.below(500) as usize;
        let points: Vec<Point> = (0..count).map(|_| point()).collect();
        let living = host.indices();
        let indices: Vec<u32> =
            (0..count.min(60)).filter(|_| living.len() > 90).map(|_| random.pick(&living)).collect();
        let moves: Vec<(u32, Point)> = indices.into_iter().zip(points.iter().copied()).collect();
        let mut gone: Vec<u32> = moves.iter().map(|&(index, _)| index).collect();
        gone.sort_unstable();
        gone.dedup();
        let kind = random.below(4);
        let both: [&mut dyn LivingMesh<Point>; 2] = [&mut mesh, &mut host];
        for mesh in both {
            let made = match kind {
                0 => mesh.delete_all(&gone),
                1 => mesh.move_all(&moves),
                _ => mesh.insert_all(&points),
            };
            made.unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
        }
        let places: Vec<Point> = (0..100).map(|_| point()).collect();
        let nearest: Vec<Option<u32>> = places.iter().map(|&place| host.nearest(place)).collect();
        assert_eq!(mesh.nearest_all(&places).expect("answers"), nearest, "seed {seed}, step {step}");
        let located: Vec<_> = places.iter().map(|&place| host.locate(place)).collect();
        assert_eq!(mesh.locate_all(&places).expect("answers"), located, "seed {seed}, step {step}");
    }
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh(), "seed {seed}");
    repeats.get()
}

#[test]
fn a_sound_line_repeats_nothing() {
    for runs in [CORE_RUNS, FEATURE_RUNS] {
        assert_eq!(compare(runs, 1, u64::MAX), 0);
    }
}

#[test]
fn faults_of_the_line_leave_no_trace_in_the_mesh() {
    for runs in [CORE_RUNS, FEATURE_RUNS] {
        let repeats: u64 = (0..30).map(|seed| compare(runs, seed, 12)).sum();
        assert!(repeats > 100, "only {repeats} commands were sent again");
    }
}

/// The answer to a change is lost, whichever frame of it is. The change is made once.
#[test]
fn a_change_whose_answer_is_lost_is_made_once() {
    for place in 0..60 {
        let mut rig = Rig::new(Params::with_rate(12_000_000), 4096);
        rig.board = rig.board.with_runs(FEATURE_RUNS);
        rig.faults = Box::new(move |to_host, frame| if to_host && frame == place { Fate::Lost } else { Fate::Passes });
        let mut device = Device::from_transport(Box::new(rig));
        let mut session = device.session().expect("a session");
        let mut mesh = session.living().expect("the board has all runs");
        let mut host = Triangulation::new();
        let square = [[0, 0], [90, 0], [90, 90], [0, 90], [41, 30], [20, 50]].map(Point::from);
        let both: [&mut dyn LivingMesh<Point>; 2] = [&mut mesh, &mut host];
        let meshes = both.map(|mesh| {
            mesh.insert_all(&square).expect("room");
            assert_eq!(mesh.nearest(Point::new(1, 1)).expect("an answer"), Some(0));
            mesh.insert(Point::new(33, 33)).expect("room");
            mesh.insert(Point::new(60, 31)).expect("room");
            mesh.delete(4).expect("a deletion");
            mesh.move_to(5, Point::new(61, 62)).expect("a move");
            mesh.insert(Point::new(41, 30)).expect("room");
            mesh.delete(6).expect("a deletion");
            mesh.mesh().expect("a mesh")
        });
        assert_eq!(meshes[0], meshes[1], "frame {place}");
    }
}
