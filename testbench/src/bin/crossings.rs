//! Lists what crosses between the two clocks of a core behind a stream link. The exit code is 0 only if every crossing
//! goes through a synchroniser or the memory of a FIFO.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use incircle_hdl::export;
use incircle_hdl::top::STREAM_TOP_NAME;
use incircle_protocol::{Config, NAMED};
use incircle_testbench::crossings::{crossings, stream_port_clock, Way};

/// List the signals that cross between the clocks of a core behind a stream link
#[derive(Parser)]
#[command(after_help = "Example:\n  crossings --config full --width 128")]
struct Arguments {
    /// Configuration of the core: tiny, small, full, large, dual or quad
    #[arg(long, default_value = "tiny", value_parser = config)]
    config: Config,
    /// Bits of a beat: 64 or 128
    #[arg(long, default_value_t = 64)]
    width: u32,
}

fn config(name: &str) -> Result<Config, String> {
    let names = NAMED.map(|config| config.name).join(", ");
    Config::named(name).ok_or_else(|| format!("there is no configuration of this name: choose one of {names}"))
}

fn run(Arguments { config, width }: &Arguments) -> Result<usize, Box<dyn Error>> {
    let found = crossings(&export::stream_top(*config, *width, false)?, STREAM_TOP_NAME, stream_port_clock)?;
    found.iter().for_each(|crossing| println!("{crossing}"));
    Ok(found.iter().filter(|crossing| crossing.way == Way::Fault).count())
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(faults) => {
            eprintln!("crossings: {faults} of these are neither in a synchroniser nor in a FIFO's memory");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("crossings: {error}");
            ExitCode::FAILURE
        }
    }
}
