//! `incircle triangulate`: points in, the canonical mesh out.

use std::path::Path;
use std::time::{Duration, Instant};

use incircle::{DeviceAddress, Mesh, Solution};

use crate::arguments::TriangulateArguments;
use crate::backend::{self, Backend, Choice};
use crate::failure::{counted, failure_of, Failure};
use crate::formats::{extension, MeshFormat, MeshView};
use crate::grid::{self, Laid};
use crate::output::{self, Output, Written};
use crate::points::PointTable;
use crate::progress::Meter;
use crate::report::RunReport;
use crate::{interrupt, source};

/// Reads the points, triangulates them, writes the mesh, and prints the report.
pub fn run(arguments: &TriangulateArguments) -> Result<(), Failure> {
    let format = format_of(arguments)?;
    let output = prepare_mesh(arguments)?;
    let default = if arguments.job.wants_insertion() { "model" } else { "cpu" };
    let choice = Choice::of(&arguments.backend, arguments.grid.coord_bits, default)?;
    let trace = prepare_trace(arguments, &choice, &output)?;
    let mut watch = Watch::start();
    let table = source::read_points(&arguments.points, arguments.from)?;
    watch.ended("load");
    interrupt::check()?;
    let Laid { points, quantization } = grid::lay(&table, &choice.grid(arguments.grid.quantize))
        .map_err(|failure| failure.in_file(source::name(&arguments.points)))?;
    watch.ended("quantise");
    let trace = trace.map(Output::reserve).transpose()?;
    let mut backend =
        backend::open(&choice, Some(&points), trace.as_ref().and_then(Written::part), arguments.job.timeout)?;
    backend.check_job(&arguments.job)?;
    tell_if_long(&backend, points.len(), arguments);
    watch.ended("open");
    let Solution { mesh, report: about, .. } = triangulate(&mut backend, points, arguments)?;
    watch.stages.extend(&about.stages);
    let mut report = RunReport::new(&about, &backend, choice.coord_bits, quantization.as_ref());
    // Dropping the back end ends a simulation, which completes its waveform.
    drop(backend);
    watch.since = Instant::now();
    let written = output.write(|out| write(&table, &mesh, format, out))?;
    watch.ended("write");
    report.stages = watch.stages;
    output::finish(trace.into_iter().chain([written]), || tell(&report, arguments))
}

/// The output for the mesh, checked before the work.
fn prepare_mesh(arguments: &TriangulateArguments) -> Result<Output, Failure> {
    let output = Output::prepare(&arguments.output, Some(&arguments.points))?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the mesh and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    Ok(output)
}

/// The output for the waveform of `--trace`, checked before the work.
fn prepare_trace(arguments: &TriangulateArguments, choice: &Choice, mesh: &Output) -> Result<Option<Output>, Failure> {
    let Some(path) = &arguments.trace else {
        return Ok(None);
    };
    if !matches!(choice.address, DeviceAddress::Sim { .. }) {
        return Err(Failure::usage("--trace records the simulated core: it needs --backend sim"));
    }
    let trace = Output::prepare(path, Some(&arguments.points))?;
    if trace.is_same(mesh) {
        return Err(Failure::usage(format!(
            "{} is both the mesh and the waveform: choose another file for one",
            source::name(path)
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

fn format_of(arguments: &TriangulateArguments) -> Result<MeshFormat, Failure> {
    let path: &Path = &arguments.output;
    let format = arguments.format.or_else(|| MeshFormat::of_extension(extension(path)));
    format.ok_or_else(|| {
        let name = if source::is_standard(path) { "standard output".to_owned() } else { source::name(path) };
        let why = source::no_format(path);
        Failure::usage(format!("{name}: {why}: add --format ele, obj, ply, vtk, geojson, json, csv or svg"))
    })
}

fn triangulate(
    backend: &mut Backend,
    points: Vec<incircle::Point>,
    arguments: &TriangulateArguments,
) -> Result<Solution, Failure> {
    let meter = Meter::new(arguments.quiet);
    let listener = |progress| meter.hear(progress);
    let options = arguments.job.options(&listener);
    let solution = interrupt::working(|| {
        let session = backend.device.session();
        session.and_then(|mut session| session.triangulate_owned(points, &options))
    });
    // The check comes first, because an interrupt may surface as any error.
    interrupt::check()?;
    solution.map_err(|error| failure_of(&error))
}

/// Writes the mesh with the coordinates of the input file, not with those of the grid.
fn write(table: &PointTable, mesh: &Mesh, format: MeshFormat, out: &mut dyn std::io::Write) -> std::io::Result<()> {
    let duplicates: Vec<_> = mesh.duplicates.iter().map(|duplicate| [duplicate.index, duplicate.of]).collect();
    let view =
        MeshView { points: &table.points, triangles: &mesh.triangles, hull: &mesh.hull, duplicates: &duplicates };
    format.write(&view, out)
}

/// A stopwatch for the stages of the command.
struct Watch {
    since: Instant,
    stages: Vec<(&'static str, Duration)>,
}

impl Watch {
    fn start() -> Self {
        Self { since: Instant::now(), stages: Vec::new() }
    }

    fn ended(&mut self, stage: &'static str) {
        let now = Instant::now();
        self.stages.push((stage, now - self.since));
        self.since = now;
    }
}
