//! Voronoi cells, and points spread evenly.

use std::num::NonZeroUsize;

use incircle::lloyd::{self, repeat, step, weighted_step, Density, End, Stop};
use incircle::voronoi::Clip;
use incircle::{CellLists, GridSet, GridSetError, PlanePoint, Quantize, VoronoiLists, EMPTY};
use numpy::{Element, PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{bad_input, of_job};
use crate::memory::{look_for_memory, BYTES_OF_A_CELL, BYTES_OF_A_PIXEL};
use crate::points::{array, list, of_any_type, Points};
use crate::watch::Signals;

/// Bits below the lattice that a relaxation needs for places between the points.
const SPARE_BITS: u32 = 8;

/// A clip as it comes from Python: the corners of all rings in the type of numbers of the points, and how many each
/// ring has. Without counts there is one ring, or two corners of a rectangle, or none.
#[derive(FromPyObject)]
pub struct Border<'py>(Bound<'py, PyAny>, Vec<usize>);

impl Border<'_> {
    /// The clip that these corners of a set make.
    fn clip(&self, py: Python<'_>, set: &GridSet) -> PyResult<Clip> {
        let clip = if self.1.is_empty() { set.clip() } else { set.clip_with_holes(&self.1) };
        clip.map_err(|error| bad_input(py, &error.to_string()))
    }
}

/// The Voronoi diagram of a set, as a dictionary; with the cells inside the clip if there is one.
#[pyfunction]
pub fn voronoi<'py>(
    points: &Bound<'py, PyAny>,
    border: Border<'py>,
    is_clipped: bool,
    quantize: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let py = points.py();
    let set = of_any_type!(Points, Points::read(points)?, points => grid_set(py, points, &border, 0, quantize))?;
    let clip = is_clipped.then(|| border.clip(py, &set)).transpose()?;
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
    dict.set_item("is_hole", PyArray1::from_vec(py, cells.is_hole))?;
    dict.set_item("areas", PyArray1::from_vec(py, cells.areas))?;
    dict.set_item("neighbors", PyArray1::from_vec(py, cells.neighbors))?;
    dict.set_item("neighbor_starts", PyArray1::from_vec(py, cells.neighbor_starts))?;
    Ok(dict)
}

/// Points and the corners of a clip, which have the same type of numbers, on one grid.
fn grid_set<T: Element + Copy>(
    py: Python<'_>,
    points: Vec<[T; 2]>,
    Border(corners, _): &Border<'_>,
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

/// Why a relaxation failed.
enum Failure {
    Library(lloyd::Error),
    /// An exception of a signal.
    Raised(PyErr),
}

/// Relaxes points inside a clip, by the weights of a density if there is one, unless a signal comes.
#[pyfunction]
pub fn spread<'py>(
    points: &Bound<'py, PyAny>,
    border: Border<'py>,
    stop: (u32, bool),
    threads: Option<NonZeroUsize>,
    quantize: bool,
    density: Option<PyReadonlyArray2<'py, u16>>,
) -> PyResult<Spread<'py>> {
    let py = points.py();
    let set = of_any_type!(Points, Points::read(points)?, points => {
        grid_set(py, points, &border, SPARE_BITS, quantize)
    })?;
    let clip = border.clip(py, &set)?;
    let density = density.map(|weights| density_over(py, &clip, &weights)).transpose()?;
    let stop = Stop { iterations: stop.0, when_still: stop.1 };
    let threads = threads.or(std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let relaxed = py.detach(|| {
        let signals = Signals::new();
        repeat(set.points().to_vec(), stop, |points| {
            signals.look().map_err(Failure::Raised)?;
            let moved = match &density {
                None => step(points, &clip, threads),
                Some(density) => weighted_step(points, &clip, density, threads),
            };
            moved.map_err(Failure::Library)
        })
    });
    let relaxed = relaxed.map_err(|failure| match failure {
        Failure::Library(error) => bad_input(py, &error.to_string()),
        Failure::Raised(error) => error,
    })?;
    let end = match relaxed.end {
        End::Iterations => "iterations",
        End::Still => "still",
        End::Cycle => "cycle",
    };
    let places: Vec<[f64; 2]> = relaxed.points.iter().map(|&point| set.restore(point)).collect();
    let error = set.quantization().map(|quantization| quantization.largest_error);
    Ok((array(py, places)?, relaxed.iterations, relaxed.moved, end, error))
}

/// The density of an array of weights, whose first row lies uppermost.
fn density_over(py: Python<'_>, clip: &Clip, weights: &PyReadonlyArray2<'_, u16>) -> PyResult<Density> {
    let columns = weights.shape()[1];
    look_for_memory(py, weights.len(), BYTES_OF_A_PIXEL)?;
    let weights: Vec<u16> = weights.as_array().iter().copied().collect();
    py.detach(|| Density::over(clip, columns, &weights)).map_err(|error| bad_input(py, &error.to_string()))
}
