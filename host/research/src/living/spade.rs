//! The library spade as a contestant.

use std::time::Instant;

use spade::handles::FixedVertexHandle;
use spade::{
    DelaunayTriangulation, HasPosition, HintGenerator, Point2, PositionInTriangulation as Position, Triangulation,
};

use super::contestant::{smallest_first, Block, Contestant, Run, NO_VERTEX};
use crate::orders::Failure;

/// A point with its number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbered {
    place: Point2<f64>,
    number: u32,
}

impl HasPosition for Numbered {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// A triangulation of spade. The type `H` chooses where its walks begin.
pub(super) struct Spade<H: HintGenerator<f64>> {
    mesh: DelaunayTriangulation<Numbered, (), (), (), H>,
    /// The handle of each point. spade gives the last handle to another vertex when one is removed, and leaves it to
    /// the caller to know that.
    handles: Vec<FixedVertexHandle>,
}

impl<H: HintGenerator<f64>> Spade<H> {
    pub(super) fn new() -> Self {
        Self { mesh: DelaunayTriangulation::new(), handles: Vec::new() }
    }

    fn number(&self, handle: FixedVertexHandle) -> u32 {
        self.mesh.vertex(handle).data().number
    }

    fn corners(&self, position: Position) -> [u32; 3] {
        match position {
            Position::OnVertex(vertex) => [self.number(vertex), NO_VERTEX, NO_VERTEX],
            Position::OnEdge(edge) => {
                let [one, other] = self.mesh.directed_edge(edge).vertices().map(|vertex| vertex.data().number);
                [one.min(other), one.max(other), NO_VERTEX]
            }
            Position::OnFace(face) => {
                smallest_first(self.mesh.face(face).vertices().map(|vertex| vertex.data().number))
            }
            Position::OutsideOfConvexHull(_) | Position::NoTriangulation => [NO_VERTEX; 3],
        }
    }

    fn delete(&mut self, numbers: &[u32]) -> f64 {
        let since = Instant::now();
        for &number in numbers {
            let handle = self.handles[number as usize];
            self.mesh.remove(handle);
            if handle.index() < self.mesh.num_vertices() {
                let moved = self.mesh.vertex(handle).data().number;
                self.handles[moved as usize] = handle;
            }
        }
        since.elapsed().as_secs_f64()
    }
}

fn at([x, y]: [f64; 2]) -> Point2<f64> {
    Point2::new(x, y)
}

impl<H: HintGenerator<f64>> Contestant for Spade<H> {
    fn name(&self) -> &'static str {
        "spade"
    }

    fn load(&mut self, points: &[[f64; 2]], order: &[u32]) -> Result<(), Failure> {
        let along = order.iter().map(|&number| Numbered { place: at(points[number as usize]), number });
        self.mesh = DelaunayTriangulation::new();
        self.handles = vec![FixedVertexHandle::from_index(0); points.len()];
        for point in along {
            self.handles[point.number as usize] = self.mesh.insert(point)?;
        }
        Ok(())
    }

    fn run(&mut self, block: Block) -> Result<Run, Failure> {
        match block {
            Block::Locate(places) => {
                let mut found = Vec::with_capacity(places.len());
                let since = Instant::now();
                found.extend(places.iter().map(|&place| self.mesh.locate(at(place))));
                let seconds = since.elapsed().as_secs_f64();
                Ok(Run { seconds, answers: found.into_iter().flat_map(|position| self.corners(position)).collect() })
            }
            Block::Nearest(places) => {
                let mut found = Vec::with_capacity(places.len());
                let since = Instant::now();
                let nearest = |&place: &[f64; 2]| self.mesh.nearest_neighbor(at(place)).map(|vertex| vertex.fix());
                found.extend(places.iter().map(nearest));
                let seconds = since.elapsed().as_secs_f64();
                let answers = found.into_iter().map(|vertex| vertex.map_or(NO_VERTEX, |vertex| self.number(vertex)));
                Ok(Run { seconds, answers: answers.collect() })
            }
            Block::Insert(places) => {
                self.handles.reserve(places.len());
                let since = Instant::now();
                for &place in places {
                    let point = Numbered { place: at(place), number: self.handles.len() as u32 };
                    self.handles.push(self.mesh.insert(point)?);
                }
                Ok(Run { seconds: since.elapsed().as_secs_f64(), answers: Vec::new() })
            }
            Block::Delete(numbers) => Ok(Run { seconds: self.delete(numbers), answers: Vec::new() }),
        }
    }

    fn triangles(&mut self) -> Result<Vec<[u32; 3]>, Failure> {
        let corners = self.mesh.inner_faces().map(|face| face.vertices().map(|vertex| vertex.data().number));
        let mut triangles: Vec<_> = corners.map(smallest_first).collect();
        triangles.sort_unstable();
        Ok(triangles)
    }
}
