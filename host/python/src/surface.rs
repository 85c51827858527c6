//! Values between points.

use std::num::NonZeroUsize;

use incircle::interpolate::{self, Method, Outside};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::error::{bad_input, of_job};
use crate::memory::{look_for_memory, BYTES_OF_A_CELL, BYTES_OF_A_PLACE};
use crate::points::{array, list};

type Any<'py> = PyResult<Bound<'py, PyAny>>;

/// Points with a value each, behind `incircle.Surface`, which documents its calls.
#[pyclass(module = "incircle._native", frozen)]
pub struct Surface {
    points: Vec<[f64; 2]>,
    surface: interpolate::Surface,
}

#[pymethods]
impl Surface {
    #[new]
    fn new(points: &Bound<'_, PyAny>, values: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        let (py, points, values) = (points.py(), places(points)?, values.to_vec()?);
        look_for_memory(py, points.len(), BYTES_OF_A_CELL)?;
        let mesh = py.detach(|| incircle::triangulate(&points)).map_err(|error| of_job(py, &error))?;
        let surface = py.detach(|| interpolate::Surface::new(&points, &mesh.triangles, &values));
        let surface = surface.map_err(|error| bad_input(py, &error.to_string()))?;
        Ok(Self { points, surface })
    }

    fn values<'py>(
        &self,
        at: &Bound<'py, PyAny>,
        method: &str,
        outside: &str,
        threads: Option<NonZeroUsize>,
    ) -> Any<'py> {
        let (py, at) = (at.py(), places(at)?);
        look_for_memory(py, at.len(), BYTES_OF_A_PLACE)?;
        let method = match method {
            "linear" => Method::Linear,
            "laplace" => Method::Laplace,
            "sibson" => Method::Sibson,
            other => return Err(PyTypeError::new_err(format!("{other} is no method"))),
        };
        let outside = match outside {
            "nan" => Outside::Nan,
            "nearest" => Outside::Nearest,
            other => return Err(PyTypeError::new_err(format!("{other} is no value outside the hull"))),
        };
        let threads = threads.or(std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
        let values = py.detach(|| self.surface.values(method, outside, &at, threads));
        Ok(PyArray1::from_vec(py, values).into_any())
    }

    /// The places along each contour line of a level, and whether the line is closed.
    fn contours<'py>(&self, py: Python<'py>, level: f64) -> PyResult<Vec<(Bound<'py, PyAny>, bool)>> {
        look_for_memory(py, self.points.len(), BYTES_OF_A_CELL)?;
        let lines = py.detach(|| self.surface.contours(level));
        let place = |line: &interpolate::Contour| {
            let places = line.crossings.iter().map(|crossing| crossing.place(&self.points)).collect();
            Ok((array(py, places)?, line.is_closed))
        };
        lines.iter().map(place).collect()
    }
}

/// Places in doubles.
fn places(array: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 2]>> {
    list(array)?.ok_or_else(|| PyTypeError::new_err("places must be an array of float64 with two columns"))
}
