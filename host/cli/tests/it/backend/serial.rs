//! Tests of serial back ends without a board: a wrong port, address or choice is named in a sentence. Other tests run
//! jobs over a line with the simulated board.

use crate::common::{Run, Scratch};

/// The error of wrong arguments says how to get help.
fn refused(run: &Run, parts: &[&str]) {
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(parts.iter().all(|part| run.stderr.contains(part)), "{run:?}");
}

#[test]
fn addresses_are_checked_before_anything_is_opened() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    for (backend, parts) in [
        ("serial:", ["no port is named", "serial:/dev/ttyUSB0"]),
        ("serial", ["'serial:PORT'", "/dev/ttyUSB0"]),
        ("serial:/nowhere/tty?baud=9600", ["baud", "115200"]),
        ("serial:/nowhere/tty?parity=odd", ["parity", "slow"]),
    ] {
        refused(&scratch.run(&format!("triangulate p.csv -o m.ele --backend {backend}")), &parts);
    }
    scratch.run("triangulate p.csv -o m.ele --backend serial:/nowhere/tty --config tiny").fails(2, &["--config"]);
    scratch.run("triangulate p.csv -o m.ele --backend serial:/nowhere/tty --trace t.vcd").fails(2, &["--backend sim"]);
    refused(&scratch.run("info --port /nowhere/tty --backend model"), &["--port", "--backend"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn ports_that_cannot_be_had_end_with_exit_code_4() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    let missing = ["/nowhere/tty cannot be opened", "there is no such port"];
    scratch.run("triangulate p.csv -o m.ele --backend serial:/nowhere/tty").fails(4, &missing);
    scratch.run("bench --backend serial:/nowhere/tty").fails(4, &missing);
    scratch.run("info --port /nowhere/tty").fails(4, &missing);
    scratch.run("info --backend serial:/nowhere/tty").fails(4, &missing);
    scratch.run("info --port p.csv").fails(4, &["p.csv cannot be opened", "no serial port", "incircle devices"]);
    #[cfg(unix)]
    scratch.run("info --port /dev/null").fails(4, &["/dev/null cannot be opened", "no serial port"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

/// A pseudo-terminal whose other end nobody holds is like a board that never answers.
#[cfg(target_os = "linux")]
#[test]
fn a_timeout_bounds_the_opening_of_a_board_too() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    for command in ["triangulate p.csv -o m.ele", "bench uniform -n 10", "bench uniform -n 10 --batch 2"] {
        let run = scratch.run(&format!("{command} --backend serial:/dev/ptmx?slow=50 --timeout 1"));
        run.fails(6, &["the greeting within 1 s", "allow a longer time"]);
    }
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn devices_lists_what_the_system_knows() {
    let scratch = Scratch::new();
    let run = scratch.run("devices").ok();
    // A machine has any number of ports, each with a line. Without ports there is a sentence.
    assert_ne!(run.stdout.is_empty(), run.stderr.is_empty(), "{run:?}");
    assert!(run.stdout.lines().all(|line| line.contains(" (")), "{run:?}");
}
