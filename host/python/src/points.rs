//! Points as they come from arrays of numpy, and lists as they go there.

use incircle_geometry::pages;
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::memory::look_for_memory;

/// Points in one of the five types of numbers that the library takes from Python.
pub enum Points {
    F64(Vec<[f64; 2]>),
    F32(Vec<[f32; 2]>),
    I32(Vec<[i32; 2]>),
    I64(Vec<[i64; 2]>),
    U32(Vec<[u32; 2]>),
}

/// Evaluates an expression with the content of an enum that has one variant for each type of numbers.
macro_rules! of_any_type {
    ($kind:ident, $value:expr, $name:pat => $body:expr) => {
        match $value {
            $kind::F64($name) => $body,
            $kind::F32($name) => $body,
            $kind::I32($name) => $body,
            $kind::I64($name) => $body,
            $kind::U32($name) => $body,
        }
    };
}
pub(crate) use of_any_type;

impl Points {
    /// Reads an array of two columns once, whatever its order and strides. The list has no tie to the array, so later
    /// writes to the array change nothing.
    pub fn read(array: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Some(points) = list(array)? {
            return Ok(Self::F64(points));
        }
        if let Some(points) = list(array)? {
            return Ok(Self::F32(points));
        }
        if let Some(points) = list(array)? {
            return Ok(Self::I32(points));
        }
        if let Some(points) = list(array)? {
            return Ok(Self::I64(points));
        }
        if let Some(points) = list(array)? {
            return Ok(Self::U32(points));
        }
        Err(PyTypeError::new_err(
            "points must be an array of float64, float32, int32, int64 or uint32 with two columns",
        ))
    }
}

/// The rows of an array whose items have the type `T`; `None` for an array of another type or shape.
pub fn list<T: Element + Copy, const N: usize>(array: &Bound<'_, PyAny>) -> PyResult<Option<Vec<[T; N]>>> {
    let Ok(array) = array.cast::<PyArray2<T>>() else { return Ok(None) };
    if array.shape()[1] != N || !array.is_aligned() {
        return Ok(None);
    }
    let array = array.try_readonly()?;
    look_for_memory(array.py(), array.shape()[0], size_of::<[T; N]>())?;
    let mut list = pages::with_room(array.shape()[0]);
    match array.as_slice() {
        // A slice may also have the columns one after the other.
        Ok(items) if array.is_c_contiguous() => list.extend_from_slice(items.as_chunks().0),
        _ => list.extend(array.as_array().rows().into_iter().map(|row| std::array::from_fn(|column| row[column]))),
    }
    Ok(Some(list))
}

/// A list of rows as an array. The array takes the memory of the list over.
pub fn array<T: Element + Copy, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Bound<'_, PyAny>> {
    let count = rows.len();
    let items = PyArray1::from_vec(py, rows.into_flattened());
    Ok(items.reshape([count, N])?.into_any())
}
