//! The mesh that a device has, and making it anew when it lacks changes.
//!
//! A device cannot make every change: it refuses vertices with many neighbours, and some devices have no command to
//! delete or to move a vertex. The host takes note of such a change, and the next question makes the mesh anew, once
//! for all changes before it.

use incircle_protocol::RunKind;

use super::session::{Held, LivingSession};
use crate::error::Error;
use crate::job::prepare::prepare;
use incircle_geometry::Point;

impl LivingSession<'_> {
    /// The vertex of the device at a place that has points, if the device can make a change of this kind to it.
    pub(super) fn vertex_for(&self, kind: RunKind, point: Point) -> Option<u32> {
        let can = self.held == Held::Mesh && self.device.takes(kind);
        self.names.place(point).map(|place| place.vertex).filter(|_| can)
    }

    /// Takes note of a change that the device has not made. Points on one line are still on one without a point.
    pub(super) fn fall_behind(&mut self) {
        if self.held == Held::Mesh {
            self.held = Held::Older;
        }
    }

    /// Brings the mesh on the device up to date. Returns false if all points lie on one line, so that the device has
    /// none.
    pub(super) fn refresh(&mut self) -> Result<bool, Error> {
        if self.held == Held::Older {
            self.load()?;
        }
        Ok(self.held == Held::Mesh)
    }

    /// Makes the mesh on the device anew, if the points span a triangle.
    fn load(&mut self) -> Result<(), Error> {
        self.vertices.clear();
        self.free.clear();
        let places: Vec<Point> = self.names.places().keys().copied().collect();
        let prepared = prepare(&places, self.choices.order, self.choices.contexts);
        if prepared.collinear {
            self.held = Held::Nothing;
            return Ok(());
        }
        let points: Vec<Point> = prepared.order.iter().map(|&place| places[place as usize]).collect();
        self.device.load(&points, self.choices.contexts)?;
        for (vertex, &point) in (0..).zip(&points) {
            self.names.set_vertex(point, vertex);
        }
        self.vertices = points.into_iter().map(Some).collect();
        self.held = Held::Mesh;
        Ok(())
    }
}
