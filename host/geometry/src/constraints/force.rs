//! Forcing a constraint into a mesh: the triangles that it crosses are replaced by others on either side of it.
//!
//! From a vertex of the constraint the walk turns to the triangle, or along the edge, that leads towards the other end.
//! It goes straight through the triangles until it meets a vertex on the constraint: the end, or a point between. The
//! edges around the triangles that were crossed form a chain on either side, and each chain sees the constraint. A scan
//! with a stack cuts every vertex off at which the chain turns towards the constraint, which triangulates such a chain
//! in linear time (Toussaint and Avis, *On a convex hull algorithm for polygons and its application to triangulation
//! problems*, 1982). Flips then make the triangles canonical.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::error::Error;
use super::network::{Link, Network};
use crate::living::plane::{Side, INFINITE};
use crate::site::Site;

/// Where a constraint goes from one of its vertices.
enum Way {
    /// Along this edge, to this vertex.
    Along(Side, u32),
    /// Through the triangle whose edge opposite the vertex this is.
    Through(Side),
}

/// Why a step along a constraint ended before a vertex.
pub(super) enum Stop {
    /// The constraint crosses this edge, which is fixed.
    Crossing([u32; 2]),
    Error(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl<S: Site> Network<'_, S> {
    /// Forces the first edge of the line from one vertex to another, fixes it, and returns its end: the nearest vertex
    /// on that line.
    pub fn step(&mut self, from: u32, to: u32) -> Result<u32, Stop> {
        match self.way(from, to).ok_or(Error::NoMesh)? {
            Way::Along(side, end) => {
                self.fix(side);
                self.note(end, side.triangle());
                Ok(end)
            }
            Way::Through(first) => {
                let end = self.cross(first, from, to)?;
                self.fill(from, end)?;
                self.repair()?;
                Ok(end)
            }
        }
    }

    /// The way from a vertex towards another.
    fn way(&self, from: u32, to: u32) -> Option<Way> {
        let [a, q] = [from, to].map(|vertex| self.site(vertex));
        let side_of = |vertex: u32| S::orient2d(a, self.site(vertex), q);
        let is_ahead = |vertex: u32| vertex == to || S::is_between(a, self.site(vertex), q);
        self.around(from, self.triangle_at(from)).find_map(|side| {
            let [b, c] = self.plane.ends(side);
            match side_of(b) {
                Ordering::Equal if is_ahead(b) => Some(Way::Along(side.last(), b)),
                Ordering::Greater => match side_of(c) {
                    Ordering::Less => Some(Way::Through(side)),
                    Ordering::Equal if is_ahead(c) => Some(Way::Along(side.next(), c)),
                    _ => None,
                },
                _ => None,
            }
        })
    }

    /// Walks to the next vertex on the line, and collects the triangles on the way with the chains on both sides: the
    /// right one from `from` to that vertex, the left one back.
    fn cross(&mut self, first: Side, from: u32, to: u32) -> Result<u32, Stop> {
        self.crossed.clear();
        self.left.clear();
        self.right.clear();
        let [a, q] = [from, to].map(|vertex| self.site(vertex));
        self.crossed.push(first.triangle());
        self.add_right(first.last(), from);
        let [_, c] = self.plane.ends(first);
        self.add_left(first.next(), c);
        let mut edge = first;
        for _ in 0..self.plane.len() {
            if self.is_fixed(edge) {
                return Err(Stop::Crossing(self.edge(edge)));
            }
            let [b, _] = self.plane.ends(edge);
            let beyond = self.plane.across(edge);
            let apex = self.plane.apex(beyond);
            if apex == INFINITE || self.is_ghost(beyond.triangle()) {
                return Err(Error::NoMesh.into());
            }
            self.crossed.push(beyond.triangle());
            // Seen from beyond, the edge runs from `c` to `b`: the side after it lies opposite `c`, at the right.
            let (right, left) = (beyond.next(), beyond.last());
            match S::orient2d(a, q, self.site(apex)) {
                Ordering::Less => {
                    self.add_right(right, b);
                    edge = left;
                }
                Ordering::Greater => {
                    self.add_left(left, apex);
                    edge = right;
                }
                // In triangles of another set the vertex may lie elsewhere on the line, and the walk would never end.
                Ordering::Equal if apex != to && !S::is_between(a, self.site(apex), q) => {
                    return Err(Error::NoMesh.into());
                }
                Ordering::Equal => {
                    self.add_right(right, b);
                    self.add_left(left, apex);
                    return Ok(apex);
                }
            }
        }
        Err(Error::NoMesh.into())
    }

    fn add_right(&mut self, side: Side, from: u32) {
        let link = Link { from, outside: self.plane.across(side), is_fixed: self.is_fixed(side) };
        self.right.push(link);
    }

    fn add_left(&mut self, side: Side, from: u32) {
        let link = Link { from, outside: self.plane.across(side), is_fixed: self.is_fixed(side) };
        self.left.push(link);
    }

    /// Fills both chains with the numbers of the triangles that were crossed, and fixes the edge between.
    fn fill(&mut self, from: u32, end: u32) -> Result<(), Error> {
        self.left.reverse();
        for place in 0..self.crossed.len() {
            self.mark_crossed(self.crossed[place]);
        }
        let mut right = core::mem::take(&mut self.right);
        let mut left = core::mem::take(&mut self.left);
        let mut hanging = self.pair_hanging(&mut right, end);
        hanging.extend(self.pair_hanging(&mut left, from));
        let below = self.fill_chain(&right, end);
        let above = self.fill_chain(&left, from);
        (self.right, self.left) = (right, left);
        let (Some(below), Some(above)) = (below, above) else { return Err(Error::NoMesh) };
        for between in hanging {
            let [one, other, _] = self.plane.get(between).across;
            self.plane.link(one, other);
            self.spare.push(between);
        }
        self.plane.link(below, above);
        self.fix(below);
        Ok(())
    }

    /// Finds the edges that hang into a chain: both of their sides are links of it, so that what lies behind either is
    /// not known before both are filled. Until then a triangle of no place stands between the two sides. Returns these
    /// triangles. The links of hanging edges are nested like brackets, so a stack finds the pairs.
    fn pair_hanging(&mut self, links: &mut [Link], end: u32) -> Vec<u32> {
        let mut open: Vec<(usize, [u32; 2])> = Vec::new();
        let mut between = Vec::new();
        for place in 0..links.len() {
            let Link { from, outside, .. } = links[place];
            if !self.is_crossed(outside.triangle()) {
                continue;
            }
            let to = links.get(place + 1).map_or(end, |next| next.from);
            match open.last() {
                Some(&(first, ends)) if ends == [to, from] => {
                    open.pop();
                    let triangle = self.take_spare();
                    links[first].outside = Side::new(triangle, 0);
                    links[place].outside = Side::new(triangle, 1);
                    between.push(triangle);
                }
                _ => open.push((place, [from, to])),
            }
        }
        between
    }

    /// Fills a chain, which ends at this vertex, with triangles. Returns the side of the edge from its end to its
    /// beginning. `None` if the chain does not see that edge, which happens in no mesh.
    fn fill_chain(&mut self, links: &[Link], end: u32) -> Option<Side> {
        // The chain that is not filled yet: its links, and the last vertex.
        let mut open = core::mem::take(&mut self.chain);
        open.clear();
        let targets = links.iter().skip(1).map(|link| link.from).chain([end]);
        let mut only = None;
        for (&link, to) in links.iter().zip(targets) {
            let mut last = link;
            while let Some(&before) = open.last() {
                let [a, b, c] = [before.from, last.from, to].map(|vertex| self.site(vertex));
                if S::orient2d(a, b, c).is_le() {
                    break;
                }
                let triangle = self.crossed.pop()?;
                let behind = |link: Link| (link.outside, link.is_fixed);
                let new = Side::new(triangle, 1);
                self.write(triangle, [before.from, last.from, to], [behind(last), (new, false), behind(before)]);
                self.stack.extend([0, 2].map(|slot| Side::new(triangle, slot)));
                open.pop();
                last = Link { from: before.from, outside: new, is_fixed: false };
                only = Some(new);
            }
            open.push(last);
        }
        let is_filled = open.len() == 1;
        self.chain = open;
        only.filter(|_| is_filled)
    }
}
