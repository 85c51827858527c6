//! `runs`: counts the cycles of runs on the model by clock of the living engine.
//!
//! Each row is a kind of run on one set of points. The items are in the order of the Hilbert curve or in random order,
//! and dealt to the contexts, a stretch to each. The cycles are those from the opcode of a run to the last word of its
//! answer, divided by the items.

mod arguments;
mod core;
mod script;

use incircle_protocol::{Config, FULL};
use incircle_testkit::Distribution;

use self::core::Core;
use crate::orders::{print, Failure};
pub use arguments::RunsArguments;
use script::{Script, Tally};

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
                let mut script = Script::new(arguments, set, along_curve, Core::new(config, arguments.hardware)?)?;
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
