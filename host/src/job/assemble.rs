//! From the records of a device to the canonical mesh. Nothing in a record is used before it is checked.
//!
//! The checks cost O(n): ids are in range, locks and unused bits are clear, triangles are counter-clockwise and none
//! comes twice, ghost triangles close one hull, and areas sum to the area of the hull. Ids of neighbours, where they
//! are read, are only checked to be in range, and not used. The Delaunay property and the tie rule are not checked
//! here: [`Mesh::verify`](crate::Mesh::verify) proves them.

use std::ops::Range;

use incircle_protocol::{infinite_vertex, Layout, NARROW_ID_BITS};

use crate::error::DeviceFault;
use incircle_geometry::{orient2d, Point};

/// Collects the records of one mesh, one after another.
pub(crate) struct Assembly<'a> {
    /// Input index of each vertex.
    order: &'a [u32],
    points: &'a [Point],
    infinite: u32,
    triangles: Vec<[u32; 3]>,
    /// Hull edges, counter-clockwise, as input indices.
    hull_edges: Vec<[u32; 2]>,
    /// Twice the area of the triangles so far, in grid squares.
    area: i128,
}

/// Lock bit of a narrow record, among the bits above the ids of its first word.
const LOCK: u32 = 0b10;

impl<'a> Assembly<'a> {
    /// An empty assembly for the mesh of the points that `order` names, on a device of this capacity.
    pub(crate) fn new(order: &'a [u32], points: &'a [Point], capacity: u32) -> Self {
        let records = 2 * order.len() - 2;
        Self {
            order,
            points,
            infinite: infinite_vertex(capacity),
            triangles: Vec::with_capacity(records),
            hull_edges: Vec::new(),
            area: 0,
        }
    }

    /// Takes the vertices of a record, numbered within this mesh.
    pub(crate) fn take_vertices(&mut self, record: usize, [a, b, c]: [u32; 3]) -> Result<(), DeviceFault> {
        if (a == b) | (b == c) | (c == a) {
            return Err(DeviceFault::RepeatedVertex { record });
        }
        if a == self.infinite {
            self.take_ghost(record, b, c)
        } else if b == self.infinite {
            self.take_ghost(record, c, a)
        } else if c == self.infinite {
            self.take_ghost(record, a, b)
        } else {
            self.take_triangle(record, a, b, c)
        }
    }

    /// Takes the ghost triangle of the hull edge from `b` to `a`.
    fn take_ghost(&mut self, record: usize, a: u32, b: u32) -> Result<(), DeviceFault> {
        let edge = [self.input_index(record, b)?, self.input_index(record, a)?];
        self.hull_edges.push(edge);
        Ok(())
    }

    fn take_triangle(&mut self, record: usize, a: u32, b: u32, c: u32) -> Result<(), DeviceFault> {
        let a = self.input_index(record, a)?;
        let b = self.input_index(record, b)?;
        let c = self.input_index(record, c)?;
        let at = |index: u32| self.points[index as usize];
        let area = orient2d(at(a), at(b), at(c));
        if area <= 0 {
            return Err(DeviceFault::Orientation { record, corners: [at(a), at(b), at(c)] });
        }
        self.area += i128::from(area);
        self.triangles.push(smallest_first(a, b, c));
        Ok(())
    }

    fn input_index(&self, record: usize, vertex: u32) -> Result<u32, DeviceFault> {
        let known = self.order.get(vertex as usize).copied();
        known.ok_or(DeviceFault::VertexOutOfRange { record, vertex, points: self.order.len() })
    }

    /// Checks the mesh as a whole, and gives its triangles and its hull in canonical form.
    pub(crate) fn finish(self) -> Result<(Vec<[u32; 3]>, Vec<u32>), DeviceFault> {
        let hull = close_hull(self.hull_edges)?;
        let area = hull_area(&hull, self.points);
        if self.area != area {
            return Err(DeviceFault::Area { triangles: self.area, hull: area });
        }
        let triangles = sort_triangles(self.triangles, self.points.len());
        match triangles.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(DeviceFault::TriangleTwice { triangle: pair[0] }),
            None => Ok((triangles, hull)),
        }
    }
}

