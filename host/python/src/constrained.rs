//! Constraints forced into a finished mesh, and the proof of a constrained mesh.

use incircle::constraints::{constrain, Domain, Plan};
use incircle::verify::verify_constrained;
use incircle::{Duplicate, Mesh, PlanePoint};
use numpy::{Element, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{bad_input, exception};
use crate::memory::{look_for_memory, BYTES_OF_A_CONSTRAINT};
use crate::points::{array, list, of_any_type, Points};

/// Constraints and domain as they come from Python: pairs of indices, how many of them bound nothing, the name of the
/// domain, and places in holes and regions in the type of numbers of the points.
#[derive(FromPyObject)]
pub struct Asked<'py> {
    constraints: Bound<'py, PyAny>,
    lines: usize,
    domain: String,
    holes: Bound<'py, PyAny>,
    regions: Bound<'py, PyAny>,
}

/// The same in Rust.
struct Wanted<P> {
    constraints: Vec<[u32; 2]>,
    lines: usize,
    domain: Domain,
    holes: Vec<P>,
    regions: Vec<P>,
}

impl<T: Element + Copy> Wanted<[T; 2]> {
    fn of(asked: &Asked<'_>) -> PyResult<Self> {
        let wrong = || PyTypeError::new_err("constraints are pairs of uint32, and holes and regions like the points");
        let domain = asked.domain.parse::<Domain>();
        Ok(Self {
            constraints: list(&asked.constraints)?.ok_or_else(wrong)?,
            lines: asked.lines,
            domain: domain.map_err(|error| PyTypeError::new_err(error.to_string()))?,
            holes: list(&asked.holes)?.ok_or_else(wrong)?,
            regions: list(&asked.regions)?.ok_or_else(wrong)?,
        })
    }
}

impl<P> Wanted<P> {
    fn plan(&self) -> Plan<'_, P> {
        let Self { constraints, lines, domain, holes, regions } = self;
        Plan { constraints, lines: *lines, domain: *domain, holes, regions }
    }
}

/// Forces constraints into the mesh with these lists. The answer is a dictionary with the names of the library.
#[pyfunction]
pub fn constrained<'py>(
    points: &Bound<'py, PyAny>,
    triangles: &Bound<'py, PyAny>,
    hull: Vec<u32>,
    duplicates: Vec<[u32; 2]>,
    asked: Asked<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let (py, triangles) = (points.py(), triangle_list(triangles)?);
    let duplicates = duplicates.into_iter().map(|[index, of]| Duplicate { index, of }).collect();
    of_any_type!(Points, Points::read(points)?, points => {
        let wanted = Wanted::of(&asked)?;
        forced(py, Mesh::new(points, triangles, hull, duplicates), &wanted)
    })
}

fn forced<'py, P>(py: Python<'py>, mesh: Mesh<P>, wanted: &Wanted<P>) -> PyResult<Bound<'py, PyDict>>
where
    P: PlanePoint + Send + Sync,
{
    look_for_memory(py, mesh.points.len() + wanted.constraints.len(), BYTES_OF_A_CONSTRAINT)?;
    let made = py.detach(|| constrain(&mesh, &wanted.plan()));
    let made = made.map_err(|error| bad_input(py, &error.to_string()))?;
    let mut starts = vec![0u32];
    let mut constraints = Vec::new();
    for (_, some) in made.pieces.iter() {
        constraints.extend_from_slice(some);
        starts.push(constraints.len() as u32);
    }
    let dict = PyDict::new(py);
    dict.set_item("pieces", array(py, made.pieces.edges().to_vec())?)?;
    dict.set_item("piece_starts", PyArray1::from_vec(py, starts))?;
    dict.set_item("piece_constraints", PyArray1::from_vec(py, constraints))?;
    dict.set_item("triangles", array(py, made.triangles)?)?;
    dict.set_item("regions", PyArray1::from_vec(py, made.regions))?;
    dict.set_item("marked", PyArray1::from_vec(py, made.marked))?;
    Ok(dict)
}

/// Proves with the validator that triangles are those of the domain in the canonical constrained mesh of the points.
#[pyfunction]
pub fn verify_plan<'py>(points: &Bound<'py, PyAny>, triangles: &Bound<'py, PyAny>, asked: Asked<'py>) -> PyResult<()> {
    let (py, triangles) = (points.py(), triangle_list(triangles)?);
    let verified = of_any_type!(Points, Points::read(points)?, points => {
        let wanted = Wanted::of(&asked)?;
        look_for_memory(py, points.len() + wanted.constraints.len(), BYTES_OF_A_CONSTRAINT)?;
        py.detach(|| verify_constrained(&points, &triangles, &wanted.plan()))
    });
    verified.map(|_| ()).map_err(|error| exception(py, "VerifyError", &error.to_string()))
}

/// The rows of an array of triangles.
pub fn triangle_list(triangles: &Bound<'_, PyAny>) -> PyResult<Vec<[u32; 3]>> {
    let wrong = || PyTypeError::new_err("triangles must be an array of uint32 with three columns");
    list(triangles)?.ok_or_else(wrong)
}
