//! Triangulating a set, and what is computed from a finished mesh.

use std::num::NonZeroU32;
use std::time::Instant;

use incircle::{ConstrainedError, Device, Duplicate, Error, Fleet, Mesh, Options, PlanePoint, Report, Solution, EMPTY};
use numpy::{Element, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::constrained::{described_plan, triangle_list, Asked, Wanted};
use crate::error::{bad_input, exception, of_job};
use crate::memory::{look_for_memory, BYTES_OF_A_CONSTRAINT, BYTES_OF_A_JOB, BYTES_OF_A_TRIANGLE};
use crate::points::{array, of_any_type, Points};
use crate::watch::Watch;

/// Points of one command to a device. Between commands, signals are looked for and progress is told.
const CHUNK: usize = 4096;

/// Seconds on the clock and of the processor, and triangles.
type Timed<'py> = ((f64, f64), Bound<'py, PyAny>);

/// Points, triangles, hull, duplicates and report of a mesh.
type Lists<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyDict>);

/// The seconds that the library takes for a mesh by itself, on the clock and of the processor, and the triangles. The
/// bench compares them with what Python takes.
#[pyfunction]
pub fn library<'py>(points: &Bound<'py, PyAny>, threads: Option<NonZeroU32>) -> PyResult<Timed<'py>> {
    let py = points.py();
    let processor = || py.import("time")?.call_method0("process_time")?.extract::<f64>();
    of_any_type!(Points, Points::read(points)?, points => {
        let (start, began) = (Instant::now(), processor()?);
        let found = Device::cpu(threads).session().and_then(|mut session| session.triangulate(&points));
        let seconds = (start.elapsed().as_secs_f64(), processor()? - began);
        let mesh = found.map_err(|error| of_job(py, &error))?.mesh;
        Ok((seconds, array(py, mesh.triangles)?))
    })
}

/// Why there is no mesh.
enum Failure {
    Library(ConstrainedError),
    /// An exception of a signal or of the listener.
    Raised(PyErr),
}

/// The back ends that do a job: one or several addresses, or none for the CPU triangulator.
struct Choice {
    addresses: Vec<String>,
    threads: Option<NonZeroU32>,
}

/// Triangulates an array of points. The interpreter is free for other threads meanwhile.
#[pyfunction]
pub fn triangulate<'py>(
    points: &Bound<'py, PyAny>,
    backends: Vec<String>,
    threads: Option<NonZeroU32>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Lists<'py>> {
    let (py, choice) = (points.py(), Choice { addresses: backends, threads });
    of_any_type!(Points, Points::read(points)?, points => {
        look_for_memory(py, points.len(), BYTES_OF_A_JOB)?;
        let solution = py.detach(|| watched(progress, |options| Ok(solve(points, &choice, options)?)));
        solution.map_err(|failure| failure.into_exception(py)).and_then(|solution| lists(py, solution))
    })
}

/// Points, hull, duplicates and report of a constrained mesh, and a dictionary with what constraints made of it.
type ConstrainedLists<'py> =
    (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyDict>);

/// Triangulates an array of points with constraints as one job of at most one back end. The interpreter is free for
/// other threads meanwhile.
#[pyfunction]
pub fn triangulate_constrained<'py>(
    points: &Bound<'py, PyAny>,
    backends: Vec<String>,
    threads: Option<NonZeroU32>,
    progress: Option<Py<PyAny>>,
    asked: Asked<'py>,
) -> PyResult<ConstrainedLists<'py>> {
    let (py, choice) = (points.py(), Choice { addresses: backends, threads });
    of_any_type!(Points, Points::read(points)?, points => {
        let wanted = Wanted::of(&asked)?;
        look_for_memory(py, points.len(), BYTES_OF_A_JOB)?;
        look_for_memory(py, points.len() + wanted.constraints.len(), BYTES_OF_A_CONSTRAINT)?;
        let found = py.detach(|| watched(progress, |options| {
            choice.open()?.session()?.triangulate_constrained(&points, &wanted.plan(), options)
        }));
        let (found, report) = found.map_err(|failure| failure.into_exception(py))?;
        let report = described(py, &report)?;
        let made = described_plan(py, found.made)?;
        let mesh = Mesh::new(points, Vec::new(), found.hull, found.duplicates);
        let [points, _, hull, duplicates] = mesh_lists(py, mesh)?;
        Ok((points, hull, duplicates, report, made))
    })
}

impl Failure {
    fn into_exception(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Library(ConstrainedError::Job(error)) => of_job(py, &error),
            Self::Library(error) => bad_input(py, &error.to_string()),
            Self::Raised(error) => error,
        }
    }
}

