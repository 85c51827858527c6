//! The Delaunay hierarchy, for points that arrive one at a time in an order that nobody chose.
//!
//! Each level has a mesh of its own, and about one in 32 of its points are in the level above. A point is located in
//! the highest level first. The nearest corner of the triangle found there is the start of the walk in the level below.
//! So a walk takes a constant number of steps on average in each of O(log n) levels, wherever the previous point lay.
//! Source: Devillers, *The Delaunay hierarchy*, 2002.

mod level;

use incircle_geometry::cpu::Error;
use incircle_geometry::order::mix;
use incircle_geometry::{Duplicate, Mesh, Point, MAX_COORD_BITS, MAX_POINTS};
use incircle_model::Counts;

use self::level::Level;
use crate::assembly::canonical;

/// Coins that a point throws for each level. All must fall right, so about one point of a level in 2^5 is in the level
/// above; the author of the hierarchy found one in 30 to be good.
const SHIFT: u32 = 5;
/// A Delaunay triangulation of points that arrive one at a time.
///
/// Reach for the hierarchy if the points are not known in advance. The mesh is the one that all devices
/// give, byte for byte.
///
/// The levels are meshes of the software model, with coordinates of up to 31 bits. A point takes O(log n) on average
/// over the coins that choose levels, which are hashes of the coordinates, as long as cavities are small; a bad order
/// of arrival can make them large. Points that arrive while all lie on one line are only in the lowest level, so walks
/// among them can be long. The hierarchy takes 75 bytes per point, and up to twice that while lists grow.
///
/// ```
/// use incircle_geometry::Point;
/// use incircle_research::Hierarchy;
///
/// let mut hierarchy = Hierarchy::new();
/// for k in 0..100u32 {
///     hierarchy.insert(Point::new(k * k % 83, k * 7 % 89))?;
/// }
/// assert_eq!(hierarchy.insert(Point::new(0, 0))?, Some(0));
/// let mesh = hierarchy.mesh();
/// assert!(mesh.verify().is_ok());
/// # Ok::<(), incircle_geometry::cpu::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Hierarchy {
    points: Vec<Point>,
    duplicates: Vec<Duplicate>,
    /// The levels from the lowest up; the lowest has all distinct points.
    levels: Vec<Level>,
}

impl Hierarchy {
    /// Makes a hierarchy without points.
    pub fn new() -> Self {
        Self::default()
    }

    /// The points that have arrived so far, duplicates included.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Inserts a point, whose index is the number of the points before it. If there is a point with the same
    /// coordinates already, the mesh stays as it is, and the index of the first such point is returned.
    ///
    /// # Errors
    /// [`Error::CoordinateOutOfRange`] beyond 31 bits, [`Error::TooManyPoints`] beyond [`MAX_POINTS`]. The hierarchy
    /// then does not have the point.
    pub fn insert(&mut self, point: Point) -> Result<Option<u32>, Error> {
        let index = self.points.len();
        if (point.x | point.y) >> MAX_COORD_BITS != 0 {
            return Err(Error::CoordinateOutOfRange { index, point });
        }
        if index == MAX_POINTS {
            return Err(Error::TooManyPoints { points: index + 1 });
        }
        if self.levels.is_empty() {
            self.levels.push(Level::default());
        }
        self.points.push(point);
        let guide = self.descend(point);
        match self.levels[0].add(point, index as u32, guide) {
            Err(of) => {
                self.duplicates.push(Duplicate { index: index as u32, of });
                Ok(Some(of))
            }
            Ok(vertex) => {
                self.ascend(point, vertex);
                Ok(None)
            }
        }
    }

    /// Locates a point from the highest level down; returns a vertex near the point in the lowest level.
    fn descend(&mut self, point: Point) -> Option<u32> {
        let above = self.levels.iter_mut().skip(1).rev();
        above.fold(None, |guide, level| level.find(point, guide))
    }

    /// Adds a new point to the levels above the lowest that its coins choose. At most one level is new.
    fn ascend(&mut self, point: Point, vertex: Option<u32>) {
        let key = u64::from(point.x) << 32 | u64::from(point.y);
        let top = (mix(key).trailing_zeros() / SHIFT) as usize;
        let mut below = vertex;
        for number in 1..=top.min(self.levels.len()) {
            // A point on a line is no vertex yet, so it cannot be a guide and stays out of the levels above.
            let Some(vertex) = below else {
                return;
            };
            if number == self.levels.len() {
                self.levels.push(Level::default());
            }
            // No guide is needed, because the last walk in this level ended at this point. The point is new in every
            // level, so there is no error.
            below = self.levels[number].add(point, vertex, None).unwrap_or(None);
        }
    }

    /// The mesh of all points so far. O(n).
    pub fn mesh(&self) -> Mesh {
        match self.levels.first() {
            None => Mesh::default(),
            Some(Level::Line(line)) => {
                let hull = line.values().copied().collect();
                Mesh::new(self.points.clone(), Vec::new(), hull, self.duplicates.clone())
            }
            Some(Level::Plane { mesh, below }) => {
                canonical(mesh.mesh().records(), below, &self.points, self.duplicates.clone())
            }
        }
    }

    /// The sums of the counters of all levels. Insertions are counted in the lowest level only.
    pub fn counts(&self) -> Counts {
        let mut sum = Counts { insertions: (self.points.len() - self.duplicates.len()) as u32, ..Counts::default() };
        for counts in self.levels.iter().filter_map(Level::mesh).map(|mesh| mesh.counts()) {
            sum.walk_visits += counts.walk_visits;
            sum.tests += counts.tests;
            sum.cavity_triangles += counts.cavity_triangles;
            sum.overflows += counts.overflows;
            sum.flips += counts.flips;
        }
        sum
    }
}
