//! The hardware side's command: export of the core to Verilog.

use clap::{Parser, Subcommand};
use incircle_hdl::committed;
use incircle_protocol::{Config, NAMED};
use std::path::PathBuf;
use std::process::ExitCode;

/// The incircle core: export to Verilog.
#[derive(Parser)]
#[command(name = "incircle-hdl", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Write the Verilog of the core.
    ///
    /// Without options this renews the files that the repository holds, hdl/verilog/incircle_*.v.
    Export {
        /// Configuration: tiny, small, full or large. Default: those the repository holds.
        #[arg(long, value_parser = config)]
        config: Option<Config>,
        /// File to write; `-` is standard output. Needs --config.
        #[arg(short, long, requires = "config")]
        out: Option<PathBuf>,
        /// Add the write port of the triangle memory to the ports, for simulation.
        #[arg(long, requires = "config")]
        probe: bool,
    },
}

fn config(name: &str) -> Result<Config, String> {
    let names = NAMED.map(|config| config.name).join(", ");
    Config::named(name).ok_or_else(|| format!("there is no configuration of this name: choose one of {names}"))
}

fn main() -> ExitCode {
    let Command::Export { config, out, probe } = Arguments::parse().command;
    let result = match config {
        None => committed::renew().map(|files| {
            for file in files {
                println!("{}", file.display());
            }
        }),
        Some(config) => committed::write(config, probe, out),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("incircle-hdl: {error}");
            ExitCode::FAILURE
        }
    }
}
