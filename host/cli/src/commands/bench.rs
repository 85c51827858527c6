//! `incircle bench`: measures a back end on generated sets.

use incircle::{Point, Session};
use incircle_testkit::Distribution;

use crate::arguments::BenchArguments;
use crate::backend::{self, Backend, Choice};
use crate::bench_report::{Bench, Measured};
use crate::commands::bench_batch;
use crate::commands::bench_sets::{points_of, sets_of, timed, DEFAULT_BACKEND, DEFAULT_MHZ, SOFTWARE_RUNS};
use crate::commands::generate::check_count;
use crate::failure::{counted, failure_of, Failure};
use crate::fit::Fit;
use crate::memory::Memory;
use crate::output;
use crate::progress::Meter;

/// Divisors of the number of points, for the smaller sets that a board does as well, for the fitted line.
const PARTS: [u32; 3] = [8, 4, 2];

/// Runs the subcommand. Each row is printed as soon as its set is done, or one JSON object at the end.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    check_count(arguments.n)?;
    if let Some(jobs) = arguments.batch {
        return bench_batch::run(arguments, jobs);
    }
    let sets = sets_of(arguments);
    let choice = Choice::of(&arguments.backend, arguments.coord_bits, DEFAULT_BACKEND)?;
    choice.check_bits()?;
    let set = format!("a set of {}", counted(arguments.n as usize, "point"));
    Memory::free().check_sets(&set, Memory::of_points(arguments.n.into()), "choose a smaller -n")?;
    let runs = if choice.is_software() { SOFTWARE_RUNS } else { 1 };
    let room = room_for(&choice, &sets, arguments)?;
    let mut backend = backend::open_with_room(&choice, Some(room), None, arguments.job.timeout)?;
    backend.check_job(&arguments.job)?;
    let Backend { name, config, board, .. } = backend;
    let has_clock = backend.has_clock();
    let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
    let bench = Bench {
        arguments,
        coord_bits: choice.coord_bits,
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
        let mut measured = measure(&mut session, set, runs, &bench)?;
        if board.is_some() {
            measured.fit = fit(&mut session, &measured, &bench)?;
        }
        if !arguments.json {
            // The header comes with the first row, so that an early failure prints its sentence alone.
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

/// The clock frequency that a board reports, in MHz; `None` if the board reports zero.
fn clock_of(board: backend::Board) -> Option<f64> {
    Some(f64::from(board.greeting.clock_hz) / 1e6).filter(|&mhz| mhz > 0.0)
}

/// Points that the back end must hold for every set. A core in simulation counts distinct points, because it is small;
/// all others count all points.
fn room_for(choice: &Choice, sets: &[Distribution], arguments: &BenchArguments) -> Result<usize, Failure> {
    if !choice.is_core() {
        return Ok(arguments.n as usize);
    }
    let mut most = 0;
    for &set in sets {
        most = most.max(backend::count_distinct(&points_of(set, arguments.n, arguments.seed, choice.coord_bits)?));
    }
    Ok(most)
}

fn measure(session: &mut Session<'_>, set: Distribution, runs: usize, bench: &Bench<'_>) -> Result<Measured, Failure> {
    let &Bench { arguments, coord_bits, .. } = bench;
    let points = points_of(set, arguments.n, arguments.seed, coord_bits)?;
    let mut best = run_once(session, set, &points, arguments)?;
    for _ in 1..runs {
        let next = run_once(session, set, &points, arguments)?;
        if next.seconds < best.seconds {
            best = next;
        }
    }
    Ok(best)
}

/// Measures smaller sets as well, and fits a line through the times of all sizes.
fn fit(session: &mut Session<'_>, whole: &Measured, bench: &Bench<'_>) -> Result<Option<Fit>, Failure> {
    let &Bench { arguments, coord_bits, .. } = bench;
    let mut jobs = Vec::with_capacity(PARTS.len() + 1);
    for part in PARTS.map(|part| arguments.n / part).into_iter().filter(|&n| n > 0) {
        let points = points_of(whole.set, part, arguments.seed, coord_bits)?;
        let measured = run_once(session, whole.set, &points, arguments)?;
        jobs.push((measured.report.distinct, measured.seconds));
    }
    jobs.push((whole.report.distinct, whole.seconds));
    Ok(Fit::of(jobs))
}

fn run_once(
    session: &mut Session<'_>,
    set: Distribution,
    points: &[Point],
    arguments: &BenchArguments,
) -> Result<Measured, Failure> {
    let meter = Meter::new(false);
    let listener = |progress| meter.hear(progress);
    let options = arguments.job.options(&listener);
    let (solution, seconds) = timed(|| session.triangulate_with(points, &options))?;
    Ok(Measured { set, report: solution.report, seconds, fit: None })
}
