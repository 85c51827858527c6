//! From the records of the device to the canonical mesh, in the caller's buffer. Nothing in a record is used before it
//! is checked.
//!
//! The checks cost O(n log n): vertices are in range, triangles are counter-clockwise and none comes twice, ghost
//! triangles close one hull, and areas sum to the area of the hull. The Delaunay property is not checked.

use incircle_protocol::infinite_vertex;

use crate::error::Fault;
use crate::load::Load;
use crate::order::{at, orient2d, smallest_first};
use crate::sort::sort_by;
use crate::Point;

/// A canonical mesh, in the buffers of the caller.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'b> {
    points: &'b [Point],
    triangles: &'b [[u16; 3]],
    /// Hull edges, sorted by their first point: the two points, and the point of the hull with the number of the edge.
    hull_edges: &'b [[u16; 3]],
    /// The hull of points on one line.
    line: &'b [u16],
    duplicates: &'b [u16],
}

impl<'b> Mesh<'b> {
    /// The mesh of points that all lie on one line, which has no triangle.
    pub(crate) const fn on_a_line(points: &'b [Point], line: &'b [u16], duplicates: &'b [u16]) -> Self {
        Self { points, triangles: &[], hull_edges: &[], line, duplicates }
    }

    /// Triples of indices into the points, counter-clockwise, the smallest index first, in sorted order.
    pub const fn triangles(&self) -> &'b [[u16; 3]] {
        self.triangles
    }

    /// Indices of the points on the boundary of the convex hull, counter-clockwise from the lowest index. Where all
    /// points lie on one line, the distinct points in lexicographic order.
    pub fn hull(&self) -> impl Iterator<Item = u16> + 'b {
        self.line.iter().copied().chain(self.hull_edges.iter().map(|edge| edge[2]))
    }

    /// Each point with the coordinates of an earlier one, and the lowest index of these coordinates, by index. O(n) for
    /// each.
    pub fn duplicates(&self) -> impl Iterator<Item = (u16, u16)> + 'b {
        let points = self.points;
        let lowest = move |index: u16| (0..index).find(|&other| at(points, other) == at(points, index));
        self.duplicates.iter().map(move |&index| (index, lowest(index).unwrap_or(index)))
    }
}

/// Collects the records of a mesh: triangles from the front of the caller's buffer, ghost triangles from its end.
pub(crate) struct Assembly<'b> {
    load: Load<'b>,
    infinite: u32,
    /// As many places as the mesh has records.
    records: &'b mut [[u16; 3]],
    triangles: usize,
    ghosts: usize,
    /// Twice the area of the triangles so far, in grid squares.
    area: i64,
}

impl<'b> Assembly<'b> {
    pub fn new(load: Load<'b>, capacity: u32, records: &'b mut [[u16; 3]]) -> Self {
        Self { load, infinite: infinite_vertex(capacity), records, triangles: 0, ghosts: 0, area: 0 }
    }

    /// Takes the vertices of the next record.
    pub fn take(&mut self, vertices: [u32; 3]) -> Result<(), Fault> {
        let record = self.triangles + self.ghosts;
        let wrong = Fault::Vertices { record, vertices };
        let [a, b, c] = vertices;
        let index = |vertex| self.load.index(vertex).ok_or(wrong);
        let ghost = match self.infinite {
            infinite if a == infinite => Some([b, c]),
            infinite if b == infinite => Some([c, a]),
            infinite if c == infinite => Some([a, b]),
            _ => None,
        };
        if a == b || b == c || c == a {
            return Err(wrong);
        }
        if let Some([a, b]) = ghost {
            // The ghost triangle lies behind its edge, which the hull passes from `b` to `a`.
            let edge = [index(b)?, index(a)?, 0];
            self.ghosts += 1;
            return self.put(self.records.len().saturating_sub(self.ghosts), edge, wrong);
        }
        let triangle = [index(a)?, index(b)?, index(c)?];
        let [a, b, c] = triangle.map(|index| at(self.load.points, index));
        let area = orient2d(a, b, c);
        if area <= 0 {
            return Err(Fault::Orientation { record });
        }
        self.area += area;
        self.triangles += 1;
        self.put(self.triangles - 1, smallest_first(triangle), wrong)
    }

    fn put(&mut self, place: usize, entry: [u16; 3], wrong: Fault) -> Result<(), Fault> {
        *self.records.get_mut(place).ok_or(wrong)? = entry;
        Ok(())
    }

    /// Checks the mesh as a whole, and puts its triangles and its hull in canonical form.
    pub fn finish(self, duplicates: &'b [u16]) -> Result<Mesh<'b>, Fault> {
        let points = self.load.points;
        let (triangles, hull_edges) = self.records.split_at_mut(self.triangles.min(self.records.len()));
        close_hull(hull_edges)?;
        let hull = hull_area(hull_edges, points);
        if self.area != hull {
            return Err(Fault::Area { triangles: self.area, hull });
        }
        sort_by(triangles, |a, b| a < b);
        match triangles.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(Fault::TriangleTwice(pair[0])),
            None => Ok(Mesh { points, triangles, hull_edges, line: &[], duplicates }),
        }
    }
}

