//! A mesh of the software model that knows a triangle of each vertex, so that a walk can begin at a
//! vertex near its point.

use incircle_geometry::Point;
use incircle_model::{Approach, Counts, Insertion, Mesh, Record};
use incircle_protocol::{infinite_vertex, MAX_MODEL_POINTS};

/// Entries of the boundary list of the model, the same number as in the standard cores.
pub const RING_CAPACITY: u32 = 32;
/// Marks a vertex of which no triangle is known.
const NONE: u32 = u32::MAX;

/// The point in the model's own type.
pub(crate) fn in_model(Point { x, y }: Point) -> incircle_model::predicate::Point {
    incircle_model::predicate::Point { x, y }
}

/// A mesh of the software model with a finite triangle of each vertex.
///
/// Use this mesh to insert points with a guide, which is a vertex near the point. The triangles take four bytes per
/// point and are updated with each insertion.
#[derive(Clone, Debug)]
pub struct GuidedMesh {
    mesh: Mesh,
    infinite: u32,
    /// For each vertex, that is by number of arrival, a finite triangle. A duplicate has a record near its place.
    triangle_of: Vec<u32>,
}

impl Default for GuidedMesh {
    fn default() -> Self {
        Self::new(MAX_MODEL_POINTS, RING_CAPACITY)
    }
}

impl GuidedMesh {
    /// Makes an empty mesh for `capacity` points with boundary lists of `ring_capacity` entries.
    pub fn new(capacity: u32, ring_capacity: u32) -> Self {
        let mesh = Mesh::new(capacity, ring_capacity);
        Self { mesh, infinite: infinite_vertex(capacity), triangle_of: Vec::new() }
    }

    /// The mesh of the software model.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The counters of the model since the last call of [`Self::clear`].
    pub fn counts(&self) -> &Counts {
        self.mesh.counts()
    }

    /// Removes all points, and sets the counters to zero.
    pub fn clear(&mut self) {
        self.mesh.clear();
        self.triangle_of.clear();
    }

    /// A finite triangle with this vertex; `None` if there is none yet.
    pub fn triangle_of(&self, vertex: u32) -> Option<u32> {
        let found = self.triangle_of.get(vertex as usize).copied()?;
        self.mesh.records().get(found as usize)?.v.contains(&vertex).then_some(found)
    }

    /// Inserts a point. The walk begins at a triangle of the vertex `guide`, a number of arrival, or at the end of the
    /// last walk if there is no such vertex before this point. The mesh is the same wherever the walk begins.
    pub fn insert(&mut self, point: Point, guide: Option<u32>) -> Insertion {
        match self.walk_to(point, guide) {
            None => self.insert_first(point),
            Some(approach) => {
                let record = approach.record();
                let insertion = approach.insert();
                match insertion {
                    Insertion::Inserted => self.note_star(record),
                    Insertion::Duplicate => self.triangle_of.push(record),
                    Insertion::Collinear | Insertion::Refused => {}
                }
                insertion
            }
        }
    }

    fn walk_to(&mut self, point: Point, guide: Option<u32>) -> Option<Approach<'_>> {
        let start = guide.and_then(|vertex| self.triangle_of.get(vertex as usize).copied());
        self.mesh.approach(in_model(point), start.filter(|&record| record != NONE))
    }

    /// Inserts one of the first three points.
    fn insert_first(&mut self, point: Point) -> Insertion {
        let insertion = self.mesh.insert(in_model(point));
        if insertion != Insertion::Refused {
            self.triangle_of.push(NONE);
        }
        if let Some(first) = self.mesh.records().first() {
            self.note(0, first.v);
        }
        insertion
    }

    /// Notes a triangle for each of its vertices, unless the triangle is a ghost.
    fn note(&mut self, triangle: u32, vertices: [u32; 3]) {
        if !vertices.contains(&self.infinite) {
            for vertex in vertices {
                self.triangle_of[vertex as usize] = triangle;
            }
        }
    }

    /// Notes all triangles of the star around the last point, one of which is `of_star`. Each vertex of a removed
    /// triangle has a triangle in the star.
    fn note_star(&mut self, of_star: u32) {
        self.triangle_of.push(NONE);
        let mut triangle = of_star;
        loop {
            let Record { v, n } = self.mesh.records()[triangle as usize];
            self.note(triangle, v);
            triangle = n[1];
            if triangle == of_star {
                return;
            }
        }
    }
}
