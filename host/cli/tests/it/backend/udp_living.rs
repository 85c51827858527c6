//! Tests that a script on a core with runs behind a UDP link gives the files of the back end `cpu`, byte for byte.

use super::sim_living::compare;
use crate::common::Scratch;
use incircle_protocol::SMALL;
use incircle_sim::serve::{serve_network, NetworkService};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;

/// Ends the service of a device, also if a test fails.
struct Ends<'s>(&'s AtomicBool);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Serves the core `small`, with runs or without, on a network with these faults, and calls `work` with its address.
/// `is_fast` leaves out the pins.
fn serve(is_fast: bool, has_runs: bool, faults: &str, work: impl FnOnce(&str)) {
    let listen = "127.0.0.1:0".parse().expect("an address");
    let service = NetworkService { listen, config: SMALL, is_fast, has_runs, faults: faults.parse().expect("faults") };
    let (stops, (tell, told)) = (AtomicBool::new(false), channel());
    std::thread::scope(|scope| {
        let ends = Ends(&stops);
        let server = scope.spawn(|| serve_network(&service, &stops, |address| tell.send(address).expect("a test")));
        let address = told.recv().expect("the device listens");
        work(&format!("udp:{address}"));
        drop(ends);
        let figures = server.join().expect("the service ends").expect("the network works");
        assert_eq!(figures.faults > 0, !faults.is_empty(), "{figures:?}");
    });
}

#[test]
fn made_scripts_give_the_files_of_the_processor() {
    let scratch = Scratch::new();
    for (recipe, faults) in [
        ("drift -n 60 --frames 6", ""),
        ("tracks -n 60 --frames 10", "loss=0.05,double=0.05,swap=0.05,flip=0.02,seed=3"),
        ("churn -n 60 --commands 400", "loss=0.05,delay=5,seed=4"),
    ] {
        scratch.run(&format!("generate {recipe} --seed 8 -o s.txt")).ok();
        serve(true, true, faults, |address| {
            let report = compare(&scratch, address);
            assert_eq!([&report["changes_by"], &report["mesh_by"]], ["udp", "udp"], "{recipe}");
        });
    }
}

#[test]
fn a_script_at_the_pins_of_a_device_gives_the_files_of_the_processor() {
    let scratch = Scratch::new();
    scratch.run("generate churn -n 20 --commands 120 --seed 9 -o s.txt").ok();
    serve(false, true, "", |address| assert_eq!(compare(&scratch, address)["changes_by"], "udp"));
}

#[test]
fn a_device_without_runs_makes_the_mesh_at_the_end() {
    let scratch = Scratch::new();
    scratch.run("generate churn -n 20 --commands 60 --seed 10 -o s.txt").ok();
    serve(true, false, "", |address| {
        let report = compare(&scratch, address);
        assert_eq!([&report["changes_by"], &report["mesh_by"]], ["cpu", "udp"]);
    });
}

#[test]
fn places_get_the_values_of_the_processor() {
    let scratch = Scratch::new();
    let rows: String = (0..40u32).map(|k| format!("{},{},{}\n", k * 37 % 100, k * k % 89, k % 7)).collect();
    scratch.write("p.csv", format!("x,y,z\n{rows}"));
    scratch.run("interpolate p.csv --grid 10 -o cpu.csv --quiet").ok();
    serve(true, true, "", |address| {
        scratch.run(&format!("interpolate p.csv --grid 10 -o udp.csv --backend {address} --quiet")).ok();
    });
    assert_eq!(scratch.read("udp.csv"), scratch.read("cpu.csv"));
}