/// Does the job, and ends it if a signal or the listener asks for that.
fn watched<T>(
    progress: Option<Py<PyAny>>,
    job: impl FnOnce(&Options<'_>) -> Result<T, ConstrainedError>,
) -> Result<T, Failure> {
    let watch = Watch::new(progress);
    let listener = |progress| watch.hear(progress);
    let found = job(&Options::default().progress(&listener).insert_chunk(CHUNK));
    match (found, watch.into_raised()) {
        (_, Some(error)) => Err(Failure::Raised(error)),
        (found, None) => found.map_err(Failure::Library),
    }
}

impl Choice {
    /// Opens the only back end, or the first of several.
    fn open(&self) -> Result<Device, Error> {
        match self.addresses.first() {
            Some(address) if address != "cpu" => Device::open(address),
            _ => Ok(Device::cpu(self.threads)),
        }
    }
}

fn solve<P: PlanePoint>(points: Vec<P>, choice: &Choice, options: &Options<'_>) -> Result<Solution<P>, Error> {
    if choice.addresses.len() > 1 {
        return Fleet::open(&choice.addresses)?.triangulate(&points, options);
    }
    choice.open()?.session()?.triangulate_owned(points, options)
}

fn lists<'py, T: Element + Copy>(py: Python<'py>, solution: Solution<[T; 2]>) -> PyResult<Lists<'py>>
where
    [T; 2]: PlanePoint,
{
    let report = described(py, &solution.report)?;
    let [points, triangles, hull, duplicates] = mesh_lists(py, solution.mesh)?;
    Ok((points, triangles, hull, duplicates, report))
}

/// Points, triangles, hull and duplicates of a mesh as arrays. All but the last take the memory of the lists over.
pub fn mesh_lists<T: Element + Copy>(py: Python<'_>, mesh: Mesh<[T; 2]>) -> PyResult<[Bound<'_, PyAny>; 4]> {
    let duplicates: Vec<[u32; 2]> = mesh.duplicates.iter().map(|one| [one.index, one.of]).collect();
    Ok([
        array(py, mesh.points)?,
        array(py, mesh.triangles)?,
        PyArray1::from_vec(py, mesh.hull).into_any(),
        array(py, duplicates)?,
    ])
}

/// The report as a dictionary, with the names that the fields have in the library.
fn described<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let stages = PyDict::new(py);
    for &(stage, time) in &report.stages {
        stages.set_item(stage, time.as_secs_f64())?;
    }
    let shares = report.shares.iter().map(|share| (&share.device, share.parts, share.points, &share.left_out));
    dict.set_item("points", report.points)?;
    dict.set_item("distinct", report.distinct)?;
    dict.set_item("duplicates", report.duplicates)?;
    dict.set_item("triangles", report.triangles)?;
    dict.set_item("hull", report.hull)?;
    dict.set_item("collinear", report.collinear)?;
    dict.set_item("backend", &report.backend)?;
    dict.set_item("order", report.order)?;
    dict.set_item("stages", stages)?;
    dict.set_item("counters", report.counters.map(|counters| counters.named().to_vec()))?;
    dict.set_item("clocks", report.clocks)?;
    dict.set_item("step", report.lattice.map(|lattice| lattice.step.to_string()))?;
    dict.set_item("bits", report.lattice.map(|lattice| lattice.bits))?;
    dict.set_item("contexts", report.contexts)?;
    dict.set_item("parts", report.parts)?;
    dict.set_item("shares", shares.collect::<Vec<_>>())?;
    Ok(dict)
}

/// The half-edges of triangles as int32, or as int64 if there are too many; -1 on the hull.
#[pyfunction]
pub fn halfedges<'py>(py: Python<'py>, triangles: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let triangles = triangle_list(triangles)?;
    look_for_memory(py, triangles.len(), BYTES_OF_A_TRIANGLE)?;
    let halfedges = py.detach(|| connected(triangles).halfedges());
    if i32::try_from(halfedges.len()).is_ok() {
        // `EMPTY`, all bits set, is -1 as a signed number.
        return Ok(PyArray1::from_vec(py, bytemuck::cast_vec::<u32, i32>(halfedges)).into_any());
    }
    let signed = |half| if half == EMPTY { -1 } else { i64::from(half) };
    Ok(PyArray1::from_vec(py, halfedges.into_iter().map(signed).collect()).into_any())
}

/// The neighbours of triangles, opposite their vertices; -1 on the hull.
#[pyfunction]
pub fn neighbors<'py>(py: Python<'py>, triangles: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let triangles = triangle_list(triangles)?;
    look_for_memory(py, triangles.len(), BYTES_OF_A_TRIANGLE)?;
    let neighbors: Vec<[i32; 3]> = py.detach(|| {
        let halfedges = connected(triangles).halfedges();
        // Half-edge `3 t` is opposite vertex 2. A mesh has fewer than 2^31 triangles.
        let beside = |half: u32| if half == EMPTY { -1 } else { (half / 3) as i32 };
        halfedges.as_chunks().0.iter().map(|&[a, b, c]: &[u32; 3]| [b, c, a].map(beside)).collect()
    });
    array(py, neighbors)
}

/// Proves with the validator that a mesh is the canonical one of its points.
#[pyfunction]
pub fn verify(
    points: &Bound<'_, PyAny>,
    triangles: &Bound<'_, PyAny>,
    hull: Vec<u32>,
    duplicates: Vec<[u32; 2]>,
) -> PyResult<()> {
    let (py, triangles) = (points.py(), triangle_list(triangles)?);
    let duplicates = duplicates.into_iter().map(|[index, of]| Duplicate { index, of }).collect();
    look_for_memory(py, triangles.len(), BYTES_OF_A_TRIANGLE)?;
    let verified = of_any_type!(Points, Points::read(points)?, points => {
        py.detach(|| Mesh::new(points, triangles, hull, duplicates).verify())
    });
    verified.map_err(|error| exception(py, "VerifyError", &error.to_string()))
}

/// A mesh without points, of which only the triangles are asked.
fn connected(triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh::new(Vec::new(), triangles, Vec::new(), Vec::new())
}
