//! `runs`: counts the cycles of runs on the model by clock of the living engine.
//!
//! Each row is a kind of run on one set of points. The items are in the order of the Hilbert curve or in random order,
//! and dealt to the contexts, a stretch to each. The cycles are those from the opcode of a run to the last word of its
//! answer, divided by the items.

mod core;
mod script;

use clap::Args;
use incircle_protocol::{Config, FULL};
use incircle_testkit::Distribution;

use self::core::Core;
use crate::orders::{print, Failure};
use script::{Script, Tally};

/// Arguments of `runs`.
#[derive(Clone, Debug, Args)]
pub struct RunsArguments {
    /// Points
    #[arg(short, value_name = "N", default_value_t = 8000, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub n: u32,
    /// Sets of points
    #[arg(value_name = "SET", default_values = ["uniform", "kuzmin", "lattice", "circle"])]
    pub sets: Vec<Distribution>,
    /// Contexts of the core
    #[arg(short = 'k', long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=24))]
    pub contexts: u32,
    /// Items of a run, at most
    #[arg(long, value_name = "N", default_value_t = 8000, value_parser = clap::value_parser!(u32).range(1..))]
    pub items: u32,
    /// Also count runs in random order
    #[arg(long)]
    pub random: bool,
    /// Repetitions of the deletions and insertions, to see that the cycles do not grow
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// Runs the subcommand: a row for each kind of run.
///
/// # Errors
/// A set that cannot be made, and a core that answers wrongly.
pub fn runs(arguments: &RunsArguments) -> Result<(), Failure> {
    let config = Config { name: "runs", contexts: arguments.contexts, ..FULL };
    print(&format!(
        "{} points, {} contexts, at most {} items a run; cycles an item; latencies in clocks\n\
         set      order   kind              items cycles    p99 longest visits   walk writes aborts\n",
        arguments.n, arguments.contexts, arguments.items
    ))?;
    for &set in &arguments.sets {
        for along_curve in [true, false] {
            if along_curve || arguments.random {
                let mut script = Script::new(arguments, set, along_curve, Core::new(config)?)?;
                script.run(&mut |kind, tally| print(&row(set, along_curve, kind, tally)).map_err(Failure::from))?;
            }
        }
    }
    Ok(())
}

fn row(set: Distribution, along_curve: bool, kind: &str, tally: &Tally) -> String {
    let order = if along_curve { "Hilbert" } else { "random" };
    let mean = |count: u64| count as f64 / tally.items as f64;
    let mut latencies = tally.latencies.clone();
    latencies.sort_unstable();
    let at = |share: f64| latencies.get((latencies.len() as f64 * share) as usize).copied().unwrap_or(0);
    let in_place = match tally.in_place {
        0 => String::new(),
        count => format!("  {:.0} % in place", 100.0 * mean(count)),
    };
    format!(
        "{:8} {order:7} {kind:16} {:6} {:6.2} {:6} {:7} {:6.2} {:6.2} {:6.2} {:6.3}{in_place}\n",
        set.name(),
        tally.items,
        mean(tally.clocks),
        at(0.99),
        latencies.last().copied().unwrap_or(0),
        mean(tally.visits),
        mean(tally.walk_visits),
        mean(tally.writes),
        mean(tally.aborts),
    )
}
