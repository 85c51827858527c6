//! Triangulators beside each other, in one run: `cargo run --release -p incircle-testbench --bin peers -- --help`.

use std::error::Error;

use clap::Parser;
use incircle_testbench::peers::{compare, Arguments};

fn main() -> Result<(), Box<dyn Error>> {
    Ok(compare(&Arguments::parse())?)
}
