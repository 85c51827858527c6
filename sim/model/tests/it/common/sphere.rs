//! The check of a mesh by its definition, on the records of the model.

use incircle_model::predicate::Point;
use incircle_model::{Mesh, Record};
use incircle_protocol::infinite_vertex;
use std::collections::{BTreeSet, HashMap};

/// The sign of the lifted determinant of four points, whose rows are differences to `d`.
fn lifted(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let row = |q: Point| {
        let (x, y) = (i128::from(q.x) - i128::from(d.x), i128::from(q.y) - i128::from(d.y));
        [x, y, x * x + y * y]
    };
    let (a, b, c) = (row(a), row(b), row(c));
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The finite triangles as triples of points. Panics unless the records that are not free are a valid canonical mesh.
pub fn triangles(mesh: &Mesh, points: &[Point], capacity: u32) -> BTreeSet<[Point; 3]> {
    let inf = infinite_vertex(capacity);
    let live = || (0u32..).zip(mesh.records()).filter(|(_, record)| !mesh.is_free(record));
    let mut finite = BTreeSet::new();
    let mut across: HashMap<(u32, u32), (u32, usize)> = HashMap::new();
    for (id, record) in live() {
        for k in 0..3 {
            let edge = (record.v[(k + 1) % 3], record.v[(k + 2) % 3]);
            assert!(across.insert(edge, (id, k)).is_none(), "edge {edge:?} twice");
        }
    }
    for (id, record) in live() {
        check_edges(mesh, id, record, points, &across, inf);
        if !record.v.contains(&inf) {
            let mut corners = record.v.map(|v| points[v as usize]);
            let lowest = (0..3).min_by_key(|&k| corners[k]).unwrap();
            corners.rotate_left(lowest);
            assert!(finite.insert(corners));
        }
    }
    finite
}

/// Checks the links of a record, and that its edges are those of the canonical mesh.
fn check_edges(
    mesh: &Mesh,
    id: u32,
    record: &Record,
    points: &[Point],
    across: &HashMap<(u32, u32), (u32, usize)>,
    inf: u32,
) {
    for k in 0..3 {
        let (a, b) = (record.v[(k + 1) % 3], record.v[(k + 2) % 3]);
        let (other, slot) = across[&(b, a)];
        assert_eq!(record.n[k], other, "link {k} of record {id}");
        let apex = mesh.records()[other as usize].v[slot];
        if record.v.contains(&inf) || apex == inf {
            continue;
        }
        let at = |v: u32| points[v as usize];
        let (p, q, r, s) = (at(record.v[k]), at(a), at(b), at(apex));
        let side = lifted(p, q, r, s);
        assert!(side <= 0, "edge {q:?} {r:?} is not Delaunay");
        assert!(side < 0 || p.min(s) > q.min(r), "edge {q:?} {r:?} breaks the tie rule");
    }
}
