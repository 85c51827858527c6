//! All steps of a run.

use std::io::Write;

use incircle_cli::{euler, Failure};

use crate::arguments::TriangulateArguments;
use crate::climb::{Climb, Level};
use crate::cuts;
use crate::exchange;
use crate::folder::Folder;
use crate::nodes::nodes;
use crate::ordering;
use crate::report::{Counts, Log};
use crate::slice;
use crate::world::{Halt, World};

/// Triangulates the points of all inputs, and writes the mesh.
///
/// # Errors
/// Any process failed. The reason has been printed, and no folder has the name of the mesh.
pub fn triangulate(world: &World, arguments: &TriangulateArguments) -> Result<(), Halt> {
    let number = world.gather(&[std::process::id().into()])[0][0];
    let folder = Folder::new(&arguments.output, number);
    world.agree(if world.is_first() { folder.make() } else { Ok(()) })?;
    let done = fill(world, arguments, &folder);
    if done.is_err() {
        if world.is_first() {
            folder.remove();
        }
        // A launcher may end all processes as soon as one has ended with a failure, so all wait for the folder to go.
        world.agree(Ok(()))?;
    }
    done
}

/// Does all steps but the first and the last one of the folder.
fn fill(world: &World, arguments: &TriangulateArguments, folder: &Folder) -> Result<(), Halt> {
    let mut log = Log::new(world.is_first() && !arguments.quiet);
    let slice = slice::read(world, &arguments.inputs)?;
    let points = slice.total;
    log.step(world, "read", &format!("{points} points, "));

    let cuts = cuts::cut(world, &slice, arguments.points);
    log.step(world, "cut", &format!("{} tiles, ", cuts.owners.len()));

    let nodes = nodes(&cuts);
    let tiles = exchange::exchange(world, slice, &cuts);
    let most = world.greatest(tiles.points);
    log.step(world, "exchange", &format!("at most {most} points in a process, "));

    let mut climb = world.agree(Climb::alone(world.rank(), &nodes, tiles))?;
    log.step(world, "local", "");

    climb.together(world, &nodes);
    let (counts, levels) = summed(world, points, &climb);
    world.agree(check(&counts))?;
    log.step(world, "join", "");

    let triangles = ordering::sort(world, climb.finals);
    let lists = world.gather(&[triangles.len() as u64]);
    let counts = Counts { triangles: lists.concat(), ..counts };
    log.step(world, "sort", "");

    world.agree(folder.write(world.rank(), &triangles))?;
    world.agree(if world.is_first() { folder.finish(&counts.to_json()) } else { Ok(()) })?;
    log.step(world, "write", "");
    if world.is_first() {
        tell(arguments, &log, &counts, most, &levels);
    }
    Ok(())
}

/// The counts of the mesh and the levels of the tree, of all processes together.
fn summed(world: &World, points: u64, climb: &Climb) -> (Counts, Vec<Level>) {
    let mut own = vec![climb.finals.len() as u64, climb.duplicates, climb.hull];
    own.extend(climb.levels.iter().flat_map(|level| [level.regions, level.border, level.open, level.bytes]));
    let all = world.sum(&own);
    let (head, rest) = all.split_at(3);
    let levels =
        rest.as_chunks().0.iter().map(|&[regions, border, open, bytes]| Level { regions, border, open, bytes });
    (Counts { points, duplicates: head[1], hull: head[2], triangles: vec![head[0]] }, levels.collect())
}

/// Checks the number of triangles, so that a mistake in the way of a point or border is found.
fn check(counts: &Counts) -> Result<(), Failure> {
    let (distinct, triangles) = (counts.points.saturating_sub(counts.duplicates), counts.sum());
    let expected = euler(distinct, counts.hull, triangles > 0);
    if triangles == expected {
        return Ok(());
    }
    Err(Failure::new(
        incircle_cli::Exit::Device,
        format!(
            "the tiles contradict each other: {triangles} triangles of {distinct} distinct points with {} on the hull \
             should be {expected}; please report this",
            counts.hull
        ),
    ))
}

/// Prints the summary. A closed standard output is no failure.
fn tell(arguments: &TriangulateArguments, log: &Log, counts: &Counts, most: u64, levels: &[Level]) {
    if arguments.json {
        let _ = writeln!(std::io::stdout(), "{}", log.to_json(counts, most, levels));
    } else if !arguments.quiet {
        let _ = writeln!(std::io::stderr(), "{}", log.line(counts));
    }
}
