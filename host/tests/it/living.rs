//! A mesh that lives on a device against [`Triangulation`], which brute force holds: the same answers and the same
//! meshes after every command, on sets that are full of ties.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Instant;

use incircle::living::{Error as Refusal, Location, Triangulation};
use incircle::transports::{AnswerHead, ClockTransport};
use incircle::{Device, Error, ErrorKind, LivingMesh, LivingSession, Point, Transport, TransportError};
use incircle_model::ChipModel;
use incircle_protocol::{signed_header, Command, Config, Opcode, RunKind, FEATURES_SHIFT, IDENTITY_WORDS, SMALL};
use incircle_testkit::SplitMix64;

/// The places of a script: small lattices, lines, points of a circle.
fn places(random: &mut SplitMix64) -> Vec<Point> {
    let side = 2 + random.below_u32(5);
    match random.below(8) {
        0 => (0..8).map(|k| Point::new(2 * k, k)).collect(),
        1 => (0..8).map(|k| Point::new(3, k)).chain([Point::new(1, 4), Point::new(4, 4)]).collect(),
        2 => {
            let far = [(0, 5), (3, 4), (4, 3), (5, 0)];
            let all = far.iter().flat_map(|&(x, y)| [(x, y), (-x, y), (x, -y), (-x, -y), (0, 0)]);
            all.map(|(x, y)| Point::new((5 + x) as u32, (5 + y) as u32)).collect()
        }
        _ => (0..side * side).map(|cell| Point::new(cell / side, cell % side)).collect(),
    }
}

/// A script on a device and on the host.
struct Script<'d> {
    device: LivingSession<'d>,
    host: Triangulation<Point>,
    places: Vec<Point>,
    capacity: usize,
    log: Vec<String>,
    refused: u32,
}