/// The vertices of an unpacked record, after a check of its neighbours' ids against `records` and of its unused bits.
pub(crate) fn checked_record(
    layout: Layout,
    record: usize,
    words: &[u32],
    records: usize,
) -> Result<[u32; 3], DeviceFault> {
    if layout.record_words == 3 {
        check_spare_bits(record, words)?;
    }
    let (v, [x, y, z]) = layout.record_from_words(words);
    let neighbor = x.max(y).max(z);
    if neighbor as usize >= records {
        return Err(DeviceFault::NeighborOutOfRange { record, neighbor, records });
    }
    Ok(v)
}

/// Checks that the half word behind the last of these packed records, if there is one, is 0.
pub(crate) fn check_last_half(layout: Layout, records: &Range<usize>, words: &[u32]) -> Result<(), DeviceFault> {
    let ends_in_half = layout.record_words == 3 && records.len() % 2 == 1;
    match words.last() {
        Some(&word) if ends_in_half && word >> 16 != 0 => Err(DeviceFault::SpareHalf { record: records.end - 1, word }),
        _ => Ok(()),
    }
}

/// Checks that a narrow record is not locked, and that its bits above the ids are 0, as on every device at rest.
fn check_spare_bits(record: usize, words: &[u32]) -> Result<(), DeviceFault> {
    for (place, &word) in (0..).zip(words) {
        match word >> (2 * NARROW_ID_BITS) {
            0 => {}
            LOCK if place == 0 => return Err(DeviceFault::Locked { record }),
            _ => return Err(DeviceFault::SpareBits { record, place, word }),
        }
    }
    Ok(())
}

/// The triangle, rotated to begin with its smallest index. Selections replace branches here, since no processor can
/// predict which corner is the smallest.
fn smallest_first(a: u32, b: u32, c: u32) -> [u32; 3] {
    let b_is_first = (b < a) & (b < c);
    let c_is_first = (c < a) & (c < b);
    let select = |if_a: u32, if_b: u32, if_c: u32| {
        let not_c = if b_is_first { if_b } else { if_a };
        if c_is_first {
            if_c
        } else {
            not_c
        }
    };
    [select(a, b, c), select(b, c, a), select(c, a, b)]
}

/// Chains the hull edges into one cycle that starts at its lowest index.
fn close_hull(mut edges: Vec<[u32; 2]>) -> Result<Vec<u32>, DeviceFault> {
    edges.sort_unstable();
    let open = |point| DeviceFault::OpenHull { ghosts: edges.len(), point };
    if let Some(pair) = edges.windows(2).find(|pair| pair[0][0] == pair[1][0]) {
        return Err(open(pair[0][0]));
    }
    let start = edges.first().map_or(0, |edge| edge[0]);
    let mut hull = Vec::with_capacity(edges.len());
    let mut point = start;
    for _ in 0..edges.len() {
        hull.push(point);
        let leaving = edges.binary_search_by_key(&point, |edge| edge[0]);
        let Some(edge) = leaving.ok().and_then(|place| edges.get(place)) else {
            return Err(open(point));
        };
        point = edge[1];
        if point == start {
            break;
        }
    }
    if point == start && hull.len() == edges.len() && hull.len() >= 3 {
        Ok(hull)
    } else {
        Err(open(point))
    }
}

/// Twice the signed area of the hull polygon, in grid squares.
fn hull_area(hull: &[u32], points: &[Point]) -> i128 {
    let at = |index: &u32| points[*index as usize];
    let Some((first, rest)) = hull.split_first() else {
        return 0;
    };
    let fan = rest.windows(2);
    fan.map(|pair| i128::from(orient2d(at(first), at(&pair[0]), at(&pair[1])))).sum()
}

