//! A mesh that lives on a device.

use std::time::Duration;

use incircle_protocol::{Identity, Outcome, RunKind};

use super::exchange::LivingDevice;
use super::names::Names;
use super::LivingMesh;
use crate::device::backend::Backend;
use crate::error::{DeviceFault, Error};
use incircle_geometry::living::Location;
use incircle_geometry::{Mesh, Order, Point};

/// The choices of the caller for a mesh that lives on a device.
#[derive(Clone, Copy)]
pub(crate) struct Choices {
    /// Limit for one exchange with the device; `None` for the usual one.
    pub(crate) timeout: Option<Duration>,
    /// Order of insertion where many points are given to the device at once, and the contexts that work then.
    pub(crate) order: Order,
    pub(crate) contexts: u32,
}

/// The mesh that a device has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// None, because all points lie on one line. The host answers.
    Nothing,
    /// One that lacks changes, or none yet. The next question makes the mesh anew, once for all changes before it.
    Older,
    /// The mesh of the points.
    Mesh,
}

/// A mesh that lives on a device, with the methods of [`LivingMesh`].
///
/// [`Session::living`](crate::Session::living) makes one. The device changes its mesh in place: an insertion, a
/// deletion or a move costs it what depends on the neighbours and on the way from the last place, and not on the number
/// of points. The host keeps the points and their indices, and knows which vertex of the device each place is.
///
/// - **Few points.** A device needs three points that span a triangle. While there are none, the host answers; when a
///   deletion or a move leaves all points on one line, the host takes over, and gives the points back to the device
///   when they span a triangle again.
/// - **Many neighbours.** A device refuses to delete or move a vertex with more neighbours than its list holds, 32 in
///   the standard cores and the model. The next question, or a call of [`mesh`](LivingMesh::mesh), then makes the mesh
///   on the device anew. That takes O(n), once for all changes since the mesh before.
/// - **No moves.** On a device without the command that moves a vertex, every move is made like that of a vertex with
///   many neighbours.
/// - **Memory.** The device holds as many different places as its capacity. [`Error::MemoryFull`] says that there is no
///   room, and leaves the mesh as it was.
/// - **Faults.** After an error of the link or a wrong answer, the mesh on the device is not known, and all further
///   calls fail: open the device again.
/// - **Pauses.** A device at a serial port or on a network forgets its mesh if it hears nothing for two seconds, or for
///   the silence that its greeting names. A call that needs this mesh then fails with an error of the link.
pub struct LivingSession<'d> {
    pub(super) device: LivingDevice<'d>,
    pub(super) choices: Choices,
    pub(super) names: Names,
    /// The place of each vertex that the device has had since it was loaded; `None` for those that are free.
    pub(super) vertices: Vec<Option<Point>>,
    /// Vertices that are free, the last freed last.
    pub(super) free: Vec<u32>,
    pub(super) held: Held,
    /// The items of the next run go backwards along the curve, as those of every second run do.
    pub(super) runs_backwards: bool,
}

impl<'d> LivingSession<'d> {
    pub(crate) fn new(backend: &'d mut dyn Backend, identity: Identity, choices: Choices) -> Self {
        let device = LivingDevice::new(backend, identity, choices.timeout);
        let (vertices, free) = (Vec::new(), Vec::new());
        Self { device, choices, names: Names::default(), vertices, free, held: Held::Nothing, runs_backwards: false }
    }

    /// The vertices of the triangle, edge or vertex at a place, each with its weight there: the value at the place, by
    /// linear interpolation, is the sum of weights times values, divided by the sum of the weights. The weights are
    /// twice the areas of the triangles that the place makes with the other corners, at least 1.
    ///
    /// Empty outside the hull, and while all points lie on one line.
    ///
    /// ```
    /// use incircle::{Device, LivingMesh, Point};
    ///
    /// let mut device = Device::open("model")?;
    /// let mut session = device.session()?;
    /// let mut mesh = session.living()?;
    /// mesh.insert_all(&[Point::new(0, 0), Point::new(10, 0), Point::new(0, 10)])?;
    /// let mut weights = mesh.weights(Point::new(2, 3))?;
    /// weights.sort_unstable();
    /// assert_eq!(weights, [(0, 50), (1, 20), (2, 30)]);
    /// # Ok::<(), incircle::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`LivingMesh::locate`].
    pub fn weights(&mut self, place: Point) -> Result<Vec<(u32, u64)>, Error> {
        self.check_grid(place)?;
        if !self.refresh()? {
            return Ok(Vec::new());
        }
        let (outcome, located) = self.device.ask(RunKind::Interpolate, None, Some(place))?;
        let count = match outcome {
            Outcome::Outside => 0,
            Outcome::Vertex => 1,
            Outcome::Edge => 2,
            Outcome::Triangle => 3,
            other => return Err(self.unexpected(RunKind::Interpolate, other)),
        };
        let weighed = located.vertices.into_iter().zip(located.weights).take(count);
        weighed.map(|(vertex, weight)| Ok((self.name(RunKind::Interpolate, vertex)?, weight))).collect()
    }

