//! The hardware side's command: export of the core to Verilog.

use clap::{Parser, Subcommand, ValueEnum};
use incircle_hdl::committed::{self, Top};
use incircle_protocol::{Config, LinkConfig, NAMED, SILENCE_MS};
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
    /// Write the Verilog of the core, or of a whole device.
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
        /// What to export: the core with its two streams of words, or the core behind a serial link.
        #[arg(long, value_enum, default_value = "core", requires = "config")]
        top: TopName,
        /// Clock of the serial link in Hz.
        #[arg(long, default_value_t = 125_000_000)]
        clock_hz: u32,
        /// Bytes of the serial link's receive FIFO: a power of two.
        #[arg(long, default_value_t = 4_096)]
        fifo_bytes: u32,
    },
}

#[derive(Clone, Copy, ValueEnum)]
enum TopName {
    /// incircle_core
    Core,
    /// incircle_serial_top
    Serial,
}

fn config(name: &str) -> Result<Config, String> {
    let names = NAMED.map(|config| config.name).join(", ");
    Config::named(name).ok_or_else(|| format!("there is no configuration of this name: choose one of {names}"))
}

fn main() -> ExitCode {
    let Command::Export { config, out, probe, top, clock_hz, fifo_bytes } = Arguments::parse().command;
    let top = match top {
        TopName::Core => Top::Core,
        TopName::Serial => Top::Serial(LinkConfig { clock_hz, fifo_bytes, silence_ms: SILENCE_MS }),
    };
    let result = match config {
        None => committed::renew().map(|files| {
            for file in files {
                println!("{}", file.display());
            }
        }),
        Some(config) => committed::write(config, top, probe, out),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("incircle-hdl: {error}");
            ExitCode::FAILURE
        }
    }
}
