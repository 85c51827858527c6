//! Points that arrive one at a time, in an order that nobody chose.
//!
//! Devillers, *The Delaunay hierarchy*, 2002. Of the points of a level about one in 32 are in the level above, each
//! level with a mesh of its own. A point is looked for in the highest level first; the nearest corner of the triangle
//! found there is where the walk in the level below begins. So a walk takes a constant number of steps in each of O(log
//! n) levels, wherever the point before lay.

mod level;

use incircle_geometry::cpu::Error;
use incircle_geometry::order::mix;
use incircle_geometry::{Duplicate, Mesh, Point, MAX_COORD_BITS, MAX_POINTS};
use incircle_model::Counts;

use self::level::Level;
use crate::assembly::canonical;

/// One in 2 to this many points of a level is in the level above: about one in 30, as the author found to be good.
const SHIFT: u32 = 5;
/// A Delaunay triangulation of points that arrive one at a time. The mesh is the one that all devices give, byte for
/// byte.
///
/// The levels are meshes of the software model, with coordinates up to 31 bits. A point takes O(log n) in the mean over
/// the coins that choose levels, which are hashes of the coordinates, as long as cavities are small: an order of
/// arrival can be bad, unlike one that is chosen. Points that come while all lie on one line are in no sample, so walks
/// among them can be long. 75 bytes per point, up to twice that while lists grow.
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
    /// Lowest first, which has all distinct points.
    levels: Vec<Level>,
}

impl Hierarchy {
    /// Without points.
    pub fn new() -> Self {
        Self::default()
    }

    /// The points that have arrived, duplicates included.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Takes a point, whose index is the number of those before it. Returns the index of the first point of the same
    /// coordinates, if there is one: then the mesh stays as it is.
    ///
    /// # Errors
    /// [`Error::CoordinateOutOfRange`] beyond 31 bits, [`Error::TooManyPoints`] beyond [`MAX_POINTS`]. The point is not
    /// taken then.
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

    /// Looks for a point from the highest level down: a vertex near it in the lowest.
    fn descend(&mut self, point: Point) -> Option<u32> {
        let above = self.levels.iter_mut().skip(1).rev();
        above.fold(None, |guide, level| level.find(point, guide))
    }

    /// Adds a new point to the levels above the lowest that its coins choose, at most to one more than there are.
    fn ascend(&mut self, point: Point, vertex: Option<u32>) {
        let key = u64::from(point.x) << 32 | u64::from(point.y);
        let top = (mix(key).trailing_zeros() / SHIFT) as usize;
        let mut below = vertex;
        for number in 1..=top.min(self.levels.len()) {
            // What is no vertex cannot be a guide: on a line the point stays out of the levels above.
            let Some(vertex) = below else {
                return;
            };
            if number == self.levels.len() {
                self.levels.push(Level::default());
            }
            // A new point is in no level; the walk has just ended at it.
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

    /// The counters of all levels, added up; points inserted are those of the lowest.
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
