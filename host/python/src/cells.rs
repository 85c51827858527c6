//! Voronoi cells, and points spread evenly.

use std::num::NonZeroUsize;

use incircle::lloyd::{relax, End, Stop};
use incircle::voronoi::{Cells, Clip, Side, Voronoi};
use incircle::{GridSet, GridSetError, PlanePoint, Quantize};
use numpy::{Element, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{bad_input, of_job};
use crate::points::{array, list, of_any_type, Points};

/// Bits below the lattice that a relaxation needs for places between the points.
const SPARE_BITS: u32 = 8;

/// Lists of the cells inside a clip.
#[derive(Default)]
struct Clipped {
    /// The corners of all pieces, one piece behind the other.
    corners: Vec<[f64; 2]>,
    /// The first corner of each piece, and the end of the last.
    starts: Vec<u64>,
    /// The point of each piece.
    points: Vec<u32>,
    areas: Vec<f64>,
    neighbors: Vec<u32>,
    neighbor_starts: Vec<u64>,
}

/// The Voronoi diagram of a set, as a dictionary; with the cells inside the clip if there is one.
#[pyfunction]
pub fn voronoi<'py>(
    points: &Bound<'py, PyAny>,
    corners: &Bound<'py, PyAny>,
    is_clipped: bool,
    quantize: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let py = points.py();
    let set = of_any_type!(Points, Points::read(points)?, points => grid_set(py, points, corners, 0, quantize))?;
    let clip = is_clipped.then(|| set.clip()).transpose().map_err(|error| bad_input(py, &error.to_string()))?;
    let mesh = py.detach(|| incircle::triangulate(set.points())).map_err(|error| of_job(py, &error))?;
    let diagram = py.detach(|| Voronoi::of(&mesh)).map_err(|error| bad_input(py, &error.to_string()))?;
    let dict = PyDict::new(py);
    describe(py, &dict, &diagram, &set)?;
    let duplicates: Vec<[u32; 2]> = mesh.duplicates.iter().map(|one| [one.index, one.of]).collect();
    dict.set_item("duplicates", array(py, duplicates)?)?;
    dict.set_item("largest_error", set.quantization().map(|quantization| quantization.largest_error))?;
    dict.set_item("clipped", None::<u8>)?;
    if let Some(clip) = clip {
        let lists = py.detach(|| clipped(&diagram, &clip, &set));
        let inner = PyDict::new(py);
        inner.set_item("corners", array(py, lists.corners)?)?;
        inner.set_item("starts", PyArray1::from_vec(py, lists.starts))?;
        inner.set_item("points", PyArray1::from_vec(py, lists.points))?;
        inner.set_item("areas", PyArray1::from_vec(py, lists.areas))?;
        inner.set_item("neighbors", PyArray1::from_vec(py, lists.neighbors))?;
        inner.set_item("neighbor_starts", PyArray1::from_vec(py, lists.neighbor_starts))?;
        dict.set_item("clipped", inner)?;
    }
    Ok(dict)
}

/// Points and the corners of a clip, which have the same type of numbers, on one grid.
fn grid_set<T: Element + Copy>(
    py: Python<'_>,
    points: Vec<[T; 2]>,
    corners: &Bound<'_, PyAny>,
    spare: u32,
    quantize: bool,
) -> PyResult<GridSet>
where
    [T; 2]: PlanePoint + Send + Sync,
{
    let wrong = || PyTypeError::new_err("the corners of the clip have another type of numbers than the points");
    let corners: Vec<[T; 2]> = list(corners)?.ok_or_else(wrong)?;
    let how = quantize.then_some(Quantize::Fit);
    py.detach(|| GridSet::of(&points, &corners, spare, how)).map_err(|error| of_grid_set(py, &error))
}

fn of_grid_set(py: Python<'_>, error: &GridSetError) -> PyErr {
    match error {
        GridSetError::Points(error) => of_job(py, error),
        error => bad_input(py, &error.to_string()),
    }
}

