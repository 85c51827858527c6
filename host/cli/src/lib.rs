//! The command `incircle` as a library, so that tests, benchmarks and `incircle-mpi` can use its file formats,
//! generators and failures.
//!
//! [`formats`] reads points and writes meshes, [`generate`] makes point sets, and [`run`] is the whole command with the
//! exit codes of [`Exit`].
#![warn(missing_docs)]

mod arguments;
mod backend;
mod bench_report;
mod cells;
mod commands;
mod connections;
mod failure;
mod fit;
mod fleet;
pub mod formats;
mod geotiff;
mod grid;
mod help;
mod image;
mod input;
mod interrupt;
mod lattice;
mod lines;
mod memory;
mod number;
mod numbers;
mod output;
mod path;
mod plan;
mod planned;
mod player;
mod points;
mod progress;
mod proof;
mod refusal;
mod report;
mod script;
#[cfg(feature = "sim")]
mod sim_backend;
mod snapping;
mod solve;
mod source;
mod step;
mod text;
mod tiles;
mod trace;
mod value_places;
mod value_writer;
mod values;
mod watch;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

pub use failure::{Exit, Failure};
pub use incircle_testkit as generate;
pub use input::Input;
pub use memory::Memory;
pub use number::Coordinate;
pub use points::{Coordinates, Place, PointTable, Unit};
pub use tiles::{canonical, euler, scattered, Extent, Ground};

use arguments::{Cli, Command};

/// Runs the command with these arguments, the program's name first, and returns its exit code. Never panics.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(refusal) => {
            // Nobody can be told that standard output is closed.
            let _ = refusal.print();
            return ExitCode::from(if refusal.use_stderr() { Exit::Usage as u8 } else { 0 });
        }
    };
    let result = interrupt::watch().and_then(|()| match &cli.command {
        Command::Triangulate(arguments) => commands::triangulate::run(arguments),
        Command::Verify(arguments) => commands::verify::run(arguments),
        Command::Generate(arguments) => commands::generate::run(arguments),
        Command::Bench(arguments) => commands::bench::run(arguments),
        Command::Tile(arguments) => commands::tile::run(arguments),
        Command::Replay(arguments) => commands::replay::run(arguments),
        Command::Voronoi(arguments) => commands::voronoi::run(arguments),
        Command::Interpolate(arguments) => commands::interpolate::run(arguments),
        Command::Lloyd(arguments) => commands::lloyd::run(arguments),
        Command::Info(arguments) => commands::info::run(arguments),
        Command::Devices(arguments) => commands::devices::run(arguments),
        Command::Completions(arguments) => commands::completions::run(arguments),
        Command::Man(arguments) => commands::man::run(arguments),
    });
    match result.and_then(|()| interrupt::done()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // An interrupt may surface as any other failure, and then counts as an interrupt.
            let failure = interrupt::check().err().unwrap_or(failure);
            interrupt::tell(&failure);
            ExitCode::from(failure.exit as u8)
        }
    }
}
