//! `incircle tile`: a set in tiles over files. The work is in [`crate::tiles`].

use std::cell::RefCell;
use std::io::{self, Write};
use std::num::NonZeroUsize;

use incircle::{Mesh, Options, Point};
use serde_json::json;

use crate::arguments::{JoinArguments, LocalArguments, SplitArguments, TileArguments, TileCommand};
use crate::backend::{self, Choice};
use crate::failure::{counted, failure_of, Failure};
use crate::formats::{npy_writer, MeshFormat, MeshView};
use crate::output::{self, Output};
use crate::progress::{CountMeter, Meter};
use crate::tiles::{self, Joined, Manifest, Order, Outcome, Plan, Summary, TileAt};
use crate::{interrupt, path, source};

/// Runs a verb.
pub fn run(arguments: &TileArguments) -> Result<(), Failure> {
    match &arguments.command {
        TileCommand::Split(arguments) => split(arguments),
        TileCommand::Local(arguments) => local(arguments),
        TileCommand::Join(arguments) => join(arguments),
    }
}

fn split(arguments: &SplitArguments) -> Result<(), Failure> {
    let plan = Plan {
        inputs: &arguments.inputs,
        read: &arguments.read,
        most: NonZeroUsize::new(arguments.points as usize).unwrap_or(NonZeroUsize::MIN),
        folder: &arguments.output,
        quiet: arguments.quiet,
    };
    tiles::split(&plan, |summary| tell_split(summary, arguments))
}

fn tell_split(summary: &Summary, arguments: &SplitArguments) -> Result<(), Failure> {
    let Summary { manifest, bytes, was_there } = summary;
    let tiles = manifest.tiles().count();
    let largest = manifest.tiles().map(|(_, points)| points).max().unwrap_or(0);
    let (points, bits) = (manifest.points(), manifest.ground.bits);
    if arguments.json {
        let run = format!("{:016x}", manifest.run);
        let report = json!({
            "run": run, "points": points, "tiles": tiles, "largest": largest, "bits": bits, "bytes": bytes,
            "skipped": was_there,
        });
        return output::print(&format!("{report}\n"));
    }
    if !arguments.quiet {
        let there = if *was_there { ", which were there already" } else { "" };
        output::note(&format!(
            "{} in {} of up to {}{there}; {bits} bits, {bytes} bytes",
            counted(points as usize, "point"),
            counted(tiles, "tile"),
            counted(largest as usize, "point")
        ));
    }
    Ok(())
}

fn local(arguments: &LocalArguments) -> Result<(), Failure> {
    let at = TileAt::of_path(&arguments.tile)?;
    let choice = Choice::of(&arguments.backend, None, "cpu")?;
    let name = path::name(&arguments.tile);
    let mut triangulate =
        |points: &[Point], bits: u32| triangulate(points, bits, &choice, arguments).map_err(|f| f.in_file(&name));
    tiles::local(&at, &mut triangulate, |outcome| tell_local(&at, outcome, arguments))
}

/// Triangulates the points of a tile with the back end.
fn triangulate(points: &[Point], bits: u32, choice: &Choice, arguments: &LocalArguments) -> Result<Mesh, Failure> {
    let room = if choice.is_core() { backend::count_distinct(points) } else { points.len() };
    let mut backend = backend::open_with_room(choice, Some(room), None, arguments.timeout)?;
    let (name, takes_all) = (backend.name, backend.takes_all_numbers());
    let meter = Meter::new(arguments.quiet);
    let listener = |progress| meter.hear(progress);
    let options = Options::default().timeout(arguments.timeout).progress(&listener);
    let solution = interrupt::working(|| {
        let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
        let has = session.identity().coord_bits;
        if bits > has && !takes_all {
            return Err(Failure::input(format!(
                "the tile needs coordinates of {bits} bits, and {name} has {has}: give --backend cpu, or split the \
                 set into smaller tiles"
            )));
        }
        session.triangulate_with(points, &options).map_err(|error| failure_of(&error))
    });
    interrupt::check()?;
    solution.map(|solution| solution.mesh)
}

fn tell_local(at: &TileAt, outcome: &Outcome, arguments: &LocalArguments) -> Result<(), Failure> {
    let Outcome { points, counts: [finals, border, open], was_there } = *outcome;
    if arguments.json {
        let report = json!({
            "tile": at.tile, "points": points, "final": finals, "border": border, "open": open, "skipped": was_there,
        });
        return output::print(&format!("{report}\n"));
    }
    if !arguments.quiet {
        let there = if was_there { "; the file was there already" } else { "" };
        output::note(&format!(
            "tile {}: {}, {}, {} and {} for the join{there}",
            at.tile,
            counted(points as usize, "point"),
            counted(finals, "final triangle"),
            counted(border, "point"),
            counted(open, "triangle")
        ));
    }
    Ok(())
}

