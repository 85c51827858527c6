//! Points that arrive one at a time, in an order that nobody chose.
//!
//! Devillers, *The Delaunay hierarchy*, 2002. Of the points of a level about one in 32 are in the level above, each level with a mesh of
//! its own. A point is looked for in the highest level first; the nearest corner of the triangle found there is where the walk in the
//! level below begins. So a walk takes a constant number of steps in each of O(log n) levels, wherever the point before lay.

mod level;

use self::level::Level;
use crate::assemble::Assembly;
use crate::counters::Counters;
use crate::error::Error;
use crate::mesh::{Duplicate, Mesh};
use crate::order::mix;
use crate::point::Point;
use crate::report::Report;
use crate::session::MAX_POINTS;
use incircle_protocol::{Layout, MAX_COORD_BITS, MAX_MODEL_POINTS};

/// One in 2 to this many points of a level is in the level above: about one in 30, as the author found to be good.
const SHIFT: u32 = 5;
/// Name in reports.
const HIERARCHY_NAME: &str = "hierarchy";
/// Name of the order in reports: nobody chose it.
const ORDER_NAME: &str = "arrival";

/// A Delaunay triangulation of points that arrive one at a time. The mesh is the one that all devices give, byte for byte.
///
/// The levels are meshes of the software model, with coordinates up to 31 bits. A point takes O(log n) in the mean over the coins that
/// choose levels, which are hashes of the coordinates, as long as cavities are small: an order of arrival can be bad, unlike one that is
/// chosen. Points that come while all lie on one line are in no sample, so walks among them can be long. 75 bytes per point, up to
/// twice that while lists grow.
///
/// ```
/// use incircle::{Hierarchy, Point};
///
/// let mut hierarchy = Hierarchy::new();
/// for k in 0..100u32 {
///     hierarchy.insert(Point::new(k * k % 83, k * 7 % 89))?;
/// }
/// assert_eq!(hierarchy.insert(Point::new(0, 0))?, Some(0));
/// let mesh = hierarchy.mesh()?;
/// assert_eq!(mesh.triangles, incircle::triangulate(&mesh.points)?.triangles);
/// # Ok::<(), incircle::Error>(())
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

    /// Takes a point, whose index is the number of those before it. Returns the index of the first point of the same coordinates, if
    /// there is one: then the mesh stays as it is.
    ///
    /// # Errors
    /// [`Error::CoordinateOutOfRange`] beyond 31 bits, [`Error::TooManyPoints`] beyond [`MAX_POINTS`]. The point is not taken then.
    pub fn insert(&mut self, point: Point) -> Result<Option<u32>, Error> {
        let (index, Point { x, y }) = (self.points.len(), point);
        if (x | y) >> MAX_COORD_BITS != 0 {
            return Err(Error::CoordinateOutOfRange { index, x, y, coord_bits: MAX_COORD_BITS });
        }
        if index == MAX_POINTS {
            return Err(Error::TooManyPoints { points: index + 1, max: MAX_POINTS });
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

    /// The mesh of all points so far, and in its report the counts of all levels together. O(n), as for a device.
    ///
    /// # Errors
    /// None that a sound model can cause: [`Error::Device`] if its mesh is not whole.
    pub fn mesh(&self) -> Result<Mesh, Error> {
        let distinct = self.points.len() - self.duplicates.len();
        let (triangles, hull) = match self.levels.first() {
            None => (Vec::new(), Vec::new()),
            Some(Level::Line(line)) => (Vec::new(), line.values().copied().collect()),
            Some(Level::Plane { mesh, below }) => {
                let mut assembly =
                    Assembly::new(below, &self.points, Layout::of(MAX_COORD_BITS, MAX_MODEL_POINTS), MAX_MODEL_POINTS);
                let taken = mesh.records().iter().enumerate().try_for_each(|(number, record)| {
                    let [a, b, c] = record.v;
                    assembly.take_vertices(number, a, b, c)
                });
                let distrust = |fault| Error::Device { device: HIERARCHY_NAME.to_owned(), during: "assembly", fault };
                taken.and_then(|()| assembly.finish()).map_err(distrust)?
            }
        };
        let report = Report {
            points: self.points.len(),
            distinct,
            duplicates: self.duplicates.len(),
            triangles: triangles.len(),
            hull: hull.len(),
            collinear: triangles.is_empty(),
            backend: HIERARCHY_NAME.to_owned(),
            order: ORDER_NAME,
            counters: (!triangles.is_empty()).then(|| self.counters()),
            coord_bits: MAX_COORD_BITS,
            capacity: MAX_MODEL_POINTS,
            contexts: 1,
            ..Report::default()
        };
        Ok(Mesh { points: self.points.clone(), triangles, hull, duplicates: self.duplicates.clone(), report })
    }

    /// What the levels have counted; points inserted are those of the lowest.
    fn counters(&self) -> Counters {
        let mut sum =
            Counters { insertions: (self.points.len() - self.duplicates.len()) as u32, ..Counters::default() };
        let meshes = self.levels.iter().filter_map(Level::mesh);
        for counts in meshes.map(|mesh| mesh.counts()) {
            sum.walk_visits += counts.walk_visits;
            sum.tests += counts.tests;
            sum.cavity_triangles += counts.cavity_triangles;
            sum.overflows += counts.overflows;
            sum.flips += counts.flips;
        }
        sum
    }
}
