//! The constraints of a mesh that lives, by number and by end.

use alloc::collections::{BTreeMap, BTreeSet};

use super::constrained::ConstrainedLevel;
use super::level::Level;
use crate::plane_point::PlanePoint;

/// The constraints of a triangulation, and the mesh that has them.
#[derive(Clone, Debug)]
pub struct Constraints<P: PlanePoint> {
    pub mesh: ConstrainedLevel<P>,
    /// The indices of both ends of each constraint, by its number.
    pub ends: BTreeMap<u32, [u32; 2]>,
    /// The index of an end and the number of the constraint.
    pub by_end: BTreeSet<[u32; 2]>,
}

impl<P: PlanePoint> Constraints<P> {
    pub fn new(base: &Level<P>) -> Self {
        Self { mesh: ConstrainedLevel::new(base), ends: BTreeMap::new(), by_end: BTreeSet::new() }
    }

    pub fn insert(&mut self, constraint: u32, ends: [u32; 2]) {
        self.ends.insert(constraint, ends);
        self.by_end.extend(ends.map(|end| [end, constraint]));
    }

    /// The numbers of the constraints with an end at a point, in rising order.
    pub fn at(&self, index: u32) -> impl Iterator<Item = u32> + '_ {
        self.by_end.range([index, 0]..=[index, u32::MAX]).map(|entry| entry[1])
    }
}
