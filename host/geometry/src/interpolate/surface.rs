//! Values between points.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use super::buckets::Buckets;
use super::contours::{contours, Contour};
use super::error::Error;
use super::linear::{edge_value, plane_value};
use super::locate::{locate, Place};
use super::natural::Tour;
use super::nearest::nearest_value;
use super::record::{after, records, Record};
use crate::cpu::in_parallel;
use crate::sort::{sort_by_key, Entry, Narrow};

/// Queries that justify one more thread.
const THREAD_QUERIES: usize = 4096;

/// Pairs of consecutive places that are looked at, to tell whether places are scattered.
const SAMPLES: usize = 512;

/// How values between points are made.
///
/// With `u = 2^-53`, values of a linear function are reproduced to the following errors, where `v` is the largest
/// magnitude of a value near the place and `d` the largest difference of two. A thin triangle makes them larger: `t` is
/// the square of its longest edge, divided by twice its area. `r` is the largest circumradius of a triangle of the
/// cavity or of the place with an edge of the ring, divided by the distance to the nearest natural neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// The plane through the corners of the triangle: continuous, with a kink at each edge. Error: `4 u v + 16 u t d`.
    Linear,
    /// Natural neighbours, weighted by edge length over distance: continuous, smooth but for kinks on some circles.
    /// Error: `4 u v + 64 u t d`, with `t` of the triangles of the place with the edges of the ring.
    Laplace,
    /// Natural neighbours, weighted by area: smooth but at the points themselves. Error: `4 u v + 256 u r² d`.
    Sibson,
}

/// The value outside the hull of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outside {
    /// Not a number.
    Nan,
    /// The value of the nearest point; of points at one distance, that of the lowest index.
    Nearest,
}

/// A set of points with a value each, made ready for queries.
///
/// The surface takes about 220 bytes a point. Coordinates may be all finite doubles, but values between points need
/// squares of lengths within the range of doubles: keep coordinates below 1e75.
#[derive(Clone, Debug)]
pub struct Surface {
    records: Vec<Record>,
    buckets: Buckets,
}

impl Surface {
    /// Makes a surface of a Delaunay triangulation and a value for each point. Points that no triangle names, such as
    /// duplicates, have no influence. O(n), about 0.8 µs a point.
    ///
    /// # Errors
    /// There is no triangle, the lists do not fit each other, or a triangle is not counter-clockwise.
    pub fn new(points: &[[f64; 2]], triangles: &[[u32; 3]], values: &[f64]) -> Result<Self, Error> {
        let records = records(points, triangles, values)?;
        let buckets = Buckets::of(&records);
        Ok(Self { records, buckets })
    }

    /// The value at a place. A place that is not finite has no value: the result is not a number.
    pub fn value(&self, method: Method, outside: Outside, q: [f64; 2]) -> f64 {
        self.value_with(method, outside, q, &mut Tour::default())
    }

    /// The values at all places, in their order, on at most `threads` threads. The values are those of
    /// [`value`](Self::value), whatever the number of threads.
    pub fn values(&self, method: Method, outside: Outside, places: &[[f64; 2]], threads: NonZeroUsize) -> Vec<f64> {
        let threads = threads.get().min(places.len() / THREAD_QUERIES + 1);
        let share = places.len().div_ceil(threads).max(1);
        let mut values = alloc::vec![0.0; places.len()];
        if self.are_scattered(places) {
            let order = self.order(places);
            let found = in_parallel(order.chunks(share), |order| {
                let mut tour = Tour::default();
                let value =
                    |entry: &Narrow| self.value_with(method, outside, places[entry.value() as usize], &mut tour);
                order.iter().map(value).collect::<Vec<f64>>()
            });
            let found = found.into_iter().flatten();
            order.iter().zip(found).for_each(|(entry, value)| values[entry.value() as usize] = value);
            return values;
        }
        let parts = places.chunks(share).zip(values.chunks_mut(share));
        in_parallel(parts, |(places, values)| {
            let mut tour = Tour::default();
            for (&q, value) in places.iter().zip(values) {
                *value = self.value_with(method, outside, q, &mut tour);
            }
        });
        values
    }

    /// Whether consecutive places usually are far from one another: then it is quicker to sort them first.
    fn are_scattered(&self, places: &[[f64; 2]]) -> bool {
        let step = (places.len() / SAMPLES).max(1);
        let pairs = places.windows(2).step_by(step);
        let count = pairs.len();
        // A list of 2^32 places or more keeps its order.
        let far = pairs.filter(|pair| !self.buckets.are_near(pair[0], pair[1])).count();
        places.len() >= THREAD_QUERIES && u32::try_from(places.len()).is_ok() && 2 * far > count
    }

    /// The places by number, those of one bucket together.
    fn order(&self, places: &[[f64; 2]]) -> Vec<Narrow> {
        let entry = |(number, &q): (usize, &[f64; 2])| Narrow::new(self.buckets.number(q), number as u32);
        let mut order: Vec<Narrow> = places.iter().enumerate().map(entry).collect();
        sort_by_key(&mut order);
        order
    }

    /// The contour lines of a level on the surface of [`Method::Linear`]. Ground at the level counts as above it, so a
    /// flat region at the level has one line around it. O(n) for each level.
    ///
    /// ```
    /// use incircle_geometry::interpolate::Surface;
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    /// let lines = Surface::new(&points, &[[0, 1, 2]], &[0.0, 8.0, 0.0])?.contours(2.0);
    /// let places: Vec<[f64; 2]> = lines[0].crossings.iter().map(|crossing| crossing.place(&points)).collect();
    /// assert_eq!((places, lines[0].is_closed), (vec![[1.0, 3.0], [1.0, 0.0]], false));
    /// # Ok::<(), incircle_geometry::interpolate::Error>(())
    /// ```
    pub fn contours(&self, level: f64) -> Vec<Contour> {
        contours(&self.records, level)
    }

    fn value_with(&self, method: Method, outside: Outside, q: [f64; 2], tour: &mut Tour) -> f64 {
        if !q.iter().all(|value| value.is_finite()) {
            return f64::NAN;
        }
        let records = &self.records;
        match locate(records, self.buckets.start(q), q) {
            Place::Corner(at, corner) => records[at as usize].values[corner],
            Place::Outside(at) => match outside {
                Outside::Nan => f64::NAN,
                Outside::Nearest => nearest_value(records, at, q),
            },
            Place::Edge(at, edge) if method == Method::Linear || self.is_hull(at, edge) => {
                on_edge(&records[at as usize], edge, q)
            }
            Place::Edge(at, _) | Place::Inside(at) => match method {
                Method::Linear => on_plane(&records[at as usize], q),
                Method::Laplace => tour.laplace(records, at, q),
                Method::Sibson => tour.sibson(records, at, q),
            },
        }
    }

    fn is_hull(&self, at: u32, edge: usize) -> bool {
        self.records[at as usize].behind[edge] == super::record::NONE
    }
}

/// The value on an edge of a triangle, from the end of the lower index on.
fn on_edge(record: &Record, edge: usize, q: [f64; 2]) -> f64 {
    let other = after(edge);
    let (from, to) = if record.ids[edge] < record.ids[other] { (edge, other) } else { (other, edge) };
    edge_value([from, to].map(|end| (record.corners[end], record.values[end])), q)
}

/// The value in a triangle that contains the place.
#[inline]
fn on_plane(record: &Record, q: [f64; 2]) -> f64 {
    plane_value([0, 1, 2].map(|corner| (record.corners[corner], record.values[corner])), q)
}
