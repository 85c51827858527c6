//! Loading a whole set of points: the CPU triangulator makes the mesh, and its triangles are linked.

use alloc::vec;
use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use super::answer::sorted;
use super::error::Error;
use super::level::{Level, Vertex};
use super::plane::grow;
use super::triangulation::Triangulation;
use crate::cpu::{connect, Connectivity};
use crate::mesh::smallest_first;
use crate::order::hilbert;
use crate::plane_point::PlanePoint;
use crate::point::{Point, MAX_POINTS};
use crate::site::Site;

impl<P: PlanePoint> Triangulation<P> {
    /// Makes the triangulation of a list of points, whose indices are their positions.
    ///
    /// The CPU triangulator makes the mesh on one thread, in a fraction of the time of as many insertions.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from((0..9).map(|k| [k % 3, k / 3]))?;
    /// assert_eq!(mesh.mesh().triangles.len(), 8);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// A point has a coordinate that is infinite or not a number, or there are too many points.
    pub fn from(points: impl IntoIterator<Item = P>) -> Result<Self, Error> {
        let points: Vec<P> = points.into_iter().collect();
        let mut made = Self::new();
        made.next = u32::try_from(points.len()).map_err(|_| Error::TooManyPoints)?;
        made.load(&points, |index| index)?;
        Ok(made)
    }

    /// Loads points, which get the indices that the function gives for their positions, into a triangulation without
    /// points. The indices rise with the positions.
    pub(super) fn load(&mut self, points: &[P], index: impl Fn(u32) -> u32) -> Result<(), Error> {
        if points.len() > MAX_POINTS {
            return Err(Error::TooManyPoints);
        }
        if let Some(position) = points.iter().position(|point| !point.site().is_finite()) {
            return Err(Error::NotFiniteAt { position });
        }
        let mesh = connected(points);
        let mut is_first = vec![true; points.len()];
        mesh.duplicates.iter().for_each(|duplicate| is_first[duplicate.index as usize] = false);
        let order: Vec<u32> = along_curve(points).into_iter().filter(|&rank| is_first[rank as usize]).collect();
        let mut vertex_of = vec![0u32; points.len()];
        self.names.reserve(points.len());
        for (vertex, &rank) in (0u32..).zip(&order) {
            vertex_of[rank as usize] = vertex;
            self.names.set(index(rank), vertex);
        }
        for duplicate in &mesh.duplicates {
            let vertex = vertex_of[duplicate.of as usize];
            self.names.set(index(duplicate.index), vertex);
            self.duplicates.insert((vertex, index(duplicate.index)));
        }
        let vertices = order.iter().map(|&rank| (points[rank as usize], index(rank)));
        let base = Level::load(vertices, &mesh, |rank| vertex_of[rank as usize]);
        self.levels = vec![base];
        self.load_levels();
        Ok(())
    }

    /// Makes the levels above the highest that there is.
    pub(super) fn load_levels(&mut self) {
        let highest = self.levels.len() - 1;
        let vertices = self.levels[highest].vertices.len() as u32;
        // Vertices of the level below that are in the next one, and the vertex of the lowest level of each.
        let all = (0..vertices).filter(|&vertex| self.levels[highest].is_vertex(vertex));
        let all = all.map(|vertex| (vertex, self.lowest(highest, vertex)));
        let mut chosen: Vec<(u32, u32)> = all.filter(|&(_, lowest)| Self::top_of(lowest) > highest).collect();
        while !chosen.is_empty() {
            let below = &self.levels[self.levels.len() - 1];
            let points: Vec<P> = chosen.iter().map(|&(vertex, _)| below.vertices[vertex as usize].point).collect();
            let vertices = points.iter().zip(&chosen).map(|(&point, &(vertex, _))| (point, vertex));
            let level = Level::load(vertices, &connected(&points), |rank| rank);
            let top = self.levels.len();
            self.levels.push(level);
            let next = (0u32..).zip(&chosen).map(|(vertex, &(_, lowest))| (vertex, lowest));
            chosen = next.filter(|&(_, lowest)| Self::top_of(lowest) > top).collect();
        }
    }

    /// The vertex of the lowest level that has the place of a vertex of some level.
    fn lowest(&self, number: usize, vertex: u32) -> u32 {
        self.levels[1..=number].iter().rev().fold(vertex, |vertex, level| level.vertices[vertex as usize].name)
    }
}

/// The mesh of points whose coordinates are finite.
pub(super) fn connected<P: PlanePoint>(points: &[P]) -> Connectivity {
    let (numbers, _) = P::numbers(points).on_lattice();
    // There are not too many points, all are finite, and nothing ends the work, so there is no error.
    connect(&numbers, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).unwrap_or_default()
}

/// The positions of the points along a Hilbert curve over all of them. Neighbours on the curve share memory.
fn along_curve<P: PlanePoint>(points: &[P]) -> Vec<u32> {
    const CELLS: f64 = (1u64 << 31) as f64;
    // A quarter of each coordinate, so that differences do not overflow.
    let quarters = |point: &P| point.site().rounded().map(|value| 0.25 * value);
    let none = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (low, high) = points
        .iter()
        .map(quarters)
        .fold(none, |(low, high), [x, y]| ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]));
    let scale = CELLS / (high[0] - low[0]).max(high[1] - low[1]);
    // Conversions to integers saturate, and make 0 of what is not a number, so every scale is right.
    let cell = |[x, y]: [f64; 2]| Point::new(((x - low[0]) * scale) as u32, ((y - low[1]) * scale) as u32);
    let cells: Vec<Point> = points.iter().map(|point| cell(quarters(point))).collect();
    hilbert(&cells)
}

impl<P: PlanePoint> Level<P> {
    /// Makes a level of vertices, given with their names, and of a mesh, each of whose ranks stands for a vertex.
    fn load(
        vertices: impl ExactSizeIterator<Item = (P, u32)>,
        mesh: &Connectivity,
        vertex_of: impl Fn(u32) -> u32,
    ) -> Self {
        let mut level = Self::default();
        grow(&mut level.vertices, vertices.len());
        level.vertices.extend(vertices.map(|(point, name)| Vertex { point, triangle: 0, name }));
        level.count = level.vertices.len();
        let hull: Vec<u32> = mesh.hull.iter().map(|&rank| vertex_of(rank)).collect();
        if mesh.triangles.is_empty() {
            level.line = hull.iter().map(|&vertex| (level.site(vertex), vertex)).collect();
            return level;
        }
        let triangles = mesh.triangles.iter().map(|triangle| smallest_first(triangle.map(&vertex_of))).collect();
        level.plane.load(&sorted(triangles, level.count), &hull, level.count);
        for triangle in 0..level.plane.len() as u32 {
            for vertex in level.plane.get(triangle).vertices {
                level.note(vertex, triangle);
            }
        }
        level
    }
}
