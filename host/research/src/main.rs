//! Research as a command.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use incircle_research::{figures, orders, picture, FiguresArguments, OrdersArguments, PictureArguments};

/// Orders of insertion of the literature, measured
#[derive(Debug, Parser)]
#[command(name = "incircle-research", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare orders of insertion: time to order, walk steps, tests and cavity of an insertion, cycles of the core,
    /// time in all
    Orders(OrdersArguments),
    /// Draw an order: a line from each point to the next
    Draw(PictureArguments),
    /// Make all published figures of the orders again: the table, the ranking, the guided walks
    Figures(FiguresArguments),
}

fn main() -> ExitCode {
    let result = match &Cli::parse().command {
        Command::Orders(arguments) => orders(arguments),
        Command::Draw(arguments) => picture(arguments),
        Command::Figures(arguments) => figures(arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("incircle-research: {failure}");
            ExitCode::from(2)
        }
    }
}