    /// Clocks of the device since it was opened; `None` unless the device is a simulated core, whose clocks are
    /// counted.
    #[must_use]
    pub fn clocks(&self) -> Option<u64> {
        self.device.clocks()
    }

    pub(super) fn check_grid(&self, point: Point) -> Result<(), Error> {
        let (Point { x, y }, coord_bits) = (point, self.device.identity.coord_bits);
        if (x | y) >> coord_bits == 0 {
            return Ok(());
        }
        Err(Error::OffGrid { x, y, coord_bits, device: self.device.name() })
    }

    /// Fails if the device has no room for another place.
    fn check_room(&self) -> Result<(), Error> {
        let capacity = self.device.identity.capacity;
        if self.names.places().len() < capacity as usize {
            return Ok(());
        }
        Err(Error::MemoryFull { capacity, device: self.device.name() })
    }

    /// The index for another point, unless the point cannot be taken.
    pub(super) fn check_new(&self, point: Point) -> Result<u32, Error> {
        let index = self.names.new_index()?;
        self.check_grid(point)?;
        if self.names.place(point).is_none() {
            self.check_room()?;
        }
        Ok(index)
    }

    /// The name of the place of a vertex that the device named.
    pub(super) fn name(&mut self, kind: RunKind, vertex: u32) -> Result<u32, Error> {
        let point = self.vertices.get(vertex as usize).copied().flatten();
        match point.and_then(|point| self.names.place(point)) {
            Some(place) => Ok(place.name()),
            None => Err(self.device.distrust(kind.opcode(), DeviceFault::NoSuchVertex { vertex })),
        }
    }

    /// The error for an outcome that no sound device gives to this item.
    pub(super) fn unexpected(&mut self, kind: RunKind, outcome: Outcome) -> Error {
        self.device.distrust(kind.opcode(), DeviceFault::Outcome { found: outcome as u8 })
    }

    /// Puts an index at a place that has no point. There is room.
    fn add_place(&mut self, index: u32, point: Point) -> Result<(), Error> {
        if self.held != Held::Mesh {
            if self.held == Held::Nothing && !self.names.stays_flat_with(point) {
                self.held = Held::Older;
            }
            self.names.put(index, point, 0);
            return Ok(());
        }
        let vertex = self.free.pop().unwrap_or(self.vertices.len() as u32);
        match self.device.ask(RunKind::InsertAs, Some(vertex), Some(point))?.0 {
            Outcome::Done => {}
            other => return Err(self.unexpected(RunKind::InsertAs, other)),
        }
        if vertex as usize == self.vertices.len() {
            self.vertices.push(None);
        }
        self.vertices[vertex as usize] = Some(point);
        self.names.put(index, point, vertex);
        Ok(())
    }

    /// Takes an index away from its place, where it is alone.
    fn take_place(&mut self, index: u32, point: Point) -> Result<(), Error> {
        let Some(vertex) = self.vertex_for(RunKind::Delete, point) else {
            self.names.take(index);
            self.fall_behind();
            return Ok(());
        };
        let outcome = self.device.ask(RunKind::Delete, Some(vertex), None)?.0;
        match outcome {
            Outcome::Done => {
                self.names.take(index);
                self.vertices[vertex as usize] = None;
                self.free.push(vertex);
                Ok(())
            }
            Outcome::Flat | Outcome::ManyNeighbors => {
                self.names.take(index);
                self.fall_behind();
                Ok(())
            }
            other => Err(self.unexpected(RunKind::Delete, other)),
        }
    }

    /// Moves an index that is alone at its place to another place that has no point.
    fn move_place(&mut self, index: u32, from: Point, to: Point) -> Result<(), Error> {
        let Some(vertex) = self.vertex_for(RunKind::Move, from) else {
            self.names.take(index);
            self.fall_behind();
            return self.add_place(index, to);
        };
        let outcome = self.device.ask(RunKind::Move, Some(vertex), Some(to))?.0;
        if !matches!(outcome, Outcome::Done | Outcome::Flat | Outcome::ManyNeighbors) {
            return Err(self.unexpected(RunKind::Move, outcome));
        }
        self.names.take(index);
        self.names.put(index, to, vertex);
        self.vertices[vertex as usize] = Some(to);
        if outcome != Outcome::Done {
            self.fall_behind();
        }
        Ok(())
    }
}

