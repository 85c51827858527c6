//! `incircle generate`: point sets by name.

use incircle::MAX_POINTS;

use crate::arguments::GenerateArguments;
use crate::failure::{Exit, Failure};
use crate::formats::{csv, extension, node, xyz, PointFormat};
use crate::generate::{generate, GenerateError};
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
    let n = arguments.n as usize;
    if n > MAX_POINTS {
        return Err(Failure::usage(format!(
            "-n {n} is more than the {MAX_POINTS} points that a job may have: choose fewer"
        )));
    }
    let output = Output::prepare(path, None)?;
    let points = generate(arguments.distribution, n, arguments.bits, arguments.seed);
    let points = points.map_err(|error| {
        let exit = match error {
            GenerateError::Bits(_) => Exit::Usage,
            GenerateError::Memory(_) => Exit::Capacity,
        };
        Failure::new(exit, error.to_string())
    })?;
    let written = output.write(|out| write_points(&points, out))?;
    output::finish([written], || Ok(()))
}
