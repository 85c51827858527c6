//! The goodput of the UDP link in virtual time: how fast jobs pass with faults, as a share of how fast they pass
//! without.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use crate::common::network::{VirtualNetwork, VirtualTransport};
use crate::common::Random;
use incircle::{Device, Options, Point};
use incircle_testkit::NetworkFaults;

/// Seconds of virtual time that `jobs` jobs of `points` points take.
fn seconds(points: usize, jobs: usize, loss: f64, seed: u64) -> f64 {
    let faults = NetworkFaults { loss, seed, ..NetworkFaults::default() };
    let network = Rc::new(RefCell::new(VirtualNetwork::new(&faults, Duration::from_micros(200))));
    let transport = VirtualTransport { network: Rc::clone(&network), limit: Duration::from_secs(20) };
    let mut device = Device::from_transport(Box::new(transport));
    let mut random = Random(3);
    let sets: Vec<Vec<Point>> = (0..jobs).map(|_| random.points(points, 1 << 16)).collect();
    let mut session = device.session().expect("a session");
    let begun = network.borrow().now();
    session.triangulate_batch(&sets, &Options::default()).expect("meshes");
    let end = network.borrow().now();
    (end - begun).as_secs_f64()
}

/// The command of the table in `testbench/goodput-udp.md`:
/// `cargo test --release -p incircle --test it udp::goodput -- --nocapture`.
#[test]
fn loss_costs_no_more_than_it_should() {
    let mut refused = Vec::new();
    println!("| points of a job | loss each way | million points a second | of that without loss |\n|---|---|---|---|");
    for points in [1000, 4000] {
        let best = seconds(points, 100, 0.0, 1);
        for (loss, least) in [(0.0, 99.9), (0.001, 90.0), (0.02, 50.0)] {
            let took = seconds(points, 100, loss, 1);
            let (rate, share) = ((points * 100) as f64 / took / 1e6, 100.0 * best / took);
            println!("| {points} | {} % | {rate:.2} | {share:.0} % |", 100.0 * loss);
            if share < least {
                refused.push((points, loss, share));
            }
        }
    }
    assert!(refused.is_empty(), "{refused:?}");
}
