//! The goodput of the UDP link in virtual time: the time that jobs take without faults, as a share of the time that they
//! take with faults.

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
    println!("{:?}", network.borrow().statistics());
    (end - begun).as_secs_f64()
}

/// The rows of `testbench/goodput.md`: points of a job, loss, and share of the goodput without loss in percent.
fn table(jobs: usize) -> Vec<(usize, f64, f64, f64)> {
    let mut rows = Vec::new();
    for points in [1000, 4000] {
        let best = seconds(points, jobs, 0.0, 1);
        for loss in [0.0, 0.001, 0.02] {
            let took = seconds(points, jobs, loss, 1);
            rows.push((points, loss, (points * jobs) as f64 / took / 1e6, 100.0 * best / took));
        }
    }
    rows
}

/// The command of the table: `cargo test --release -p incircle --test it udp::goodput -- --nocapture`.
#[test]
fn loss_costs_no_more_than_it_should() {
    println!("| points of a job | loss | million points a second | of that without loss |\n|---|---|---|---|");
    for (points, loss, rate, share) in table(100) {
        println!("| {points} | {} % | {rate:.2} | {share:.0} % |", 100.0 * loss);
        let least = if loss >= 0.02 {
            50.0
        } else if loss > 0.0 {
            90.0
        } else {
            99.9
        };
        assert!(share >= least, "{points} points, loss {loss}: {share} %");
    }
}
