//! A mesh of the software model with a triangle of each vertex, so that the walk to a point can begin at a vertex near
//! it.

use incircle_geometry::Point;
use incircle_model::{Approach, Counts, Insertion, Mesh, Record};
use incircle_protocol::{infinite_vertex, MAX_MODEL_POINTS};

/// Edges around one cavity that the model keeps; the standard cores keep as many.
pub const RING_CAPACITY: u32 = 32;
/// No triangle is known.
const NONE: u32 = u32::MAX;

/// The point as the model has it.
pub(crate) fn in_model(Point { x, y }: Point) -> incircle_model::predicate::Point {
    incircle_model::predicate::Point { x, y }
}

/// A mesh of the software model with a finite triangle of each vertex. The triangles take four bytes per point, and are
/// noted with each insertion.
#[derive(Clone, Debug)]
pub struct GuidedMesh {
    mesh: Mesh,
    infinite: u32,
    /// By vertex, that is by number of arrival. A point that fell onto a vertex has a record near it.
    triangle_of: Vec<u32>,
}

impl Default for GuidedMesh {
    fn default() -> Self {
        Self::new(MAX_MODEL_POINTS, RING_CAPACITY)
    }
}

impl GuidedMesh {
    /// An empty mesh for `capacity` points with boundary lists of `ring_capacity` entries.
    pub fn new(capacity: u32, ring_capacity: u32) -> Self {
        let mesh = Mesh::new(capacity, ring_capacity);
        Self { mesh, infinite: infinite_vertex(capacity), triangle_of: Vec::new() }
    }

    /// The mesh of the model.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The counters of the model since the last clear.
    pub fn counts(&self) -> &Counts {
        self.mesh.counts()
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.mesh.clear();
        self.triangle_of.clear();
    }

    /// A finite triangle with this vertex; `None` if there is none yet.
    pub fn triangle_of(&self, vertex: u32) -> Option<u32> {
        let found = self.triangle_of.get(vertex as usize).copied()?;
        self.mesh.records().get(found as usize)?.v.contains(&vertex).then_some(found)
    }

    /// Inserts a point. The search for it begins at a triangle of the vertex `guide`, by number of arrival; where the
    /// last search ended if there is no such vertex before this one. The mesh is the same wherever the search
    /// begins.
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

    /// Inserts a point as [`Self::insert`] does, unless there is a vertex at its place: then gives that one as the
    /// error. Otherwise gives the vertex of the point.
    pub fn insert_unless_there(&mut self, point: Point, guide: Option<u32>) -> Result<u32, u32> {
        let own = self.triangle_of.len() as u32;
        let Some(approach) = self.walk_to(point, guide) else {
            self.insert_first(point);
            return Ok(own);
        };
        let (vertex, at) = approach.nearest();
        if at == in_model(point) {
            return Err(vertex);
        }
        let record = approach.record();
        if approach.insert() == Insertion::Inserted {
            self.note_star(record);
        }
        Ok(own)
    }

    /// A vertex near this point, found by a search that begins at `guide`; `None` before the first triangle.
    pub fn find(&mut self, point: Point, guide: Option<u32>) -> Option<u32> {
        self.walk_to(point, guide).map(|approach| approach.nearest().0)
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

    /// Notes a triangle of its vertices, unless it is a ghost.
    fn note(&mut self, triangle: u32, vertices: [u32; 3]) {
        if !vertices.contains(&self.infinite) {
            for vertex in vertices {
                self.triangle_of[vertex as usize] = triangle;
            }
        }
    }

    /// Notes the triangles around the point that was inserted last, of which this is one: all vertices of those that
    /// are gone are at them.
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
