//! `incircle bench --batch`: measures many jobs as one batch, from the first word sent to the last triangle received.

use std::collections::BTreeSet;

use incircle::{Point, Session, Solution};
use incircle_protocol::FULL;
use incircle_testkit::Distribution;
use serde_json::{json, Value};

use crate::arguments::BenchArguments;
use crate::backend::{self, Choice};
use crate::commands::bench_sets::{points_of, sets_of, timed, DEFAULT_BACKEND, DEFAULT_MHZ, SOFTWARE_RUNS};
use crate::failure::{counted, failure_of, Failure};
use crate::memory::Memory;
use crate::output;
use crate::progress::Meter;

/// Width of the column with the names of sets.
const SET_WIDTH: usize = 15;
/// The other columns with their widths.
const COLUMNS: [(&str, usize); 10] = [
    ("points", 10),
    ("triangles", 11),
    ("cycles/point", 14),
    ("engine", 8),
    ("cycles/job", 12),
    ("longest", 9),
    ("ms", 10),
    ("us/job", 10),
    ("ns/point", 10),
    ("Mpoints/s", 11),
];

/// The measurement of the jobs of one set.
struct Measured {
    set: Distribution,
    /// Distinct points of all jobs together.
    distinct: usize,
    triangles: usize,
    /// Clocks of all jobs, if the back end counts clocks and did any of the jobs.
    cycles: Option<u64>,
    /// Clocks of the longest job, if all jobs were exclusive jobs.
    longest: Option<u64>,
    /// Clocks in which the insertion engine worked, by its own counter, if all jobs were exclusive jobs.
    engine: Option<u64>,
    /// Engines of the device that got stuck.
    stuck_engines: BTreeSet<u32>,
    /// Seconds of the whole library call.
    seconds: f64,
}

/// The facts that all rows of a table have in common.
struct Table<'a> {
    arguments: &'a BenchArguments,
    coord_bits: u32,
    jobs: u32,
    backend: &'static str,
    config: Option<&'static str>,
    mhz: f64,
    capacity: u32,
    contexts: u32,
    engines: u32,
}

/// Most points of all jobs together. Points and meshes are in memory at once: up to [`KEPT_BYTES`] a point and
/// [`JOB_BYTES`] a job.
const MOST_POINTS: u64 = 1 << 26;
/// Bytes that a point of a batch takes, with its share of the mesh.
const KEPT_BYTES: u64 = 40;
/// Bytes that a job of a batch takes beside its points: its lists, and its report with the counters. Batches of 30,000
/// to a million jobs took 1,600 to 2,200; it is more where a list has just doubled its room.
const JOB_BYTES: u64 = 2_300;

/// Runs a batch of `jobs` jobs of each set. Each row is printed as soon as its batch is done, or one JSON
/// object at the end.
pub fn run(arguments: &BenchArguments, jobs: u32) -> Result<(), Failure> {
    let points = u64::from(jobs) * u64::from(arguments.n);
    if points > MOST_POINTS {
        return Err(Failure::usage(format!(
            "--batch {jobs} with -n {} is {points} points, all in memory at once: ask for at most {MOST_POINTS}",
            arguments.n
        )));
    }
    let choice = Choice::of(&arguments.backend, arguments.coord_bits, DEFAULT_BACKEND)?;
    choice.check_bits()?;
    check_memory(arguments.n, jobs, Memory::free())?;
    let runs = if choice.is_software() { SOFTWARE_RUNS } else { 1 };
    let mut backend = backend::open_with_room(&choice, Some(room(&choice, arguments)), None, arguments.job.timeout)?;
    backend.check_job(&arguments.job)?;
    let (name, config) = (backend.name, backend.config);
    let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
    let table = Table {
        arguments,
        coord_bits: choice.coord_bits,
        jobs,
        backend: name,
        config: config.map(|config| config.name),
        mhz: arguments.mhz.unwrap_or(DEFAULT_MHZ),
        capacity: session.identity().capacity,
        contexts: arguments.job.contexts.unwrap_or(session.identity().contexts),
        engines: session.identity().engines,
    };
    let mut rows = Vec::new();
    for set in sets_of(arguments) {
        let measured = measure(&mut session, set, runs, &table)?;
        if !arguments.json {
            let header = if rows.is_empty() { table.header() } else { String::new() };
            output::print(&format!("{header}{}\n", table.row(&measured)))?;
        }
        rows.push(measured);
    }
    if arguments.json {
        output::print(&format!("{}\n", table.to_json(&rows)))?;
    }
    Ok(())
}

