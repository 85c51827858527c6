//! Meshes that live: points come, go and move.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::cell::RefCell;

use incircle_geometry::living::{Error, Location};
use incircle_geometry::pages::has_room;
use incircle_geometry::Triangulation;

use crate::batch::{flat, pairs};
use crate::border::{give, points, told};

type Mesh = Triangulation<[f64; 2]>;

/// The most bytes a point that a mesh needs while it is made.
const BYTES_OF_A_POINT: usize = 500;
/// After this many insertions the memory for the growth of all lists is looked for again.
const LOOK: u32 = 1024;

thread_local! {
    /// The meshes of the program, by their handles; `None` where one was freed.
    static MESHES: RefCell<Vec<Option<Mesh>>> = const { RefCell::new(Vec::new()) };
}

/// Why a call failed, as a sentence.
struct Failure(String);

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self(error.to_string())
    }
}

/// Calls `ask` with the mesh of a handle.
fn with(handle: usize, ask: impl FnOnce(&mut Mesh) -> Result<f64, Failure>) -> Result<f64, String> {
    MESHES.with_borrow_mut(|meshes| match meshes.get_mut(handle) {
        Some(Some(mesh)) => ask(mesh).map_err(|Failure(text)| text),
        _ => Err("the triangulation was freed: make another one".to_owned()),
    })
}

/// Looks whether there are `bytes` bytes of memory, because the library takes memory without a way to refuse.
fn look_for_memory(bytes: usize) -> Result<(), Failure> {
    let text = || Failure(format!("this may need {bytes} bytes more, and the module cannot get them"));
    has_room(bytes).then_some(()).ok_or_else(text)
}

/// Looks whether there is the memory for a job on all points of a mesh.
fn look_for_a_job(mesh: &Mesh) -> Result<(), Failure> {
    look_for_memory(mesh.len().saturating_mul(BYTES_OF_A_POINT))
}

fn number(index: Option<u32>) -> f64 {
    index.map_or(-1.0, f64::from)
}

/// Makes a mesh of the points in the buffer, and returns its handle.
#[no_mangle]
pub extern "C" fn living_new() -> f64 {
    let points = points();
    if let Err(Failure(text)) = look_for_memory(points.len().saturating_mul(BYTES_OF_A_POINT)) {
        return told(Err(text));
    }
    told(Mesh::from(points).map(|mesh| {
        MESHES.with_borrow_mut(|meshes| {
            let free = meshes.iter().position(Option::is_none).unwrap_or(meshes.len());
            if free == meshes.len() {
                meshes.push(None);
            }
            meshes[free] = Some(mesh);
            free as f64
        })
    }))
}

/// Frees a mesh. Its handle may then name another mesh. The last mesh takes the table with it.
#[no_mangle]
pub extern "C" fn living_free(handle: usize) {
    MESHES.with_borrow_mut(|meshes| {
        if let Some(place) = meshes.get_mut(handle) {
            *place = None;
        }
        if meshes.iter().all(Option::is_none) {
            *meshes = Vec::new();
        }
    });
}

/// Inserts a point and returns its index.
#[no_mangle]
pub extern "C" fn living_insert(handle: usize, x: f64, y: f64) -> f64 {
    told(with(handle, |mesh| {
        if mesh.next_index().is_multiple_of(LOOK) {
            // A list that doubles needs twice its bytes while it is copied, and all lists may double in turn.
            look_for_memory(mesh.bytes().saturating_mul(2).saturating_add(LOOK as usize * BYTES_OF_A_POINT))?;
        }
        Ok(mesh.insert([x, y])?.into())
    }))
}

/// Deletes the point of an index.
#[no_mangle]
pub extern "C" fn living_delete(handle: usize, index: u32) -> f64 {
    told(with(handle, |mesh| Ok(mesh.delete(index).map(|()| 0.0)?)))
}

/// Moves the point of an index.
#[no_mangle]
pub extern "C" fn living_move(handle: usize, index: u32, x: f64, y: f64) -> f64 {
    told(with(handle, |mesh| Ok(mesh.move_to(index, [x, y]).map(|()| 0.0)?)))
}

/// Moves all points to the places in the buffer, in the order of their indices.
#[no_mangle]
pub extern "C" fn living_move_all(handle: usize) -> f64 {
    let places = points();
    told(with(handle, |mesh| {
        look_for_a_job(mesh)?;
        Ok(mesh.move_all(&places).map(|()| 0.0)?)
    }))
}

/// Says what a place is: nothing (0), a vertex, an edge, a triangle, or outside (4) beyond an edge. The list has the
/// vertices.
#[no_mangle]
pub extern "C" fn living_locate(handle: usize, x: f64, y: f64) -> f64 {
    told(with(handle, |mesh| {
        let (kind, vertices) = match mesh.locate([x, y]) {
            Location::None => (0.0, Vec::new()),
            Location::Vertex(vertex) => (1.0, vec![vertex]),
            Location::Edge(ends) => (2.0, ends.to_vec()),
            Location::Triangle(corners) => (3.0, corners.to_vec()),
            Location::Outside(ends) => (4.0, ends.to_vec()),
        };
        give(vec![vertices]);
        Ok(kind)
    }))
}

/// The index of the point nearest to a place, or -1 if there is none.
#[no_mangle]
pub extern "C" fn living_nearest(handle: usize, x: f64, y: f64) -> f64 {
    told(with(handle, |mesh| Ok(number(mesh.nearest([x, y])))))
}

/// Lists the neighbours of a point.
#[no_mangle]
pub extern "C" fn living_neighbors(handle: usize, index: u32) -> f64 {
    told(with(handle, |mesh| {
        let found = mesh.neighbors(index)?.collect();
        give(vec![found]);
        Ok(0.0)
    }))
}

/// The number of living points.
#[no_mangle]
pub extern "C" fn living_size(handle: usize) -> f64 {
    told(with(handle, |mesh| Ok(mesh.len() as f64)))
}

/// Lists triangles, hull, duplicates and indices of the canonical mesh of the living points. Positions in the first
/// three are positions in the list of indices.
#[no_mangle]
pub extern "C" fn living_mesh(handle: usize) -> f64 {
    told(with(handle, |mesh| {
        look_for_a_job(mesh)?;
        let answer = mesh.mesh();
        let duplicates = pairs(&answer.duplicates);
        give(vec![flat(answer.triangles), answer.hull, duplicates, mesh.indices()]);
        Ok(0.0)
    }))
}

/// Lists the triangles by the indices of their points, in no order: quicker than the canonical mesh.
#[no_mangle]
pub extern "C" fn living_triangles(handle: usize) -> f64 {
    told(with(handle, |mesh| {
        look_for_a_job(mesh)?;
        give(vec![flat(mesh.triangles().collect())]);
        Ok(0.0)
    }))
}
