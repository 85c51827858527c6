//! From triangles to cells.

use alloc::vec;
use alloc::vec::Vec;

use super::error::Error;
use crate::mesh::{Mesh, EMPTY};
use crate::point::{Point, MAX_COORD_BITS};
use crate::predicate::{incircle, orient2d};

/// Marks in the list of corners that an edge comes from infinity.
pub(super) const NONE: u32 = u32::MAX;

/// The lists of a diagram, as its fields of the same names.
#[derive(Default)]
pub(super) struct Lists {
    pub(super) starts: Vec<u32>,
    pub(super) neighbors: Vec<u32>,
    pub(super) corners: Vec<u32>,
    pub(super) vertices: Vec<[u32; 3]>,
}

/// Refuses a mesh that no triangulator makes, so that the walks below end and no index is beyond a list.
pub(super) fn check(mesh: &Mesh<Point>) -> Result<(), Error> {
    let count = mesh.points.len();
    let is_wide = |point: &Point| (point.x | point.y) >> MAX_COORD_BITS != 0;
    if let Some(index) = mesh.points.iter().position(is_wide) {
        return Err(Error::CoordinateOutOfRange { index, point: mesh.points[index] });
    }
    let of_duplicates = mesh.duplicates.iter().map(|duplicate| &duplicate.index);
    let mut named = mesh.triangles.iter().flatten().chain(&mesh.hull).chain(of_duplicates);
    if let Some(&index) = named.find(|&&index| index as usize >= count) {
        return Err(Error::NoSuchPoint { index, points: count });
    }
    let turns = |&[a, b, c]: &[u32; 3]| {
        let at = |index: u32| mesh.points[index as usize];
        orient2d(at(a), at(b), at(c)) > 0
    };
    match mesh.triangles.iter().position(|triangle| !turns(triangle)) {
        Some(triangle) => Err(Error::NotCounterClockwise { triangle }),
        None => Ok(()),
    }
}

/// The half-edge before this one in its triangle.
fn before(halfedge: u32) -> u32 {
    if halfedge.is_multiple_of(3) {
        halfedge + 2
    } else {
        halfedge - 1
    }
}

/// The cells of a mesh that has triangles.
pub(super) fn of_triangles(mesh: &Mesh<Point>) -> Lists {
    let twins = mesh.halfedges();
    let (vertex_of, vertices) = merge(mesh, &twins);
    let first = first_halfedges(mesh, &twins);
    let count = mesh.points.len();
    let mut lists = Lists { starts: Vec::with_capacity(count + 1), vertices, ..Lists::default() };
    lists.neighbors.reserve_exact(2 * mesh.triangles.len() + count);
    lists.corners.reserve_exact(2 * mesh.triangles.len() + count);
    lists.starts.push(0);
    for &halfedge in &first {
        if halfedge != EMPTY {
            add_cell(mesh, &twins, &vertex_of, halfedge, &mut lists);
        }
        lists.starts.push(lists.neighbors.len() as u32);
    }
    lists
}

/// A half-edge that begins at each point: the one on the hull if there is one. [`EMPTY`] for points without triangles.
fn first_halfedges(mesh: &Mesh<Point>, twins: &[u32]) -> Vec<u32> {
    let mut first = vec![EMPTY; mesh.points.len()];
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        for (k, &corner) in corners.iter().enumerate() {
            let halfedge = 3 * triangle + k;
            let known = &mut first[corner as usize];
            if *known == EMPTY || twins[halfedge] == EMPTY {
                *known = halfedge as u32;
            }
        }
    }
    first
}

