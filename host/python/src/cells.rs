//! Voronoi cells, and points spread evenly.

use std::num::NonZeroUsize;

use incircle::lloyd::{relax, End, Stop};
use incircle::{CellLists, GridSet, GridSetError, PlanePoint, Quantize, VoronoiLists, EMPTY};
use numpy::{Element, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{bad_input, of_job};
use crate::memory::{look_for_memory, BYTES_OF_A_CELL};
use crate::points::{array, list, of_any_type, Points};

/// Bits below the lattice that a relaxation needs for places between the points.
const SPARE_BITS: u32 = 8;

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
    let lists = py.detach(|| VoronoiLists::of(&set, clip.as_ref())).map_err(|error| of_grid_set(py, &error))?;
    // `EMPTY` stands for infinity.
    let corners = lists.corners.iter().map(|&vertex| if vertex == EMPTY { -1 } else { i64::from(vertex) }).collect();
    let dict = PyDict::new(py);
    dict.set_item("vertices", array(py, lists.vertices)?)?;
    dict.set_item("starts", PyArray1::from_vec(py, lists.starts))?;
    dict.set_item("neighbors", PyArray1::from_vec(py, lists.neighbors))?;
    dict.set_item("corners", PyArray1::from_vec(py, corners))?;
    dict.set_item("duplicates", array(py, lists.duplicates)?)?;
    dict.set_item("largest_error", set.quantization().map(|quantization| quantization.largest_error))?;
    dict.set_item("clipped", lists.cells.map(|cells| described(py, cells)).transpose()?)?;
    Ok(dict)
}

/// The cells inside a clip as a dictionary.
fn described(py: Python<'_>, cells: CellLists) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("corners", array(py, cells.corners)?)?;
    dict.set_item("starts", PyArray1::from_vec(py, cells.starts))?;
    dict.set_item("points", PyArray1::from_vec(py, cells.points))?;
    dict.set_item("areas", PyArray1::from_vec(py, cells.areas))?;
    dict.set_item("neighbors", PyArray1::from_vec(py, cells.neighbors))?;
    dict.set_item("neighbor_starts", PyArray1::from_vec(py, cells.neighbor_starts))?;
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
    look_for_memory(py, points.len() + corners.len(), BYTES_OF_A_CELL)?;
    let how = quantize.then_some(Quantize::Fit);
    py.detach(|| GridSet::of(&points, &corners, spare, how)).map_err(|error| of_grid_set(py, &error))
}

fn of_grid_set(py: Python<'_>, error: &GridSetError) -> PyErr {
    match error {
        GridSetError::Points(error) => of_job(py, error),
        error => bad_input(py, &error.to_string()),
    }
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
