//! Changes of all points: a frame in which all move, and new indices.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::error::Error;
use super::level::Vertex;
use super::names::Names;
use super::sweep::{Sweep, Taken};
use super::triangulation::Triangulation;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// Positions are looked up in a table if it is at most this many times as long as the list of living indices.
const SPARSE: usize = 8;
/// If more than one in this many vertices would have to be taken out, the mesh is made anew. Measured with a million
/// points: steps of half the mean distance take 240 ns a point by the sweep and 440 by a new mesh, and steps of the
/// whole distance take 460 either way. In tests all may be, so that small sets take out some.
const MOST: usize = if cfg!(test) { 1 } else { 2 };

/// The positions of living indices in the list of all.
enum Ranks<'i> {
    /// All indices below the number of points are living.
    Dense,
    /// A position for each index from the first living one to the last.
    Table(u32, Vec<u32>),
    /// The living indices lie so far apart that a table would be long; a position is found by binary search.
    Sparse(&'i [u32]),
}

impl<'i> Ranks<'i> {
    fn of(indices: &'i [u32]) -> Self {
        let [first, .., last] = *indices else { return Self::Sparse(indices) };
        let range = (last - first) as usize + 1;
        if last as usize == indices.len() - 1 {
            return Self::Dense;
        }
        if range > SPARSE * indices.len() {
            return Self::Sparse(indices);
        }
        let mut table = alloc::vec![0; range];
        (0u32..).zip(indices).for_each(|(rank, &index)| table[(index - first) as usize] = rank);
        Self::Table(first, table)
    }

    /// The position of a living index.
    #[inline]
    fn rank(&self, index: u32) -> usize {
        match self {
            Self::Dense => index as usize,
            Self::Table(first, table) => {
                table.get(index.wrapping_sub(*first) as usize).map_or(usize::MAX, |&rank| rank as usize)
            }
            Self::Sparse(indices) => indices.binary_search(&index).unwrap_or(usize::MAX),
        }
    }
}

impl<P: PlanePoint> Triangulation<P> {
    /// Moves all living points at once: the list has a new place for each, in the order of the indices. All points keep
    /// their indices.
    ///
    /// If the steps are short against the distances between neighbours, this is quicker than a new triangulation; if
    /// not, one is made. The result is the same either way. O(n) where few points have to be inserted anew. Constraints
    /// follow their points, and are all forced anew.
    ///
    /// ```
    /// let mut mesh = incircle_geometry::Triangulation::from([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])?;
    /// mesh.move_all(&[[0.0, 0.1], [4.0, 0.0], [4.1, 4.0], [0.0, 4.0]])?;
    /// assert_eq!(mesh.point(2), Some([4.1, 4.0]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// The list does not have one place for each living point, a coordinate is infinite or not a number, or constraints
    /// would cross at a place that is no point. The mesh stays as it was.
    pub fn move_all(&mut self, places: &[P]) -> Result<(), Error> {
        if places.len() != self.len() {
            return Err(Error::WrongCount { given: places.len(), living: self.len() });
        }
        if let Some(position) = places.iter().position(|place| !place.site().is_finite()) {
            return Err(Error::NotFiniteAt { position });
        }
        if self.constraints.is_some() {
            let mut moved = self.without_constraints();
            moved.move_all(places)?;
            self.constraints().try_for_each(|(number, ends)| moved.put_constraint(number, ends))?;
            *self = moved;
            return Ok(());
        }
        let all_live = self.next as usize == places.len();
        let indices = if all_live { Vec::new() } else { self.indices() };
        let index = |position: u32| if all_live { position } else { indices[position as usize] };
        let ranks = if all_live { Ranks::Dense } else { Ranks::of(&indices) };
        if !self.sweep(&ranks, places) {
            *self = Self { next: self.next, next_constraint: self.next_constraint, ..Self::new() };
            self.load(places, index)?;
        }
        Ok(())
    }

    /// Moves the points by a sweep; says whether that was possible. If not, the mesh is of no use.
    fn sweep(&mut self, ranks: &Ranks, places: &[P]) -> bool {
        if !self.base().is_plane() {
            return false;
        }
        // The point that names a place takes the vertex along. What stands here for a free vertex is never used.
        let place = |vertex: &Vertex<P>| places.get(ranks.rank(vertex.name)).copied().unwrap_or(vertex.point);
        let moved: Vec<P> = self.base().vertices.iter().map(place).collect();
        let most = self.base().count / MOST;
        let Some(taken) = Sweep::run(&mut self.levels[0], &moved, most) else { return false };
        self.sweep_levels();
        self.attach_all(&taken, |index| places[ranks.rank(index)]);
        true
    }

