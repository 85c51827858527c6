//! A mesh that lives on the simulated core with runs, against the triangulation on the processor: the same meshes,
//! answers and refusals.

use crate::serve::service;
use incircle::living::{Error as Refusal, Location};
use incircle::{Device, Error, ErrorKind, LivingMesh, Point, Triangulation};
use incircle_protocol::{RunKind, FULL, SMALL, TINY};
use incircle_sim::network::NetworkBoard;
use incircle_sim::{SimDevice, SimError, SimTransport};
use incircle_testkit::SplitMix64;
use std::process::Command;

fn device() -> Device {
    let core = SimDevice::living(SMALL).expect("the core was built");
    Device::from_transport(Box::new(SimTransport::new(core, "small")))
}

fn point(random: &mut SplitMix64, side: u32) -> Point {
    Point::new(random.below_u32(side), random.below_u32(side))
}

/// Makes one random change of several points on both, and returns what each says.
fn change(random: &mut SplitMix64, side: u32, meshes: [&mut dyn LivingMesh<Point>; 2]) -> [Result<(), String>; 2] {
    let next = meshes[1].next_index();
    let points: Vec<Point> = (0..1 + random.below(40)).map(|_| point(random, side)).collect();
    // Seldom an index that no point has any more, or has not yet.
    let living = meshes[1].indices();
    let mut index = || if random.once_in(40) { random.below_u32(next + 1) } else { random.pick(&living) };
    let indices: Vec<u32> = if living.is_empty() { vec![0] } else { points.iter().map(|_| index()).collect() };
    let moves: Vec<(u32, Point)> = indices.iter().copied().zip(points.iter().copied()).collect();
    let kind = random.below(5);
    meshes.map(|mesh| {
        let made = match kind {
            0 => mesh.delete_all(&indices[..indices.len() / 2]),
            1 => mesh.move_all(&moves),
            2 => moves.iter().try_for_each(|&(index, to)| mesh.move_to(index, to)),
            _ => mesh.insert_all(&points),
        };
        made.map_err(|error| error.to_string())
    })
}

#[test]
fn random_changes_and_questions_agree_with_the_processor() {
    let mut random = SplitMix64::new(31);
    let (mut refused, mut outcomes) = (0, [0; 4]);
    for script in 0..12 {
        let side = [3, 6, 20, 1 << 16][script % 4];
        let mut device = device();
        let mut session = device.session().expect("a session");
        let mut mesh = session.living().expect("the core has enough runs");
        let mut host = Triangulation::new();
        for _ in 0..12 {
            let [found, expected] = change(&mut random, side, [&mut mesh, &mut host]);
            assert_eq!(found, expected);
            refused += usize::from(found.is_err());
            let places: Vec<Point> = (0..40).map(|_| point(&mut random, (side + 2).min(1 << 16))).collect();
            let located = mesh.locate_all(&places).expect("answers");
            for (&place, &found) in places.iter().zip(&located) {
                assert_eq!(found, host.locate(place), "{place}");
                match found {
                    Location::Vertex(_) => outcomes[0] += 1,
                    Location::Edge(_) => outcomes[1] += 1,
                    Location::Triangle(_) => outcomes[2] += 1,
                    Location::Outside(_) | Location::None => outcomes[3] += 1,
                }
            }
            let nearest: Vec<Option<u32>> = places.iter().map(|&place| host.nearest(place)).collect();
            assert_eq!(mesh.nearest_all(&places).expect("answers"), nearest);
            let sum = mesh.weights(places[0]).expect("an answer").iter().map(|&(_, weight)| weight).sum::<u64>();
            let spans = host.triangles().next().is_some();
            assert_eq!(sum > 0, spans && !matches!(host.locate(places[0]), Location::Outside(_)));
            if random.once_in(2) {
                assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
            }
        }
        assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
    }
    assert!(refused > 3, "{refused} changes were refused");
    assert!(outcomes.iter().all(|&count| count > 100), "{outcomes:?}");
}

/// The same core behind the model of the serial link, on a line that loses and spoils frames. A change whose answer is
/// lost is asked for again, and made once.
#[test]
fn random_changes_over_a_bad_serial_line_agree_with_the_processor() {
    let said = agrees_over_serial("bad", &["--fast", "--fault", "drop-frame=0.05,ber=1e-5,seed=4"], 20, 15);
    assert!(!said.contains(" 0 faults"), "{said}");
}

/// The Verilog of the serial link and of the core with runs behind it, bit by bit.
#[test]
fn random_changes_at_the_pins_of_a_board_agree_with_the_processor() {
    agrees_over_serial("pins", &[], 1000, 6);
}

