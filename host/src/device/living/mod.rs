//! Meshes that live, on the host and on a device, behind one trait.
//!
//! [`LivingSession`] keeps the mesh on a device that takes runs, `runs` gathers items into runs, `names` knows the
//! point of every index, `line` answers while all points lie on one line, `held` makes the mesh anew where the device
//! cannot change it, and `exchange` speaks with the device.

mod exchange;
mod held;
mod line;
mod names;
mod runs;
mod session;

use crate::error::Error;
use incircle_geometry::living::{Location, Triangulation};
use incircle_geometry::{Mesh, PlanePoint};
pub(super) use session::Choices;
pub use session::LivingSession;

/// A Delaunay triangulation that can be asked and changed, wherever its mesh is kept.
///
/// The trait has the methods of [`Triangulation`] that a device has as well, with the same promises: after any changes,
/// [`mesh`](Self::mesh) is byte for byte the mesh that [`triangulate`](crate::triangulate()) gives for the living
/// points, and answers name a place by the lowest living index there. [`Triangulation`] implements it on the processor,
/// [`LivingSession`] on a device. A call on a device may fail because of the device, so all return an [`Error`].
///
/// ```
/// use incircle::living::{Location, Triangulation};
/// use incircle::{Device, Error, LivingMesh, Point};
///
/// fn ask(mesh: &mut impl LivingMesh<Point>) -> Result<(), Error> {
///     for [x, y] in [[0, 0], [4, 0], [4, 4], [0, 4]] {
///         mesh.insert(Point::new(x, y))?;
///     }
///     let middle = mesh.insert(Point::new(2, 1))?;
///     mesh.move_to(middle, Point::new(3, 2))?;
///     assert_eq!(mesh.nearest(Point::new(2, 2))?, Some(4));
///     mesh.delete(middle)?;
///     assert_eq!(mesh.locate(Point::new(3, 2))?, Location::Triangle([0, 1, 2]));
///     assert_eq!(mesh.mesh()?.triangles, [[0, 1, 2], [0, 2, 3]]);
///     Ok(())
/// }
///
/// ask(&mut Triangulation::new())?;
/// ask(&mut Device::open("model")?.session()?.living()?)?;
/// # Ok::<(), Error>(())
/// ```
pub trait LivingMesh<P: PlanePoint> {
    /// Inserts a point and returns its index: 0, 1, 2 and so on. A point at the place of a living one is a duplicate,
    /// which is no error.
    ///
    /// # Errors
    /// [`Error::Living`] for a point that is not finite and where no more points or indices are possible;
    /// [`Error::OffGrid`] and [`Error::MemoryFull`] for a device. The mesh stays as it was. Else errors of the device.
    fn insert(&mut self, point: P) -> Result<u32, Error>;

    /// Inserts points, whose indices follow one another. Into a mesh without points this takes a fraction of the time.
    ///
    /// # Errors
    /// Those of [`insert`](Self::insert). The points before the one at fault are in.
    fn insert_all(&mut self, points: &[P]) -> Result<(), Error> {
        points.iter().try_for_each(|&point| self.insert(point).map(|_| ()))
    }

    /// Deletes the point of an index. Its index is never used again.
    ///
    /// # Errors
    /// [`Error::Living`] if no living point has the index. Else errors of the device.
    fn delete(&mut self, index: u32) -> Result<(), Error>;

    /// Moves the point of an index to another place.
    ///
    /// # Errors
    /// Those of [`insert`](Self::insert) and [`delete`](Self::delete). [`Error::MemoryFull`] is only possible if
    /// another point stays at the old place.
    fn move_to(&mut self, index: u32, point: P) -> Result<(), Error>;

    /// Makes the edge from one living point to another a constraint, and returns the number of the constraint.
    ///
    /// # Errors
    /// [`Error::Living`] for a constraint that [`Triangulation::insert_constraint`] refuses, and
    /// [`Error::NoConstraints`] for a device. The mesh stays as it was.
    fn insert_constraint(&mut self, from: u32, to: u32) -> Result<u32, Error>;

    /// Removes the constraint of a number.
    ///
    /// # Errors
    /// [`Error::Living`] if there is no such constraint, and [`Error::NoConstraints`] for a device.
    fn remove_constraint(&mut self, number: u32) -> Result<(), Error>;

