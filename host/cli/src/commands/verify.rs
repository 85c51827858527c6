//! `incircle verify`: checks that a mesh is the canonical Delaunay triangulation of its points.

use incircle::{VerifyError, VerifySummary};
use serde_json::{json, Value};

use crate::arguments::{GridArguments, VerifyArguments};
use crate::backend::MODEL_COORD_BITS;
use crate::failure::{counted, Exit, Failure};
use crate::lattice::{Laid, Numbers};
use crate::report::quantization_json;
use crate::{lattice, output, path, source};

/// Runs the subcommand. A wrong mesh leads to exit code 1.
pub fn run(arguments: &VerifyArguments) -> Result<(), Failure> {
    if path::is_standard(&arguments.points) && path::is_standard(&arguments.mesh) {
        return Err(Failure::usage(
            "points and mesh cannot both come from standard input: name a file for one of them",
        ));
    }
    let points_name = path::name(&arguments.points);
    if arguments.script {
        return run_script(arguments, &points_name);
    }
    let table = source::read_points(&arguments.points, &arguments.read, arguments.quiet)?;
    let GridArguments { coord_bits, quantize } = arguments.grid.checked()?;
    let how = quantize.map(|how| (how, coord_bits.unwrap_or(MODEL_COORD_BITS)));
    let laid = lattice::lay(&table, how).map_err(|failure| failure.in_file(&points_name))?;
    let checked = source::read_mesh(&arguments.mesh, arguments.format, arguments.quiet).and_then(|triangles| {
        check(&laid.numbers, &triangles).map_err(|error| rejected(&error.to_string(), &points_name, arguments))
    });
    tell(checked, &laid, &points_name, arguments)
}

/// Verifies the mesh that a script leaves, which names points by the numbers of their insertions.
fn run_script(arguments: &VerifyArguments, name: &str) -> Result<(), Failure> {
    let in_file = |failure: Failure| failure.in_file(name);
    let script = source::read_script(&arguments.points, arguments.quiet)?;
    let laid = lattice::lay(&script.places, None).map_err(in_file)?;
    let living = script.living();
    let numbers = laid.numbers.select(&script.last_places(&living));
    let checked = source::read_mesh(&arguments.mesh, arguments.format, arguments.quiet).and_then(|triangles| {
        check_living(&numbers, &living, &triangles).map_err(|reason| rejected(&reason, name, arguments))
    });
    tell(checked, &laid, name, arguments)
}

/// Verifies triangles that name points by the numbers of their insertions. `living` has the numbers of the points.
fn check_living(numbers: &Numbers<'_>, living: &[u32], triangles: &[[u32; 3]]) -> Result<VerifySummary, String> {
    let rank = |index: u32| {
        let found = living.binary_search(&index);
        let rank = found.map_err(|_| format!("a triangle has the point {index}, which does not live at the end"))?;
        Ok::<u32, String>(rank as u32)
    };
    let ranks = |&[a, b, c]: &[u32; 3]| Ok([rank(a)?, rank(b)?, rank(c)?]);
    let triangles: Vec<[u32; 3]> = triangles.iter().map(ranks).collect::<Result<_, String>>()?;
    let words = "the living points counted from 0 in the order of their indices";
    check(numbers, &triangles).map_err(|error| format!("{error} ({words})"))
}

/// The failure of a mesh that is not the one of these points.
fn rejected(reason: &str, points_name: &str, arguments: &VerifyArguments) -> Failure {
    let mesh_name = path::name(&arguments.mesh);
    Failure::new(
        Exit::Rejected,
        format!("the triangles of {mesh_name} are not the canonical Delaunay triangulation of {points_name}: {reason}"),
    )
}

/// Prints the result. A wrong mesh is a failure.
fn tell(
    checked: Result<VerifySummary, Failure>,
    laid: &Laid<'_>,
    points_name: &str,
    arguments: &VerifyArguments,
) -> Result<(), Failure> {
    let mesh_name = path::name(&arguments.mesh);
    let summary = match checked {
        Ok(summary) => summary,
        Err(failure) => {
            if arguments.json && failure.exit == Exit::Rejected {
                output::print(&format!("{}\n", json!({ "valid": false, "reason": failure.message })))?;
            }
            return Err(failure);
        }
    };
    if arguments.json {
        output::print(&format!("{}\n", to_json(&summary, laid)))
    } else if arguments.quiet {
        Ok(())
    } else {
        output::print(&format!(
            "the triangles of {mesh_name} are the canonical Delaunay triangulation of {points_name}: {}, {}, {} on the \
             hull, {}\n",
            counted(summary.points, "point"),
            counted(summary.triangles, "triangle"),
            counted(summary.hull.len(), "point"),
            counted(summary.ties, "tie")
        ))
    }
}

/// Verifies triangles in the numbers of their points.
fn check(numbers: &Numbers<'_>, triangles: &[[u32; 3]]) -> Result<VerifySummary, VerifyError> {
    match numbers {
        Numbers::Grid(points) => incircle::verify(points, triangles),
        Numbers::Whole(points) => incircle::verify(points, triangles),
        Numbers::Doubles(points) => incircle::verify(points, triangles),
    }
}

fn to_json(summary: &VerifySummary, laid: &Laid<'_>) -> Value {
    json!({
        "valid": true,
        "points": summary.points,
        "distinct": summary.distinct,
        "duplicates": summary.duplicates,
        "triangles": summary.triangles,
        "edges": summary.edges,
        "ties": summary.ties,
        "hull": summary.hull.len(),
        "collinear": summary.collinear,
        "lattice": laid.to_json(),
        "quantisation": laid.quantization().map(quantization_json),
    })
}
