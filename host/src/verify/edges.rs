//! Edges: each has its two sides, and each inner one is locally Delaunay.

use std::cmp::Ordering;

use crate::edges::EdgeList;
use crate::sort::{Entry, Wide};

use super::exact::circle_side;
use super::sites::Sites;
use super::{VerifyError, VerifySummary};

/// Checks all edges and counts edges and ties.
pub(super) fn check(
    sites: &Sites<'_>,
    triangles: &[[u32; 3]],
    summary: &mut VerifySummary,
) -> Result<(), VerifyError> {
    let edges = EdgeList::of(triangles);
    let mut hull = HullEdges::of(&summary.hull, sites.points.len());
    for group in edges.groups() {
        summary.edges += 1;
        match group {
            [only] => hull.take(only.value(), edges.ends(only.value()))?,
            _ => check_sides(&edges, group)?,
        }
    }
    hull.check_complete(&summary.hull)?;
    for [one, other] in edges.pairs() {
        summary.ties += usize::from(check_inner_edge(sites, triangles, one, other)?);
    }
    Ok(())
}

/// No two half-edges of one edge may run the same way. Of three or more, two do.
fn check_sides(edges: &EdgeList<'_>, group: &[Wide]) -> Result<(), VerifyError> {
    for (place, later) in group.iter().enumerate() {
        let edge = edges.ends(later.value());
        let mut earlier = group[..place].iter();
        if let Some(twin) = earlier.find(|twin| edges.ends(twin.value()) == edge) {
            return Err(VerifyError::SameSide {
                one: (twin.value() / 3) as usize,
                other: (later.value() / 3) as usize,
                edge,
            });
        }
    }
    Ok(())
}

/// The hull edges, to be met once each.
struct HullEdges {
    /// The point after each point of the hull, until its edge is met.
    following: Vec<Option<u32>>,
}

impl HullEdges {
    fn of(hull: &[u32], points: usize) -> Self {
        let mut following = vec![None; points];
        for (&from, &to) in hull.iter().zip(hull.iter().skip(1).chain(hull.first())) {
            following[from as usize] = Some(to);
        }
        Self { following }
    }

    fn take(&mut self, halfedge: u32, edge: [u32; 2]) -> Result<(), VerifyError> {
        let following = &mut self.following[edge[0] as usize];
        if *following != Some(edge[1]) {
            return Err(VerifyError::OpenEdge {
                triangle: (halfedge / 3) as usize,
                edge,
            });
        }
        *following = None;
        Ok(())
    }

    fn check_complete(&self, hull: &[u32]) -> Result<(), VerifyError> {
        for &from in hull {
            if let Some(to) = self.following[from as usize] {
                return Err(VerifyError::MissingHullEdge { edge: [from, to] });
            }
        }
        Ok(())
    }
}

/// Local Delaunay property and tie rule of the edge between two triangles; true for a tie.
fn check_inner_edge(
    sites: &Sites<'_>,
    triangles: &[[u32; 3]],
    one: u32,
    other: u32,
) -> Result<bool, VerifyError> {
    let corner = |halfedge: u32, step: u32| {
        triangles[(halfedge / 3) as usize][((halfedge % 3 + step) % 3) as usize]
    };
    let (a, b, c, d) = (
        corner(one, 0),
        corner(one, 1),
        corner(one, 2),
        corner(other, 2),
    );
    match circle_side(sites.at(a), sites.at(b), sites.at(c), sites.at(d)) {
        Ordering::Less => Ok(false),
        Ordering::Greater => Err(VerifyError::NotDelaunay {
            triangle: (one / 3) as usize,
            point: d,
            edge: [a, b],
        }),
        Ordering::Equal => {
            let corners = [a, d, b, c];
            let smallest = corners.into_iter().min_by_key(|&index| sites.at(index));
            match smallest {
                Some(smallest) if smallest != a && smallest != b => Err(VerifyError::WrongTie {
                    corners,
                    edge: [a, b],
                    smallest,
                }),
                _ => Ok(true),
            }
        }
    }
}
