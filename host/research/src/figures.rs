//! `figures`: makes all figures that the documents publish of this package again.

use std::path::PathBuf;

use clap::Args;
use incircle_testkit::Distribution;

use crate::compare::{draw, ranking, to_csv, Row};
use crate::order::{BrioDc, Order};
use crate::orders::{print, table, write, Failure};

/// Arguments of `figures`. The defaults are those of the published figures.
#[derive(Clone, Debug, Args)]
pub struct FiguresArguments {
    /// Points of each set in the table of all orders
    #[arg(long, value_name = "N", default_value_t = 4096)]
    pub table: u32,
    /// Points of each set for the published ranking
    #[arg(long, value_name = "N", default_value_t = 1 << 18)]
    pub ranking: u32,
    /// Points of each set for the guided walks
    #[arg(long, value_name = "N", default_value_t = 1 << 20)]
    pub walks: u32,
    /// Folder for the figures: orders.csv, orders.svg, ranking.csv and walks.csv
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
}

/// Bits of a coordinate in the sets for the guided walks and the ranking, and the seed of all sets.
const WIDE_BITS: u32 = 24;
const SEED: u64 = 1;

/// Runs the subcommand: the table of all orders, the published ranking, and the guided walks of docs/performance.md.
///
/// # Errors
/// A file cannot be written, or a set cannot be made.
pub fn figures(arguments: &FiguresArguments) -> Result<(), Failure> {
    let keep = |name: &str, text: String| match &arguments.out {
        Some(folder) => write(&folder.join(name), &text),
        None => Ok(()),
    };
    if let Some(folder) = &arguments.out {
        std::fs::create_dir_all(folder)?;
    }
    print("== All orders, on the literature's distributions and on two sets on which plain curves fail\n")?;
    let hard = [Distribution::TwoChains, Distribution::ParabolaInward];
    let sets: Vec<Distribution> = Distribution::LITERATURE.into_iter().chain(hard).collect();
    let rows = table(&sets, &[arguments.table], &Order::usual(), 16, SEED)?;
    keep("orders.csv", to_csv(&rows))?;
    keep("orders.svg", draw(&rows))?;
    print("\n== Published ranking\n")?;
    let rows = table(&Distribution::LITERATURE, &[arguments.ranking], &published(), WIDE_BITS, SEED)?;
    print(&ranking(&rows))?;
    keep("ranking.csv", to_csv(&rows))?;
    print("\n== Guided walks (docs/performance.md)\n")?;
    let orders = [Order::BRIO_HILBERT, Order::BrioDc(BrioDc::Linear)];
    let rows = table(&Distribution::LITERATURE, &[arguments.walks], &orders, WIDE_BITS, SEED)?;
    keep("walks.csv", to_csv(&rows))?;
    print(&guided_walks(&rows))?;
    Ok(())
}

/// The orders of the published ranking.
fn published() -> Vec<Order> {
    Order::usual().into_iter().filter(|order| order.name().starts_with("brio")).collect()
}

/// The sentence about guided walks in the documents.
fn guided_walks(rows: &[Row]) -> String {
    let of = |name: &str, get: fn(&Row) -> f64| {
        let values = || rows.iter().filter(|row| row.order.name() == name).map(get);
        (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max))
    };
    let [guided, plain] =
        ["briodc-linear", "brio-hilbert"].map(|name| (of(name, |row| row.walk), of(name, |row| row.order_ns)));
    format!(
        "rounds with guides beside BRIO + Hilbert: {:.2} to {:.2} triangles a walk beside {:.2} to {:.2}; {:.0} to \
         {:.0} ns a point to order beside {:.0} to {:.0}\n",
        guided.0 .0, guided.0 .1, plain.0 .0, plain.0 .1, guided.1 .0, guided.1 .1, plain.1 .0, plain.1 .1
    )
}
