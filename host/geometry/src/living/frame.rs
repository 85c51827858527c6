//! Changes of all points: a frame in which all move, and new indices.

use alloc::vec::Vec;

use super::error::Error;
use super::names::Names;
use super::sweep::Sweep;
use super::triangulation::Triangulation;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// If more than one in this many vertices would have to be taken out, the mesh is made anew. In tests all may be, so
/// that small sets take out some.
const MOST: usize = if cfg!(test) { 1 } else { 16 };

impl<P: PlanePoint> Triangulation<P> {
    /// Moves all living points at once: the list has a new place for each, in the order of the indices. All points keep
    /// their indices.
    ///
    /// If the steps are short against the distances between neighbours, this is quicker than a new triangulation; if
    /// not, one is made. The result is the same either way. O(n) where few points have to be inserted anew.
    ///
    /// ```
    /// let mut mesh = incircle_geometry::Triangulation::from([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])?;
    /// mesh.move_all(&[[0.0, 0.1], [4.0, 0.0], [4.1, 4.0], [0.0, 4.0]])?;
    /// assert_eq!(mesh.point(2), Some([4.1, 4.0]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// The list does not have one place for each living point, or a coordinate is infinite or not a number.
    pub fn move_all(&mut self, places: &[P]) -> Result<(), Error> {
        if places.len() != self.len() {
            return Err(Error::WrongCount { given: places.len(), living: self.len() });
        }
        if let Some(position) = places.iter().position(|place| !place.site().is_finite()) {
            return Err(Error::NotFiniteAt { position });
        }
        let indices = self.indices();
        if !self.sweep(&indices, places) {
            let next = self.next;
            *self = Self::new();
            self.next = next;
            self.load(places, |position| indices[position as usize])?;
        }
        Ok(())
    }

    /// Moves the points by a sweep; says whether that was possible. If not, the mesh is of no use.
    fn sweep(&mut self, indices: &[u32], places: &[P]) -> bool {
        if !self.base().is_plane() {
            return false;
        }
        let mut moved: Vec<P> = self.base().vertices.iter().map(|vertex| vertex.point).collect();
        let vertices: Vec<u32> = indices.iter().filter_map(|&index| self.names.get(index)).collect();
        // The point that names a place takes the vertex along.
        for ((&vertex, &index), &place) in vertices.iter().zip(indices).zip(places) {
            if self.name(vertex) == index {
                moved[vertex as usize] = place;
            }
        }
        self.levels.truncate(1);
        let most = self.base().count / MOST;
        let mut sweep = Sweep { level: &mut self.levels[0], places: &moved, taken: Vec::new(), most };
        if !sweep.run() {
            return false;
        }
        let taken = sweep.taken;
        self.load_levels();
        self.attach_all(indices, &vertices, places, &taken);
        true
    }

    /// Inserts the points of vertices that were taken out, and those that went another way than the point that names
    /// their place.
    fn attach_all(&mut self, indices: &[u32], vertices: &[u32], places: &[P], taken: &[u32]) {
        if taken.is_empty() && self.twins.is_empty() {
            return;
        }
        let mut is_taken = alloc::vec![false; self.base().vertices.len()];
        taken.iter().for_each(|&vertex| is_taken[vertex as usize] = true);
        let mut loose: Vec<(u32, P)> = Vec::new();
        for ((&index, &vertex), &place) in indices.iter().zip(vertices).zip(places) {
            if is_taken[vertex as usize] || self.base().site(vertex) != place.site() {
                self.twins.remove(&(vertex, index));
                loose.push((index, place));
            }
        }
        for (index, place) in loose {
            self.attach(index, place);
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
        let twins = core::mem::take(&mut self.twins);
        for (new, &old) in (0u32..).zip(&indices) {
            let Some(vertex) = self.names.get(old) else { continue };
            names.set(new, vertex);
            if twins.contains(&(vertex, old)) {
                self.twins.insert((vertex, new));
            } else {
                self.levels[0].vertices[vertex as usize].name = new;
            }
        }
        self.names = names;
        self.next = indices.len() as u32;
        indices
    }
}
