//! `incircle triangulate`: points in, the canonical mesh out.

use std::path::{Path, PathBuf};
use std::time::Instant;

use incircle::constraints::Pieces;
use incircle::{ConstrainedError, DeviceAddress, Fleet, Quantize, Report};

use crate::arguments::{Crossings, TriangulateArguments};
use crate::backend::{self, Backend, Choice};
use crate::commands::plan_files::PlanFiles;
use crate::commands::triangulate_large;
use crate::connections::Connections;
use crate::failure::{counted, failure_of, Failure};
use crate::fleet::Several;
use crate::formats::edge;
use crate::lattice::{self, Laid, Numbers};
use crate::output::{self, Output, Written};
use crate::plan::PlannedSet;
use crate::planned::Snapping;
use crate::progress::Meter;
use crate::report::RunReport;
use crate::solve::{self, without_points};
use crate::trace::Trace;
use crate::watch::Watch;
use crate::{interrupt, path, plan, snapping, source};

/// Reads the points, triangulates them, writes the mesh, and prints the report.
pub fn run(arguments: &TriangulateArguments) -> Result<(), Failure> {
    match triangulate_large::memory_of(arguments) {
        Some(_) if arguments.asks_for_plan() => Err(Failure::usage(
            "constraints, domains, --edges and --neighbors need the whole set in memory: leave out --memory, \
             --scratch, --resume and --unordered",
        )),
        Some(memory) => triangulate_large::run(arguments, memory),
        None => run_in_memory(arguments),
    }
}

/// Triangulates a set that the memory holds.
fn run_in_memory(arguments: &TriangulateArguments) -> Result<(), Failure> {
    let format = source::mesh_format(&arguments.output, arguments.format)?;
    let output = prepare_mesh(arguments)?;
    let lists = Lists::prepare(arguments, &output)?;
    let chosen = Chosen::of(arguments)?;
    let trace = prepare_trace(arguments, &chosen, &output, &lists)?;
    let mut watch = Watch::start();
    let set = plan::read_set(&arguments.points, &arguments.read, &arguments.plan, arguments.quiet)?;
    watch.ended("load");
    interrupt::check()?;
    let in_file = |failure: Failure| failure.in_file(source::set_name(&arguments.points));
    let how = arguments.grid.quantize.map(|how| (how, chosen.coord_bits()));
    let (set, snapping) = snap(set, how, arguments.plan.crossings).map_err(in_file)?;
    let how = how.filter(|_| snapping.is_none());
    let plan_files = PlanFiles::prepare((arguments, &inputs(arguments)), format, &set, snapping.is_some())?;
    let table = &set.table;
    format.check_points(table).map_err(in_file)?;
    let places = lattice::lay(table, how).map_err(in_file)?;
    // The places of holes and regions are in the same numbers as the points, but are none of them.
    let own = set.has_marks().then(|| places.first(set.points));
    let laid = own.as_ref().unwrap_or(&places);
    chosen.check_lattice(laid).map_err(in_file)?;
    watch.ended("quantise");
    let trace = trace.map(Output::reserve).transpose()?;
    let trace_part = trace.as_ref().and_then(Written::part);
    let wanted = trace_part.map(|path| Trace { path, job: arguments.trace_job });
    let (mut mesh, about, backend) = solve(chosen, (&set, &places, laid), wanted, arguments, &mut watch)?;
    watch.stages.extend(&about.stages);
    let mut report = report_of(&about, backend.as_ref(), laid);
    report.left_out = table.left_out();
    // Dropping the back end ends a simulation, which completes its waveform.
    drop(backend);
    check_traced(trace_part, arguments)?;
    watch.since = Instant::now();
    force_plan((&set, &source::set_name(&arguments.points)), &places, &mut mesh, &mut watch)?;
    mesh.planned.iter_mut().for_each(|planned| planned.snapping = snapping);
    report.planned = mesh.planned.as_ref();
    let points = set.has_marks().then(|| table.first(set.points));
    let written = output.write(|out| mesh.write(points.as_ref().unwrap_or(table), format, out))?;
    let mut lists = lists.write(&mesh)?;
    lists.extend(plan_files.write(&set)?);
    watch.ended("write");
    report.stages = watch.stages;
    output::finish(trace.into_iter().chain(lists).chain([written]), || tell(&report, arguments))
}

/// Snaps the crossings of the constraints of a set, if that is wanted.
fn snap(
    set: PlannedSet,
    how: Option<(Quantize, u32)>,
    crossings: Crossings,
) -> Result<(PlannedSet, Option<Snapping>), Failure> {
    match crossings {
        Crossings::Reject => Ok((set, None)),
        Crossings::Snap => snapping::snap_set(set, how),
    }
}

/// Forces the constraints of a set into its mesh, if the set has any that are not in it, and checks the holes of its
/// polygons. `file` names the set.
fn force_plan(
    (set, file): (&PlannedSet, &str),
    places: &Laid<'_>,
    mesh: &mut Connections,
    watch: &mut Watch,
) -> Result<(), Failure> {
    let Some(request) = &set.request else { return Ok(()) };
    if mesh.planned.is_none() {
        mesh.planned = Some(request.force(mesh, (set, file), places)?);
        watch.ended("constrain");
    }
    request.check_holes((set, file), places)
}