/// Chains the hull edges into one cycle that starts at its lowest index, and writes the cycle into the third places.
fn close_hull(edges: &mut [[u16; 3]]) -> Result<(), Fault> {
    sort_by(edges, |a, b| a < b);
    let ghosts = edges.len();
    let start = edges.first().map_or(0, |edge| edge[0]);
    let mut point = start;
    for place in 0..ghosts {
        let open = Fault::OpenHull { ghosts, point };
        // A point that is passed twice closes the cycle before all edges are used.
        if place > 0 && point == start {
            return Err(open);
        }
        edges.get_mut(place).ok_or(open)?[2] = point;
        let leaving = edges.binary_search_by_key(&point, |edge| edge[0]).map_err(|_| open)?;
        point = edges.get(leaving).ok_or(open)?[1];
    }
    if point == start && ghosts >= 3 {
        Ok(())
    } else {
        Err(Fault::OpenHull { ghosts, point })
    }
}

/// Twice the signed area of the hull polygon, in grid squares.
fn hull_area(edges: &[[u16; 3]], points: &[Point]) -> i64 {
    let corner = |edge: &[u16; 3]| at(points, edge[2]);
    let Some((first, rest)) = edges.split_first() else { return 0 };
    rest.windows(2).map(|pair| orient2d(corner(first), corner(&pair[0]), corner(&pair[1]))).sum()
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use incircle_protocol::Layout;
    use std::vec::Vec;

    const SQUARE: [Point; 4] = [[0, 0], [4, 0], [4, 4], [0, 4]];
    const INFINITE: u32 = infinite_vertex(8);
    const GHOSTS: [[u32; 3]; 4] = [[1, 0, INFINITE], [INFINITE, 2, 1], [2, INFINITE, 3], [0, 3, INFINITE]];

    /// The triangles and the hull of a mesh of the square.
    fn mesh(records: &[[u32; 3]]) -> Result<(Vec<[u16; 3]>, Vec<u16>), Fault> {
        let layout = Layout { point_words: 1, record_words: 3 };
        let load = Load { points: &SQUARE, order: &[0, 1, 2, 3], contexts: 1, layout };
        let mut buffer = [[0; 3]; 6];
        let mut assembly = Assembly::new(load, 8, &mut buffer);
        records.iter().try_for_each(|&record| assembly.take(record))?;
        let mesh = assembly.finish(&[])?;
        Ok((mesh.triangles().to_vec(), mesh.hull().collect()))
    }

    fn closed_by(triangles: [[u32; 3]; 2]) -> Result<(Vec<[u16; 3]>, Vec<u16>), Fault> {
        mesh(&[&triangles[..], &GHOSTS].concat())
    }

    #[test]
    fn records_become_the_canonical_mesh() {
        let (triangles, hull) = closed_by([[2, 3, 0], [0, 1, 2]]).unwrap();
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(hull, [0, 1, 2, 3]);
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        assert_eq!(closed_by([[0, 1, 2], [1, 2, 0]]), Err(Fault::TriangleTwice([0, 1, 2])));
        assert_eq!(closed_by([[0, 1, 2], [0, 3, 2]]), Err(Fault::Orientation { record: 1 }));
        assert_eq!(closed_by([[0, 1, 2], [0, 2, 2]]), Err(Fault::Vertices { record: 1, vertices: [0, 2, 2] }));
        assert_eq!(closed_by([[0, 1, 2], [0, 2, 4]]), Err(Fault::Vertices { record: 1, vertices: [0, 2, 4] }));
        let twice = [INFINITE, INFINITE, 2];
        assert_eq!(closed_by([twice, [0, 2, 3]]), Err(Fault::Vertices { record: 0, vertices: twice }));
        let half = [[0, 1, 2], GHOSTS[0], GHOSTS[1], GHOSTS[2], GHOSTS[3], GHOSTS[3]];
        assert!(matches!(mesh(&half), Err(Fault::OpenHull { ghosts: 5, .. })));
        let seven = [&[[0, 1, 2], [0, 2, 3]], &GHOSTS[..], &[[0, 1, 3]]].concat();
        assert!(mesh(&seven).is_err());
        let open: [&[[u16; 3]]; 5] = [
            &[],
            &[[1, 2, 0], [2, 1, 0]],
            &[[1, 2, 0], [2, 3, 0], [3, 4, 0]],
            &[[1, 2, 0], [2, 3, 0], [3, 1, 0], [4, 5, 0], [5, 6, 0], [6, 4, 0]],
            &[[1, 2, 0], [2, 3, 0], [3, 2, 0]],
        ];
        for edges in open {
            assert!(close_hull(&mut edges.to_vec()).is_err(), "{edges:?}");
        }
    }
}
