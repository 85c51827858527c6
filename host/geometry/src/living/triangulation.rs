//! The triangulation that can be changed: its parts, and finding places in it.

use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::constraint_list::Constraints;
use super::error::Error;
use super::level::Level;
use super::names::Names;
use super::walk::Place;
use crate::order::mix;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The number of bits of the hash of a vertex for each level. If all are 0, the vertex is in the level above, so about
/// one vertex in 2^5 of a level is there; the author of the hierarchy found one in 30 to be good. In tests it is one in
/// two, so that small sets have several levels.
const LEVEL_BITS: u32 = if cfg!(test) { 1 } else { 5 };
/// A walk begins at the last vertex if that is at most the square root of this many edges away, measured by one of its
/// edges; else at the top of the hierarchy.
const NEAR: f64 = 64.0;

/// A vertex near the place of the last call. Several threads may write it at the same time, because a walk may begin at
/// any vertex.
#[derive(Debug, Default)]
pub struct Hint(AtomicU32);

impl Hint {
    pub fn get(&self) -> u32 {
        self.0.load(Relaxed)
    }

    pub fn set(&self, vertex: u32) {
        self.0.store(vertex, Relaxed);
    }
}

impl Clone for Hint {
    fn clone(&self) -> Self {
        Self(AtomicU32::new(self.get()))
    }
}

/// A Delaunay triangulation that can be asked and changed; see [the module](super).
///
/// Each point that is inserted gets an index: 0, 1, 2 and so on. An index stays that of its point until the point is
/// deleted, and is never used again. A place with several points is named by the lowest of their indices in all
/// answers.
///
/// ```
/// use incircle_geometry::living::{Location, Triangulation};
///
/// let mut mesh = Triangulation::from([[0u32, 0], [4, 0], [4, 4], [0, 4]])?;
/// let middle = mesh.insert([2, 1])?;
/// assert_eq!(middle, 4);
/// assert_eq!(mesh.locate([2, 1]), Location::Vertex(4));
/// mesh.delete(middle)?;
/// assert_eq!(mesh.locate([2, 1]), Location::Triangle([0, 1, 2]));
/// assert_eq!(mesh.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Triangulation<P: PlanePoint> {
    /// The levels of the hierarchy from the lowest up. The lowest has all places.
    pub(super) levels: Vec<Level<P>>,
    pub(super) names: Names,
    /// The points at a place that has a point of a lower index: vertex and index.
    pub(super) duplicates: BTreeSet<(u32, u32)>,
    /// The index of the next point.
    pub(super) next: u32,
    pub(super) hint: Hint,
    /// None while there are no constraints.
    pub(super) constraints: Option<Box<Constraints<P>>>,
    /// The number of the next constraint.
    pub(super) next_constraint: u32,
}

impl<P: PlanePoint> Default for Triangulation<P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: PlanePoint> Triangulation<P> {
    /// Makes a triangulation without points.
    pub fn new() -> Self {
        Self {
            levels: vec![Level::default()],
            names: Names::default(),
            duplicates: BTreeSet::new(),
            next: 0,
            hint: Hint::default(),
            constraints: None,
            next_constraint: 0,
        }
    }

    /// The number of living points, duplicates included.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there are no living points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The point of an index; `None` if no living point has the index.
    pub fn point(&self, index: u32) -> Option<P> {
        self.names.get(index).map(|vertex| self.base().vertices[vertex as usize].point)
    }

    /// The name of the place of a point: the lowest living index there. A point is a duplicate if this is not its own
    /// index. `None` if no living point has the index.
    pub fn place_of(&self, index: u32) -> Option<u32> {
        self.names.get(index).map(|vertex| self.name(vertex))
    }

    /// The index that the next point will have.
    pub fn next_index(&self) -> u32 {
        self.next
    }

    /// The bytes of memory that the triangulation takes, without the few that duplicates and the numbers of constraints
    /// take.
    pub fn bytes(&self) -> usize {
        let constrained = self.constraints.iter().map(|own| &own.mesh.level);
        let levels: usize = self.levels.iter().chain(constrained).map(Level::bytes).sum();
        levels + self.names.bytes() + size_of::<Self>()
    }

    /// The lowest level, which has all places.
    #[inline(always)]
    pub(super) fn base(&self) -> &Level<P> {
        &self.levels[0]
    }

    /// The name of a vertex of the lowest level.
    #[inline(always)]
    pub(super) fn name(&self, vertex: u32) -> u32 {
        self.base().vertices[vertex as usize].name
    }

    /// The vertex of a living index.
    pub(super) fn vertex(&self, index: u32) -> Result<u32, Error> {
        self.names.get(index).ok_or_else(|| self.missing(index))
    }

    /// The error of an index that no living point has.
    pub(super) fn missing(&self, index: u32) -> Error {
        if index < self.next {
            Error::Deleted { index }
        } else {
            Error::Unknown { index, next: self.next }
        }
    }

    /// The highest level that a vertex of the lowest level is in.
    pub(super) fn top_of(vertex: u32) -> usize {
        (mix(vertex.into()).trailing_zeros() / LEVEL_BITS) as usize
    }

    /// Finds a place in the lowest level, and notes a vertex near it for the next call.
    #[inline]
    pub(super) fn find(&self, q: P::Site) -> Place {
        self.find_with_vertex(q).0
    }

    /// The vertex, edge or triangle at a place in the lowest level, and a vertex near it, which is noted for the next
    /// call.
    #[inline]
    pub(super) fn find_with_vertex(&self, q: P::Site) -> (Place, Option<u32>) {
        let (base, hint) = (self.base(), self.hint.get());
        let place = if self.is_near(q, hint) { base.find(q, Some(hint)) } else { self.find_at(0, q) };
        let near = base.vertex_near(q, place);
        if let Some(vertex) = near {
            if vertex != hint {
                self.hint.set(vertex);
            }
        }
        (place, near)
    }

    /// Whether a walk from the vertex is expected to be short.
    fn is_near(&self, q: P::Site, vertex: u32) -> bool {
        let base = self.base();
        if !base.is_plane() || !base.is_vertex(vertex) {
            return false;
        }
        let other = base.plane.ends(base.side_opposite(vertex)).into_iter().find(|&end| end != super::plane::INFINITE);
        let site = base.site(vertex);
        other.is_some_and(|other| site.rough_distance(q) <= NEAR * site.rough_distance(base.site(other)))
    }

    /// Finds a place in the level `floor`, from the top of the hierarchy.
    pub(super) fn find_at(&self, floor: usize, q: P::Site) -> Place {
        let mut from = None;
        for level in self.levels.iter().skip(floor + 1).rev() {
            let place = level.find(q, from);
            from = level.vertex_near(q, place).map(|vertex| level.vertices[vertex as usize].name);
        }
        self.levels.get(floor).map_or(Place::Nowhere, |level| level.find(q, from))
    }
}
