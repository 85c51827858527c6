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
    let (points, mesh) = arguments.files()?;
    if points.iter().any(|path| path::is_standard(path)) && path::is_standard(mesh) {
        return Err(Failure::usage(
            "points and mesh cannot both come from standard input: name a file for one of them",
        ));
    }
    let table = source::read_set(points, &arguments.read, arguments.quiet)?;
    let points_name = source::set_name(points);
    let GridArguments { coord_bits, quantize } = arguments.grid.checked()?;
    let how = quantize.map(|how| (how, coord_bits.unwrap_or(MODEL_COORD_BITS)));
    let laid = lattice::lay(&table, how).map_err(|failure| failure.in_file(&points_name))?;
    let mesh_name = path::name(mesh);
    let checked = source::read_mesh(mesh, arguments.format, arguments.quiet).and_then(|mut triangles| {
        if arguments.unordered {
            triangles.sort_unstable();
        }
        check(&laid.numbers, &triangles).map_err(|error| {
            Failure::new(
                Exit::Rejected,
                format!(
                    "the triangles of {mesh_name} are not the canonical Delaunay triangulation of {points_name}: \
                     {error}"
                ),
            )
        })
    });
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
        output::print(&format!("{}\n", to_json(&summary, &laid)))
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
