//! What several tests share: a small random generator, and a brute-force oracle.

pub mod batches;
pub mod board;
pub mod card;
pub mod heap;
pub mod liar;
pub mod mock;
pub mod rig;

use incircle::{Device, Mesh, Point};

/// A small random generator: SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    pub fn below(&mut self, limit: u32) -> u32 {
        (self.next() % u64::from(limit)) as u32
    }

    pub fn points(&mut self, count: usize, side: u32) -> Vec<Point> {
        (0..count).map(|_| Point::new(self.below(side), self.below(side))).collect()
    }
}

/// The mesh by the software model, as narrow as the points allow.
pub fn by_model(points: &[Point]) -> Mesh {
    let used = points.iter().fold(0, |all, point| all | point.x | point.y);
    let address = if used >> 16 == 0 { "model" } else { "model?coord-bits=31" };
    by(address, points)
}

/// The mesh by the device at this address.
pub fn by(address: &str, points: &[Point]) -> Mesh {
    let mut device = Device::open(address).expect("a device in this process");
    let mesh = device.session().and_then(|mut session| session.triangulate(points)).expect("a mesh");
    assert_right(&mesh);
    mesh
}

fn area(a: Point, b: Point, c: Point) -> i64 {
    let d = |u: u32, v: u32| i64::from(u) - i64::from(v);
    d(b.x, a.x) * d(c.y, a.y) - d(b.y, a.y) * d(c.x, a.x)
}

/// Whether `d` lies inside the circle of the counter-clockwise `a b c`, a point on it decided by lowering the
/// lexicographically smallest of the four on the lifted paraboloid. For small coordinates.
fn conflicts(a: Point, b: Point, c: Point, d: Point) -> bool {
    let lift = |p: Point| {
        let (x, y) = (i64::from(p.x) - i64::from(d.x), i64::from(p.y) - i64::from(d.y));
        x * x + y * y
    };
    let inside = lift(a) * area(d, b, c) + lift(b) * area(d, c, a) + lift(c) * area(d, a, b);
    if inside != 0 {
        return inside > 0;
    }
    // Lowering a corner changes the determinant by minus the factor of its lift; lowering `d` moves it inside.
    match [a, b, c, d].into_iter().min() {
        Some(smallest) if smallest == a => area(d, b, c) < 0,
        Some(smallest) if smallest == b => area(d, c, a) < 0,
        Some(smallest) if smallest == c => area(d, a, b) < 0,
        _ => true,
    }
}

/// The canonical triangles by definition: all triples that no point conflicts with. O(n^4).
pub fn brute_force(points: &[Point]) -> Vec<[u32; 3]> {
    let first = |k: usize| points.iter().position(|p| *p == points[k]) == Some(k);
    let distinct: Vec<usize> = (0..points.len()).filter(|&k| first(k)).collect();
    let mut triangles = Vec::new();
    for (place, &i) in distinct.iter().enumerate() {
        for &j in &distinct[place + 1..] {
            for &k in &distinct[place + 1..] {
                let (a, b, c) = (points[i], points[j], points[k]);
                let empty = |&m: &usize| m == i || m == j || m == k || !conflicts(a, b, c, points[m]);
                if area(a, b, c) > 0 && distinct.iter().all(empty) {
                    triangles.push([i as u32, j as u32, k as u32]);
                }
            }
        }
    }
    triangles.sort_unstable();
    triangles
}

/// The mesh passes the validator, and its counts agree with its lists.
pub fn assert_right(mesh: &Mesh) {
    mesh.verify().unwrap_or_else(|error| panic!("{error}"));
    let report = &mesh.report;
    assert_eq!(report.points, mesh.points.len());
    assert_eq!(report.triangles, mesh.triangles.len());
    assert_eq!(report.hull, mesh.hull.len());
    assert_eq!(report.duplicates, mesh.duplicates.len());
    assert_eq!(report.distinct + report.duplicates, report.points);
    assert_eq!(report.collinear, mesh.is_collinear());
}
