//! The driver's engine before simulated boards, in virtual time.

use std::time::Duration;

use incircle_protocol::{command_word, Opcode, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_testbench::link::{soak, Detail, Soak, VirtualLine};

const TRIP: Duration = Duration::from_millis(1);
const LIMIT: Duration = Duration::from_secs(5);

fn jobs(detail: Detail, spec: &str, jobs: u64, points: usize) -> Soak {
    Soak { detail, config: SMALL, faults: spec.parse().unwrap(), rate: 12_000_000, jobs, points }
}

#[test]
fn jobs_without_bits_survive_every_fault_of_the_line() {
    for spec in [
        "",
        "ber=1e-6",
        "ber=1e-5",
        "ber=1e-4",
        "drop=1e-4",
        "double=1e-4",
        "swap=1e-4",
        "drop-frame=0.02",
        "double-frame=0.05",
        "swap-frame=0.02",
        "truncate=0.02",
        "babble=0.05",
        "stall=0.05,stall-ms=30",
    ] {
        let report = soak(&jobs(Detail::Bytes, spec, 20, 400)).unwrap();
        println!("{spec}: {report}");
        assert_eq!((report.right, report.wrong), (20, 0), "{spec}: {report}");
        assert!(report.faults > 0 || spec.is_empty() || spec == "ber=1e-6", "{spec}: {report}");
    }
}

/// Points as an `Insert` with `count` of them.
fn insert(count: u32) -> Vec<u32> {
    let mut words = vec![command_word(Opcode::Insert), count];
    words.extend((0..count).map(|j| (j * 7919 & 0xffff) | (j * 104_729 & 0xffff) << 16));
    words
}

#[test]
fn a_host_that_is_killed_in_mid_job_leaves_a_device_that_the_next_one_finds() {
    for detail in [Detail::Bytes] {
        for (seed, limit) in [(1, 0), (2, 3), (3, 11)] {
            let board = detail.board(SMALL).unwrap();
            let mut line = VirtualLine::new(board, 3_000_000, TRIP, &FaultSpec::default());
            line.open(LIMIT).unwrap();
            // Killed while points are on their way, at 3 Mbaud, without a goodbye.
            line.ask(&insert(1000), Duration::from_millis(limit)).unwrap_err();
            line.restart_host(3_000_000, seed);
            line.open(LIMIT).unwrap();
            let answer = line.ask(&insert(20), LIMIT).unwrap();
            assert_eq!(answer[..4], [0x0300_0000, 5, 20, 20], "{seed}");
            line.close();
        }
    }
}