impl Script<'_> {
    /// Number of different places with points.
    fn count(&self) -> usize {
        self.host.vertices().count()
    }

    fn load(&mut self, random: &mut SplitMix64) {
        let points: Vec<Point> = (0..random.below(20)).map(|_| random.pick(&self.places)).collect();
        self.log.push(format!("{points:?}"));
        // A prefix goes in if the rest does not fit.
        let result = self.device.insert_all(&points);
        let taken = self.device.next_index() as usize;
        self.host = Triangulation::from(points[..taken].iter().copied()).expect("a triangulation");
        assert_eq!(result.is_ok(), taken == points.len());
        assert!(result.is_ok() || self.count() == self.capacity, "{result:?}");
    }

    fn step(&mut self, random: &mut SplitMix64, growth: u64) {
        let place = random.pick(&self.places);
        let index = random.below_u32(self.host.next_index() + 1);
        let is_full =
            self.count() == self.capacity && self.host.indices().iter().all(|&k| self.host.point(k) != Some(place));
        match random.below(10) {
            action if action < growth => {
                self.log.push(format!("insert {place}"));
                match self.device.insert(place) {
                    Ok(given) => assert_eq!(self.host.insert(place), Ok(given), "{:?}", self.log),
                    Err(error) => self.refuse(&error, is_full),
                }
            }
            8 | 9 => {
                self.log.push(format!("move {index} {place}"));
                match self.device.move_to(index, place) {
                    Ok(()) => assert_eq!(self.host.move_to(index, place), Ok(()), "{:?}", self.log),
                    Err(Error::Living(refusal)) => assert_eq!(self.host.move_to(index, place), Err(*refusal)),
                    Err(error) => self.refuse(&error, is_full),
                }
            }
            _ => {
                self.log.push(format!("delete {index}"));
                match self.device.delete(index) {
                    Ok(()) => assert_eq!(self.host.delete(index), Ok(()), "{:?}", self.log),
                    Err(Error::Living(refusal)) => assert_eq!(self.host.delete(index), Err(*refusal)),
                    Err(error) => panic!("{error}: {:?}", self.log),
                }
            }
        }
    }

    /// Several changes of a kind in one call, which the device does in runs. The memory has room for all.
    fn step_in_runs(&mut self, random: &mut SplitMix64) {
        let count = 1 + random.below(12) as usize;
        if self.count() + count > self.capacity {
            return;
        }
        let places: Vec<Point> = (0..count).map(|_| random.pick(&self.places)).collect();
        let next = self.host.next_index();
        // Seldom an index that no point has, or has any more.
        let indices: Vec<u32> = (0..count).map(|_| random.below_u32(next + 1)).collect();
        let living: Vec<u32> = indices.iter().copied().filter(|&index| self.host.point(index).is_some()).collect();
        let (device, host): (&mut dyn LivingMesh<Point>, &mut dyn LivingMesh<Point>) =
            (&mut self.device, &mut self.host);
        let results = match random.below(4) {
            0 => {
                self.log.push(format!("insert {places:?}"));
                let one_by_one = places.iter().try_for_each(|&place| host.insert(place).map(|_| ()));
                [device.insert_all(&places), one_by_one]
            }
            1 => {
                let indices = if random.once_in(4) { indices } else { living };
                self.log.push(format!("delete {indices:?}"));
                [device.delete_all(&indices), host.delete_all(&indices)]
            }
            _ => {
                let indices = if random.once_in(8) { indices } else { living };
                let moves: Vec<(u32, Point)> = indices.into_iter().zip(places).collect();
                self.log.push(format!("move {moves:?}"));
                [device.move_all(&moves), host.move_all(&moves)]
            }
        };
        let [device, host] = results.map(|result| result.map_err(|error| error.to_string()));
        assert_eq!(device, host, "{:?}", self.log);
    }

    /// Questions about several places in one call.
    fn ask_in_runs(&mut self, random: &mut SplitMix64) {
        let places: Vec<Point> =
            (0..random.below(20)).map(|_| Point::new(random.below_u32(9), random.below_u32(9))).collect();
        let located = self.device.locate_all(&places).expect("answers");
        let expected: Vec<Location> = places.iter().map(|&place| self.host.locate(place)).collect();
        assert_eq!(located, expected, "{:?}", self.log);
        let nearest = self.device.nearest_all(&places).expect("answers");
        let expected: Vec<Option<u32>> = places.iter().map(|&place| self.host.nearest(place)).collect();
        assert_eq!(nearest, expected, "{:?}", self.log);
    }

    fn refuse(&mut self, error: &Error, is_full: bool) {
        assert!(matches!(error, Error::MemoryFull { .. }) && is_full, "{error}: {:?}", self.log);
        assert_eq!(error.kind(), ErrorKind::Capacity);
        self.refused += 1;
    }

    fn check(&mut self, random: &mut SplitMix64) {
        let mesh = self.device.mesh().unwrap_or_else(|error| panic!("{error}: {:?}", self.log));
        assert_eq!(mesh, self.host.mesh(), "{:?}", self.log);
        assert_eq!(self.device.indices(), self.host.indices());
        for q in [random.pick(&self.places), Point::new(random.below_u32(9), random.below_u32(9))] {
            let located = self.device.locate(q).expect("an answer");
            assert_eq!(located, self.host.locate(q), "locate {q}: {:?}", self.log);
            assert_eq!(self.device.nearest(q).expect("an answer"), self.host.nearest(q), "nearest {q}: {:?}", self.log);
            self.check_weights(q, located);
        }
    }

    /// The weights give the coordinates of the place, and are those of the corners that `locate` names.
    fn check_weights(&mut self, q: Point, located: Location) {
        let weights = self.device.weights(q).expect("an answer");
        let mut named: Vec<u32> = weights.iter().map(|&(index, _)| index).collect();
        named.sort_unstable();
        let mut expected = match located {
            Location::Vertex(one) => vec![one],
            Location::Edge(ends) => ends.to_vec(),
            Location::Triangle(corners) => corners.to_vec(),
            Location::Outside(_) | Location::None => vec![],
        };
        if self.host.triangles().next().is_none() {
            expected.clear();
        }
        expected.sort_unstable();
        assert_eq!(named, expected, "weights {q}: {:?}", self.log);
        let sum: u64 = weights.iter().map(|&(_, weight)| weight).sum();
        let at = |index: u32| self.host.point(index).expect("a living point");
        let mean = |axis: fn(Point) -> u32| weights.iter().map(|&(k, w)| w * u64::from(axis(at(k)))).sum::<u64>();
        if sum > 0 {
            assert_eq!([mean(|p| p.x), mean(|p| p.y)], [q.x, q.y].map(|value| sum * u64::from(value)));
        }
    }
}

/// The model by commands for the script of this number, with its capacity.
fn model(number: usize) -> (Device, u32) {
    let capacity = [1 << 20, 6, 16][number % 3];
    // Points of 20 bits take two words, and wide records six.
    let bits = [4, 16, 20][number / 3 % 3];
    (Device::model(bits, capacity).expect("a model"), capacity)
}

