//! `orders`: compares orders of insertion in a table, in a CSV file and in a drawing.

use std::io::{self, Write as _};
use std::path::{absolute, Path, PathBuf};

use clap::Args;
use incircle::Point;
use incircle_testkit::{generate, Distribution};

use crate::compare::{draw, header, measure, ranking, to_csv, Row};
use crate::order::Order;

/// The reason why a run failed, as a sentence.
pub type Failure = Box<dyn std::error::Error>;

/// Arguments of `orders`.
#[derive(Clone, Debug, Args)]
pub struct OrdersArguments {
    /// Sets (default: the literature's five distributions, and two on which plain curves fail)
    #[arg(value_name = "SET")]
    pub sets: Vec<Distribution>,
    /// Points of a set, as one number or several with commas; cycles are counted up to 16384
    #[arg(short, value_name = "N", value_delimiter = ',', default_values_t = [4096])]
    pub n: Vec<u32>,
    /// Orders, separated by commas (default: all but 'input', with rounds of a quarter)
    ///
    /// The default is random, every curve, rounds along every curve, and rounds with guides.
    #[arg(long = "order", value_name = "ORDER", value_delimiter = ',', value_parser = order_from)]
    pub orders: Vec<Order>,
    /// Bits of a coordinate; cycles are counted up to 16
    #[arg(long, value_name = "BITS", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=31))]
    pub coord_bits: u32,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Write the figures as CSV as well
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Draw walk steps and time as well
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

/// Parses the name of an order.
fn order_from(name: &str) -> Result<Order, String> {
    Order::named(name).ok_or_else(|| {
        format!("the orders are {}", Order::all().into_iter().map(Order::name).collect::<Vec<_>>().join(", "))
    })
}

/// Runs the subcommand. Each row is printed as soon as it is measured, the published ranking follows below the table,
/// and files are written at the end.
///
/// # Errors
/// The files cannot be written or are the same, or a set cannot be made.
pub fn orders(arguments: &OrdersArguments) -> Result<(), Failure> {
    check_files(arguments)?;
    let orders = if arguments.orders.is_empty() { Order::usual() } else { arguments.orders.clone() };
    let rows = table(&sets_of(arguments), &arguments.n, &orders, arguments.coord_bits, arguments.seed)?;
    print(&ranking(&rows))?;
    if let Some(path) = &arguments.csv {
        write(path, &to_csv(&rows))?;
    }
    if let Some(path) = &arguments.plot {
        write(path, &draw(&rows))?;
    }
    Ok(())
}

/// Measures all orders of insertion on all sets, and prints the table.
pub(crate) fn table(
    sets: &[Distribution],
    sizes: &[u32],
    orders: &[Order],
    coord_bits: u32,
    seed: u64,
) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    print(&header(coord_bits, seed))?;
    for &n in sizes {
        for &set in sets {
            let points = generate(set, n as usize, coord_bits, seed)?;
            let points: Vec<Point> = points.into_iter().map(Point::from).collect();
            for &order in orders {
                let row = measure(set, &points, order, coord_bits)?;
                print(&row.line())?;
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

/// Checks that the files for the figures and for the drawing are different, and that their folders exist.
fn check_files(arguments: &OrdersArguments) -> Result<(), Failure> {
    let place = |path: &Option<PathBuf>| path.as_deref().map(absolute).transpose();
    let (csv, plot) = (place(&arguments.csv)?, place(&arguments.plot)?);
    if csv.is_some() && csv == plot {
        return Err("--csv and --plot name the same file: choose another file for one".into());
    }
    for path in [csv, plot].into_iter().flatten() {
        if !path.parent().is_some_and(Path::is_dir) {
            return Err(format!("{} cannot be written: there is no such folder", path.display()).into());
        }
    }
    Ok(())
}

fn sets_of(arguments: &OrdersArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        let hard = [Distribution::TwoChains, Distribution::ParabolaInward];
        Distribution::LITERATURE.into_iter().chain(hard).collect()
    } else {
        arguments.sets.clone()
    }
}

/// Prints a text immediately, so that the reader sees a long table grow.
pub(crate) fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

pub(crate) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(|error| format!("{} cannot be written: {error}", path.display()).into())
}
