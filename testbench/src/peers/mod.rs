//! Triangulators beside each other: what each takes for the same points, in one run, in turn, with fresh points each time.
//!
//! Times are of the whole call, from a list of points to a mesh in the form of the library; each must have as many triangles as ours.
//! Each does other points just before, untimed: what the system takes to hand out memory says much of a machine and little of an algorithm. Four million
//! points take some 10 ns longer each without that, and more than 200 where a virtual machine has lent its free memory to others.
//! Ratios are medians over the repetitions of times taken next to each other, so that what else the machine does touches both; objects
//! also have the processor's time on the calling thread ("busy"), which others disturb less.

mod contestant;
mod points;
mod process;
mod table;

use std::io::Write;

use clap::Parser;
use incircle::Point;
use incircle_cli::generate::SplitMix64;

use contestant::{Contestant, Run};
pub use points::Set;

/// Points of all repetitions together, unless their number is given.
const POINTS: usize = 6_000_000;
/// Fewest and most repetitions unless their number is given.
const REPETITIONS: std::ops::RangeInclusive<usize> = 3..=101;

/// Triangulators beside each other: nanoseconds per point, medians
#[derive(Debug, Parser)]
#[command(name = "peers")]
pub struct Arguments {
    /// The sets (default: the five distributions of the literature, the lattice, and the airports of the world)
    #[arg(long, value_name = "SET", value_delimiter = ',')]
    dist: Vec<Set>,
    /// Numbers of points
    #[arg(short, value_name = "N", value_delimiter = ',', default_values_t = [1000, 16_384, 65_536, 1_000_000])]
    n: Vec<u32>,
    /// Bits of a coordinate
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=31))]
    bits: u32,
    /// Repetitions, each with fresh points (default: 3 to 101, fewer for more points)
    #[arg(long, value_name = "R")]
    repetitions: Option<usize>,
    /// Seed of the first repetition
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Leave out what each does just before, untimed: other points of the same set, so that it finds memory at hand
    #[arg(long)]
    cold: bool,
    /// Print one JSON object a line for each set and number of points
    #[arg(long)]
    json: bool,
}

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The set cannot be made.
    #[error("{0}")]
    Generate(#[from] incircle_cli::generate::GenerateError),
    /// Our own work failed.
    #[error("{0}")]
    Ours(#[from] incircle::Error),
    /// A peer stopped in the middle, or answered nonsense.
    #[error("{peer}: {reason}")]
    Peer {
        /// Its name.
        peer: &'static str,
        /// What happened.
        reason: String,
    },
    /// The results cannot be printed.
    #[error("{0}")]
    Print(#[from] std::io::Error),
}

/// What all repetitions of one set gave.
struct Outcome {
    set: Set,
    bits: u32,
    cold: bool,
    /// Points of a repetition; distinct ones of the last.
    points: usize,
    distinct: usize,
    /// The share of the ordering in our time, one thread.
    order_share: Vec<f64>,
    names: Vec<&'static str>,
    /// For each contestant, its run in each repetition.
    runs: Vec<Vec<Run>>,
}

/// Runs the comparison and prints it, a row or an object for each set and number of points.
///
/// # Errors
/// A set that cannot be made, or a contestant that fails.
pub fn compare(arguments: &Arguments) -> Result<(), PeerError> {
    let (mut contestants, missing) = contestant::all(arguments.bits)?;
    let names: Vec<_> = contestants.iter().map(|contestant| contestant.name()).collect();
    let mut out = std::io::stdout().lock();
    if !arguments.json {
        out.write_all(table::header(arguments, &names, &missing).as_bytes())?;
    }
    let sets = if arguments.dist.is_empty() { Set::usual() } else { arguments.dist.clone() };
    for &n in &arguments.n {
        for &set in &sets {
            let outcome = measure(&mut contestants, set, n as usize, arguments)?;
            let text = if arguments.json { table::json(&outcome, &missing) } else { table::row(&outcome) };
            out.write_all(text.as_bytes())?;
            out.flush()?;
        }
    }
    Ok(())
}

/// All repetitions of one set.
fn measure(
    contestants: &mut [Box<dyn Contestant>],
    set: Set,
    n: usize,
    arguments: &Arguments,
) -> Result<Outcome, PeerError> {
    let usual = (POINTS / n.max(1)).clamp(*REPETITIONS.start(), *REPETITIONS.end());
    let mut outcome = Outcome {
        set,
        bits: arguments.bits,
        cold: arguments.cold,
        points: 0,
        distinct: 0,
        order_share: Vec::new(),
        names: contestants.iter().map(|contestant| contestant.name()).collect(),
        runs: vec![Vec::new(); contestants.len()],
    };
    for repetition in 0..arguments.repetitions.unwrap_or(usual).max(1) {
        let points: Vec<Point> = set.points(n, arguments.bits, arguments.seed + repetition as u64)?;
        let before: Vec<Point> = set.points(n, arguments.bits, !arguments.seed - repetition as u64)?;
        // By chance: whoever always came after a program that has just given its memory back would wait for the system each time.
        let mut random = SplitMix64::new(arguments.seed + repetition as u64);
        let mut turns: Vec<usize> = (0..contestants.len()).collect();
        turns.sort_by_cached_key(|_| random.next_u64());
        for place in turns {
            if !arguments.cold {
                contestants[place].run(&before)?;
            }
            let run = contestants[place].run(&points)?;
            outcome.points = points.len();
            if place == 0 {
                outcome.distinct = run.distinct.unwrap_or(points.len());
                outcome.order_share.extend(run.order_share);
            }
            outcome.runs[place].push(run);
        }
    }
    Ok(outcome)
}
