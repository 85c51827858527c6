//! Runs the driver's protocol in front of simulated boards in virtual time: no fault of the line may make a wrong
//! mesh, and goodput reaches its target.

use std::time::Duration;

use incircle_protocol::{Command, FIRST_RATE, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_testbench::link::{measure, soak, Detail, Soak, VirtualLine, RATES, TARGET};

const TRIP: Duration = Duration::from_millis(1);
const LIMIT: Duration = Duration::from_secs(5);
/// Number of jobs for each fault.
const JOBS: u64 = 8;

fn jobs(detail: Detail, spec: &str, jobs: u64, points: usize) -> Soak {
    Soak { detail, config: SMALL, faults: spec.parse().unwrap(), rate: 12_000_000, jobs, points }
}

#[test]
fn jobs_without_bits_survive_every_fault_of_the_line() {
    let mut met = 0;
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
        let report = soak(&jobs(Detail::Bytes, spec, JOBS, 600)).unwrap();
        println!("{spec}: {report}");
        assert_eq!((report.right, report.wrong), (JOBS, 0), "{spec}: {report}");
        // At the lowest rate few of these jobs meet a fault, and possibly none.
        let least = if spec.is_empty() || spec == "ber=1e-6" { 0 } else { 1 };
        assert!(report.met >= least, "{spec}: {report}");
        met += report.met;
    }
    assert!(met >= 35, "{met} jobs met a fault");
}

/// An `Insert` of `count` points.
fn insert(count: u32) -> Command<Vec<u32>> {
    let points = (0..count).map(|j| ((j * 7919) & 0xffff) | (((j * 104_729) & 0xffff) << 16));
    Command::Insert { count, points: points.collect() }
}

#[test]
fn a_host_that_is_killed_in_mid_job_leaves_a_device_that_the_next_one_finds() {
    // At the pins every clock of the silence would be simulated. The device is therefore left at the first rate there,
    // and hears the next host at once.
    let at_the_pins = (Detail::Pins, FIRST_RATE, &[(4, 5)][..]);
    for (detail, rate, kills) in [(Detail::Bytes, 3_000_000, &[(1, 0), (2, 3), (3, 11)][..]), at_the_pins] {
        for &(seed, limit) in kills {
            let board = detail.board(SMALL).unwrap();
            let mut line = VirtualLine::new(board, rate, TRIP, &FaultSpec::default());
            line.open(LIMIT).unwrap();
            // The time limit kills the host while points are on their way, without a goodbye.
            line.ask(&insert(1000), Duration::from_millis(limit)).unwrap_err();
            line.restart_host(rate, seed);
            line.open(LIMIT).unwrap();
            let answer = line.ask(&insert(20), LIMIT).unwrap();
            assert_eq!(answer[..4], [0x0300_0000, 5, 20, 20], "{seed}");
            line.close();
        }
    }
}

#[test]
fn bit_errors_at_the_pins_make_no_wrong_mesh() {
    // Least number of six jobs that meet a fault. At the lowest rate such small jobs meet none,
    // and do not count as faulty.
    for (ber, least) in [("ber=1e-6", 0), ("ber=1e-5", 1), ("ber=1e-4", 4), ("ber=2e-4", 5)] {
        let report = soak(&jobs(Detail::Pins, ber, 6, 100)).unwrap();
        println!("{ber}: {report}");
        assert_eq!((report.right, report.wrong), (6, 0), "{ber}: {report}");
        assert!(report.met >= least, "{ber}: {report}");
    }
}

#[test]
fn the_link_reaches_its_goodput() {
    for goodput in measure(Detail::Bytes, 12_000_000, 8192).unwrap() {
        println!("{goodput:?}: {:.3}", goodput.share());
        assert!(goodput.share() >= TARGET, "{goodput:?} is {:.3} of the limit", goodput.share());
    }
}

#[test]
fn the_table_of_goodput_reaches_the_target_at_every_rate() {
    let rows: Vec<_> = include_str!("../../../goodput.md").lines().filter(|line| line.ends_with(" % |")).collect();
    assert_eq!(rows.len(), 2 * RATES.len());
    for (row, rate) in rows.iter().zip(RATES.into_iter().flat_map(|rate| [rate; 2])) {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        assert_eq!(cells[1], rate.to_string(), "{row}");
        let share: f64 = cells[6].trim_end_matches(" %").parse().expect(row);
        assert!(share >= 100.0 * TARGET, "{row}");
    }
}
