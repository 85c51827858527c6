//! `incircle generate`: point sets by name.

use incircle::MAX_POINTS;

use crate::arguments::GenerateArguments;
use crate::failure::{Exit, Failure};
use crate::formats::{csv, extension, node, xyz, PointFormat};
use crate::generate::{generate, Distribution, GenerateError};
use crate::output::{self, Output};
use crate::source;

/// Runs the subcommand.
pub fn run(arguments: &GenerateArguments) -> Result<(), Failure> {
    let path = arguments.output.as_path();
    // What has no extension (standard output, a device) takes CSV.
    let format = match extension(path) {
        "" => Some(PointFormat::Csv),
        extension => PointFormat::of_extension(extension),
    };
    let write_points = match format {
        Some(PointFormat::Csv) => csv::write_points,
        Some(PointFormat::Xyz) => xyz::write_points,
        Some(PointFormat::Node) => node::write_points,
        _ => {
            return Err(Failure::usage(format!("{}: points are written as .csv, .xyz or .node", source::name(path))));
        }
    };
    check_count(arguments.n)?;
    let output = Output::prepare(path, None)?;
    let points = make(arguments.distribution, arguments.n, arguments.bits, arguments.seed)?;
    let written = output.write(|out| write_points(&points, out))?;
    output::finish([written], || Ok(()))
}

/// Refuses more points than a job may have.
pub fn check_count(n: u32) -> Result<(), Failure> {
    if n as usize > MAX_POINTS {
        return Err(Failure::usage(format!(
            "-n {n} is more than the {MAX_POINTS} points that a job may have: choose fewer"
        )));
    }
    Ok(())
}

/// The points of a set, or a sentence.
pub fn make(distribution: Distribution, n: u32, bits: u32, seed: u64) -> Result<Vec<[u32; 2]>, Failure> {
    generate(distribution, n as usize, bits, seed).map_err(|error| {
        let exit = match error {
            GenerateError::Bits(_) => Exit::Usage,
            GenerateError::Memory(_) => Exit::Capacity,
        };
        Failure::new(exit, error.to_string())
    })
}
