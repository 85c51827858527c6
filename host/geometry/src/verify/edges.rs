//! The validator's checks of edges: each edge has its two sides, and each inner edge is locally Delaunay.

use alloc::vec;
use alloc::vec::Vec;

use super::error::VerifyError;
use super::exact::ExactPoint;
use super::local::{check_circle, check_directions, check_only_side};
use super::sites::Sites;
use super::summary::VerifySummary;

/// Checks all edges, and counts edges and ties in the summary.
pub(super) fn check<P: ExactPoint>(
    sites: &Sites<'_, P>,
    triangles: &[[u32; 3]],
    summary: &mut VerifySummary,
) -> Result<(), VerifyError> {
    let sides = sides(triangles);
    let edges = || sides.chunk_by(|one, other| one.0 == other.0);
    let mut hull = HullEdges::of(&summary.hull, sites.points.len());
    for edge in edges() {
        summary.edges += 1;
        match *edge {
            [(_, only)] => hull.take(only, ends(triangles, only))?,
            _ => check_sides(triangles, edge)?,
        }
    }
    hull.check_complete(&summary.hull)?;
    for edge in edges() {
        // `check_sides` has refused edges of more than two sides, and sides that run the same way.
        if let [(_, one), (_, other)] = *edge {
            summary.ties += usize::from(check_inner_edge(sites, triangles, one, other)?);
        }
    }
    Ok(())
}

/// One side of an edge: the two points in rising order, and the half-edge. Half-edge `3 t + k` runs from corner `k` of
/// triangle `t` to the next.
pub(super) type Side = ([u32; 2], u32);

/// The sides of all edges, those of one edge in a row. O(n log n) by a plain sort, so that the validator shares no
/// sort with the host.
pub(super) fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    // `check_sizes` has made sure that three half-edges of each triangle fit 32 bits.
    let halfedges = 0..3 * triangles.len() as u32;
    let mut sides: Vec<Side> = halfedges
        .map(|halfedge| {
            let [from, to] = ends(triangles, halfedge);
            ([from.min(to), from.max(to)], halfedge)
        })
        .collect();
    sides.sort_unstable();
    sides
}

/// The two points of a half-edge: its origin, then its end.
pub(super) fn ends(triangles: &[[u32; 3]], halfedge: u32) -> [u32; 2] {
    let corners = triangles[(halfedge / 3) as usize];
    let k = (halfedge % 3) as usize;
    [corners[k], corners[(k + 1) % 3]]
}

/// Refuses two half-edges of one edge that run the same way.
pub(super) fn check_sides(triangles: &[[u32; 3]], sides: &[Side]) -> Result<(), VerifyError> {
    check_directions(sides.len(), |place| {
        let (_, halfedge) = sides[place];
        ((halfedge / 3) as usize, ends(triangles, halfedge))
    })
}

/// The hull edges, each of which must be met exactly once.
pub(super) struct HullEdges {
    /// For each point of the hull, the next point, until the edge between both is met.
    following: Vec<Option<u32>>,
}

impl HullEdges {
    pub(super) fn of(hull: &[u32], points: usize) -> Self {
        let mut following = vec![None; points];
        for (&from, &to) in hull.iter().zip(hull.iter().skip(1).chain(hull.first())) {
            following[from as usize] = Some(to);
        }
        Self { following }
    }

    pub(super) fn take(&mut self, halfedge: u32, edge: [u32; 2]) -> Result<(), VerifyError> {
        let following = &mut self.following[edge[0] as usize];
        check_only_side((halfedge / 3) as usize, edge, following.map(|to| [edge[0], to]))?;
        *following = None;
        Ok(())
    }

    pub(super) fn check_complete(&self, hull: &[u32]) -> Result<(), VerifyError> {
        for &from in hull {
            if let Some(to) = self.following[from as usize] {
                return Err(VerifyError::MissingHullEdge { edge: [from, to] });
            }
        }
        Ok(())
    }
}

/// Checks the local Delaunay property and the tie rule of the edge between two triangles; returns true for a tie.
pub(super) fn check_inner_edge<P: ExactPoint>(
    sites: &Sites<'_, P>,
    triangles: &[[u32; 3]],
    one: u32,
    other: u32,
) -> Result<bool, VerifyError> {
    let corner = |halfedge: u32, step: u32| triangles[(halfedge / 3) as usize][((halfedge % 3 + step) % 3) as usize];
    let (a, b, c, d) = (corner(one, 0), corner(one, 1), corner(one, 2), corner(other, 2));
    check_circle((one / 3) as usize, [a, b, c, d], [a, b, c, d].map(|corner| sites.at(corner)))
}