    /// Says what a place is: a vertex, or in an edge, a triangle, or outside the hull.
    ///
    /// # Errors
    /// [`Error::OffGrid`] for a place that the device cannot take. Else errors of the device.
    fn locate(&mut self, place: P) -> Result<Location, Error>;

    /// The index of the living point nearest to a place; of points at the same distance, the one with the smaller x,
    /// then y. `None` if there are no points.
    ///
    /// # Errors
    /// Those of [`locate`](Self::locate).
    fn nearest(&mut self, place: P) -> Result<Option<u32>, Error>;

    /// Says what each of these places is, in their order, as [`locate`](Self::locate) does. A device answers in runs,
    /// several places at a time.
    ///
    /// # Errors
    /// Those of [`locate`](Self::locate), for any of the places.
    fn locate_all(&mut self, places: &[P]) -> Result<Vec<Location>, Error> {
        places.iter().map(|&place| self.locate(place)).collect()
    }

    /// The index of the living point nearest to each of these places, in their order, as [`nearest`](Self::nearest)
    /// finds it. A device answers in runs, several places at a time.
    ///
    /// # Errors
    /// Those of [`nearest`](Self::nearest), for any of the places.
    fn nearest_all(&mut self, places: &[P]) -> Result<Vec<Option<u32>>, Error> {
        places.iter().map(|&place| self.nearest(place)).collect()
    }

    /// Deletes the points of these indices, as [`delete`](Self::delete) does one after another. A device deletes
    /// several at a time.
    ///
    /// # Errors
    /// Those of [`delete`](Self::delete). The points before the one at fault are deleted.
    fn delete_all(&mut self, indices: &[u32]) -> Result<(), Error> {
        indices.iter().try_for_each(|&index| self.delete(index))
    }

    /// Moves the points of these indices to other places, as [`move_to`](Self::move_to) does one after another. A
    /// device moves several at a time; a move whose index or place an earlier one has touched waits for that one.
    ///
    /// # Errors
    /// Those of [`move_to`](Self::move_to). The points before the one at fault are moved.
    fn move_all(&mut self, moves: &[(u32, P)]) -> Result<(), Error> {
        moves.iter().try_for_each(|&(index, point)| self.move_to(index, point))
    }

    /// The canonical mesh of the living points. Its indices count the living points in the order of
    /// [`indices`](Self::indices).
    ///
    /// # Errors
    /// Errors of the device.
    fn mesh(&mut self) -> Result<Mesh<P>, Error>;

    /// The indices of all living points, duplicates included, in rising order.
    fn indices(&self) -> Vec<u32>;

    /// The index that the next point will have.
    fn next_index(&self) -> u32;
}

impl<P: PlanePoint> LivingMesh<P> for Triangulation<P> {
    fn insert(&mut self, point: P) -> Result<u32, Error> {
        Ok(Triangulation::insert(self, point)?)
    }

    fn insert_all(&mut self, points: &[P]) -> Result<(), Error> {
        if Triangulation::next_index(self) == 0 {
            if let Ok(made) = Self::from(points.iter().copied()) {
                *self = made;
                return Ok(());
            }
            // One by one below, so that the points before the one at fault are in.
        }
        points.iter().try_for_each(|&point| LivingMesh::insert(self, point).map(|_| ()))
    }

    fn delete(&mut self, index: u32) -> Result<(), Error> {
        Ok(Triangulation::delete(self, index)?)
    }

    fn move_to(&mut self, index: u32, point: P) -> Result<(), Error> {
        Ok(Triangulation::move_to(self, index, point)?)
    }

    fn insert_constraint(&mut self, from: u32, to: u32) -> Result<u32, Error> {
        Ok(Triangulation::insert_constraint(self, from, to)?)
    }

    fn remove_constraint(&mut self, number: u32) -> Result<(), Error> {
        Ok(Triangulation::remove_constraint(self, number)?)
    }

    fn locate(&mut self, place: P) -> Result<Location, Error> {
        Ok(Triangulation::locate(self, place))
    }

    fn nearest(&mut self, place: P) -> Result<Option<u32>, Error> {
        Ok(Triangulation::nearest(self, place))
    }

    fn mesh(&mut self) -> Result<Mesh<P>, Error> {
        Ok(Triangulation::mesh(self))
    }

    fn indices(&self) -> Vec<u32> {
        Triangulation::indices(self)
    }

    fn next_index(&self) -> u32 {
        Triangulation::next_index(self)
    }
}
