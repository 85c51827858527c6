//! From a device's records to the canonical mesh. Nothing a record says is used before it is checked.

use incircle_protocol::{infinite_vertex, Layout};

use crate::fault::DeviceFault;
use crate::point::Point;
use crate::prepare::doubled_area;

/// Takes records one after the other.
pub(crate) struct Assembly<'a> {
    /// Input index of each vertex.
    order: &'a [u32],
    points: &'a [Point],
    layout: Layout,
    infinite: u32,
    records: usize,
    triangles: Vec<[u32; 3]>,
    /// Hull edges, counter-clockwise, as input indices.
    hull_edges: Vec<[u32; 2]>,
    /// Twice the area of the triangles so far.
    area: i128,
}

/// Lock bit in the first word of a narrow record.
const LOCK: u32 = 1 << 31;

impl<'a> Assembly<'a> {
    /// For the mesh of the points `order` names, on a device of this layout and capacity.
    pub(crate) fn new(
        order: &'a [u32],
        points: &'a [Point],
        layout: Layout,
        capacity: u32,
    ) -> Self {
        let records = 2 * order.len() - 2;
        Self {
            order,
            points,
            layout,
            infinite: infinite_vertex(capacity),
            records,
            triangles: Vec::with_capacity(records),
            hull_edges: Vec::new(),
            area: 0,
        }
    }

    /// How many records the device holds, ghosts included.
    pub(crate) fn records(&self) -> usize {
        self.records
    }

    /// Takes the words of whole records, the first of which has the number `first`.
    pub(crate) fn take(&mut self, first: usize, words: &[u32]) -> Result<(), DeviceFault> {
        for (record, words) in (first..).zip(words.chunks_exact(self.layout.record_words)) {
            if self.layout.record_words == 3 && words[0] & LOCK != 0 {
                return Err(DeviceFault::Locked { record });
            }
            let (v, n) = self.layout.record_from_words(words);
            self.take_record(record, v, n)?;
        }
        Ok(())
    }

    fn take_record(&mut self, record: usize, v: [u32; 3], n: [u32; 3]) -> Result<(), DeviceFault> {
        if let Some(&neighbor) = n.iter().find(|&&n| n as usize >= self.records) {
            return Err(DeviceFault::NeighborOutOfRange {
                record,
                neighbor,
                records: self.records,
            });
        }
        if v[0] == v[1] || v[1] == v[2] || v[2] == v[0] {
            return Err(DeviceFault::RepeatedVertex { record });
        }
        match v.iter().position(|&vertex| vertex == self.infinite) {
            None => {
                let triangle = [
                    self.input_index(record, v[0])?,
                    self.input_index(record, v[1])?,
                    self.input_index(record, v[2])?,
                ];
                self.take_triangle(record, triangle)
            }
            Some(k) => {
                let a = self.input_index(record, v[(k + 1) % 3])?;
                let b = self.input_index(record, v[(k + 2) % 3])?;
                self.hull_edges.push([b, a]);
                Ok(())
            }
        }
    }

    fn input_index(&self, record: usize, vertex: u32) -> Result<u32, DeviceFault> {
        let known = self.order.get(vertex as usize).copied();
        known.ok_or(DeviceFault::VertexOutOfRange {
            record,
            vertex,
            points: self.order.len(),
        })
    }

    fn take_triangle(&mut self, record: usize, triangle: [u32; 3]) -> Result<(), DeviceFault> {
        let corners = triangle.map(|index| self.points[index as usize]);
        let area = doubled_area(corners[0], corners[1], corners[2]);
        if area <= 0 {
            return Err(DeviceFault::Orientation { record, corners });
        }
        self.area += i128::from(area);
        self.triangles.push(smallest_first(triangle));
        Ok(())
    }

    /// Sorts and checks the whole: the canonical triangles and the hull.
    pub(crate) fn finish(self) -> Result<(Vec<[u32; 3]>, Vec<u32>), DeviceFault> {
        let hull = close_hull(self.hull_edges)?;
        let area = hull_area(&hull, self.points);
        if self.area != area {
            return Err(DeviceFault::Area {
                triangles: self.area,
                hull: area,
            });
        }
        let triangles = sort_triangles(self.triangles, self.points.len());
        match triangles.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(DeviceFault::TriangleTwice { triangle: pair[0] }),
            None => Ok((triangles, hull)),
        }
    }
}

/// The same triangle with its smallest index first.
fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Chains the hull edges into one cycle that starts at its lowest index.
fn close_hull(mut edges: Vec<[u32; 2]>) -> Result<Vec<u32>, DeviceFault> {
    edges.sort_unstable();
    let open = |point| DeviceFault::OpenHull {
        ghosts: edges.len(),
        point,
    };
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

/// Twice the signed area of the hull polygon.
fn hull_area(hull: &[u32], points: &[Point]) -> i128 {
    let at = |index: &u32| points[*index as usize];
    let Some((first, rest)) = hull.split_first() else {
        return 0;
    };
    let fan = rest.windows(2);
    fan.map(|pair| i128::from(doubled_area(at(first), at(&pair[0]), at(&pair[1]))))
        .sum()
}

/// Sorts triangles by counting their first corners, then each corner's few triangles. O(n) for meshes, O(n log n) for any
/// list.
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
