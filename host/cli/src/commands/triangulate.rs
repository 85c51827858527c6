//! `incircle triangulate`: points in, the canonical mesh out.

use std::path::Path;
use std::time::Instant;

use incircle::{DeviceAddress, Fleet, Report};

use crate::arguments::TriangulateArguments;
use crate::backend::{self, Backend, Choice};
use crate::commands::triangulate_large;
use crate::connections::Connections;
use crate::failure::{counted, failure_of, Failure};
use crate::fleet::Several;
use crate::lattice::{self, Laid, Numbers};
use crate::output::{self, Output, Written};
use crate::progress::Meter;
use crate::report::RunReport;
use crate::solve::{self, without_points};
use crate::trace::Trace;
use crate::watch::Watch;
use crate::{interrupt, path, source};

/// Reads the points, triangulates them, writes the mesh, and prints the report.
pub fn run(arguments: &TriangulateArguments) -> Result<(), Failure> {
    match triangulate_large::memory_of(arguments) {
        Some(memory) => triangulate_large::run(arguments, memory),
        None => run_in_memory(arguments),
    }
}

/// Triangulates a set that the memory holds.
fn run_in_memory(arguments: &TriangulateArguments) -> Result<(), Failure> {
    let format = source::mesh_format(&arguments.output, arguments.format)?;
    let output = prepare_mesh(arguments)?;
    let chosen = Chosen::of(arguments)?;
    let trace = prepare_trace(arguments, &chosen, &output)?;
    let mut watch = Watch::start();
    let table = source::read_set(&arguments.points, &arguments.read, arguments.quiet)?;
    watch.ended("load");
    interrupt::check()?;
    let in_file = |failure: Failure| failure.in_file(source::set_name(&arguments.points));
    format.check_points(&table).map_err(in_file)?;
    let how = arguments.grid.quantize.map(|how| (how, chosen.coord_bits()));
    let laid = lattice::lay(&table, how).map_err(in_file)?;
    chosen.check_lattice(&laid).map_err(in_file)?;
    watch.ended("quantise");
    let trace = trace.map(Output::reserve).transpose()?;
    let trace_part = trace.as_ref().and_then(Written::part);
    let wanted = trace_part.map(|path| Trace { path, job: arguments.trace_job });
    let (mesh, about, backend) = solve(chosen, &laid, wanted, arguments, &mut watch)?;
    watch.stages.extend(&about.stages);
    let mut report = match &backend {
        Some(backend) => RunReport::new(&about, backend, &laid),
        None => RunReport::of_several(&about, &laid),
    };
    report.left_out = table.left_out();
    // Dropping the back end ends a simulation, which completes its waveform.
    drop(backend);
    check_traced(trace_part, arguments)?;
    watch.since = Instant::now();
    let written = output.write(|out| mesh.write(&table, format, out))?;
    watch.ended("write");
    report.stages = watch.stages;
    output::finish(trace.into_iter().chain([written]), || tell(&report, arguments))
}

/// Opens the back ends and lets them triangulate the points. A single back end stays open.
fn solve(
    chosen: Chosen,
    laid: &Laid<'_>,
    trace: Option<Trace<'_>>,
    arguments: &TriangulateArguments,
    watch: &mut Watch,
) -> Result<(Connections, Report, Option<Backend>), Failure> {
    let in_file = |failure: Failure| failure.in_file(source::set_name(&arguments.points));
    match chosen {
        Chosen::One(choice) => {
            let room = choice.room_for(&laid.numbers);
            let mut backend = backend::open_with_room(&choice, Some(room), trace, arguments.job.timeout)?;
            backend.check_job(&arguments.job)?;
            tell_if_long(&backend, laid.numbers.len(), arguments);
            watch.ended("open");
            let check_bits = |bits| laid.check_bits(bits, choice.address.name());
            let solved = solve::triangulate(&mut backend, &laid.numbers, check_bits, &arguments.job, arguments.quiet);
            let (mesh, about) = solved.map_err(in_file)?;
            Ok((mesh, about, Some(backend)))
        }
        Chosen::Several(several) => {
            let (mesh, about) = triangulate_together(&several.fleet(laid), laid, arguments).map_err(in_file)?;
            Ok((mesh, about, None))
        }
    }
}

