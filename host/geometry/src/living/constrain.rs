//! Constraints: edges that stay in the mesh while points come, go and move.

use alloc::boxed::Box;
use alloc::vec::Vec;

use super::constraint_list::Constraints;
use super::error::Error;
use super::level::Level;
use super::triangulation::Triangulation;
use super::walk::Place;
use crate::constraints::crossing;
use crate::constraints::pieces::Pieces;
use crate::constraints::repeats::Repeats;
use crate::lattice::Numbers;
use crate::plane_point::PlanePoint;
use crate::site::Site;

impl<P: PlanePoint> Triangulation<P> {
    /// Inserts a constraint: the straight line between two points becomes an edge of the mesh, or several where points
    /// lie on it. Returns the number of the constraint, which counts from 0 and is never used again.
    ///
    /// From then on [`mesh`](Self::mesh), [`triangles`](Self::triangles), [`locate`](Self::locate) and all other
    /// answers about the mesh are those of the canonical constrained mesh: the one that
    /// [`constrain`](crate::constraints::constrain) makes of the same points and constraints. Which points are near a
    /// place does not depend on constraints. A constraint between two points of one place has no edge.
    ///
    /// The first constraint copies the mesh: O(n), and changes then take about twice as long as without. Each costs the
    /// degree of its first point, the number of triangles that it crosses, and the flips around them.
    ///
    /// ```
    /// use incircle_geometry::Triangulation;
    ///
    /// let mut mesh = Triangulation::from([[0, 0], [4, -1], [8, 0], [4, 1]])?;
    /// assert_eq!(mesh.mesh().triangles, [[0, 1, 3], [1, 2, 3]]);
    /// let wall = mesh.insert_constraint(0, 2)?;
    /// assert_eq!(mesh.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
    /// mesh.remove_constraint(wall)?;
    /// assert_eq!(mesh.mesh().triangles, [[0, 1, 3], [1, 2, 3]]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// No living point has one of the indices, or the constraint crosses another at a place that is no point. The mesh
    /// stays as it was.
    pub fn insert_constraint(&mut self, from: u32, to: u32) -> Result<u32, Error> {
        if self.next_constraint == u32::MAX {
            return Err(Error::ConstraintsUsedUp);
        }
        let constraint = self.next_constraint;
        self.put_constraint(constraint, [from, to])?;
        self.next_constraint += 1;
        Ok(constraint)
    }

    /// Removes a constraint. Edges that no other constraint holds are flipped where the canonical mesh has others.
    ///
    /// # Errors
    /// There is no constraint of this number.
    pub fn remove_constraint(&mut self, constraint: u32) -> Result<(), Error> {
        let next = self.next_constraint;
        let unknown = Error::UnknownConstraint { constraint, next };
        let constraints = self.constraints.as_mut().ok_or(unknown)?;
        let ends = constraints.ends.remove(&constraint).ok_or(unknown)?;
        for end in ends {
            constraints.by_end.remove(&[end, constraint]);
        }
        if constraints.ends.is_empty() {
            self.constraints = None;
            return Ok(());
        }
        self.free(constraint, ends);
        Ok(())
    }

