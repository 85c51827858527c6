//! Compares triangulators in one run: `cargo run --release -p incircle-testbench --bin peers -- --help`.

use std::process::ExitCode;

use clap::Parser;
use incircle_testbench::peers::{compare, Arguments};

fn main() -> ExitCode {
    match compare(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("peers: {error}");
            ExitCode::FAILURE
        }
    }
}