/// Writes the diagram without a clip into a dictionary.
fn describe<'py>(py: Python<'py>, dict: &Bound<'py, PyDict>, diagram: &Voronoi<'_>, set: &GridSet) -> PyResult<()> {
    let vertices = py.detach(|| {
        let numbers = 0..diagram.vertex_count() as u32;
        numbers.map(|vertex| set.coordinates(diagram.vertex(vertex))).collect::<Vec<[f64; 2]>>()
    });
    let (starts, neighbors, corners) = py.detach(|| {
        let (mut starts, mut neighbors, mut corners) = (vec![0u64], Vec::new(), Vec::new());
        for point in 0..diagram.points().len() as u32 {
            for edge in diagram.cell(point).iter().flat_map(|cell| cell.edges()) {
                neighbors.push(edge.neighbor);
                corners.push(edge.from.map_or(-1, i64::from));
            }
            starts.push(neighbors.len() as u64);
        }
        (starts, neighbors, corners)
    });
    dict.set_item("vertices", array(py, vertices)?)?;
    dict.set_item("starts", PyArray1::from_vec(py, starts))?;
    dict.set_item("neighbors", PyArray1::from_vec(py, neighbors))?;
    dict.set_item("corners", PyArray1::from_vec(py, corners))
}

/// The cells inside a clip.
fn clipped(diagram: &Voronoi<'_>, clip: &Clip, set: &GridSet) -> Clipped {
    let mut lists = Clipped { starts: vec![0], neighbor_starts: vec![0], ..Clipped::default() };
    let (mut cells, length) = (Cells::new(diagram, clip), set.length());
    for point in 0..diagram.points().len() as u32 {
        let cell = cells.cell(point);
        let begin = lists.neighbors.len();
        for piece in cell.pieces() {
            for (corner, side) in piece.corners() {
                lists.corners.push(set.coordinates(corner));
                if let Side::Neighbor(neighbor) = side {
                    lists.neighbors.push(neighbor);
                }
            }
            lists.starts.push(lists.corners.len() as u64);
            lists.points.push(point);
        }
        lists.neighbors[begin..].sort_unstable();
        dedup_from(&mut lists.neighbors, begin);
        lists.neighbor_starts.push(lists.neighbors.len() as u64);
        lists.areas.push(cell.area() * length * length);
    }
    lists
}

/// Drops repeated items of a list behind a place; the items there are sorted.
fn dedup_from(list: &mut Vec<u32>, begin: usize) {
    let mut end = begin;
    for place in begin..list.len() {
        if end == begin || list[end - 1] != list[place] {
            list[end] = list[place];
            end += 1;
        }
    }
    list.truncate(end);
}

/// Places, steps, how many points moved in the last step, why the relaxation ended, and the largest error of a
/// quantisation.
type Spread<'py> = (Bound<'py, PyAny>, u32, usize, &'static str, Option<f64>);

/// Relaxes points inside a clip.
#[pyfunction]
pub fn spread<'py>(
    points: &Bound<'py, PyAny>,
    corners: &Bound<'py, PyAny>,
    stop: (u32, bool),
    threads: Option<NonZeroUsize>,
    quantize: bool,
) -> PyResult<Spread<'py>> {
    let py = points.py();
    let set = of_any_type!(Points, Points::read(points)?, points => {
        grid_set(py, points, corners, SPARE_BITS, quantize)
    })?;
    let clip = set.clip().map_err(|error| bad_input(py, &error.to_string()))?;
    let stop = Stop { iterations: stop.0, when_still: stop.1 };
    let threads = threads.or(std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let relaxed = py.detach(|| relax(set.points().to_vec(), &clip, stop, threads));
    let relaxed = relaxed.map_err(|error| bad_input(py, &error.to_string()))?;
    let end = match relaxed.end {
        End::Iterations => "iterations",
        End::Still => "still",
        End::Cycle => "cycle",
    };
    let places: Vec<[f64; 2]> = relaxed.points.iter().map(|&point| set.restore(point)).collect();
    let error = set.quantization().map(|quantization| quantization.largest_error);
    Ok((array(py, places)?, relaxed.iterations, relaxed.moved, end, error))
}
