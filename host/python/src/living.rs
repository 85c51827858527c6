//! The mesh that lives, for each of the five types of numbers.

use incircle::living::{Location, Triangulation};
use incircle::PlanePoint;
use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::coordinate::{coordinate, Coordinate};
use crate::error::of_living;
use crate::job::mesh_lists;
use crate::memory::{
    look_for_memory, BYTES_OF_A_FOUND_PLACE, BYTES_OF_A_LISTED_POINT, BYTES_OF_A_LIVING_POINT, BYTES_OF_A_PLACE,
};
use crate::points::{array, of_any_type, Points};
use crate::watch::each;

type Any<'py> = PyResult<Bound<'py, PyAny>>;
/// A place as it comes from Python: x and y.
type Place<'a, 'py> = (&'a Bound<'py, PyAny>, &'a Bound<'py, PyAny>);

/// After so many single insertions the memory for the growth of all lists is looked for again.
const LOOK_FOR_MEMORY: u32 = 1024;

/// The triangulation that can be changed, in one of the types of numbers.
enum Mesh {
    F64(Triangulation<[f64; 2]>),
    F32(Triangulation<[f32; 2]>),
    I32(Triangulation<[i32; 2]>),
    I64(Triangulation<[i64; 2]>),
    U32(Triangulation<[u32; 2]>),
}

/// Evaluates an expression with a mesh and a list of points that have the same type of numbers.
macro_rules! of_same_type {
    ($mesh:expr, $points:expr, |$name:ident, $list:ident| $body:expr) => {
        match ($mesh, Points::read($points)?) {
            (Mesh::F64($name), Points::F64($list)) => $body,
            (Mesh::F32($name), Points::F32($list)) => $body,
            (Mesh::I32($name), Points::I32($list)) => $body,
            (Mesh::I64($name), Points::I64($list)) => $body,
            (Mesh::U32($name), Points::U32($list)) => $body,
            _ => Err(PyTypeError::new_err("the points have another type of numbers than the triangulation")),
        }
    };
}

/// The mesh that lives, behind `incircle.Triangulation`, which documents its calls.
#[pyclass(module = "incircle._native")]
pub struct Living(Mesh);

fn place<T: Coordinate>((x, y): Place<'_, '_>) -> PyResult<[T; 2]> {
    Ok([coordinate('x', x)?, coordinate('y', y)?])
}

/// The kind of a location as a number, and its vertices, -1 where there are fewer than three.
fn numbered(location: Location) -> (u8, [i64; 3]) {
    match location {
        Location::None => (0, [-1; 3]),
        Location::Vertex(a) => (1, [a.into(), -1, -1]),
        Location::Edge([a, b]) => (2, [a.into(), b.into(), -1]),
        Location::Triangle(corners) => (3, corners.map(i64::from)),
        Location::Outside([a, b]) => (4, [a.into(), b.into(), -1]),
    }
}

fn fresh<P: PlanePoint + Send>(py: Python<'_>, points: Vec<P>) -> PyResult<Triangulation<P>> {
    look_for_memory(py, points.len(), BYTES_OF_A_LIVING_POINT)?;
    py.detach(|| Triangulation::from(points)).map_err(|error| of_living(py, error))
}

/// Looks for the memory for `insertions` insertions. A list that doubles needs twice its bytes while it is copied, and
/// all lists may double in turn.
fn look_for_growth<P: PlanePoint>(py: Python<'_>, mesh: &Triangulation<P>, insertions: usize) -> PyResult<()> {
    look_for_memory(py, 2 * mesh.bytes() + insertions.saturating_mul(BYTES_OF_A_LIVING_POINT), 1)
}

impl Living {
    /// Looks for the memory for a list of all points or triangles.
    fn look_for_a_list(&self, py: Python<'_>) -> PyResult<()> {
        look_for_memory(py, self.__len__(), BYTES_OF_A_LISTED_POINT)
    }
}

#[pymethods]
impl Living {
    /// Makes the triangulation of an array of points, in the type of the array.
    #[new]
    fn new(points: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = points.py();
        Ok(Self(match Points::read(points)? {
            Points::F64(points) => Mesh::F64(fresh(py, points)?),
            Points::F32(points) => Mesh::F32(fresh(py, points)?),
            Points::I32(points) => Mesh::I32(fresh(py, points)?),
            Points::I64(points) => Mesh::I64(fresh(py, points)?),
            Points::U32(points) => Mesh::U32(fresh(py, points)?),
        }))
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        look_for_memory(py, self.bytes(), 1)?;
        Ok(Self(match &self.0 {
            Mesh::F64(mesh) => Mesh::F64(mesh.clone()),
            Mesh::F32(mesh) => Mesh::F32(mesh.clone()),
            Mesh::I32(mesh) => Mesh::I32(mesh.clone()),
            Mesh::I64(mesh) => Mesh::I64(mesh.clone()),
            Mesh::U32(mesh) => Mesh::U32(mesh.clone()),
        }))
    }

