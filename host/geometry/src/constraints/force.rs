//! Forcing a constraint into a mesh: the triangles that it crosses are replaced by others on either side of it.
//!
//! From a vertex of the constraint the walk turns to the triangle, or along the edge, that leads towards the other end.
//! It goes straight through the triangles until it meets a vertex on the constraint: the end, or a point between. The
//! edges around the triangles that were crossed form a chain on either side, and each chain sees the constraint. A scan
//! with a stack cuts every vertex off at which the chain turns towards the constraint, which triangulates such a chain
//! in linear time (Toussaint and Avis, *On a convex hull algorithm for polygons and its application to triangulation
//! problems*, 1982). Flips then make the triangles canonical.

use core::cmp::Ordering;

use super::fixed_mesh::{FixedMesh, Link, NoMesh};
use crate::living::plane::{Side, INFINITE};
use crate::site::Site;

/// The way of a constraint from one of its vertices on.
enum Way {
    /// Along this edge, to this vertex.
    Along(Side, u32),
    /// Through the triangle whose edge opposite the vertex this is.
    Through(Side),
}

/// The reason why a step along a constraint ended before a vertex.
pub(crate) enum Stop {
    /// The constraint crosses this edge, which is fixed.
    Crossing([u32; 2]),
    /// The triangles are not those of a mesh.
    NoMesh,
}

impl From<NoMesh> for Stop {
    fn from(_: NoMesh) -> Self {
        Self::NoMesh
    }
}

/// Forces the first edge of the line from one vertex to another, fixes it, and returns its end: the nearest vertex on
/// that line.
pub(crate) fn step<M: FixedMesh>(mesh: &mut M, from: u32, to: u32) -> Result<u32, Stop> {
    match way(mesh, from, to).ok_or(NoMesh)? {
        Way::Along(side, end) => {
            mesh.fix(side);
            mesh.note(end, side.triangle());
            Ok(end)
        }
        Way::Through(first) => {
            let end = cross(mesh, first, from, to)?;
            fill(mesh, from, end)?;
            mesh.repair()?;
            Ok(end)
        }
    }
}

