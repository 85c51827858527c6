//! Runs jobs over a serial link with bit errors in both directions, 200 jobs for each bit error rate. The only argument is
//! another number of jobs.
//!
//! Jobs of up to 100 points run through the pins at 12 Mbaud, larger ones without the bits. No mesh may be wrong. Up to
//! one bit error in 100,000 bits every job must succeed. At one in 10,000, where frames are lost by the dozen, nineteen
//! jobs of twenty must succeed, and the others must end with an error.

use std::error::Error;
use std::process::ExitCode;

use incircle_protocol::{FULL, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_testbench::link::{soak, Detail, Soak};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let jobs = std::env::args().nth(1).map_or(Ok(200), |text| text.parse())?;
    if jobs == 0 {
        return Err("no job proves nothing: give a number from 1 on".into());
    }
    let mut is_good = true;
    for (detail, config, points) in [(Detail::Pins, SMALL, 100), (Detail::Bytes, FULL, 1500)] {
        // At least one job in `one_in` must meet a fault. Few small jobs do at one bit error in a million bits.
        for (ber, least, one_in) in [(1e-6, 1.0, 200), (1e-5, 1.0, 20), (1e-4, 0.95, 2)] {
            let faults = FaultSpec { ber, seed: 1000, ..FaultSpec::default() };
            let report = soak(&Soak { detail, config, faults, rate: 12_000_000, jobs, points })?;
            println!("{}, up to {points} points, bit errors {ber:e}: {report}", detail.name());
            is_good &= report.is_good(jobs, least, jobs / one_in);
        }
    }
    println!("{}", if is_good { "as it must be" } else { "NOT as it must be" });
    Ok(if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
