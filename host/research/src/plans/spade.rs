//! The library spade as a contestant.

use std::time::Instant;

use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::run::{canonical, Run};
use super::sets::Set;
use crate::orders::Failure;

/// A point with its number.
#[derive(Clone, Copy, Debug)]
struct Numbered {
    place: Point2<f64>,
    number: u32,
}

impl HasPosition for Numbered {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// Makes the mesh of a set.
pub(super) fn run(set: &Set) -> Result<Run, Failure> {
    let numbered = |(number, &[x, y]): (u32, &[f64; 2])| Numbered { place: Point2::new(x, y), number };
    let points: Vec<Numbered> = (0..).zip(&set.points).map(numbered).collect();
    let edges: Vec<[usize; 2]> = set.constraints.iter().map(|pair| pair.map(|end| end as usize)).collect();
    let since = Instant::now();
    let mesh = ConstrainedDelaunayTriangulation::<Numbered>::bulk_load_cdt(points, edges)?;
    let seconds = since.elapsed().as_secs_f64();
    let corners = mesh.inner_faces().map(|face| face.vertices().map(|vertex| vertex.data().number));
    Ok(Run { seconds, triangles: canonical(corners.collect()) })
}
