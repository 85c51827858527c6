//! The living triangulation of this project as a contestant.

use std::time::Instant;

use incircle_geometry::living::{Location, Triangulation};
use incircle_geometry::PlanePoint;

use super::contestant::{Block, Contestant, Run, NO_VERTEX};
use crate::orders::Failure;

/// Our triangulation, with points of some type.
pub(super) struct Ours<P: PlanePoint> {
    mesh: Triangulation<P>,
    point: fn([f64; 2]) -> P,
}

impl<P: PlanePoint> Ours<P> {
    /// `point` turns two coordinates into a point, without a loss.
    pub(super) fn new(point: fn([f64; 2]) -> P) -> Self {
        Self { mesh: Triangulation::new(), point }
    }

    fn points(&self, places: &[[f64; 2]]) -> Vec<P> {
        places.iter().map(|&place| (self.point)(place)).collect()
    }
}

/// Seconds that the work took, and its results.
fn timed<T, R>(items: &[T], work: impl FnMut(&T) -> R) -> (f64, Vec<R>) {
    let mut results = Vec::with_capacity(items.len());
    let since = Instant::now();
    results.extend(items.iter().map(work));
    (since.elapsed().as_secs_f64(), results)
}

fn corners(location: &Location) -> [u32; 3] {
    match *location {
        Location::Vertex(vertex) => [vertex, NO_VERTEX, NO_VERTEX],
        Location::Edge([one, other]) => [one, other, NO_VERTEX],
        Location::Triangle(triangle) => triangle,
        Location::Outside(_) | Location::None => [NO_VERTEX; 3],
    }
}

impl<P: PlanePoint> Contestant for Ours<P> {
    fn name(&self) -> &'static str {
        "incircle"
    }

    fn load(&mut self, points: &[[f64; 2]], _: &[u32]) -> Result<(), Failure> {
        self.mesh = Triangulation::from(self.points(points))?;
        Ok(())
    }

    fn run(&mut self, block: Block) -> Result<Run, Failure> {
        match block {
            Block::Locate(places) => {
                let (seconds, found) = timed(&self.points(places), |&place| self.mesh.locate(place));
                Ok(Run { seconds, answers: found.iter().flat_map(corners).collect() })
            }
            Block::Nearest(places) => {
                let (seconds, found) = timed(&self.points(places), |&place| self.mesh.nearest(place));
                Ok(Run { seconds, answers: found.into_iter().map(|nearest| nearest.unwrap_or(NO_VERTEX)).collect() })
            }
            Block::Insert(places) => {
                let (seconds, given) = timed(&self.points(places), |&place| self.mesh.insert(place));
                given.into_iter().collect::<Result<Vec<_>, _>>()?;
                Ok(Run { seconds, answers: Vec::new() })
            }
            Block::Delete(numbers) => {
                let (seconds, done) = timed(numbers, |&number| self.mesh.delete(number));
                done.into_iter().collect::<Result<Vec<_>, _>>()?;
                Ok(Run { seconds, answers: Vec::new() })
            }
        }
    }

    fn triangles(&mut self) -> Result<Vec<[u32; 3]>, Failure> {
        let mut triangles: Vec<_> = self.mesh.triangles().collect();
        triangles.sort_unstable();
        Ok(triangles)
    }
}