/// The report of a run on one back end, or on several if there is none to name.
fn report_of<'a>(about: &'a Report, backend: Option<&Backend>, laid: &'a Laid<'a>) -> RunReport<'a> {
    match backend {
        Some(backend) => RunReport::new(about, backend, laid),
        None => RunReport::of_several(about, laid),
    }
}

/// The files of edges and neighbours, checked before the work.
struct Lists {
    edges: Option<Output>,
    neighbors: Option<Output>,
}

impl Lists {
    fn prepare(arguments: &TriangulateArguments, mesh: &Output) -> Result<Self, Failure> {
        let prepare = |file: &Option<PathBuf>| -> Result<Option<Output>, Failure> {
            let Some(file) = file else { return Ok(None) };
            let output = Output::prepare(file, &inputs(arguments))?;
            if arguments.json && output.is_standard() {
                return Err(Failure::usage(
                    "a list and the report of --json cannot both go to standard output: give the list a file",
                ));
            }
            if is_one(&output, mesh) {
                let name = path::name(file);
                return Err(Failure::usage(format!("{name} is both the mesh and a list: choose another file for one")));
            }
            Ok(Some(output))
        };
        let (edges, neighbors) = (prepare(&arguments.edges)?, prepare(&arguments.neighbors)?);
        if edges.as_ref().zip(neighbors.as_ref()).is_some_and(|(one, other)| is_one(one, other)) {
            return Err(Failure::usage("--edges and --neighbors name the same file: choose another file for one"));
        }
        Ok(Self { edges, neighbors })
    }

    fn write(self, mesh: &Connections) -> Result<Vec<Written>, Failure> {
        let none = Pieces::default();
        let pieces = mesh.planned.as_ref().map_or(&none, |planned| &planned.made.pieces);
        let mut written = Vec::new();
        if let Some(output) = self.edges {
            written.push(output.write(|out| edge::write_edges(&mesh.triangles, pieces, out))?);
        }
        if let Some(output) = self.neighbors {
            written.push(output.write(|out| edge::write_neighbors(&mesh.triangles, out))?);
        }
        Ok(written)
    }
}

/// Opens the back ends and lets them triangulate the points `laid` of a set, whose holes and regions are among its
/// `places`. A single back end stays open. The CPU triangulator alone forces constraints at once.
fn solve(
    chosen: Chosen,
    (set, places, laid): (&PlannedSet, &Laid<'_>, &Laid<'_>),
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
            if let Some(request) = set.request.as_ref().filter(|_| backend.takes_all_numbers()) {
                let asked = (request, &places.numbers, set.points);
                let name = source::set_name(&arguments.points);
                let refuse = |error| match error {
                    ConstrainedError::Plan(error) => request.refuse(error, (set, &name), places),
                    ConstrainedError::Job(error) => in_file(failure_of(&error)),
                    other => in_file(Failure::input(other.to_string())),
                };
                let (found, about) = solve::constrain(&mut backend, asked, refuse, &arguments.job, arguments.quiet)?;
                let mesh = Connections::of_domain(&found);
                return Ok((Connections { planned: Some(request.planned(found.made)), ..mesh }, about, Some(backend)));
            }
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

/// Whether two outputs are the same file, or are both standard output.
fn is_one(one: &Output, other: &Output) -> bool {
    one.is_same(other) || one.is_standard() && other.is_standard()
}

/// All files that the run reads.
fn inputs(arguments: &TriangulateArguments) -> Vec<PathBuf> {
    arguments.points.iter().chain(&arguments.plan.constraints).cloned().collect()
}

/// The output for the mesh, checked before the work.
fn prepare_mesh(arguments: &TriangulateArguments) -> Result<Output, Failure> {
    let output = Output::prepare(&arguments.output, &inputs(arguments))?;
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
fn prepare_trace(
    arguments: &TriangulateArguments,
    chosen: &Chosen,
    mesh: &Output,
    lists: &Lists,
) -> Result<Option<Output>, Failure> {
    let Some(file) = &arguments.trace else {
        return Ok(None);
    };
    if !matches!(chosen, Chosen::One(Choice { address: DeviceAddress::Sim { .. }, .. })) {
        return Err(Failure::usage("--trace records the simulated core: it needs --backend sim"));
    }
    let trace = Output::prepare(file, &inputs(arguments))?;
    if trace.is_same(mesh) {
        return Err(Failure::usage(format!(
            "{} is both the mesh and the waveform: choose another file for one",
            path::name(file)
        )));
    }
    if [&lists.edges, &lists.neighbors].into_iter().flatten().any(|list| list.is_same(&trace)) {
        let name = path::name(file);
        return Err(Failure::usage(format!("{name} is both a list and the waveform: choose another file for one")));
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
