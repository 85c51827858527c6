//! `incircle tile`: a set in tiles over files. The work is in [`crate::tiles`].

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use incircle::{Mesh, Options, Point};
use serde_json::json;

use crate::arguments::{JobArguments, JoinArguments, LocalArguments, SplitArguments, TileArguments, TileCommand};
use crate::backend::{self, Choice};
use crate::failure::{counted, failure_of, Failure};
use crate::formats::{MeshFormat, MeshView};
use crate::output::{self, Output};
use crate::progress::Meter;
use crate::tiles::{self, Budget, JoinMemory, Joined, Manifest, Order, Outcome, Plan, Summary, TileAt};
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
    if path::is_standard(&arguments.output) {
        return Err(Failure::usage("tiles are files, which do not go to standard output: give -o a folder"));
    }
    let budget = Budget::of_tiles(NonZeroUsize::new(arguments.points as usize).unwrap_or(NonZeroUsize::MIN));
    let plan = Plan {
        inputs: &arguments.inputs,
        read: &arguments.read,
        most: budget.most,
        folder: &arguments.output,
        sample: budget.sample,
        buffers: budget.buffers,
        check: &|_| Ok(()),
        quiet: arguments.quiet,
    };
    tiles::split(&plan, |summary| {
        tell_split(summary, arguments)?;
        interrupt::done()
    })
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
    let job = JobArguments { contexts: None, order: None, timeout: arguments.timeout };
    let mut triangulate = |points: &[Point], bits: u32| {
        triangulate_tile(points, bits, &choice, &job, arguments.quiet).map_err(|f| f.in_file(&name))
    };
    tiles::local(&at, &mut triangulate, |outcome| {
        tell_local(&at, outcome, arguments)?;
        interrupt::done()
    })
}

/// Does a job of three points, so that a back end that is absent or cannot do what is asked ends the run before the set
/// is read.
pub fn check_backend(choice: &Choice, job: &JobArguments) -> Result<(), Failure> {
    let points = [[0, 0], [1, 0], [0, 1]].map(|[x, y]| Point::new(x, y));
    let mut backend = backend::open_with_room(choice, None, None, job.timeout)?;
    backend.check_job(job)?;
    let solution = interrupt::working(|| {
        let mut session = backend.device.session()?;
        session.triangulate_with(&points, &Options::default().timeout(job.timeout).contexts(job.contexts))
    });
    interrupt::check()?;
    solution.map(drop).map_err(|error| failure_of(&error))
}

/// Triangulates the points of a tile, which need so many bits, with the back end.
pub fn triangulate_tile(
    points: &[Point],
    bits: u32,
    choice: &Choice,
    job: &JobArguments,
    quiet: bool,
) -> Result<Mesh, Failure> {
    let room = if choice.is_core() { backend::count_distinct(points) } else { points.len() };
    let mut backend = backend::open_with_room(choice, Some(room), None, job.timeout)?;
    backend.check_job(job)?;
    let (name, takes_all) = (backend.name, backend.takes_all_numbers());
    let meter = Meter::new(quiet);
    let listener = |progress| meter.hear(progress);
    let options = job.options(&listener);
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
            counted(finals as usize, "final triangle"),
            counted(border as usize, "point"),
            counted(open as usize, "triangle")
        ));
    }
    Ok(())
}

fn join(arguments: &JoinArguments) -> Result<(), Failure> {
    let format = source::mesh_format(&arguments.output, arguments.format)?;
    let manifest = Manifest::read(&arguments.folder)?;
    let output = Output::prepare(&arguments.output, &files_of(&arguments.folder, &manifest))?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the mesh and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    if arguments.unordered && !format.is_streamed() {
        return Err(Failure::usage("--unordered is for npy, csv and ele only: leave it out, or choose one of them"));
    }
    let order = if arguments.unordered { Order::Unordered } else { Order::Canonical };
    let (folder, keeps_lists) = (&arguments.folder, !format.is_streamed());
    let memory = JoinMemory { sort: arguments.memory, bound: None };
    let joined = tiles::join(folder, &manifest, memory, keeps_lists, arguments.quiet)?;
    let counts = [manifest.points(), joined.duplicates, joined.triangles, joined.hull_points];
    let written = if format.is_streamed() {
        tiles::write_triangles(joined, (folder, &manifest), (order, arguments.memory), format, output, arguments.quiet)?
    } else {
        write_whole(joined, &manifest, format, output, arguments)?
    };
    output::finish([written], || tell_join(counts, manifest.tiles().count(), arguments))
}

/// The files that a mesh must not replace: those of the tiles, and those of the points.
fn files_of(folder: &Path, manifest: &Manifest) -> Vec<PathBuf> {
    let tiles = 0..manifest.tiles().count() as u32;
    let own = tiles.flat_map(|tile| [tiles::points_path(folder, tile), tiles::local_path(folder, tile)]);
    let inputs = manifest.inputs.iter().map(|input| input.path.clone());
    own.chain(inputs).chain([tiles::manifest_path(folder)]).collect()
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
    let triangles = tiles::triangles_of(joined, &arguments.folder, manifest, arguments.memory)?;
    let mesh = MeshView { points: &points, triangles: &triangles, hull: &hull, duplicates: &duplicates, planned: None };
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
