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
