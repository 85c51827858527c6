//! The Voronoi diagram of a set as flat lists, as callers in other languages take it.

use incircle_geometry::voronoi::{Cells, Clip, Corner, Side, Voronoi};
use incircle_geometry::EMPTY;

use crate::grid_set::{GridSet, GridSetError};

/// The Voronoi diagram of the distinct points of a set, as flat lists.
///
/// ```
/// use incircle::{GridSet, VoronoiLists};
///
/// let set = GridSet::of(&[[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]], &[[0, 0], [4, 4]], 0, None)?;
/// let lists = VoronoiLists::of(&set, Some(&set.clip()?))?;
/// let edges = lists.starts[4] as usize..lists.starts[5] as usize;
/// assert_eq!(lists.neighbors[edges.clone()], [0, 1, 2, 3]);
/// let corners: Vec<[f64; 2]> = lists.corners[edges].iter().map(|&vertex| lists.vertices[vertex as usize]).collect();
/// assert_eq!(corners, [[0.0, 2.0], [2.0, 0.0], [4.0, 2.0], [2.0, 4.0]]);
/// assert_eq!(lists.cells.map(|cells| cells.areas), Some(vec![2.0, 2.0, 2.0, 2.0, 8.0]));
/// # Ok::<(), incircle::GridSetError>(())
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct VoronoiLists {
    /// The Voronoi vertices, each coordinate the double nearest to the exact one.
    pub vertices: Vec<[f64; 2]>,
    /// The edges of the cell of point `i` are those from `starts[i]` to `starts[i + 1]`; a duplicate has none.
    pub starts: Vec<u64>,
    /// The point on the other side of each edge, counter-clockwise around each cell.
    pub neighbors: Vec<u32>,
    /// The Voronoi vertex at which each edge begins; [`EMPTY`] if the edge comes from infinity.
    pub corners: Vec<u32>,
    /// The points at the place of an earlier one: the index of each, and the lowest index at its place.
    pub duplicates: Vec<[u32; 2]>,
    /// The cells inside the clip, if there is one.
    pub cells: Option<CellLists>,
}

/// The cells of a set inside a clip, as flat lists of rings. A cell has no piece, one, or several if the clip is not
/// convex. Each piece is one ring around it, and a ring for each hole of the clip that lies inside it.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct CellLists {
    /// The corners of all rings, one ring behind the other: counter-clockwise around a piece, clockwise around a hole.
    pub corners: Vec<[f64; 2]>,
    /// The corners of ring `k` are those from `starts[k]` to `starts[k + 1]`.
    pub starts: Vec<u64>,
    /// The point to which each ring belongs, in rising order.
    pub points: Vec<u32>,
    /// Whether each ring bounds a hole of the last piece before it.
    pub is_hole: Vec<bool>,
    /// The area of the cell of each point; 0 for a duplicate.
    pub areas: Vec<f64>,
    /// The points whose cells share an edge inside the clip, one cell behind the other, each in rising order.
    pub neighbors: Vec<u32>,
    /// The neighbours of point `i` are those from `neighbor_starts[i]` to `neighbor_starts[i + 1]`.
    pub neighbor_starts: Vec<u64>,
}

impl VoronoiLists {
    /// Makes the diagram of the points of a set, and the cells inside a clip if there is one. O(n log n), and about 300
    /// bytes a point.
    ///
    /// # Errors
    /// There are more points than indices allow, or so many that a list of the diagram would be too long.
    pub fn of(set: &GridSet, clip: Option<&Clip>) -> Result<Self, GridSetError> {
        let mesh = crate::triangulate(set.points())?;
        let diagram = Voronoi::of(&mesh)?;
        let mut lists = Self { starts: vec![0], ..Self::default() };
        let numbers = 0..diagram.vertex_count() as u32;
        lists.vertices = numbers.map(|vertex| set.coordinates(diagram.vertex(vertex))).collect();
        for point in 0..set.points().len() as u32 {
            for edge in diagram.cell(point).iter().flat_map(|cell| cell.edges()) {
                lists.neighbors.push(edge.neighbor);
                lists.corners.push(edge.from.unwrap_or(EMPTY));
            }
            lists.starts.push(lists.neighbors.len() as u64);
        }
        lists.duplicates = mesh.duplicates.iter().map(|one| [one.index, one.of]).collect();
        lists.cells = clip.map(|clip| CellLists::of(&diagram, clip, set));
        Ok(lists)
    }
}

