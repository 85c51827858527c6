//! A level of the hierarchy: points along a line until three of them span a triangle, then a mesh.

use std::collections::BTreeMap;

use incircle_geometry::{orient2d, Point};

use crate::guided::GuidedMesh;

/// A sample of the points of the level below.
#[derive(Debug)]
pub(super) enum Level {
    /// Points on one line, sorted along the line, each with its number in the level below.
    Line(BTreeMap<Point, u32>),
    /// Points that span at least one triangle.
    Plane {
        mesh: Box<GuidedMesh>,
        /// For each vertex, the number of its point in the level below.
        below: Vec<u32>,
    },
}

impl Default for Level {
    fn default() -> Self {
        Self::Line(BTreeMap::new())
    }
}

impl Level {
    /// The mesh of the level; `None` while all points lie on one line.
    pub(super) fn mesh(&self) -> Option<&GuidedMesh> {
        match self {
            Self::Line(_) => None,
            Self::Plane { mesh, .. } => Some(mesh),
        }
    }

    /// Finds a point near this one, and returns its number in the level below; `None` if the level has no points. In a
    /// mesh a walk finds the point, beginning at the vertex `guide`. On a line the result is the nearer of both
    /// neighbours along the line.
    pub(super) fn find(&mut self, point: Point, guide: Option<u32>) -> Option<u32> {
        match self {
            Self::Line(line) => {
                let neighbors = line.range(..=point).next_back().into_iter().chain(line.range(point..).next());
                neighbors
                    .min_by_key(|(at, _)| at.x.abs_diff(point.x).max(at.y.abs_diff(point.y)))
                    .map(|(_, &below)| below)
            }
            Self::Plane { mesh, below } => {
                let vertex = mesh.find(point, guide)?;
                below.get(vertex as usize).copied()
            }
        }
    }

    /// Adds a point with its number in the level below, and returns its vertex if there is a mesh. If the place is
    /// taken already, the number of the point there is the error. The walk begins at the vertex `guide`, or at the end
    /// of the last walk.
    pub(super) fn add(&mut self, point: Point, number_below: u32, guide: Option<u32>) -> Result<Option<u32>, u32> {
        match self {
            Self::Plane { mesh, below } => {
                let own = mesh.insert_unless_there(point, guide).map_err(|vertex| below[vertex as usize])?;
                below.push(number_below);
                Ok(Some(own))
            }
            Self::Line(line) => {
                if let Some(&there) = line.get(&point) {
                    return Err(there);
                }
                let Some(plane) = Self::leave_line(line, point, number_below) else {
                    line.insert(point, number_below);
                    return Ok(None);
                };
                *self = plane;
                // `leave_line` inserts the point that spans a triangle as the third one.
                Ok(Some(2))
            }
        }
    }

    /// Makes the mesh of the points of a line and a point beside it; `None` if the point is on the line, or if there is
    /// at most one point before it.
    fn leave_line(line: &BTreeMap<Point, u32>, point: Point, number_below: u32) -> Option<Self> {
        let mut along = line.iter();
        let (first, second) = (along.next()?, along.next_back()?);
        if orient2d(*first.0, *second.0, point) == 0 {
            return None;
        }
        let mut mesh = Box::<GuidedMesh>::default();
        let mut below = Vec::with_capacity(line.len() + 1);
        for (&at, &number) in [first, second, (&point, &number_below)].into_iter().chain(along) {
            mesh.insert(at, None);
            below.push(number);
        }
        Some(Self::Plane { mesh, below })
    }
}
