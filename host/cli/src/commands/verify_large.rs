//! `incircle verify --memory`: the check of a mesh that is larger than the memory.

use std::path::Path;

use incircle::Step;
use serde_json::{json, Value};

use crate::arguments::VerifyArguments;
use crate::commands::verdict::{Kind, Seen, Verdict};
use crate::failure::Failure;
use crate::formats::MeshFormat;
use crate::lattice::{self, Laid, Numbers};
use crate::memory::Memory;
use crate::path::{self, Compression};
use crate::proof::{self, Plan, Proven};
use crate::tiles::{Ground, Length};
use crate::{number, output, source};

/// Checks a mesh within a memory of so many bytes.
pub fn run(arguments: &VerifyArguments, memory: u64) -> Result<(), Failure> {
    let (points, mesh) = arguments.files()?;
    if arguments.plan.is_given() {
        return Err(Failure::usage("a mesh with constraints is checked in memory: leave --memory out"));
    }
    let format = format_of(mesh, arguments.format)?;
    let folder = arguments.scratch.as_deref().unwrap_or_else(|| output::folder_of(mesh));
    let (mesh_name, points_name) = (path::name(mesh), source::set_name(points));
    let verdict = Verdict {
        kind: Kind::Canonical,
        names: [&mesh_name, &points_name],
        json: arguments.json,
        quiet: arguments.quiet,
    };
    let proven = proof::prove(&Plan {
        points,
        read: &arguments.read,
        mesh,
        format,
        is_unordered: arguments.unordered,
        memory,
        scratch: folder,
        quiet: arguments.quiet,
    });
    verdict.tell(proven.and_then(|proven| match proven {
        Ok(proven) => Ok(seen(&proven, memory)),
        Err(error) => Err(verdict.rejected(&error.to_string())),
    }))
}

/// The format of a mesh that can be read in pieces, more than once.
fn format_of(mesh: &Path, format: Option<MeshFormat>) -> Result<MeshFormat, Failure> {
    if path::is_standard(mesh) {
        return Err(Failure::usage("with --memory the mesh is read more than once: give a file instead of '-'"));
    }
    let format = source::mesh_format(mesh, format)?;
    if !format.is_streamed() {
        return Err(Failure::usage(
            "a mesh of this format is read as a whole: leave --memory out, or write the mesh as npy, csv or ele",
        ));
    }
    if format == MeshFormat::Npy && Compression::of(mesh) != Compression::None {
        let name = path::name(mesh);
        return Err(Failure::usage(format!("{name} is packed, and --memory needs to read any part of it: unpack it")));
    }
    Ok(format)
}

fn seen(proven: &Proven, memory: u64) -> Seen {
    let Proven { points, distinct, triangles, edges, ties, hull, collinear, ground } = *proven;
    let report = json!({
        "valid": true,
        "points": points,
        "distinct": distinct,
        "duplicates": points - distinct,
        "triangles": triangles,
        "edges": edges,
        "ties": ties,
        "hull": hull,
        "collinear": collinear,
        "lattice": lattice_json(&ground),
        "quantisation": null,
        "memory": memory,
        "peak_memory": Memory::peak(),
    });
    Seen { counts: [points, triangles, hull, ties].map(|count| count as usize), report }
}

/// The lattice as the check in memory tells it.
fn lattice_json(ground: &Ground) -> Value {
    let Ground { length, offset, bits } = *ground;
    let (kind, offset) = match length {
        Length::Decimal(0) => (lattice::Kind::Whole, json!(offset.map(|steps| steps as i64))),
        Length::Decimal(digits) => {
            let exponent = -digits.cast_signed();
            (lattice::Kind::Decimal(1, exponent), json!(offset.map(|steps| number::nearest(steps, digits))))
        }
        Length::Binary(exponent) => {
            let step = Step::Binary { exponent }.length();
            (lattice::Kind::Binary(exponent), json!(offset.map(|steps| steps as f64 * step)))
        }
    };
    Laid { numbers: Numbers::Grid(Vec::new()), kind, bits: Some(bits), offset }.to_json()
}
