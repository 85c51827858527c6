//! `incircle bench`: a back end on generated sets.

use std::time::Instant;

use incircle::{Options, Point, Session};
use incircle_testkit::Distribution;

use crate::arguments::{BackendChoice, BenchArguments, BenchCommand};
use crate::backend::{self, Backend};
use crate::bench_report::{Bench, Measured};
use crate::commands::generate::{check_count, make};
use crate::commands::{bench_batch, bench_orders};
use crate::failure::Failure;
use crate::fit::Fit;
use crate::grid::failure_of;
use crate::progress::Meter;
use crate::{interrupt, output};

/// Runs of a set in software, of which the fastest counts. Cycles are the same in every run, so one is enough for a core.
pub(super) const SOFTWARE_RUNS: usize = 3;

/// Parts of a set that a board does too, for the line over the points.
const PARTS: [u32; 3] = [8, 4, 2];

/// Clock frequency for which times are told unless chosen or known.
pub(super) const DEFAULT_MHZ: f64 = 125.0;

/// Runs the subcommand: a row as soon as its set is done, or one JSON object at the end.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    if let Some(BenchCommand::Orders(orders)) = &arguments.command {
        return bench_orders::run(orders);
    }
    check_count(arguments.n)?;
    if let Some(jobs) = arguments.batch {
        return bench_batch::run(arguments, jobs);
    }
    let sets = sets_of(arguments);
    let room = room_for(&sets, arguments)?;
    let mut backend =
        backend::open_with_room(&arguments.backend, arguments.coord_bits, Some(room), None, arguments.job.timeout)?;
    backend.check_job(&arguments.job)?;
    let Backend { name, config, board, insert_chunk, .. } = backend;
    let has_clock = backend.has_clock();
    let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
    let bench = Bench {
        arguments,
        backend: name,
        config: config.map(|config| config.name),
        has_clock,
        mhz: arguments.mhz.or(board.and_then(clock_of)).unwrap_or(DEFAULT_MHZ),
        rate: board.map(|board| board.rate),
        capacity: session.identity().capacity,
        contexts: arguments.job.contexts.unwrap_or(session.identity().contexts),
    };
    let mut rows = Vec::with_capacity(sets.len());
    for set in sets {
        let mut measured = measure(&mut session, set, insert_chunk, arguments)?;
        if board.is_some() {
            measured.fit = fit(&mut session, &measured, insert_chunk, arguments)?;
        }
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

/// The clock that a board told, in MHz.
fn clock_of(board: backend::Board) -> Option<f64> {
    Some(f64::from(board.greeting.clock_hz) / 1e6).filter(|&mhz| mhz > 0.0)
}

/// It is timed, not counted in cycles.
pub(super) fn is_software(arguments: &BenchArguments) -> bool {
    matches!(arguments.backend.choice(), BackendChoice::Cpu | BackendChoice::Model)
}

pub(super) fn sets_of(arguments: &BenchArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        Distribution::LITERATURE.into_iter().chain([Distribution::Lattice]).collect()
    } else {
        arguments.sets.clone()
    }
}

/// Points that the back end must hold for every set: distinct ones for a core, which is small, all of them for software.
fn room_for(sets: &[Distribution], arguments: &BenchArguments) -> Result<usize, Failure> {
    // A board is what it is.
    if is_software(arguments) || matches!(arguments.backend.choice(), BackendChoice::Serial(_) | BackendChoice::Pcie(_))
    {
        return Ok(arguments.n as usize);
    }
    let mut most = 0;
    for &set in sets {
        most = most.max(backend::count_distinct(&points_of(set, arguments.n, arguments.seed, arguments)?));
    }
    Ok(most)
}

pub(super) fn points_of(
    set: Distribution,
    n: u32,
    seed: u64,
    arguments: &BenchArguments,
) -> Result<Vec<Point>, Failure> {
    let points = make(set, n, arguments.coord_bits, seed)?;
    Ok(points.into_iter().map(Point::from).collect())
}

fn measure(
    session: &mut Session<'_>,
    set: Distribution,
    insert_chunk: usize,
    arguments: &BenchArguments,
) -> Result<Measured, Failure> {
    let points = points_of(set, arguments.n, arguments.seed, arguments)?;
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

/// The time of jobs of several sizes, as a line.
fn fit(
    session: &mut Session<'_>,
    whole: &Measured,
    insert_chunk: usize,
    arguments: &BenchArguments,
) -> Result<Option<Fit>, Failure> {
    let mut jobs = Vec::with_capacity(PARTS.len() + 1);
    for part in PARTS.map(|part| arguments.n / part).into_iter().filter(|&n| n > 0) {
        let points = points_of(whole.set, part, arguments.seed, arguments)?;
        let measured = run_once(session, whole.set, &points, insert_chunk, arguments)?;
        jobs.push((measured.report.distinct, measured.seconds));
    }
    jobs.push((whole.report.distinct, whole.seconds));
    Ok(Fit::of(jobs))
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
    let (mesh, seconds) = timed(|| session.triangulate_with(points, &options))?;
    Ok(Measured { set, report: mesh.report, seconds, fit: None })
}

/// What a library call gives, and how many seconds it took.
pub(super) fn timed<T>(call: impl FnOnce() -> Result<T, incircle::Error>) -> Result<(T, f64), Failure> {
    let since = Instant::now();
    let result = interrupt::working(call);
    let seconds = since.elapsed().as_secs_f64();
    // Comes first, because an interrupt may show as any error.
    interrupt::check()?;
    Ok((result.map_err(|error| failure_of(&error))?, seconds))
}
