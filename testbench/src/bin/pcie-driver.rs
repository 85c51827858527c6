//! Measures what the driver of PCIe cards costs for each point, against a card that does nothing: in memory, and
//! through the files of a directory.

use std::error::Error;

use clap::Parser;
use incircle_protocol::{Opcode, FULL};
use incircle_testbench::card::{driver_cost, DriverCost, Jobs, Way};

/// Measure the driver of PCIe cards, without the ordering of points and the mapping of indices
#[derive(Parser)]
#[command(after_help = "Example:\n  pcie-driver -n 8192 --jobs 200")]
struct Arguments {
    /// Points of a job
    #[arg(short, default_value_t = FULL.points, value_parser = clap::value_parser!(u32).range(3..=1 << 20))]
    n: u32,
    /// Number of jobs
    #[arg(long, default_value_t = 200)]
    jobs: usize,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Arguments { n, jobs, json } = Arguments::parse();
    let mut found = Vec::new();
    for (way, target) in Way::ALL {
        for (read_out, opcode) in [("triangles", Opcode::Triangles), ("records", Opcode::Read)] {
            let cost = driver_cost(way, Jobs { count: jobs.max(1), points: n, config: FULL, read_out: opcode })?;
            found.push((way.name(), read_out, cost, target));
        }
    }
    if json {
        let entry = |&(way, read_out, cost, target): &(&str, &str, DriverCost, f64)| {
            serde_json::json!({
                "way": way, "read_out": read_out, "points": n, "jobs": jobs,
                "best_ns": cost.best, "median_ns": cost.median, "target_ns": target,
            })
        };
        println!("{}", serde_json::Value::Array(found.iter().map(entry).collect()));
        return Ok(());
    }
    println!("{jobs} jobs of {n} points, nanoseconds per point");
    println!("{:8} {:10} {:>8} {:>8} {:>8}", "way", "read-out", "best", "median", "target");
    for (way, read_out, cost, target) in found {
        println!("{way:8} {read_out:10} {:8.1} {:8.1} {target:8.0}", cost.best, cost.median);
    }
    Ok(())
}
