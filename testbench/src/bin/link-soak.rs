//! Runs jobs over a serial link with bit errors in both directions: at the level of pins with up to 100 points at 12
//! Mbaud, and at the level of bytes with larger jobs. The argument is the number of jobs for each bit error rate, 200
//! by default. No mesh may be wrong. Up to one bit error in 100,000 bits every job must be right. At one in 10,000,
//! where dozens of frames are lost, 19 of 20 jobs must be right and the others must end with an error.

use std::error::Error;
use std::process::ExitCode;

use incircle_protocol::{FULL, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_testbench::link::{soak, Detail, Soak};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let jobs = std::env::args().nth(1).map_or(Ok(200), |text| text.parse())?;
    if jobs == 0 {
        return Err("zero jobs prove nothing: give a number of at least 1".into());
    }
    let mut is_good = true;
    for (detail, config, points) in [(Detail::Pins, SMALL, 100), (Detail::Bytes, FULL, 1500)] {
        // `one_in`: at least one job of this many must meet a fault. Small jobs rarely do at one
        // bit error in a million bits.
        for (ber, least, one_in) in [(1e-6, 1.0, 200), (1e-5, 1.0, 20), (1e-4, 0.95, 2)] {
            let faults = FaultSpec { ber, seed: 1000, ..FaultSpec::default() };
            let report = soak(&Soak { detail, config, faults, rate: 12_000_000, jobs, points })?;
            println!("{}, up to {points} points, bit errors {ber:e}: {report}", detail.name());
            is_good &= report.is_good(jobs, least, jobs / one_in);
        }
    }
    let verdict = if is_good { "passed" } else { "FAILED: a wrong mesh, too few right ones, or too few faults met" };
    println!("{verdict}");
    Ok(if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
