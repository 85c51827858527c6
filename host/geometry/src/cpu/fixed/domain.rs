//! The triangles of a domain in canonical order, with their regions.

use alloc::vec;
use alloc::vec::Vec;

use bytemuck::Zeroable;

use super::mesh::Fixed;
use super::parts::{Boundary, Parts};
use crate::cpu::kernel::Kernel;
use crate::mesh::smallest_first;
use crate::pages;
use crate::plan::Domain;
use crate::sort::{sort_by_key, Keyed};

/// A triangle and its part.
#[derive(Clone, Copy, Zeroable)]
struct Placed {
    corners: [u32; 3],
    part: u32,
}

impl Keyed for Placed {
    /// No two triangles have the edge from their smallest corner to the next one in common.
    #[inline(always)]
    fn key(&self) -> u64 {
        u64::from(self.corners[0]) << 32 | u64::from(self.corners[1])
    }
}

/// The triangles of a domain.
pub(super) struct Chosen {
    pub(super) triangles: Vec<[u32; 3]>,
    /// The region of each triangle, and of each place that asks for one.
    pub(super) regions: Vec<u32>,
    pub(super) marked: Vec<u32>,
    pub(super) region_count: u32,
    /// The edges around the domain, which lies to their left. None if all triangles are wanted.
    pub(super) border: Vec<[u32; 2]>,
}

impl<K: Kernel> Fixed<'_, K> {
    /// Takes the triangles of a domain, by the input indices of the vertices. `None` if the boundary is not closed, a
    /// place of a hole or region is on no side of the constraints, or the domain or a region of it is empty.
    pub(super) fn take(
        &self,
        ids: &[u32],
        boundary: &Boundary<'_>,
        holes: &[K::Site],
        regions: &[K::Site],
    ) -> Option<Chosen> {
        if !boundary.is_closed(self.sites.len()) {
            return None;
        }
        let parts = Parts::of(self, boundary);
        let mut chosen = parts.chosen(boundary.domain);
        if boundary.domain == Domain::Holes {
            for edge in self.locate_all(holes)? {
                chosen[parts.at(edge) as usize] = false;
            }
        }
        let mut all = self.faces(ids, &parts, &chosen);
        if all.is_empty() {
            return None;
        }
        sort_by_key(&mut all);
        let (mut numbers, mut count) = (vec![None; chosen.len()], 0);
        let mut found = (pages::with_room(all.len()), pages::with_room(all.len()));
        for Placed { corners, part } in all {
            let number = *numbers[part as usize].get_or_insert_with(|| {
                count += 1;
                count - 1
            });
            found.0.push(corners);
            found.1.push(number);
        }
        let located = self.locate_all(regions)?;
        let marked = located.into_iter().map(|edge| numbers[parts.at(edge) as usize]).collect::<Option<_>>()?;
        let border = if boundary.domain == Domain::All { vec![] } else { self.border(ids, &parts, &chosen) };
        Some(Chosen { triangles: found.0, regions: found.1, marked, region_count: count, border })
    }

    /// The triangles of the chosen parts, in the order of the curve.
    fn faces(&self, ids: &[u32], parts: &Parts, chosen: &[bool]) -> Vec<Placed> {
        let mut all = pages::with_room(self.halves.len() / 3);
        for edge in self.edges().filter(|&edge| !self.is_outside(edge)) {
            let (part, face) = (parts.at(edge), self.face(edge));
            // Each triangle is taken at one of its half-edges.
            if chosen[part as usize] && edge < face[1] && edge < face[2] {
                let corners = face.map(|side| ids[self.origin(side) as usize]);
                all.push(Placed { corners: smallest_first(corners), part });
            }
        }
        all
    }

    /// The fixed edges with a chosen part at their left only.
    fn border(&self, ids: &[u32], parts: &Parts, chosen: &[bool]) -> Vec<[u32; 2]> {
        let is_chosen = |side: u32| chosen[parts.at(side) as usize];
        let sides = self.fixed.iter().flat_map(|&pair| [pair, pair ^ 1]);
        let border = sides.filter(|&side| is_chosen(side) && !is_chosen(side ^ 1));
        border.map(|side| [self.origin(side), self.end(side)].map(|vertex| ids[vertex as usize])).collect()
    }

    /// Half-edges at the triangles of places.
    fn locate_all(&self, places: &[K::Site]) -> Option<Vec<u32>> {
        let mut near = self.edges().find(|&edge| !self.is_outside(edge))?;
        let locate = |&place: &K::Site| {
            near = self.locate(place, near)?;
            Some(near)
        };
        places.iter().map(locate).collect()
    }
}