/// The way from a vertex towards another.
fn way<M: FixedMesh>(mesh: &M, from: u32, to: u32) -> Option<Way> {
    let [a, q] = [from, to].map(|vertex| mesh.site(vertex));
    let side_of = |vertex: u32| M::Site::orient2d(a, mesh.site(vertex), q);
    let is_ahead = |vertex: u32| vertex == to || M::Site::is_between(a, mesh.site(vertex), q);
    mesh.around(from, mesh.triangle_at(from)).find_map(|side| {
        let [b, c] = mesh.plane().ends(side);
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

/// Walks to the next vertex on the line, and collects the triangles on the way with the chains on both sides: the right
/// one from `from` to that vertex, the left one back.
fn cross<M: FixedMesh>(mesh: &mut M, first: Side, from: u32, to: u32) -> Result<u32, Stop> {
    let work = mesh.work();
    work.crossed.clear();
    work.left.clear();
    work.right.clear();
    work.crossed.push(first.triangle());
    let [a, q] = [from, to].map(|vertex| mesh.site(vertex));
    add_right(mesh, first.last(), from);
    let [_, c] = mesh.plane().ends(first);
    add_left(mesh, first.next(), c);
    let mut edge = first;
    for _ in 0..mesh.plane().len() {
        if mesh.is_fixed(edge) {
            return Err(Stop::Crossing(mesh.edge(edge)));
        }
        let [b, _] = mesh.plane().ends(edge);
        let beyond = mesh.plane().across(edge);
        let apex = mesh.plane().apex(beyond);
        if apex == INFINITE || mesh.is_ghost(beyond.triangle()) {
            return Err(Stop::NoMesh);
        }
        mesh.work().crossed.push(beyond.triangle());
        // Seen from beyond, the edge runs from `c` to `b`: the side after it lies opposite `c`, at the right.
        let (right, left) = (beyond.next(), beyond.last());
        match M::Site::orient2d(a, q, mesh.site(apex)) {
            Ordering::Less => {
                add_right(mesh, right, b);
                edge = left;
            }
            Ordering::Greater => {
                add_left(mesh, left, apex);
                edge = right;
            }
            // In triangles of another set the vertex may lie elsewhere on the line, and the walk would never end.
            Ordering::Equal if apex != to && !M::Site::is_between(a, mesh.site(apex), q) => {
                return Err(Stop::NoMesh);
            }
            Ordering::Equal => {
                add_right(mesh, right, b);
                add_left(mesh, left, apex);
                return Ok(apex);
            }
        }
    }
    Err(Stop::NoMesh)
}

fn link<M: FixedMesh>(mesh: &M, side: Side, from: u32) -> Link {
    Link { from, outside: mesh.plane().across(side), is_fixed: mesh.is_fixed(side) }
}

fn add_right<M: FixedMesh>(mesh: &mut M, side: Side, from: u32) {
    let link = link(mesh, side, from);
    mesh.work().right.push(link);
}

fn add_left<M: FixedMesh>(mesh: &mut M, side: Side, from: u32) {
    let link = link(mesh, side, from);
    mesh.work().left.push(link);
}

/// Fills both chains with the numbers of the triangles that were crossed, and fixes the edge between.
fn fill<M: FixedMesh>(mesh: &mut M, from: u32, end: u32) -> Result<(), NoMesh> {
    mesh.work().left.reverse();
    for place in 0..mesh.work().crossed.len() {
        let triangle = mesh.work().crossed[place];
        mesh.mark_crossed(triangle);
    }
    let mut right = core::mem::take(&mut mesh.work().right);
    let mut left = core::mem::take(&mut mesh.work().left);
    pair_hanging(mesh, &mut right, end);
    pair_hanging(mesh, &mut left, from);
    let below = fill_chain(mesh, &right, end);
    let above = fill_chain(mesh, &left, from);
    (mesh.work().right, mesh.work().left) = (right, left);
    let (Some(below), Some(above)) = (below, above) else { return Err(NoMesh) };
    while let Some(between) = mesh.work().between.pop() {
        let [one, other, _] = mesh.plane().get(between).across;
        mesh.plane_mut().link(one, other);
        mesh.give_spare(between);
    }
    mesh.plane_mut().link(below, above);
    mesh.fix(below);
    Ok(())
}

/// Finds the edges that hang into a chain: both of their sides are links of it, so that what lies behind either is not
/// known before both are filled. Until then a triangle of no place stands between the two sides. The links of hanging
/// edges are nested like brackets, so a stack finds the pairs.
fn pair_hanging<M: FixedMesh>(mesh: &mut M, links: &mut [Link], end: u32) {
    mesh.work().open.clear();
    for place in 0..links.len() {
        let Link { from, outside, .. } = links[place];
        if !mesh.is_crossed(outside.triangle()) {
            continue;
        }
        let to = links.get(place + 1).map_or(end, |next| next.from);
        match mesh.work().open.last() {
            Some(&(first, ends)) if ends == [to, from] => {
                mesh.work().open.pop();
                let triangle = mesh.take_spare();
                links[first].outside = Side::new(triangle, 0);
                links[place].outside = Side::new(triangle, 1);
                mesh.work().between.push(triangle);
            }
            _ => mesh.work().open.push((place, [from, to])),
        }
    }
}

/// Fills a chain, which ends at this vertex, with triangles. Returns the side of the edge from its end to its
/// beginning. `None` if the chain does not see that edge, which happens in no mesh.
fn fill_chain<M: FixedMesh>(mesh: &mut M, links: &[Link], end: u32) -> Option<Side> {
    // The chain that is not filled yet: its links, and the last vertex.
    let mut open = core::mem::take(&mut mesh.work().chain);
    open.clear();
    let targets = links.iter().skip(1).map(|link| link.from).chain([end]);
    let mut only = None;
    for (&link, to) in links.iter().zip(targets) {
        let mut last = link;
        while let Some(&before) = open.last() {
            let [a, b, c] = [before.from, last.from, to].map(|vertex| mesh.site(vertex));
            if M::Site::orient2d(a, b, c).is_le() {
                break;
            }
            let triangle = mesh.work().crossed.pop()?;
            let behind = |link: Link| (link.outside, link.is_fixed);
            let new = Side::new(triangle, 1);
            mesh.write(triangle, [before.from, last.from, to], [behind(last), (new, false), behind(before)]);
            mesh.work().stack.extend([0, 2].map(|slot| Side::new(triangle, slot)));
            open.pop();
            last = Link { from: before.from, outside: new, is_fixed: false };
            only = Some(new);
        }
        open.push(last);
    }
    let is_filled = open.len() == 1;
    mesh.work().chain = open;
    only.filter(|_| is_filled)
}
