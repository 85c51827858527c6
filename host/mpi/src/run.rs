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
use crate::share;
use crate::team::{Halt, Team};

/// Triangulates the points of all inputs, and writes the mesh.
///
/// # Errors
/// Any process failed. The reason has been printed, and the folder of the mesh does not exist.
pub fn triangulate(team: &Team, arguments: &TriangulateArguments) -> Result<(), Halt> {
    let number = team.gather(&[std::process::id().into()])[0][0];
    let folder = Folder::new(&arguments.output, number);
    team.agree(if team.is_first() { folder.make() } else { Ok(()) })?;
    let done = fill(team, arguments, &folder);
    if done.is_err() && team.is_first() {
        folder.remove();
    }
    done
}

/// Does all steps but the first and the last one of the folder.
fn fill(team: &Team, arguments: &TriangulateArguments, folder: &Folder) -> Result<(), Halt> {
    let mut log = Log::new(team.is_first() && !arguments.quiet);
    let share = share::read(team, &arguments.inputs)?;
    let points = share.total;
    log.step(team, "read", &format!("{points} points, "));

    let cuts = cuts::cut(team, &share, arguments.points);
    log.step(team, "cut", &format!("{} tiles, ", cuts.owners.len()));

    let nodes = nodes(&cuts);
    let tiles = exchange::exchange(team, share, &cuts);
    let most = team.greatest(tiles.points);
    log.step(team, "exchange", &format!("at most {most} points in a process, "));

    let mut climb = team.agree(Climb::alone(team.rank(), &nodes, tiles))?;
    log.step(team, "local", "");

    climb.together(team, &nodes);
    let (counts, levels) = summed(team, points, &climb);
    team.agree(check(&counts))?;
    log.step(team, "join", "");

    let triangles = ordering::sort(team, climb.finals);
    let lists = team.gather(&[triangles.len() as u64]);
    let counts = Counts { triangles: lists.concat(), ..counts };
    log.step(team, "sort", "");

    team.agree(folder.write(team.rank(), &triangles))?;
    team.agree(if team.is_first() { folder.finish(&counts.to_json()) } else { Ok(()) })?;
    log.step(team, "write", "");
    if team.is_first() {
        tell(arguments, &log, &counts, most, &levels);
    }
    Ok(())
}

/// The counts of the mesh and the levels of the tree, of all processes together.
fn summed(team: &Team, points: u64, climb: &Climb) -> (Counts, Vec<Level>) {
    let mut own = vec![climb.finals.len() as u64, climb.duplicates, climb.hull];
    own.extend(climb.levels.iter().flat_map(|level| [level.regions, level.border, level.open, level.bytes]));
    let all = team.sum(&own);
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