/// Sorts triangles: a counting sort by the first corner, then the few triangles of each corner by themselves. O(n) for
/// meshes, O(n log n) for any list.
fn sort_triangles(triangles: Vec<[u32; 3]>, points: usize) -> Vec<[u32; 3]> {
    let mut starts = vec![0u32; points];
    for triangle in &triangles {
        starts[triangle[0] as usize] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    let mut sorted = vec![[0; 3]; triangles.len()];
    for triangle in &triangles {
        let slot = &mut starts[triangle[0] as usize];
        sorted[*slot as usize] = *triangle;
        *slot += 1;
    }
    for corner in sorted.chunk_by_mut(|one, other| one[0] == other[0]) {
        corner.sort_unstable();
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_turn_of_a_triangle_is_the_same_triangle() {
        for turn in [[1, 5, 3], [5, 3, 1], [3, 1, 5]] {
            assert_eq!(smallest_first(turn[0], turn[1], turn[2]), [1, 5, 3]);
        }
    }

    #[test]
    fn packed_triangles_end_with_an_empty_half() {
        let layout = Layout::of(16, 8);
        let word = 0x0007_0002;
        assert_eq!(check_last_half(layout, &(0..1), &[0x0001_0000, 2]), Ok(()));
        let spare = Err(DeviceFault::SpareHalf { record: 4, word });
        assert_eq!(check_last_half(layout, &(4..5), &[0x0001_0000, word]), spare);
        assert_eq!(check_last_half(layout, &(0..2), &[0x0001_0000, word, word]), Ok(()));
        assert_eq!(check_last_half(Layout::of(20, 8), &(0..2), &[0, 1, word, 0, 1, word]), Ok(()));
        let points = [(0, 0), (4, 0), (0, 4)].map(Point::from);
        let outside = Assembly::new(&[0, 1, 2], &points, 8).take_vertices(1, [7, 3, 0]);
        assert_eq!(outside, Err(DeviceFault::VertexOutOfRange { record: 1, vertex: 7, points: 3 }));
    }

    /// One half of a square, twice: the areas sum to the hull's, and yet it is no mesh.
    #[test]
    fn a_triangle_that_comes_twice_is_refused() {
        let points = [(0, 0), (4, 0), (4, 4), (0, 4)].map(Point::from);
        let mesh = |triangles: [[u32; 3]; 2]| {
            let mut assembly = Assembly::new(&[0, 1, 2, 3], &points, 8);
            let infinite = infinite_vertex(8);
            let ghosts = [[1, 0, infinite], [2, 1, infinite], [3, 2, infinite], [0, 3, infinite]];
            for (record, vertices) in triangles.into_iter().chain(ghosts).enumerate() {
                assembly.take_vertices(record, vertices)?;
            }
            assembly.finish()
        };
        assert_eq!(mesh([[0, 1, 2], [2, 3, 0]]), Ok((vec![[0, 1, 2], [0, 2, 3]], vec![0, 1, 2, 3])));
        let twice = mesh([[0, 1, 2], [1, 2, 0]]);
        assert_eq!(twice, Err(DeviceFault::TriangleTwice { triangle: [0, 1, 2] }));
    }

    #[test]
    fn hull_edges_close_one_cycle_or_none() {
        assert_eq!(close_hull(vec![[7, 2], [4, 7], [2, 4]]), Ok(vec![2, 4, 7]));
        let open = |edges: Vec<[u32; 2]>| close_hull(edges).is_err();
        assert!(open(vec![]));
        assert!(open(vec![[1, 2], [2, 1]]));
        assert!(open(vec![[1, 2], [2, 3], [3, 4]]));
        assert!(open(vec![[1, 2], [2, 3], [3, 1], [4, 5], [5, 6], [6, 4]]));
        assert!(open(vec![[1, 2], [2, 3], [3, 2]]));
        assert!(open(vec![[1, 2], [1, 3], [3, 1]]));
    }

    #[test]
    fn triangles_sort_like_the_standard_library() {
        let mut triangles: Vec<[u32; 3]> = (0..500u32).map(|k| [k * 37 % 11, k * 101 % 97, k * 53 % 89]).collect();
        let sorted = sort_triangles(triangles.clone(), 11);
        triangles.sort_unstable();
        assert_eq!(sorted, triangles);
    }
}