/// The model clock by clock for the script of this number, with its capacity.
fn core(number: usize) -> (Device, u32) {
    let (points, contexts) = ([64, 16, 8, 256][number % 4], [16, 4, 1, 16, 7][number % 5]);
    // With a short list, insertions go solo, and the host makes the mesh anew.
    let ring = [32, 6, 12][number % 3];
    let config = Config { name: "test", points, ring, contexts, engines: 1 };
    (Device::clock_model(config).expect("a core"), points)
}

/// A core of this configuration that does runs clock by clock as the hardware does.
fn core_with_runs(config: Config) -> ClockTransport {
    ClockTransport::around(ChipModel::new(config).expect("a core").with_core_runs(), config)
}

/// The model of the hardware clock by clock for the script of this number, and its capacity.
fn hardware(number: usize) -> (Device, u32) {
    let (points, contexts) = ([64, 16, 8, 256][number % 4], [16, 4, 1, 16, 7][number % 5]);
    let config = Config { name: "test", points, ring: [32, 6, 12][number % 3], contexts, engines: 1 };
    (Device::from_transport(Box::new(core_with_runs(config))), points)
}

/// Runs scripts on devices, and returns how often the memory was full.
fn run(device_of: fn(usize) -> (Device, u32), seed: u64, scripts: usize) -> u32 {
    let mut random = SplitMix64::new(seed);
    let mut refused = 0;
    for number in 0..scripts {
        let (mut device, capacity) = device_of(number);
        let mut session = device.session().expect("a session");
        let mut script = Script {
            device: session.living().expect("the device takes runs"),
            host: Triangulation::new(),
            places: places(&mut random),
            capacity: capacity as usize,
            log: vec![],
            refused: 0,
        };
        let growth = 2 + random.below(6);
        if random.once_in(2) {
            script.load(&mut random);
        }
        for _ in 0..5 + random.below(25) {
            if random.once_in(3) {
                script.step_in_runs(&mut random);
                script.ask_in_runs(&mut random);
            } else {
                script.step(&mut random, growth);
            }
            script.check(&mut random);
        }
        refused += script.refused;
    }
    refused
}

#[test]
fn ten_thousand_scripts_on_the_model_agree_with_the_host() {
    let refused = run(model, 251, 10_000);
    assert!(refused > 100, "the memory was full {refused} times");
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_on_the_model_agree_with_the_host() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(model, 252, scripts.unwrap_or(100_000));
}

#[test]
fn hundreds_of_scripts_on_the_core_agree_with_the_host() {
    let refused = run(core, 253, 300);
    assert!(refused > 10, "the memory was full {refused} times");
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_on_the_core_agree_with_the_host() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(core, 254, scripts.unwrap_or(10_000));
}

#[test]
fn hundreds_of_scripts_on_the_model_of_the_hardware_agree_with_the_host() {
    let refused = run(hardware, 255, 300);
    assert!(refused > 10, "the memory was full {refused} times");
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_on_the_model_of_the_hardware_agree_with_the_host() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(hardware, 256, scripts.unwrap_or(10_000));
}

/// Scripts on a core that hides its moves, and on one that hides its deletions, too: the host makes these changes.
#[test]
fn scripts_on_cores_without_moves_or_deletions_agree_with_the_host() {
    let without_moves = |number| hiding(number, &[RunKind::Move]);
    let refused = run(without_moves, 257, 100);
    assert!(refused > 3, "the memory was full {refused} times");
    run(|number| hiding(number, &[RunKind::Move, RunKind::Delete]), 258, 100);
}

/// As [`hardware`], without runs of these kinds.
fn hiding(number: usize, hidden: &[RunKind]) -> (Device, u32) {
    let (points, contexts) = ([64, 16, 8, 256][number % 4], [16, 4, 1, 16, 7][number % 5]);
    let config = Config { name: "test", points, ring: [32, 6, 12][number % 3], contexts, engines: 1 };
    let hidden = hidden.iter().fold(0, |hidden, kind| hidden | kind.feature());
    let transport = Counted { inner: core_with_runs(config), hidden, seen: Rc::default(), moves: Rc::default() };
    (Device::from_transport(Box::new(transport)), points)
}

/// A transport that counts the commands `Clear` and `InsertAs`, and `Move`, and hides some features of its device.
struct Counted {
    inner: ClockTransport,
    hidden: u32,
    seen: Rc<Cell<[usize; 2]>>,
    moves: Rc<Cell<usize>>,
}

