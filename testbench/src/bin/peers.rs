//! Measures this triangulator and others side by side, in one run. The arguments are listed by
//! `cargo run --release -p incircle-testbench --bin peers -- --help`.

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