/// Refuses a batch that the memory cannot hold: all jobs, and beside them the work on one.
fn check_memory(n: u32, jobs: u32, memory: Memory) -> Result<(), Failure> {
    let (points, jobs) = (u64::from(n), u64::from(jobs));
    let kept = jobs * (points * KEPT_BYTES + JOB_BYTES);
    let sets = format!("{} of {} each", counted(jobs as usize, "job"), counted(n as usize, "point"));
    memory.check_sets(&sets, kept + Memory::of_points(points), "ask for fewer jobs or points")
}

/// Points that the back end must hold: those of one job. Without `--config` the core is at least the configuration
/// `full`, which boards have, and not the smallest one that holds a job.
fn room(choice: &Choice, arguments: &BenchArguments) -> usize {
    let least = if choice.is_core() && choice.config.is_none() { FULL.points } else { 0 };
    arguments.n.max(least) as usize
}

fn measure(session: &mut Session<'_>, set: Distribution, runs: usize, table: &Table<'_>) -> Result<Measured, Failure> {
    let &Table { arguments, coord_bits, jobs, .. } = table;
    let points = |job: u32| points_of(set, arguments.n, arguments.seed.wrapping_add(job.into()), coord_bits);
    let jobs = (0..jobs).map(points).collect::<Result<Vec<_>, _>>()?;
    let mut best = run_once(session, set, &jobs, arguments)?;
    for _ in 1..runs {
        let next = run_once(session, set, &jobs, arguments)?;
        if next.seconds < best.seconds {
            best = next;
        }
    }
    Ok(best)
}

fn run_once(
    session: &mut Session<'_>,
    set: Distribution,
    jobs: &[Vec<Point>],
    arguments: &BenchArguments,
) -> Result<Measured, Failure> {
    let meter = Meter::new(false);
    let listener = |progress| meter.hear(progress);
    let options = arguments.job.options(&listener);
    let before = session.clocks();
    let (solutions, seconds) = timed(|| session.triangulate_batch(jobs, &options))?;
    // The clock stands still if no job has reached the core.
    let cycles = session.clocks().zip(before).map(|(after, before)| after - before).filter(|&cycles| cycles > 0);
    let distinct = solutions.iter().map(|solution| solution.report.distinct).sum();
    let triangles = solutions.iter().map(|solution| solution.report.triangles).sum();
    let (longest, engine) = (longest_of(&solutions), engine_of(&solutions));
    let stuck = solutions.iter().flat_map(|solution| solution.report.stuck_engines.iter().copied());
    let stuck_engines = stuck.collect();
    Ok(Measured { set, distinct, triangles, cycles, longest, engine, stuck_engines, seconds })
}

/// Clocks of the longest job; `None` if any jobs shared the memory.
fn longest_of(solutions: &[Solution]) -> Option<u64> {
    let of_device = solutions.iter().filter(|solution| !solution.report.collinear);
    let clocks: Option<Vec<u64>> = of_device.map(|solution| solution.report.clocks).collect();
    clocks?.into_iter().max()
}

/// Clocks of all insertions; `None` if they are not counted for each job, or if several engines insert at a time, so
/// that the sum is no part of the clocks of the chip.
fn engine_of(solutions: &[Solution]) -> Option<u64> {
    if solutions.iter().any(|solution| solution.report.engines > 1) {
        return None;
    }
    let of_device = solutions.iter().filter(|solution| !solution.report.collinear);
    let cycles = |solution: &Solution| solution.report.counters.map(|counters| counters.insert_cycles);
    of_device.map(cycles).sum::<Option<u64>>().filter(|&cycles| cycles > 0)
}

