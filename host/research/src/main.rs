//! The command `incircle-research`.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use incircle_research::{figures, holes, living, orders, picture, plans, runs, tracks, values};
use incircle_research::{FiguresArguments, HolesArguments, LivingArguments};
use incircle_research::{
    OrdersArguments, PictureArguments, PlansArguments, RunsArguments, TracksArguments, ValuesArguments,
};

/// Measure and draw the orders of insertion of the literature
#[derive(Debug, Parser)]
#[command(name = "incircle-research", version, after_help = "Example:\n  incircle-research orders uniform -n 4096")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare orders of insertion in a table
    ///
    /// For each order the table has the time to order, the walk steps, tests and removed triangles of an insertion, the
    /// cycles of the core, and the total time.
    #[command(after_help = "Example:\n  incircle-research orders uniform kuzmin --order hilbert,brio-peano")]
    Orders(OrdersArguments),
    /// Draw an order as a line from each point to the next
    #[command(after_help = "Example:\n  incircle-research draw lattice -n 256 --order peano -o peano.svg")]
    Draw(PictureArguments),
    /// Make all published figures again: the table, the ranking, the guided walks
    #[command(after_help = "Example:\n  incircle-research figures --out figures")]
    Figures(FiguresArguments),
    /// Compare the triangulation that lives with spade and, where it is installed, CGAL
    #[command(after_help = "Example:\n  incircle-research living -n 100000")]
    Living(LivingArguments),
    /// Count the tests of four ways to fill the hole of a deleted vertex, by its number of neighbours
    #[command(after_help = "Example:\n  incircle-research holes -n 20000")]
    Holes(HolesArguments),
    /// Compare constrained triangulation with spade and, where they are installed, CGAL and CDT
    #[command(after_help = "Example:\n  incircle-research plans -n 100000")]
    Plans(PlansArguments),
    /// Count the cycles of questions and changes of a standing mesh on the model of the core, clock by clock
    #[command(after_help = "Example:\n  incircle-research runs uniform --random")]
    Runs(RunsArguments),
    /// Count the cycles of a mesh of features that a camera tracks, beside a mesh made anew and the processor
    #[command(after_help = "Example:\n  incircle-research tracks -n 4000")]
    Tracks(TracksArguments),
    /// Count the values between points a second, beside those of CGAL where it is installed
    #[command(after_help = "Example:\n  incircle-research values -n 1000000 --threads 2")]
    Values(ValuesArguments),
}

fn main() -> ExitCode {
    let result = match &Cli::parse().command {
        Command::Orders(arguments) => orders(arguments),
        Command::Draw(arguments) => picture(arguments),
        Command::Figures(arguments) => figures(arguments),
        Command::Living(arguments) => living(arguments),
        Command::Holes(arguments) => holes(arguments),
        Command::Plans(arguments) => plans(arguments),
        Command::Runs(arguments) => runs(arguments),
        Command::Tracks(arguments) => tracks(arguments),
        Command::Values(arguments) => values(arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("incircle-research: {failure}");
            ExitCode::from(2)
        }
    }
}
