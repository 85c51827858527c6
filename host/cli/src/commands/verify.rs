//! `incircle verify`: checks that a mesh is the canonical Delaunay triangulation of its points.

use std::path::Path;

use incircle::constraints::Domain;
use incircle::verify::verify_constrained;
use incircle::{VerifyError, VerifySummary};
use serde_json::{json, Value};

use crate::arguments::{Crossings, GridArguments, VerifyArguments};
use crate::backend::MODEL_COORD_BITS;
use crate::commands::verdict::{Kind, Seen, Verdict};
use crate::commands::verify_large;
use crate::failure::Failure;
use crate::lattice::{Laid, Numbers};
use crate::plan::{self, Request};
use crate::report::quantization_json;
use crate::{lattice, path, refusal, snapping, source};

/// Runs the subcommand. A wrong mesh leads to exit code 1.
pub fn run(arguments: &VerifyArguments) -> Result<(), Failure> {
    let (points, mesh) = arguments.files()?;
    if let Some(memory) = arguments.memory {
        return verify_large::run(arguments, memory);
    }
    if points.iter().any(|path| path::is_standard(path)) && path::is_standard(mesh) {
        return Err(Failure::usage(
            "points and mesh cannot both come from standard input: name a file for one of them",
        ));
    }
    let points_name = source::set_name(points);
    if arguments.script {
        let [script] = points else {
            return Err(Failure::usage("a mesh is that of one script: give one script, and then the file of the mesh"));
        };
        return run_script(arguments, script, mesh);
    }
    let set = plan::read_set(points, &arguments.read, &arguments.plan, arguments.quiet)?;
    let GridArguments { coord_bits, quantize } = arguments.grid.checked()?;
    let how = quantize.map(|how| (how, coord_bits.unwrap_or(MODEL_COORD_BITS)));
    let in_file = |failure: Failure| failure.in_file(&points_name);
    let (set, how) = match arguments.plan.crossings {
        Crossings::Reject => (set, how),
        Crossings::Snap => {
            let (set, snapping) = snapping::snap_set(set, how).map_err(in_file)?;
            (set, how.filter(|_| snapping.is_none()))
        }
    };
    let laid = lattice::lay(&set.table, how).map_err(in_file)?;
    let names = [&*path::name(mesh), &*points_name];
    let request = set.request.as_ref();
    let kind = if request.is_some() { Kind::Constrained } else { Kind::Canonical };
    let verdict = Verdict { kind, names, json: arguments.json, quiet: arguments.quiet };
    let checked = read_triangles(arguments, mesh).and_then(|triangles| match request {
        Some(request) => {
            let named = (&set, &*points_name);
            let checked = check_planned(&laid.numbers, set.points, request, &triangles);
            let summary = checked.map_err(|error| match refusal::of_plan(error) {
                Ok(error) => request.refuse(error, named, &laid),
                Err(error) => verdict.rejected(&format!("{error}{}", hint(arguments, request))),
            })?;
            request.check_holes(named, &laid).map(|()| summary)
        }
        None => check(&laid.numbers, &triangles).map_err(|error| verdict.rejected(&error.to_string())),
    });
    verdict.tell(checked.map(|summary| seen(&summary, &laid)))
}

/// What a message adds if the mesh may be that of another domain.
fn hint(arguments: &VerifyArguments, request: &Request) -> String {
    match arguments.plan.domain {
        None if request.domain != Domain::All => format!(
            " (the domain is '{}', because --domain is not given: give the one with which the mesh was made)",
            request.domain
        ),
        _ => String::new(),
    }
}

/// Reads the triangles of the mesh.
fn read_triangles(arguments: &VerifyArguments, mesh: &Path) -> Result<Vec<[u32; 3]>, Failure> {
    let mut triangles = source::read_mesh(mesh, arguments.format, arguments.quiet)?;
    if arguments.unordered {
        triangles.sort_unstable();
    }
    Ok(triangles)
}

/// Verifies the mesh that a script leaves, which names points by the numbers of their insertions.
fn run_script(arguments: &VerifyArguments, path: &Path, mesh: &Path) -> Result<(), Failure> {
    let name = path::name(path);
    let in_file = |failure: Failure| failure.in_file(&name);
    let script = source::read_script(path, arguments.quiet)?;
    let laid = lattice::lay(&script.places, None).map_err(in_file)?;
    let living = script.living();
    let numbers = laid.numbers.select(&script.last_places(&living));
    let names = [&*path::name(mesh), &*name];
    let request = Request::of_constraints(script.last_constraints(&living));
    let kind = if request.has_constraints() { Kind::Constrained } else { Kind::Canonical };
    let verdict = Verdict { kind, names, json: arguments.json, quiet: arguments.quiet };
    let checked = read_triangles(arguments, mesh).and_then(|triangles| {
        check_living(&numbers, &living, &request, &triangles).map_err(|reason| verdict.rejected(&reason))
    });
    verdict.tell(checked.map(|summary| seen(&summary, &laid)))
}

/// Verifies triangles that name points by the numbers of their insertions. `living` has the numbers of the points.
fn check_living(
    numbers: &Numbers<'_>,
    living: &[u32],
    request: &Request,
    triangles: &[[u32; 3]],
) -> Result<VerifySummary, String> {
    let rank = |index: u32| {
        let found = living.binary_search(&index);
        let rank = found.map_err(|_| format!("a triangle has the point {index}, which does not live at the end"))?;
        Ok::<u32, String>(rank as u32)
    };
    let ranks = |&[a, b, c]: &[u32; 3]| Ok([rank(a)?, rank(b)?, rank(c)?]);
    let triangles: Vec<[u32; 3]> = triangles.iter().map(ranks).collect::<Result<_, String>>()?;
    let words = "the living points counted from 0 in the order of their indices";
    if request.has_constraints() {
        let checked = check_planned(numbers, living.len(), request, &triangles);
        return checked.map_err(|error| format!("{error} ({words})"));
    }
    check(numbers, &triangles).map_err(|error| format!("{error} ({words})"))
}

/// Verifies triangles in the numbers of their points.
fn check(numbers: &Numbers<'_>, triangles: &[[u32; 3]]) -> Result<VerifySummary, VerifyError> {
    match numbers {
        Numbers::Grid(points) => incircle::verify(points, triangles),
        Numbers::Whole(points) => incircle::verify(points, triangles),
        Numbers::Doubles(points) => incircle::verify(points, triangles),
    }
}

/// Verifies triangles with the constraints and the domain of a request. The places of holes stand behind the points.
fn check_planned(
    numbers: &Numbers<'_>,
    points: usize,
    request: &Request,
    triangles: &[[u32; 3]],
) -> Result<VerifySummary, VerifyError> {
    match numbers {
        Numbers::Grid(all) => verify_constrained(&all[..points], triangles, &request.plan(all, points)),
        Numbers::Whole(all) => verify_constrained(&all[..points], triangles, &request.plan(all, points)),
        Numbers::Doubles(all) => verify_constrained(&all[..points], triangles, &request.plan(all, points)),
    }
}

/// The counts of a mesh that is right, with its lattice.
fn seen(summary: &VerifySummary, laid: &Laid<'_>) -> Seen {
    let [points, triangles, hull, ties] = [summary.points, summary.triangles, summary.hull.len(), summary.ties];
    Seen { counts: [points, triangles, hull, ties], report: to_json(summary, laid) }
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
