//! A level of the hierarchy: points along a line until three of them span a triangle, then a mesh.

use std::collections::BTreeMap;

use incircle_geometry::{orient2d, Point};

use crate::guided::GuidedMesh;

/// A sample of the points of the level below.
#[derive(Debug)]
pub(super) enum Level {
    /// No three points span a triangle yet: they lie on a line, along which they are sorted, with their numbers in the
    /// level below.
    Line(BTreeMap<Point, u32>),
    /// Points in the plane.
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

    /// Of a point near this one the number in the level below: found by a walk that begins at the vertex `guide`, or,
    /// on a line, the nearer of its neighbours in the order of the line. `None` if the level has no points.
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

    /// Adds a point, with its number in the level below, unless it is there: then the number of that one is the error.
    /// Returns its vertex, if there is a mesh. The walk begins at the vertex `guide`, or where the last one ended.
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
                // The point that spans a triangle comes third.
                Ok(Some(2))
            }
        }
    }

    /// The mesh of the points of a line and one beside it; `None` if it is not beside, or if the line has one point at
    /// most.
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