impl LivingMesh<Point> for LivingSession<'_> {
    fn insert(&mut self, point: Point) -> Result<u32, Error> {
        let index = self.check_new(point)?;
        if self.names.place(point).is_some() {
            self.names.put(index, point, 0);
        } else {
            self.add_place(index, point)?;
        }
        Ok(index)
    }

    fn insert_all(&mut self, points: &[Point]) -> Result<(), Error> {
        if self.held == Held::Mesh {
            return self.insert_in_runs(points);
        }
        // The device gets all points at once, up to one that is refused.
        let refused = points.iter().try_for_each(|&point| {
            let index = self.check_new(point)?;
            self.names.put(index, point, 0);
            Ok(())
        });
        self.held = Held::Older;
        self.refresh().and(refused)
    }

    fn delete(&mut self, index: u32) -> Result<(), Error> {
        let point = self.names.point(index)?;
        if self.names.place(point).is_some_and(|place| place.is_shared()) {
            self.names.take(index);
            return Ok(());
        }
        self.take_place(index, point)
    }

    fn move_to(&mut self, index: u32, point: Point) -> Result<(), Error> {
        let from = self.names.point(index)?;
        self.check_grid(point)?;
        if from == point {
            return Ok(());
        }
        let is_shared = self.names.place(from).is_some_and(|place| place.is_shared());
        match (is_shared, self.names.place(point).is_some()) {
            (false, false) => self.move_place(index, from, point),
            (false, true) => {
                self.take_place(index, from)?;
                self.names.put(index, point, 0);
                Ok(())
            }
            (true, true) => {
                self.names.take(index);
                self.names.put(index, point, 0);
                Ok(())
            }
            (true, false) => {
                self.check_room()?;
                self.names.take(index);
                self.add_place(index, point)
            }
        }
    }

    fn insert_constraint(&mut self, _from: u32, _to: u32) -> Result<u32, Error> {
        Err(Error::NoConstraints { device: self.device.name() })
    }

    fn remove_constraint(&mut self, _number: u32) -> Result<(), Error> {
        Err(Error::NoConstraints { device: self.device.name() })
    }

    fn locate(&mut self, place: Point) -> Result<Location, Error> {
        self.check_grid(place)?;
        if !self.refresh()? {
            return Ok(self.names.locate_on_line(place));
        }
        let part = self.device.ask(RunKind::Locate, None, Some(place))?;
        self.location(part)
    }

    fn nearest(&mut self, place: Point) -> Result<Option<u32>, Error> {
        self.check_grid(place)?;
        if !self.refresh()? {
            return Ok(self.names.nearest_of_all(place));
        }
        let part = self.device.ask(RunKind::Nearest, None, Some(place))?;
        self.nearest_name(part).map(Some)
    }

    fn locate_all(&mut self, places: &[Point]) -> Result<Vec<Location>, Error> {
        self.locate_in_runs(places)
    }

    fn nearest_all(&mut self, places: &[Point]) -> Result<Vec<Option<u32>>, Error> {
        self.nearest_in_runs(places)
    }

    fn delete_all(&mut self, indices: &[u32]) -> Result<(), Error> {
        self.delete_in_runs(indices)
    }

    fn move_all(&mut self, moves: &[(u32, Point)]) -> Result<(), Error> {
        self.move_in_runs(moves)
    }

    fn mesh(&mut self) -> Result<Mesh, Error> {
        let has_mesh = self.refresh()?;
        let (points, duplicates) = self.names.ranked();
        let place_ranks = self.names.place_ranks();
        if !has_mesh {
            return Ok(Mesh::new(points, Vec::new(), place_ranks, duplicates));
        }
        let mut ranks = vec![None; self.vertices.len()];
        for (place, rank) in self.names.places().values().zip(place_ranks) {
            ranks[place.vertex as usize] = Some(rank);
        }
        let (triangles, hull) = self.device.read(&ranks, &points)?;
        Ok(Mesh::new(points, triangles, hull, duplicates))
    }

    fn indices(&self) -> Vec<u32> {
        self.names.indices()
    }

    fn next_index(&self) -> u32 {
        self.names.next()
    }
}