/// Formats that need nothing but the triangles, so that these can be written one after the other.
fn is_streamed(format: MeshFormat) -> bool {
    matches!(format, MeshFormat::Npy | MeshFormat::Csv | MeshFormat::Ele)
}

fn join(arguments: &JoinArguments) -> Result<(), Failure> {
    let format = source::mesh_format(&arguments.output, arguments.format)?;
    let output = Output::prepare(&arguments.output, None)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the mesh and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    if arguments.unordered && !is_streamed(format) {
        return Err(Failure::usage("--unordered is for npy, csv and ele only: leave it out, or choose one of them"));
    }
    let manifest = Manifest::read(&arguments.folder)?;
    let order = if arguments.unordered { Order::Unordered } else { Order::Canonical };
    let (folder, keeps_pairs) = (&arguments.folder, !is_streamed(format));
    let joined = tiles::join(folder, &manifest, order, arguments.memory, keeps_pairs, arguments.quiet)?;
    let counts = [manifest.points(), joined.duplicates, joined.triangles, joined.hull.len() as u64];
    let written = if is_streamed(format) {
        stream(joined, &manifest, format, output, arguments)?
    } else {
        write_whole(joined, &manifest, format, output, arguments)?
    };
    output::finish([written], || tell_join(counts, manifest.tiles().count(), arguments))
}

/// Writes the triangles one after the other.
fn stream(
    joined: Joined,
    manifest: &Manifest,
    format: MeshFormat,
    output: Output,
    arguments: &JoinArguments,
) -> Result<output::Written, Failure> {
    let failed = RefCell::new(None);
    let written = output.write(|out| {
        match format {
            MeshFormat::Npy => npy_writer::write_mesh_head(joined.triangles, out)?,
            MeshFormat::Ele => writeln!(out, "{} 3 0", joined.triangles)?,
            _ => {}
        }
        let meter = CountMeter::new(joined.triangles, "writing", "triangles", arguments.quiet);
        let mut id = 0u64;
        let mut disk = None;
        let done = joined.each(&arguments.folder, manifest, &mut |triangles| {
            meter.advance(triangles.len() as u64);
            write_some(triangles, format, &mut id, out).map_err(|error| {
                let failure = Failure::input(error.to_string());
                disk = Some(error);
                failure
            })
        });
        match (done, disk) {
            (Ok(()), _) => Ok(()),
            (_, Some(error)) => Err(error),
            (Err(failure), None) => {
                *failed.borrow_mut() = Some(failure);
                Err(io::Error::other("the tiles cannot be read"))
            }
        }
    });
    // A file that cannot be read is told by its own sentence.
    match failed.into_inner() {
        Some(failure) => Err(failure),
        None => written,
    }
}

fn write_some(triangles: &[[u32; 3]], format: MeshFormat, id: &mut u64, out: &mut dyn Write) -> io::Result<()> {
    match format {
        MeshFormat::Npy => npy_writer::write_triangles(triangles, out),
        MeshFormat::Ele => triangles.iter().try_for_each(|[a, b, c]| {
            *id += 1;
            writeln!(out, "{} {a} {b} {c}", *id - 1)
        }),
        _ => triangles.iter().try_for_each(|[a, b, c]| writeln!(out, "{a},{b},{c}")),
    }
}

/// Writes a mesh with its points, which are read again.
fn write_whole(
    mut joined: Joined,
    manifest: &Manifest,
    format: MeshFormat,
    output: Output,
    arguments: &JoinArguments,
) -> Result<output::Written, Failure> {
    let points = tiles::points_again(manifest, &arguments.read, arguments.quiet)?;
    format.check_points(&points).map_err(|failure| failure.in_file(path::name(&manifest.inputs[0].path)))?;
    let (hull, duplicates) = (std::mem::take(&mut joined.hull), std::mem::take(&mut joined.pairs));
    let triangles = tiles::triangles_of(joined, &arguments.folder, manifest)?;
    let mesh = MeshView { points: &points, triangles: &triangles, hull: &hull, duplicates: &duplicates };
    output.write(|out| format.write(&mesh, out))
}

fn tell_join(
    [points, duplicates, triangles, hull]: [u64; 4],
    tiles: usize,
    arguments: &JoinArguments,
) -> Result<(), Failure> {
    if arguments.json {
        let report = json!({
            "points": points, "distinct": points - duplicates, "duplicates": duplicates, "triangles": triangles,
            "hull": hull, "collinear": triangles == 0, "tiles": tiles,
        });
        return output::print(&format!("{report}\n"));
    }
    if !arguments.quiet {
        output::note(&format!(
            "{} in {}, {}, {} on the hull",
            counted(points as usize, "point"),
            counted(tiles, "tile"),
            counted(triangles as usize, "triangle"),
            counted(hull as usize, "point")
        ));
    }
    Ok(())
}