    /// Moves the vertices of all levels above the lowest to the places that they have in the lowest.
    fn sweep_levels(&mut self) {
        if let Some(number) = (1..self.levels.len()).find(|&number| !self.sweep_level(number)) {
            self.levels.truncate(number);
        }
        self.load_levels();
    }

    /// Moves the vertices of a level to the places that they have in the level below, and takes out those that are no
    /// longer there. Says whether that was possible; if not, the level is of no use.
    fn sweep_level(&mut self, number: usize) -> bool {
        let (lower, upper) = self.levels.split_at_mut(number);
        let (Some(below), Some(level)) = (lower.last(), upper.first_mut()) else { return false };
        for vertex in 0..level.vertices.len() as u32 {
            let is_gone = level.is_vertex(vertex) && !below.is_vertex(level.vertices[vertex as usize].name);
            if is_gone && level.is_plane() {
                level.remove(vertex);
            }
        }
        if !level.is_plane() {
            return false;
        }
        // The entry of a free vertex is never used.
        let place = |vertex: &Vertex<P>| below.vertices.get(vertex.name as usize).map_or(vertex.point, |own| own.point);
        let moved: Vec<P> = level.vertices.iter().map(place).collect();
        let most = level.count / MOST;
        let Some(taken) = Sweep::run(level, &moved, most) else { return false };
        // The vertex that was freed last is taken first, so all get back their own, and the level above need not be
        // told.
        for Taken { vertex, name, near } in taken.into_iter().rev() {
            let point = moved[vertex as usize];
            let place = level.find(point.site(), near);
            level.add(point, name, place);
        }
        true
    }

    /// Inserts the points of the vertices that were taken out, and the duplicates that moved to another place than the
    /// point that named their common place.
    fn attach_all(&mut self, taken: &[Taken], place: impl Fn(u32) -> P) {
        let mut loose: Vec<(u32, Option<u32>)> = taken.iter().map(|taken| (taken.name, taken.near)).collect();
        if !self.duplicates.is_empty() {
            let gone: BTreeSet<u32> = taken.iter().map(|taken| taken.vertex).collect();
            let duplicates = core::mem::take(&mut self.duplicates);
            let base = self.base();
            let stays =
                |&(vertex, index): &(u32, u32)| !gone.contains(&vertex) && base.site(vertex) == place(index).site();
            let (duplicates, others) = duplicates.into_iter().partition::<Vec<_>, _>(stays);
            self.duplicates = duplicates.into_iter().collect();
            loose.extend(others.into_iter().map(|(_, index)| (index, None)));
        }
        // The vertex that was freed last is taken first, so most points get back their own.
        for (index, near) in loose.into_iter().rev() {
            if let Some(near) = near {
                self.hint.set(near);
            }
            self.attach(index, place(index));
        }
    }

    /// Gives the living points new indices, from 0 on, in the order of the old ones, which are returned. The next index
    /// is then the number of points. O(n log n).
    ///
    /// ```
    /// let mut mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [4, 4]])?;
    /// mesh.delete(1)?;
    /// assert_eq!(mesh.renumber(), [0, 2]);
    /// assert_eq!((mesh.point(1), mesh.next_index()), (Some([4, 4]), 2));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn renumber(&mut self) -> Vec<u32> {
        let indices = self.indices();
        let mut names = Names::default();
        names.reserve(indices.len());
        let duplicates = core::mem::take(&mut self.duplicates);
        for (new, &old) in (0u32..).zip(&indices) {
            let Some(vertex) = self.names.get(old) else { continue };
            names.set(new, vertex);
            if duplicates.contains(&(vertex, old)) {
                self.duplicates.insert((vertex, new));
            } else {
                self.levels[0].vertices[vertex as usize].name = new;
            }
        }
        // The ends of constraints live.
        self.rename_ends(|old| indices.binary_search(&old).map_or(old, |new| new as u32));
        self.names = names;
        self.next = indices.len() as u32;
        indices
    }
}