impl Transport for Counted {
    fn name(&self) -> String {
        self.inner.name()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let count = |opcode| commands.iter().filter(|command| command.opcode() == opcode).count();
        let [clears, runs] = self.seen.get();
        self.seen.set([clears + count(Opcode::Clear), runs + count(Opcode::InsertAs)]);
        self.moves.set(self.moves.get() + count(Opcode::Move));
        self.inner.submit(commands, deadline)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let head = self.inner.receive(head, payload, deadline)?;
        if [signed_header(head[0], 0, 0), head[1]] == [(Opcode::Hello as u32) << 24, IDENTITY_WORDS as u32] {
            payload[6] &= !(self.hidden << FEATURES_SHIFT);
        }
        Ok(head)
    }
}

/// Where a core has no moves, the first question after some makes the mesh anew. Insertions and deletions after it are
/// made in place.
#[test]
fn a_core_without_moves_makes_the_mesh_anew_once_for_many_changes() {
    let seen = Rc::new(Cell::new([0; 2]));
    let hidden = RunKind::Move.feature();
    let transport = Counted { inner: core_with_runs(SMALL), hidden, seen: Rc::clone(&seen), moves: Rc::default() };
    let mut device = Device::from_transport(Box::new(transport));
    let mut session = device.session().expect("a session");
    assert!(session.keeps_living_meshes());
    let mut mesh = session.living().expect("the core has enough runs");
    let points: Vec<Point> = (0..100).map(|k| Point::new(k % 10, k / 10)).collect();
    mesh.insert_all(&points).expect("room");
    assert_eq!(seen.get(), [1, 0]);
    for index in 0..40 {
        mesh.delete(index).expect("a deletion");
        mesh.move_to(99 - index, Point::new(20 + index, index * index)).expect("a move");
        mesh.insert(Point::new(500, index)).expect("room");
    }
    assert_eq!(seen.get(), [1, 0], "no question came");
    assert_eq!(mesh.nearest(Point::new(500, 3)).expect("an answer"), Some(103));
    assert_eq!(mesh.locate(Point::new(500, 3)).expect("an answer"), Location::Vertex(103));
    assert_eq!(seen.get(), [2, 0]);
    mesh.insert(Point::new(600, 600)).expect("room");
    mesh.insert_all(&[Point::new(700, 1), Point::new(800, 900)]).expect("room");
    assert_eq!(mesh.nearest(Point::new(790, 900)).expect("an answer"), Some(142));
    assert_eq!(seen.get(), [2, 2]);
    mesh.delete_all(&[40, 41]).expect("deletions");
    assert_eq!(mesh.nearest(Point::new(700, 2)).expect("an answer"), Some(141));
    assert_eq!(seen.get(), [2, 2], "the deletions were made in place");
    mesh.move_all(&[(42, Point::new(9, 9)), (43, Point::new(31, 32))]).expect("moves");
    let mut host = Triangulation::from(points).expect("a triangulation");
    for index in 0..40 {
        host.delete(index).expect("a deletion");
        host.move_to(99 - index, Point::new(20 + index, index * index)).expect("a move");
        host.insert(Point::new(500, index)).expect("room");
    }
    for point in [[600, 600], [700, 1], [800, 900]] {
        host.insert(Point::from(point)).expect("room");
    }
    let on_host: &mut dyn LivingMesh<Point> = &mut host;
    on_host.delete_all(&[40, 41]).expect("deletions");
    on_host.move_all(&[(42, Point::new(9, 9)), (43, Point::new(31, 32))]).expect("moves");
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
    assert_eq!(seen.get(), [3, 2]);
}

/// Points that stay where they are do not part a run of moves.
#[test]
fn moves_to_their_own_places_stay_in_one_run() {
    let moves = Rc::new(Cell::new(0));
    let inner = core_with_runs(SMALL);
    let transport = Counted { inner, hidden: 0, seen: Rc::default(), moves: Rc::clone(&moves) };
    let mut device = Device::from_transport(Box::new(transport));
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the core has runs");
    let points: Vec<Point> = (0..60).map(|k| Point::new(10 * (k % 8), 9 * (k / 8))).collect();
    mesh.insert_all(&points).expect("room");
    let mut host = Triangulation::from(points.iter().copied()).expect("a triangulation");
    // Every third point stays.
    let to = |(index, &Point { x, y }): (usize, &Point)| (index as u32, Point::new(x + u32::from(index % 3 > 0), y));
    let all: Vec<(u32, Point)> = points.iter().enumerate().map(to).collect();
    mesh.move_all(&all).expect("moves");
    LivingMesh::move_all(&mut host, &all).expect("moves");
    assert_eq!(moves.get(), 1);
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
    // A move to a place off the grid is refused, also beside points that stay.
    let error = mesh.move_all(&[(0, points[0]), (1, Point::new(1 << 16, 0))]).expect_err("off the grid");
    assert!(matches!(error, Error::OffGrid { .. }), "{error}");
}