    fn insert(&mut self, x: &Bound<'_, PyAny>, y: &Bound<'_, PyAny>) -> PyResult<u32> {
        of_any_type!(Mesh, &mut self.0, mesh => {
            if mesh.next_index().is_multiple_of(LOOK_FOR_MEMORY) {
                look_for_growth(x.py(), mesh, LOOK_FOR_MEMORY as usize)?;
            }
            mesh.insert(place((x, y))?).map_err(|error| of_living(x.py(), error))
        })
    }

    fn insert_all<'py>(&mut self, points: &Bound<'py, PyAny>) -> Any<'py> {
        let py = points.py();
        of_same_type!(&mut self.0, points, |mesh, list| {
            look_for_growth(py, mesh, list.len())?;
            Ok(PyArray1::from_vec(py, each(py, &list, |&point| mesh.insert(point))?).into_any())
        })
    }

    fn delete(&mut self, py: Python<'_>, index: u32) -> PyResult<()> {
        of_any_type!(Mesh, &mut self.0, mesh => mesh.delete(index).map_err(|error| of_living(py, error)))
    }

    fn delete_all(&mut self, py: Python<'_>, indices: Vec<u32>) -> PyResult<()> {
        of_any_type!(Mesh, &mut self.0, mesh => {
            each(py, &indices, |&index| mesh.delete(index)).map(|_: Vec<()>| ())
        })
    }

    fn move_to(&mut self, index: u32, x: &Bound<'_, PyAny>, y: &Bound<'_, PyAny>) -> PyResult<()> {
        of_any_type!(Mesh, &mut self.0, mesh => {
            mesh.move_to(index, place((x, y))?).map_err(|error| of_living(x.py(), error))
        })
    }

    fn move_all(&mut self, places: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = places.py();
        of_same_type!(&mut self.0, places, |mesh, list| {
            look_for_memory(py, mesh.len(), BYTES_OF_A_LIVING_POINT)?;
            py.detach(|| mesh.move_all(&list)).map_err(|error| of_living(py, error))
        })
    }

    fn renumber<'py>(&mut self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        Ok(PyArray1::from_vec(py, of_any_type!(Mesh, &mut self.0, mesh => mesh.renumber())).into_any())
    }

    fn locate(&self, x: &Bound<'_, PyAny>, y: &Bound<'_, PyAny>) -> PyResult<(u8, [i64; 3])> {
        of_any_type!(Mesh, &self.0, mesh => Ok(numbered(mesh.locate(place((x, y))?))))
    }

    fn locate_all<'py>(&self, places: &Bound<'py, PyAny>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let py = places.py();
        let (kinds, vertices) = of_same_type!(&self.0, places, |mesh, list| {
            look_for_memory(py, list.len(), BYTES_OF_A_PLACE)?;
            let found = each(py, &list, |&at| Ok(numbered(mesh.locate(at))))?;
            Ok::<(Vec<u8>, Vec<_>), PyErr>(found.into_iter().unzip())
        })?;
        Ok((PyArray1::from_vec(py, kinds).into_any(), array(py, vertices)?))
    }

    fn nearest(&self, x: &Bound<'_, PyAny>, y: &Bound<'_, PyAny>) -> PyResult<Option<u32>> {
        of_any_type!(Mesh, &self.0, mesh => Ok(mesh.nearest(place((x, y))?)))
    }

    fn nearest_all<'py>(&self, places: &Bound<'py, PyAny>) -> Any<'py> {
        let py = places.py();
        of_same_type!(&self.0, places, |mesh, list| {
            look_for_memory(py, list.len(), BYTES_OF_A_PLACE)?;
            let indices: Vec<i64> = each(py, &list, |&at| Ok(mesh.nearest(at).map_or(-1, i64::from)))?;
            Ok(PyArray1::from_vec(py, indices).into_any())
        })
    }

    fn k_nearest<'py>(&self, x: &Bound<'py, PyAny>, y: &Bound<'py, PyAny>, count: usize) -> Any<'py> {
        look_for_memory(x.py(), count.min(self.__len__()), BYTES_OF_A_FOUND_PLACE)?;
        let found = of_any_type!(Mesh, &self.0, mesh => mesh.k_nearest(place((x, y))?, count));
        Ok(PyArray1::from_vec(x.py(), found).into_any())
    }

    fn within_circle<'py>(&self, x: &Bound<'py, PyAny>, y: &Bound<'py, PyAny>, radius: f64) -> Any<'py> {
        let found = of_any_type!(Mesh, &self.0, mesh => mesh.within_circle(place((x, y))?, radius));
        Ok(PyArray1::from_vec(x.py(), found).into_any())
    }

    fn within_rectangle<'py>(&self, corners: &Bound<'py, PyAny>) -> Any<'py> {
        let found = of_same_type!(&self.0, corners, |mesh, list| {
            let &[a, b] = list.as_slice() else { return Err(PyTypeError::new_err("a rectangle has two corners")) };
            Ok::<_, PyErr>(mesh.within_rectangle(a, b))
        })?;
        Ok(PyArray1::from_vec(corners.py(), found).into_any())
    }

    fn segment<'py>(&self, ends: &Bound<'py, PyAny>) -> Any<'py> {
        let found = of_same_type!(&self.0, ends, |mesh, list| {
            let &[a, b] = list.as_slice() else { return Err(PyTypeError::new_err("a segment has two ends")) };
            Ok::<_, PyErr>(mesh.segment(a, b))
        })?;
        array(ends.py(), found)
    }

    fn neighbors<'py>(&self, py: Python<'py>, index: u32) -> Any<'py> {
        of_any_type!(Mesh, &self.0, mesh => {
            let found = mesh.neighbors(index).map_err(|error| of_living(py, error))?;
            Ok(PyArray1::from_vec(py, found.collect()).into_any())
        })
    }

    fn star<'py>(&self, py: Python<'py>, index: u32) -> Any<'py> {
        of_any_type!(Mesh, &self.0, mesh => {
            let found = mesh.star(index).map_err(|error| of_living(py, error))?;
            array(py, found.collect())
        })
    }

    fn triangles<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        array(py, of_any_type!(Mesh, &self.0, mesh => mesh.triangles().collect()))
    }

    fn edges<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        array(py, of_any_type!(Mesh, &self.0, mesh => mesh.edges().collect()))
    }

    fn hull<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        Ok(PyArray1::from_vec(py, of_any_type!(Mesh, &self.0, mesh => mesh.hull().collect())).into_any())
    }

    fn vertices<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        Ok(PyArray1::from_vec(py, of_any_type!(Mesh, &self.0, mesh => mesh.vertices().collect())).into_any())
    }

    fn indices<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        Ok(PyArray1::from_vec(py, of_any_type!(Mesh, &self.0, mesh => mesh.indices())).into_any())
    }

    /// Points, triangles, hull and duplicates of the mesh of the living points.
    fn mesh<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; 4]> {
        of_any_type!(Mesh, &self.0, mesh => {
            look_for_memory(py, mesh.len(), BYTES_OF_A_LIVING_POINT)?;
            mesh_lists(py, py.detach(|| mesh.mesh()))
        })
    }

    /// The coordinates of the living points, in the order of their indices.
    fn points<'py>(&self, py: Python<'py>) -> Any<'py> {
        self.look_for_a_list(py)?;
        of_any_type!(Mesh, &self.0, mesh => {
            array(py, mesh.indices().into_iter().filter_map(|index| mesh.point(index)).collect())
        })
    }

    fn point<'py>(&self, py: Python<'py>, index: u32) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        of_any_type!(Mesh, &self.0, mesh => match mesh.point(index) {
            Some([x, y]) => Ok(Some((x.into_pyobject(py)?.into_any(), y.into_pyobject(py)?.into_any()))),
            None => Ok(None),
        })
    }

    fn place_of(&self, index: u32) -> Option<u32> {
        of_any_type!(Mesh, &self.0, mesh => mesh.place_of(index))
    }

    #[getter]
    fn next_index(&self) -> u32 {
        of_any_type!(Mesh, &self.0, mesh => mesh.next_index())
    }

    #[getter]
    fn bytes(&self) -> usize {
        of_any_type!(Mesh, &self.0, mesh => mesh.bytes())
    }

    fn __len__(&self) -> usize {
        of_any_type!(Mesh, &self.0, mesh => mesh.len())
    }
}
