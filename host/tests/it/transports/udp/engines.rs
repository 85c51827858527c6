//! Chips of several engines behind the UDP link: their jobs go side by side, and no fault of the network makes a wrong
//! mesh.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use crate::common::network::{VirtualNetwork, VirtualTransport};
use crate::common::{by_cpu, Random};
use incircle::transports::parts::UdpStatistics;
use incircle::{Device, Options, Point};
use incircle_protocol::{Config, QUAD};
use incircle_testkit::NetworkFaults;

const TRIP: Duration = Duration::from_micros(200);
/// Limit for an answer, in virtual time.
const LIMIT: Duration = Duration::from_secs(20);

/// A chip of so many engines, smaller than a named one so that tests end sooner.
fn chip(engines: u32) -> Config {
    Config { points: 512, contexts: 4, engines, ..QUAD }
}

/// The result of a batch.
struct Outcome {
    time: Duration,
    met: u64,
    statistics: UdpStatistics,
}

/// Does jobs with a chip over a network with these faults, and checks each mesh.
fn batch(engines: u32, faults: &str, seed: u64, sets: &[Vec<Point>]) -> Outcome {
    let faults = NetworkFaults { seed, ..faults.parse().expect("faults") };
    let network = Rc::new(RefCell::new(VirtualNetwork::of_chip(chip(engines), &faults, TRIP)));
    let transport = VirtualTransport { network: Rc::clone(&network), limit: LIMIT };
    let mut device = Device::from_transport(Box::new(transport));
    let mut session = device.session().expect("a session");
    let begun = network.borrow().now();
    let solved = session.triangulate_batch(sets, &Options::default()).expect("meshes");
    for (points, solution) in sets.iter().zip(solved) {
        assert_eq!(solution.mesh, by_cpu(points).mesh);
    }
    let time = network.borrow().now() - begun;
    // Steps of a job, each of them answered before the next one goes.
    let solution = session.triangulate(&sets[0]).expect("a mesh");
    assert_eq!(solution.mesh, by_cpu(&sets[0]).mesh);
    let network = network.borrow();
    Outcome { time, met: network.met(), statistics: network.statistics() }
}

fn sets(random: &mut Random, jobs: usize, most: u32) -> Vec<Vec<Point>> {
    let mut set = || {
        let points = 3 + random.below(most - 2) as usize;
        random.points(points, 1 << 12)
    };
    (0..jobs).map(|_| set()).collect()
}

#[test]
fn two_engines_are_faster_than_one() {
    let mut random = Random(21);
    let sets: Vec<_> = (0..40).map(|_| random.points(400, 1 << 16)).collect();
    let [one, two] = [1, 2].map(|engines| batch(engines, "", 1, &sets).time.as_secs_f64());
    println!("{one} s with one engine, {two} s with two");
    // Round trips at the beginning and the end take their part of some milliseconds.
    assert!(one / two > 1.5, "{one} {two}");
}

#[test]
fn jobs_of_several_engines_survive_every_fault_of_the_network() {
    let classes = [
        "loss=0.02",
        "double=0.1",
        "swap=0.1",
        "delay=20",
        "flip=0.02",
        "loss=0.05,double=0.05,swap=0.05,delay=5,flip=0.05",
    ];
    for (class, faults) in classes.into_iter().enumerate() {
        let (mut repeated, mut restarted) = (0, 0);
        for engines in [2, 4] {
            let seed = 100 * u64::from(engines) + class as u64;
            let Outcome { met, statistics, time } = batch(engines, faults, seed, &sets(&mut Random(seed), 80, 400));
            assert!(met > 0, "{faults}");
            println!("{faults}, {engines} engines: {met} faults, {time:?}, {statistics:?}");
            (repeated, restarted) = (repeated + statistics.repeated, restarted + statistics.restarted);
        }
        let has_loss = faults.contains("loss");
        assert!(!has_loss || repeated > 0 && restarted > 0, "{faults}: {repeated} {restarted}");
    }
}
