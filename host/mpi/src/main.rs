//! One Delaunay triangulation on many machines: tiles, whose points and borders travel by MPI.
//!
//! All processes run this program. MPI numbers them from 0, and calls the number of a process its rank. [`run`] has the
//! steps, and each step is a module: [`slice`], [`cuts`], [`exchange`], [`climb`], [`ordering`], [`folder`].
//! [`incircle::tiles`] has the computations of the steps; the code here carries points and borders from rank to rank.

mod arguments;
mod climb;
mod cuts;
mod exchange;
mod folder;
mod nodes;
mod ordering;
mod report;
mod run;
mod slice;
mod world;

use std::process::ExitCode;

use clap::Parser;
use incircle_cli::Exit;

use arguments::{Cli, Command};
use world::World;

fn main() -> ExitCode {
    // MPI may take arguments of its own, so it begins before they are read.
    let Some(universe) = mpi::initialize() else {
        eprintln!("incircle-mpi: MPI does not start: run the program with mpirun, mpiexec or srun");
        return ExitCode::from(Exit::Device as u8);
    };
    let world = World::new(universe.world());
    let code = match Cli::try_parse() {
        Ok(Cli { command: Command::Triangulate(arguments) }) => run::triangulate(&world, &arguments),
        Err(refusal) => {
            if world.is_first() {
                // Nobody can be told that standard output is closed.
                let _ = refusal.print();
            }
            Err(if refusal.use_stderr() { Exit::Usage as u8 } else { 0 })
        }
    };
    code.map_or_else(ExitCode::from, |()| ExitCode::SUCCESS)
}