/// Runs random changes and questions on a board that is started with these arguments, this many times slower than
/// real, and returns what the board says in the end.
fn agrees_over_serial(name: &str, arguments: &[&str], slow: u32, rounds: usize) -> String {
    let folder = std::env::temp_dir().join(format!("incircle-living-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let link = folder.join("board");
    let mut command = service::program(&["serve", "--living", "--slow", &slow.to_string()]);
    command.args(arguments).arg("--link").arg(&link);
    let said = agrees(command, rounds);
    std::fs::remove_dir_all(folder).expect("a folder of our own");
    said
}

/// The same core behind the Verilog of the stream link, with the system calls of a driver.
#[test]
fn random_changes_at_the_pins_of_a_card_agree_with_the_processor() {
    let folder = std::env::temp_dir().join(format!("incircle-living-card-{}", std::process::id()));
    let mut command = service::program(&["serve-pcie", "--living", "--fault", "short-read=0.1,short-write=0.1"]);
    command.arg("--dir").arg(&folder);
    agrees(command, 12);
    std::fs::remove_dir(folder).expect("an empty folder");
}

/// The same core behind the model of the UDP link, on a network that loses and spoils datagrams.
#[test]
fn random_changes_over_a_bad_network_agree_with_the_processor() {
    let faults = "loss=0.05,double=0.05,swap=0.05,flip=0.02,seed=4";
    let said = agrees(service::program(&["serve-udp", "--living", "--fast", "--fault", faults]), 30);
    assert!(!said.contains(" 0 faults"), "{said}");
}

/// The Verilog of the UDP link and of the core with runs behind it, at the pins of the PHY.
#[test]
fn random_changes_at_the_pins_of_a_device_on_the_network_agree_with_the_processor() {
    agrees(service::program(&["serve-udp", "--living"]), 12);
}

/// The same pins at the end of a network that loses and doubles datagrams.
#[test]
fn random_changes_at_these_pins_over_a_bad_network_agree_with_the_processor() {
    let faults = "loss=0.03,double=0.03,swap=0.03,seed=5";
    let said = agrees(service::program(&["serve-udp", "--living", "--fault", faults]), 12);
    assert!(!said.contains(" 0 faults"), "{said}");
}

/// Runs random changes and questions on the device that a command serves at the address in its first line, and returns
/// what the command says in the end.
fn agrees(command: Command, rounds: usize) -> String {
    let (child, line) = service::start(command);
    assert!(line.starts_with("ready: ") && line.contains("with runs"), "{line}");
    let address = line.trim_end().split("open ").nth(1).expect("an address");
    let mut device = Device::open(address).expect("the device");
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the core has enough runs");
    let mut host = Triangulation::new();
    let mut random = SplitMix64::new(32);
    for _ in 0..rounds {
        let [found, expected] = change(&mut random, 20, [&mut mesh, &mut host]);
        assert_eq!(found, expected);
        let places: Vec<Point> = (0..20).map(|_| point(&mut random, 20)).collect();
        let nearest: Vec<Option<u32>> = places.iter().map(|&place| host.nearest(place)).collect();
        assert_eq!(mesh.nearest_all(&places).expect("answers"), nearest);
    }
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh());
    drop(device);
    let (status, said) = service::end(child, "-TERM");
    assert_eq!(status.code(), Some(0), "{said}");
    said
}

#[test]
fn what_the_core_cannot_take_leaves_its_mesh_as_it_was() {
    let mut device = device();
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the core has enough runs");
    let points: Vec<Point> = (0..SMALL.points).map(|k| Point::new(k % 32 * 9, k / 32 * 7 + k % 3)).collect();
    mesh.insert_all(&points).expect("room");
    let before = mesh.mesh().expect("a mesh");
    let full = mesh.insert(Point::new(1, 60_000)).expect_err("no room");
    assert!(matches!(full, Error::MemoryFull { capacity: 1024, .. }) && full.kind() == ErrorKind::Capacity, "{full}");
    for error in [mesh.insert(Point::new(1 << 16, 0)).err(), mesh.locate(Point::new(0, 1 << 20)).err()] {
        let error = error.expect("off the grid");
        assert!(matches!(error, Error::OffGrid { coord_bits: 16, .. }), "{error}");
    }
    let unknown = mesh.delete(SMALL.points).expect_err("no such point");
    assert!(matches!(&unknown, Error::Living(refusal) if matches!(**refusal, Refusal::Unknown { .. })), "{unknown}");
    assert_eq!(mesh.mesh().expect("a mesh"), before);
    mesh.delete(3).expect("a deletion");
    let dead = mesh.move_to(3, Point::new(5, 5)).expect_err("the point is dead");
    assert!(matches!(&dead, Error::Living(refusal) if **refusal == Refusal::Deleted { index: 3 }), "{dead}");
    mesh.insert(Point::new(1, 60_000)).expect("the room of the deleted point");
    assert_eq!(mesh.nearest(Point::new(0, 60_001)).expect("an answer"), Some(SMALL.points));
}

#[test]
fn the_identity_says_which_runs_the_core_has() {
    let mut device = device();
    let session = device.session().expect("a session");
    let taken = RunKind::ALL.map(|kind| session.identity().takes(kind));
    assert_eq!(taken, [true, true, true, true, true, true]);
    assert!(session.keeps_living_meshes());
}

#[test]
fn cores_with_runs_that_were_not_built_are_refused_with_a_sentence() {
    assert!(SimDevice::has_living(SMALL));
    for config in [TINY, FULL] {
        assert!(!SimDevice::has_living(config));
        let board = NetworkBoard::living(config).map(|_| ());
        for missing in [SimDevice::living(config).map(|_| ()), board] {
            let error = missing.expect_err("not built");
            assert!(matches!(error, SimError::NoRuns { .. }), "{error}");
            assert!(error.to_string().contains("with runs: choose small, or the back end clock"), "{error}");
        }
    }
}