impl CellLists {
    fn of(diagram: &Voronoi<'_>, clip: &Clip, set: &GridSet) -> Self {
        let mut lists = Self { starts: vec![0], neighbor_starts: vec![0], ..Self::default() };
        let (mut cells, length) = (Cells::new(diagram, clip), set.length());
        for point in 0..diagram.points().len() as u32 {
            let cell = cells.cell(point);
            let begin = lists.neighbors.len();
            for piece in cell.pieces() {
                lists.add_ring(piece.corners(), point, set);
                lists.is_hole.push(false);
                for hole in piece.holes() {
                    lists.add_ring(hole.corners(), point, set);
                    lists.is_hole.push(true);
                }
            }
            lists.neighbors[begin..].sort_unstable();
            drop_repeated(&mut lists.neighbors, begin);
            lists.neighbor_starts.push(lists.neighbors.len() as u64);
            lists.areas.push(cell.area() * length * length);
        }
        lists
    }

    fn add_ring(&mut self, corners: impl Iterator<Item = (Corner, Side)>, point: u32, set: &GridSet) {
        for (corner, side) in corners {
            self.corners.push(set.coordinates(corner));
            if let Side::Neighbor(neighbor) = side {
                self.neighbors.push(neighbor);
            }
        }
        self.starts.push(self.corners.len() as u64);
        self.points.push(point);
    }
}

/// Drops repeated items of a list behind a place; the items there are sorted.
fn drop_repeated(list: &mut Vec<u32>, begin: usize) {
    let mut end = begin;
    for place in begin..list.len() {
        if end == begin || list[end - 1] != list[place] {
            list[end] = list[place];
            end += 1;
        }
    }
    list.truncate(end);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_in_pieces_names_each_neighbour_once() {
        // A clip in the form of the letter U leaves two pieces of the upper cell.
        let ring = [[0, 0], [20, 0], [20, 10], [15, 10], [15, 2], [5, 2], [5, 10], [0, 10]];
        let set = GridSet::of(&[[10, 9], [10, 1], [10, 9]], &ring, 0, None).expect("a lattice");
        let lists = VoronoiLists::of(&set, Some(&set.clip().expect("a ring"))).expect("cells");
        let cells = lists.cells.expect("a clip");
        assert_eq!((cells.points, cells.areas), (vec![0, 0, 1], vec![50.0, 70.0, 0.0]));
        assert_eq!((cells.neighbors, cells.neighbor_starts), (vec![1, 0], vec![0, 1, 2, 2]));
        assert_eq!((lists.duplicates, lists.starts), (vec![[2, 0]], vec![0, 1, 2, 2]));
        assert_eq!(lists.corners, [EMPTY, EMPTY]);
    }

    #[test]
    fn holes_follow_the_piece_around_them() {
        // One hole inside the left cell, and one that the border between both cells meets.
        let rings = [
            [[0, 0], [20, 0], [20, 10], [0, 10]],
            [[2, 2], [4, 2], [4, 4], [2, 4]],
            [[8, 5], [12, 5], [12, 7], [8, 7]],
        ];
        let set = GridSet::of(&[[5, 5], [15, 5]], rings.as_flattened(), 0, None).expect("a lattice");
        let lists = VoronoiLists::of(&set, Some(&set.clip_with_holes(&[4, 4, 4]).expect("rings"))).expect("cells");
        let cells = lists.cells.expect("a clip");
        assert_eq!((cells.points, cells.is_hole), (vec![0, 0, 1], vec![false, true, false]));
        assert_eq!(cells.starts[2] - cells.starts[1], 4);
        let mut hole = cells.corners[cells.starts[1] as usize..cells.starts[2] as usize].to_vec();
        let lowest = hole.iter().position(|corner| *corner == [2.0, 2.0]).expect("a corner of the hole");
        hole.rotate_left(lowest);
        assert_eq!(hole, [[2.0, 2.0], [2.0, 4.0], [4.0, 4.0], [4.0, 2.0]]);
        assert_eq!((cells.areas, cells.neighbors), (vec![92.0, 96.0], vec![1, 0]));
        let message = |counts: &[usize]| set.clip_with_holes(counts).map_err(|error| error.to_string()).unwrap_err();
        assert!(message(&[4, 4]).contains("have 8 corners, but the clip has 12"));
        assert!(message(&[usize::MAX, 13]).contains("but the clip has 12"));
        assert!(message(&[10, 2]).contains("clip"));
        assert!(set.clip_with_holes(&[]).is_err_and(|error| error.to_string().contains("have 0 corners")));
    }

    #[test]
    fn sets_without_points_have_empty_lists() {
        let set = GridSet::of::<[f64; 2]>(&[], &[[0.0, 0.0], [1.0, 1.0]], 0, None).expect("a lattice");
        let lists = VoronoiLists::of(&set, Some(&set.clip().expect("a rectangle"))).expect("no cells");
        let cells = lists.cells.expect("a clip");
        assert_eq!((lists.starts, lists.vertices.len(), cells.starts, cells.areas.len()), (vec![0], 0, vec![0], 0));
    }
}