/// Adds the edges around a point, counter-clockwise from the neighbour at the end of this half-edge on. Triangles with
/// one circumcentre have no edge between them.
fn add_cell(mesh: &Mesh<Point>, twins: &[u32], vertex_of: &[u32], first: u32, lists: &mut Lists) {
    let begin = lists.neighbors.len();
    let mut halfedge = first;
    // Right of the edge to the neighbour; on the hull there is no triangle.
    let mut right = match twins[first as usize] {
        EMPTY => NONE,
        twin => vertex_of[(twin / 3) as usize],
    };
    let is_open = right == NONE;
    loop {
        let (triangle, k) = ((halfedge / 3) as usize, (halfedge % 3) as usize);
        let left = vertex_of[triangle];
        if left != right {
            lists.neighbors.push(mesh.triangles[triangle][(k + 1) % 3]);
            lists.corners.push(right);
        }
        right = left;
        let next = twins[before(halfedge) as usize];
        if next == EMPTY {
            lists.neighbors.push(mesh.triangles[triangle][(k + 2) % 3]);
            lists.corners.push(right);
            return;
        }
        if next == first {
            break;
        }
        halfedge = next;
    }
    if !is_open {
        let lowest = (begin..lists.neighbors.len()).min_by_key(|&edge| lists.neighbors[edge]).unwrap_or(begin);
        lists.neighbors[begin..].rotate_left(lowest - begin);
        lists.corners[begin..].rotate_left(lowest - begin);
    }
}

/// The Voronoi vertex of each triangle, and the first triangle of each Voronoi vertex. Triangles have one vertex if a
/// chain of triangles leads from one to the other in which consecutive ones share an edge and a circle.
fn merge(mesh: &Mesh<Point>, twins: &[u32]) -> (Vec<u32>, Vec<[u32; 3]>) {
    let mut parents: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    for (halfedge, &twin) in twins.iter().enumerate() {
        if twin != EMPTY && (twin as usize) > halfedge && are_on_one_circle(mesh, halfedge / 3, twin) {
            let (one, other) = (root(&mut parents, halfedge as u32 / 3), root(&mut parents, twin / 3));
            // The lowest triangle becomes the root, so each parent is lower than its child.
            parents[one.max(other) as usize] = one.min(other);
        }
    }
    let mut vertices = Vec::with_capacity(parents.len());
    for triangle in 0..parents.len() {
        let parent = parents[triangle] as usize;
        // The parent has its vertex already.
        parents[triangle] = if parent == triangle { vertices.len() as u32 } else { parents[parent] };
        if parent == triangle {
            vertices.push(mesh.triangles[triangle]);
        }
    }
    (parents, vertices)
}

/// Whether the corner of the other triangle lies on the circle of this one.
fn are_on_one_circle(mesh: &Mesh<Point>, triangle: usize, twin: u32) -> bool {
    let at = |index: u32| mesh.points[index as usize];
    let opposite = mesh.triangles[(twin / 3) as usize][(twin as usize % 3 + 2) % 3];
    let [a, b, c] = mesh.triangles[triangle].map(at);
    incircle(a, b, c, at(opposite)) == 0
}

/// The lowest triangle of a group. Ways to it are halved on the way.
fn root(parents: &mut [u32], mut triangle: u32) -> u32 {
    while parents[triangle as usize] != triangle {
        let grandparent = parents[parents[triangle as usize] as usize];
        parents[triangle as usize] = grandparent;
        triangle = grandparent;
    }
    triangle
}

/// The cells of points on one line: strips between parallel edges. `line` has the distinct points along it.
pub(super) fn of_line(count: usize, line: &[u32]) -> Lists {
    let mut around = vec![[NONE; 2]; count];
    for pair in line.windows(2) {
        around[pair[0] as usize][0] = pair[1];
        around[pair[1] as usize][1] = pair[0];
    }
    let mut lists = Lists { starts: vec![0], ..Lists::default() };
    for pair in around {
        lists.neighbors.extend(pair.into_iter().filter(|&neighbor| neighbor != NONE));
        lists.starts.push(lists.neighbors.len() as u32);
    }
    lists.corners = vec![NONE; lists.neighbors.len()];
    lists
}