/// The hub of a wheel has more neighbours than the list of the device. The caller does not see that.
#[test]
fn a_vertex_with_many_neighbours_is_deleted_and_moved() {
    let mut device = Device::model(16, 200).expect("a model");
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the model takes runs");
    let mut host = Triangulation::new();
    // Points of a parabola, and a point that sees them all.
    let rim = (0..80u32).map(|k| Point::new(300 + k, 1000 + k * k / 2));
    let points: Vec<Point> = [Point::new(60_000, 100)].into_iter().chain(rim).collect();
    mesh.insert_all(&points).expect("room");
    points.iter().for_each(|&point| assert!(host.insert(point).is_ok()));
    assert!(host.neighbors(0).expect("a point").count() > 40);
    for to in [Point::new(60_001, 100), Point::new(0, 0), Point::new(60_000, 90)] {
        mesh.move_to(0, to).expect("a move");
        host.move_to(0, to).expect("a move");
        assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
    }
    mesh.delete(0).expect("a deletion");
    host.delete(0).expect("a deletion");
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
}

#[test]
fn what_a_device_cannot_take_leaves_its_mesh_as_it_was() {
    let mut device = Device::model(8, 4).expect("a model");
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the model takes runs");
    let square = [[0, 0], [9, 0], [9, 9], [0, 9]].map(Point::from);
    mesh.insert_all(&square).expect("room");
    let before = mesh.mesh().expect("a mesh");
    let full = mesh.insert(Point::new(4, 5)).expect_err("no room");
    assert_eq!(full.to_string(), "all 4 places that model can hold have points: delete some, or use a larger device");
    let off = [mesh.insert(Point::new(256, 0)).err(), mesh.move_to(0, Point::new(0, 256)).err()];
    let asked = [mesh.locate(Point::new(300, 0)).err(), mesh.nearest(Point::new(0, 1 << 31)).err()];
    for error in off.into_iter().chain(asked) {
        let error = error.expect("off the grid");
        assert!(matches!(error, Error::OffGrid { coord_bits: 8, .. }), "{error}");
        assert_eq!(error.kind(), ErrorKind::BadInput);
        assert!(error.to_string().contains("end at 255"));
    }
    assert_eq!(refusal_of(mesh.delete(4)), Some(Refusal::Unknown { index: 4, next: 4 }));
    // A duplicate needs no room.
    assert_eq!(mesh.insert(square[2]).expect("a duplicate"), 4);
    mesh.delete(4).expect("a deletion");
    assert_eq!(refusal_of(mesh.delete(4)), Some(Refusal::Deleted { index: 4 }));
    assert_eq!(mesh.mesh().expect("a mesh"), before);
}

#[test]
fn devices_without_runs_say_so() {
    for address in ["cpu", "clock?config=dual"] {
        let mut device = Device::open(address).expect("a device");
        let mut session = device.session().expect("a session");
        let error = session.living().err().expect("no runs");
        assert!(matches!(error, Error::NoRuns { .. }) && error.kind() == ErrorKind::BadChoice, "{error}");
    }
}

#[test]
fn points_before_a_refused_one_are_in_the_mesh_of_the_processor() {
    let mut mesh = Triangulation::new();
    let points = [[0.0, 0.0], [1.0, 0.0], [f64::NAN, 0.0], [0.0, 1.0]];
    let refused = mesh.insert_all(&points);
    assert!(matches!(refused, Err(Error::Living(_))), "{refused:?}");
    assert_eq!(mesh.next_index(), 2);
    assert_eq!(mesh.insert(points[3]), Ok(2));
}

#[test]
fn a_device_keeps_no_constraints() {
    let mut device = Device::open("model").unwrap();
    let mut session = device.session().unwrap();
    let mut mesh = session.living().unwrap();
    for error in [mesh.insert_constraint(0, 1).unwrap_err(), mesh.remove_constraint(0).unwrap_err()] {
        assert!(matches!(error, Error::NoConstraints { .. }) && error.kind() == ErrorKind::BadChoice, "{error}");
    }
}

/// The refusal that a change met, if it met one.
fn refusal_of(result: Result<(), Error>) -> Option<Refusal> {
    match result {
        Err(Error::Living(refusal)) => Some(*refusal),
        _ => None,
    }
}
