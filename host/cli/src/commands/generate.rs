//! `incircle generate`: point sets by name.

use crate::arguments::GenerateArguments;
use crate::failure::Failure;
use crate::formats::{csv, extension, node, xyz, PointFormat};
use crate::generate::generate;
use crate::output::Output;

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
            return Err(Failure::usage(format!(
                "{}: points are written as .csv, .xyz or .node",
                path.display()
            )));
        }
    };
    let output = Output::prepare(path, None)?;
    let n = arguments.n as usize;
    let points = generate(arguments.distribution, n, arguments.bits, arguments.seed);
    let points = points.map_err(|error| Failure::usage(error.to_string()))?;
    output.write(|out| write_points(&points, out))?.finish()
}