impl Table<'_> {
    fn header(&self) -> String {
        let BenchArguments { n, seed, job, .. } = self.arguments;
        let coord_bits = self.coord_bits;
        let config = self.config.map_or(String::new(), |config| format!(" {config}"));
        let is_cpu = self.backend == "cpu";
        let contexts = counted(self.contexts as usize, if is_cpu { "thread" } else { "context" });
        let engines = match self.engines {
            1 => String::new(),
            engines => format!("{engines} engines with "),
        };
        let order = if is_cpu { String::new() } else { format!(", order {}", job.order().name()) };
        let clock = self.config.map_or(String::new(), |_| format!(", ms at {} MHz", self.mhz));
        let about = format!(
            "{}{config}, {engines}{contexts}; {} of {} each, {coord_bits} bits, seeds from {seed}{order}{clock}\n",
            self.backend,
            counted(self.jobs as usize, "job"),
            counted(*n as usize, "point"),
        );
        about + &line("set", COLUMNS.map(|(name, _)| name.to_owned())) + "\n"
    }

    fn row(&self, measured: &Measured) -> String {
        let cell = |value: Option<f64>, decimals: usize| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
        };
        let seconds = self.device_seconds(measured);
        let cells = [
            measured.distinct.to_string(),
            measured.triangles.to_string(),
            cell(measured.per_point(measured.cycles), 2),
            cell(measured.per_point(measured.engine), 2),
            cell(self.cycles_per_job(measured), 0),
            cell(measured.longest.map(|cycles| cycles as f64), 0),
            cell(seconds.map(|seconds| 1e3 * seconds), 3),
            cell(seconds.map(|seconds| 1e6 * seconds / f64::from(self.jobs)), 2),
            cell(seconds.map(|seconds| 1e9 * seconds / measured.distinct as f64), 1),
            cell(self.points_per_second(measured).map(|rate| rate / 1e6), 2),
        ];
        line(&measured.set.to_string(), cells)
    }

    /// Seconds of all jobs: the clocks at the frequency of the table, or the time of the call if nothing counts clocks.
    fn device_seconds(&self, measured: &Measured) -> Option<f64> {
        if self.config.is_none() {
            return Some(measured.seconds);
        }
        measured.cycles.map(|cycles| cycles as f64 / (self.mhz * 1e6))
    }

    /// Distinct points a second, in the time that [`device_seconds`](Self::device_seconds) gives.
    fn points_per_second(&self, measured: &Measured) -> Option<f64> {
        self.device_seconds(measured).filter(|&seconds| seconds > 0.0).map(|seconds| measured.distinct as f64 / seconds)
    }

    /// Clocks from the first word sent to the last triangle received, on average over the jobs.
    fn cycles_per_job(&self, measured: &Measured) -> Option<f64> {
        measured.cycles.map(|cycles| cycles as f64 / f64::from(self.jobs))
    }

    fn to_json(&self, rows: &[Measured]) -> Value {
        let BenchArguments { n, seed, job, .. } = self.arguments;
        let coord_bits = self.coord_bits;
        let mut object = json!({
            "backend": self.backend,
            "config": self.config,
            "capacity": self.capacity,
            "contexts": self.contexts,
            "engines": self.engines,
            "order": if self.backend == "cpu" { Value::Null } else { job.order().name().into() },
            "jobs": self.jobs,
            "n": n,
            "coord_bits": coord_bits,
            "seed": seed,
            "sets": rows.iter().map(|measured| self.row_json(measured)).collect::<Vec<_>>(),
        });
        if self.config.is_some() {
            object["mhz"] = self.mhz.into();
        }
        object
    }

    fn row_json(&self, measured: &Measured) -> Value {
        let mut object = json!({
            "set": measured.set.to_string(),
            "distinct": measured.distinct,
            "triangles": measured.triangles,
            "seconds": measured.seconds,
            "points_per_second": self.points_per_second(measured),
            "stuck_engines": measured.stuck_engines,
        });
        if let Some(cycles) = measured.cycles {
            object["cycles"] = cycles.into();
            object["cycles_per_point"] = measured.per_point(Some(cycles)).into();
            object["cycles_per_job"] = self.cycles_per_job(measured).into();
            object["longest_job_cycles"] = measured.longest.into();
            object["engine_cycles_per_point"] = measured.per_point(measured.engine).into();
            object["seconds_at_mhz"] = self.device_seconds(measured).into();
        }
        object
    }
}

impl Measured {
    fn per_point(&self, cycles: Option<u64>) -> Option<f64> {
        cycles.filter(|_| self.distinct > 0).map(|cycles| cycles as f64 / self.distinct as f64)
    }
}

fn line<const N: usize>(set: &str, cells: [String; N]) -> String {
    let mut line = format!("{set:<SET_WIDTH$}");
    for (cell, (_, width)) in cells.iter().zip(COLUMNS) {
        line += &format!("{cell:>width$}");
    }
    line
}
