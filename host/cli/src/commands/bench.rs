//! `incircle bench`: a back end on generated sets.

use std::time::Instant;

use incircle::{Options, Point, Report, Session};

use crate::arguments::{BackendName, BenchArguments, BenchCommand};
use crate::backend::{self, Backend};
use crate::bench_report::{Bench, Measured};
use crate::commands::bench_orders;
use crate::commands::generate::{check_count, make};
use crate::failure::Failure;
use crate::generate::Distribution;
use crate::grid::failure_of;
use crate::progress::Meter;
use crate::{interrupt, output};

/// Runs of a set in software, of which the fastest counts. Cycles are the same in every run, so one is enough for a core.
const SOFTWARE_RUNS: usize = 3;

/// Runs the subcommand: a row as soon as its set is done, or one JSON object at the end.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    if let Some(BenchCommand::Orders(orders)) = &arguments.command {
        return bench_orders::run(orders);
    }
    check_count(arguments.n)?;
    let sets = sets_of(arguments);
    let room = room_for(&sets, arguments)?;
    let mut backend = backend::open_with_room(&arguments.backend, arguments.coord_bits, Some(room), None)?;
    backend.check_job(&arguments.job)?;
    let Backend { name, config, insert_chunk, .. } = backend;
    let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
    let bench = Bench {
        arguments,
        backend: name,
        config: config.map(|config| config.name),
        capacity: session.identity().capacity,
        contexts: arguments.job.contexts.unwrap_or(session.identity().contexts),
    };
    let mut rows = Vec::with_capacity(sets.len());
    for set in sets {
        let measured = measure(&mut session, set, insert_chunk, arguments)?;
        if !arguments.json {
            // The header comes with the first row: what fails before it has its sentence to itself.
            let header = if rows.is_empty() { bench.header() } else { String::new() };
            output::print(&format!("{header}{}\n", bench.row(&measured)))?;
        }
        rows.push(measured);
    }
    if arguments.json {
        output::print(&format!("{}\n", bench.to_json(&rows)))?;
    }
    Ok(())
}

/// It is timed, not counted in cycles.
fn is_software(arguments: &BenchArguments) -> bool {
    matches!(arguments.backend.name(), BackendName::Cpu | BackendName::Model)
}

fn sets_of(arguments: &BenchArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        Distribution::LITERATURE.into_iter().chain([Distribution::Lattice]).collect()
    } else {
        arguments.sets.clone()
    }
}

/// Points that the back end must hold for every set: distinct ones for a core, which is small, all of them for software.
fn room_for(sets: &[Distribution], arguments: &BenchArguments) -> Result<usize, Failure> {
    if is_software(arguments) {
        return Ok(arguments.n as usize);
    }
    let mut most = 0;
    for &set in sets {
        most = most.max(backend::count_distinct(&points_of(set, arguments)?));
    }
    Ok(most)
}

fn points_of(set: Distribution, arguments: &BenchArguments) -> Result<Vec<Point>, Failure> {
    let points = make(set, arguments.n, arguments.coord_bits, arguments.seed)?;
    Ok(points.into_iter().map(Point::from).collect())
}

fn measure(
    session: &mut Session<'_>,
    set: Distribution,
    insert_chunk: usize,
    arguments: &BenchArguments,
) -> Result<Measured, Failure> {
    let points = points_of(set, arguments)?;
    let runs = if is_software(arguments) { SOFTWARE_RUNS } else { 1 };
    let mut best = run_once(session, set, &points, insert_chunk, arguments)?;
    for _ in 1..runs {
        let next = run_once(session, set, &points, insert_chunk, arguments)?;
        if next.seconds < best.seconds {
            best = next;
        }
    }
    Ok(best)
}

fn run_once(
    session: &mut Session<'_>,
    set: Distribution,
    points: &[Point],
    insert_chunk: usize,
    arguments: &BenchArguments,
) -> Result<Measured, Failure> {
    let meter = Meter::new(false);
    let listener = |progress| meter.hear(progress);
    let options = Options {
        timeout: arguments.job.timeout,
        order: arguments.job.order(),
        progress: Some(&listener),
        contexts: arguments.job.contexts,
        insert_chunk,
    };
    let since = Instant::now();
    let mesh = interrupt::working(|| session.triangulate_with(points, &options));
    let seconds = since.elapsed().as_secs_f64();
    // Comes first, because an interrupt may show as any error.
    interrupt::check()?;
    let report: Report = mesh.map_err(|error| failure_of(&error))?.report;
    Ok(Measured { set, report, seconds })
}
