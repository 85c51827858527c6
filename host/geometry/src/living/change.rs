//! Changes: insertion, deletion and moves.

use super::error::Error;
use super::level::Level;
use super::triangulation::Triangulation;
use super::walk::Place;
use crate::plane_point::PlanePoint;
use crate::point::MAX_POINTS;
use crate::site::Site;

impl<P: PlanePoint> Triangulation<P> {
    /// Inserts a point and returns its index, which is [`next_index`](Self::next_index) before the call.
    ///
    /// A point at the place of a living one is a duplicate, which is no error: [`place_of`](Self::place_of) then
    /// returns the index of the first point there. O(log n) expected, if the new vertex has few neighbours.
    ///
    /// ```
    /// use incircle_geometry::Triangulation;
    ///
    /// let mut mesh = Triangulation::new();
    /// let (one, other) = (mesh.insert([0.1, 0.2])?, mesh.insert([0.1, 0.2])?);
    /// assert_eq!((one, other, mesh.place_of(other)), (0, 1, Some(0)));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// The point has a coordinate that is infinite or not a number, or there are too many points or indices.
    pub fn insert(&mut self, point: P) -> Result<u32, Error> {
        let q = point.site();
        if !q.is_finite() {
            return Err(Error::NotFinite);
        }
        if self.len() >= MAX_POINTS {
            return Err(Error::TooManyPoints);
        }
        if self.next == u32::MAX {
            return Err(Error::IndicesUsedUp);
        }
        let index = self.next;
        self.next += 1;
        self.attach(index, point);
        Ok(index)
    }

    /// Deletes a point. If other points have the same place, the place stays and has the lowest of their indices.
    ///
    /// O(log n + k²) expected for a vertex with `k` neighbours.
    ///
    /// # Errors
    /// No living point has the index, the point is an end of a constraint, or constraints cross there and would have no
    /// point at their crossing.
    pub fn delete(&mut self, index: u32) -> Result<(), Error> {
        let vertex = self.vertex(index)?;
        self.check_removal(index, vertex)?;
        self.names.remove(index);
        self.detach(index, vertex);
        Ok(())
    }

    /// Moves a point to another place. The point keeps its index.
    ///
    /// A short move that turns no triangle over costs a few flips; another costs a deletion and an insertion. A point
    /// that is moved to the place of another becomes its duplicate, and the place has the lower of both indices.
    /// Constraints that end at the point follow it.
    ///
    /// # Errors
    /// No living point has the index, the place has a coordinate that is infinite or not a number, or constraints would
    /// cross at a place that is no point. The mesh stays as it was.
    pub fn move_to(&mut self, index: u32, point: P) -> Result<(), Error> {
        let vertex = self.vertex(index)?;
        let q = point.site();
        if !q.is_finite() {
            return Err(Error::NotFinite);
        }
        if q == self.base().site(vertex) {
            return Ok(());
        }
        if self.constraints.is_some() {
            return self.move_with_constraints(index, vertex, point);
        }
        self.move_vertex(index, vertex, point);
        Ok(())
    }

    /// Moves a point whose vertex constraints do not hold.
    pub(super) fn move_vertex(&mut self, index: u32, vertex: u32, point: P) {
        if self.is_shared(vertex) || !self.shift(vertex, point) {
            self.names.remove(index);
            self.detach(index, vertex);
            self.attach(index, point);
        }
    }

    /// Whether several points have the place of a vertex.
    pub(super) fn is_shared(&self, vertex: u32) -> bool {
        self.first_duplicate(vertex).is_some()
    }

    /// The lowest index at the place of a vertex, beside that which names the place.
    fn first_duplicate(&self, vertex: u32) -> Option<u32> {
        if self.duplicates.is_empty() {
            return None;
        }
        let duplicate = self.duplicates.range((vertex, 0)..=(vertex, u32::MAX)).next();
        duplicate.map(|&(_, index)| index)
    }

    /// Puts the point of an index into the mesh.
    pub(super) fn attach(&mut self, index: u32, point: P) {
        let (place, near) = self.find_with_vertex(point.site());
        if let Place::Vertex(vertex) = place {
            self.names.set(index, vertex);
            let name = &mut self.levels[0].vertices[vertex as usize].name;
            let duplicate = index.max(*name);
            *name = index.min(*name);
            self.duplicates.insert((vertex, duplicate));
            return;
        }
        if let Some(own) = &mut self.constraints {
            own.mesh.add(point, index, near);
        }
        let vertex = self.levels[0].add(point, index, place);
        self.names.set(index, vertex);
        self.hint.set(vertex);
        self.promote(vertex, point);
    }

    /// Takes the point of an index out of the mesh. The index itself is gone already.
    fn detach(&mut self, index: u32, vertex: u32) {
        if self.name(vertex) != index {
            self.duplicates.remove(&(vertex, index));
        } else if let Some(duplicate) = self.first_duplicate(vertex) {
            self.levels[0].vertices[vertex as usize].name = duplicate;
            self.duplicates.remove(&(vertex, duplicate));
        } else {
            self.demote(vertex);
            if self.hint.get() == vertex {
                let neighbour = self.base().some_neighbor(vertex);
                self.hint.set(neighbour.unwrap_or(0));
            }
            if let Some(own) = &mut self.constraints {
                own.mesh.remove(vertex);
            }
            self.levels[0].remove(vertex);
        }
    }

    /// Adds a vertex of the lowest level to the levels above, up to the highest one that its number chooses.
    fn promote(&mut self, vertex: u32, point: P) {
        let mut below = vertex;
        for number in 1..=Self::top_of(vertex) {
            if number == self.levels.len() {
                self.levels.push(Level::default());
            }
            let place = self.find_at(number, point.site());
            below = self.levels[number].add(point, below, place);
        }
    }

    /// Removes a vertex of the lowest level from the levels above.
    fn demote(&mut self, vertex: u32) {
        let q = self.base().site(vertex);
        for number in (1..=Self::top_of(vertex)).rev() {
            if let Place::Vertex(found) = self.find_at(number, q) {
                self.levels[number].remove(found);
            }
        }
        while self.levels.len() > 1 && self.levels[self.levels.len() - 1].count == 0 {
            self.levels.pop();
        }
    }

    /// Moves a vertex of the lowest level in place, if its star stays a star; says whether it has moved.
    fn shift(&mut self, vertex: u32, point: P) -> bool {
        let from = self.base().site(vertex);
        if !self.levels[0].shift(vertex, point) {
            return false;
        }
        if let Some(own) = &mut self.constraints {
            own.mesh.shift(vertex, point, self.levels[0].vertices[vertex as usize].name);
        }
        let mut below = vertex;
        for number in 1..=Self::top_of(vertex) {
            // The levels above this one have the vertex at its old place still, which does no harm to a walk.
            if let Place::Vertex(found) = self.find_at(number, from) {
                below = self.shift_or_replace(number, found, below, point);
            }
        }
        true
    }

    /// Moves a vertex of one level; returns its number there.
    fn shift_or_replace(&mut self, number: usize, vertex: u32, below: u32, point: P) -> u32 {
        if self.levels[number].shift(vertex, point) {
            return vertex;
        }
        let level = &mut self.levels[number];
        // No walk may come from the levels above, whose vertices name the one that is being removed.
        let near = level.some_neighbor(vertex);
        level.remove(vertex);
        let place = level.find(point.site(), near);
        // The vertex takes the number that has just become free, so the level above need not be told.
        level.add(point, below, place)
    }
}