/// The back ends that do the work.
enum Chosen {
    One(Choice),
    Several(Several),
}

impl Chosen {
    fn of(arguments: &TriangulateArguments) -> Result<Self, Failure> {
        if let Some(several) = Several::of(arguments)? {
            return Ok(Self::Several(several));
        }
        let default = if arguments.job.wants_insertion() { "model" } else { "cpu" };
        Choice::for_points(&arguments.backend, &arguments.grid, default).map(Self::One)
    }

    fn coord_bits(&self) -> u32 {
        match self {
            Self::One(choice) => choice.coord_bits,
            Self::Several(several) => several.coord_bits(),
        }
    }

    fn check_lattice(&self, laid: &Laid<'_>) -> Result<(), Failure> {
        match self {
            Self::One(choice) => choice.check_lattice(laid),
            Self::Several(several) => several.check_lattice(laid),
        }
    }
}

/// The output for the mesh, checked before the work.
fn prepare_mesh(arguments: &TriangulateArguments) -> Result<Output, Failure> {
    let output = Output::prepare(&arguments.output, &arguments.points)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the mesh and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    Ok(output)
}

/// Fails if the run had no job of the number that `--trace-job` names, so that the waveform is empty.
fn check_traced(part: Option<&Path>, arguments: &TriangulateArguments) -> Result<(), Failure> {
    let (Some(part), Some(job)) = (part, arguments.trace_job) else {
        return Ok(());
    };
    match std::fs::metadata(part) {
        Ok(file) if file.len() > 0 => Ok(()),
        _ => Err(Failure::usage(format!("--trace-job {job}: the run had fewer jobs; choose a smaller number"))),
    }
}

/// The output for the waveform of `--trace`, checked before the work.
fn prepare_trace(arguments: &TriangulateArguments, chosen: &Chosen, mesh: &Output) -> Result<Option<Output>, Failure> {
    let Some(file) = &arguments.trace else {
        return Ok(None);
    };
    if !matches!(chosen, Chosen::One(Choice { address: DeviceAddress::Sim { .. }, .. })) {
        return Err(Failure::usage("--trace records the simulated core: it needs --backend sim"));
    }
    let trace = Output::prepare(file, &arguments.points)?;
    if trace.is_same(mesh) {
        return Err(Failure::usage(format!(
            "{} is both the mesh and the waveform: choose another file for one",
            path::name(file)
        )));
    }
    Ok(Some(trace))
}

/// A job that takes at least this many seconds on a serial line is announced as long.
const LONG: f64 = 10.0;

/// Prints a warning if the serial line makes the job long.
fn tell_if_long(backend: &Backend, points: usize, arguments: &TriangulateArguments) {
    let Some(board) = backend.board.filter(|_| !arguments.quiet) else { return };
    let seconds = board.seconds(points);
    if seconds >= LONG {
        let points = counted(points, "point");
        output::note(&format!(
            "{points} take about {seconds:.0} s over this line at {} bits per second: the line is for small jobs",
            board.rate
        ));
    }
}

/// Prints the report. The report comes last, so that a reader finds the files in place.
fn tell(report: &RunReport<'_>, arguments: &TriangulateArguments) -> Result<(), Failure> {
    if arguments.json {
        output::print(&format!("{}\n", report.to_json()))?;
    } else if !arguments.quiet {
        let lines = report.lines(arguments.verbose);
        lines.iter().for_each(|line| output::note(line));
    }
    Ok(())
}

/// Triangulates points with several back ends.
fn triangulate_together(
    fleet: &Fleet,
    laid: &Laid<'_>,
    arguments: &TriangulateArguments,
) -> Result<(Connections, Report), Failure> {
    let meter = Meter::new(arguments.quiet);
    let listener = |progress| meter.hear(progress);
    let options = arguments.job.options(&listener);
    let solution = interrupt::working(|| match &laid.numbers {
        Numbers::Grid(points) => fleet.triangulate(points, &options).map(without_points),
        Numbers::Whole(points) => fleet.triangulate(points, &options).map(without_points),
        Numbers::Doubles(points) => fleet.triangulate(points, &options).map(without_points),
    });
    interrupt::check()?;
    solution.map_err(|error| failure_of(&error))
}