    /// The constraints by rising number, each with the indices of its two points.
    pub fn constraints(&self) -> impl Iterator<Item = (u32, [u32; 2])> + '_ {
        self.constraints.iter().flat_map(|own| own.ends.iter().map(|(&constraint, &ends)| (constraint, ends)))
    }

    /// The edges that constraints fix, by the indices that name their places, and the constraints of each. O(p log p)
    /// for `p` of them.
    ///
    /// ```
    /// let mut mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [2, 0], [2, 2]])?;
    /// mesh.insert_constraint(0, 1)?;
    /// assert_eq!(mesh.pieces().edges(), [[0, 2], [1, 2]]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn pieces(&self) -> Pieces {
        let all = self.constraints.iter().flat_map(|own| own.mesh.parts.iter());
        let named = all.map(|(edge, constraint)| {
            let [a, b] = edge.map(|vertex| self.name(vertex));
            ([a.min(b), a.max(b)], constraint)
        });
        Pieces::of(named.collect(), &Repeats::default())
    }

    /// The level that answers about the mesh are taken from.
    #[inline(always)]
    pub(super) fn shown(&self) -> &Level<P> {
        self.constraints.as_ref().map_or_else(|| self.base(), |own| &own.mesh.level)
    }

    /// Finds a place in that level.
    pub(super) fn find_shown(&self, q: P::Site) -> Place {
        match &self.constraints {
            None => self.find(q),
            Some(own) => own.mesh.level.find_straight(q, self.find_with_vertex(q).1),
        }
    }

    /// Puts a constraint of this number into the mesh.
    pub(super) fn put_constraint(&mut self, constraint: u32, ends: [u32; 2]) -> Result<(), Error> {
        for end in ends {
            self.vertex(end)?;
        }
        if self.constraints.is_none() {
            self.constraints = Some(Box::new(Constraints::new(self.base())));
        }
        if let Err(edge) = self.force(constraint, ends) {
            let error = self.crossing(edge, constraint, ends);
            self.free(constraint, ends);
            self.constraints.take_if(|own| own.ends.is_empty());
            return Err(error);
        }
        if let Some(own) = &mut self.constraints {
            own.insert(constraint, ends);
        }
        Ok(())
    }

    fn force(&mut self, constraint: u32, ends: [u32; 2]) -> Result<(), [u32; 2]> {
        let vertices = ends.map(|end| self.names.get(end).unwrap_or(0));
        self.constraints.as_mut().map_or(Ok(()), |own| own.mesh.force(constraint, vertices))
    }

    fn free(&mut self, constraint: u32, [from, _]: [u32; 2]) {
        let vertex = self.names.get(from).unwrap_or(0);
        if let Some(own) = &mut self.constraints {
            own.mesh.free(constraint, vertex);
        }
    }

    /// The error of a constraint that crosses a piece.
    fn crossing(&self, edge: [u32; 2], constraint: u32, ends: [u32; 2]) -> Error {
        let other = self.constraints.as_ref().and_then(|own| own.mesh.parts.of(edge).next()).unwrap_or(constraint);
        let of = |number: u32| if number == constraint { ends } else { self.ends_of(number) };
        let constraints = [constraint.min(other), constraint.max(other)];
        self.crossing_of(constraints, constraints.map(of))
    }

    fn ends_of(&self, constraint: u32) -> [u32; 2] {
        self.constraints.as_ref().and_then(|own| own.ends.get(&constraint).copied()).unwrap_or_default()
    }

    fn crossing_of(&self, constraints: [u32; 2], ends: [[u32; 2]; 2]) -> Error {
        let points: Vec<P> = ends.as_flattened().iter().filter_map(|&end| self.point(end)).collect();
        let (numbers, lattice) = P::numbers(&points).on_lattice();
        let whole: [Option<[i64; 2]>; 4] = core::array::from_fn(|place| match &numbers {
            Numbers::Grid(points) => points.get(place).map(|point| [point.x.into(), point.y.into()]),
            Numbers::Whole(points) => points.get(place).copied(),
            Numbers::Doubles(_) => None,
        });
        let rounded: [[f64; 2]; 4] =
            core::array::from_fn(|place| points.get(place).map_or([0.0; 2], |point| point.site().rounded()));
        let [a, b, c, d] = whole;
        let [p, q, r, s] = rounded;
        let place = crossing::Place::of([[a, b], [c, d]], [[p, q], [r, s]]);
        let place = lattice.map_or(place, |lattice| place.restored(&lattice));
        Error::Crossing { constraints, ends, place }
    }

    /// Refuses to take a point away that constraints need.
    pub(super) fn check_removal(&self, index: u32, vertex: u32) -> Result<(), Error> {
        let Some(own) = &self.constraints else { return Ok(()) };
        if let Some(constraint) = own.at(index).next() {
            return Err(Error::EndOfConstraint { index, constraint });
        }
        self.check_crossing(vertex)
    }

    /// Refuses to take the last point of a place away at which constraints cross.
    fn check_crossing(&self, vertex: u32) -> Result<(), Error> {
        let found = self.constraints.as_ref().and_then(|own| own.mesh.crossing_at(vertex));
        let found = found.filter(|_| !self.is_shared(vertex));
        let error = |constraints: [u32; 2]| self.crossing_of(constraints, constraints.map(|c| self.ends_of(c)));
        found.map_or(Ok(()), |constraints| Err(error(constraints)))
    }

    /// Moves a point, with the constraints that end there.
    pub(super) fn move_with_constraints(&mut self, index: u32, vertex: u32, point: P) -> Result<(), Error> {
        let own: Vec<u32> = self.constraints.iter().flat_map(|own| own.at(index)).collect();
        let own: Vec<(u32, [u32; 2])> = own.into_iter().map(|number| (number, self.ends_of(number))).collect();
        let from = self.base().vertices[vertex as usize].point;
        own.iter().for_each(|&(number, ends)| self.free(number, ends));
        let mut moved = self.check_crossing(vertex);
        if moved.is_ok() {
            self.move_vertex(index, vertex, point);
            moved = own.iter().try_for_each(|&(number, ends)| {
                self.force(number, ends).map_err(|edge| self.crossing(edge, number, ends))
            });
            if moved.is_err() {
                own.iter().for_each(|&(number, ends)| self.free(number, ends));
                let vertex = self.names.get(index).unwrap_or(vertex);
                self.move_vertex(index, vertex, from);
            }
        }
        if moved.is_err() {
            let is_free = own.iter().all(|&(number, ends)| self.force(number, ends).is_ok());
            debug_assert!(is_free, "the constraints were in the mesh before");
        }
        moved
    }

    /// The same triangulation without constraints.
    pub(super) fn without_constraints(&self) -> Self {
        Self {
            levels: self.levels.clone(),
            names: self.names.clone(),
            duplicates: self.duplicates.clone(),
            next: self.next,
            hint: self.hint.clone(),
            constraints: None,
            next_constraint: self.next_constraint,
        }
    }

    /// Gives the ends of constraints other indices.
    pub(super) fn rename_ends(&mut self, new: impl Fn(u32) -> u32) {
        let Some(own) = &mut self.constraints else { return };
        own.ends.values_mut().for_each(|ends| *ends = ends.map(&new));
        own.by_end = own.ends.iter().flat_map(|(&number, ends)| ends.map(|end| [end, number])).collect();
    }
}
