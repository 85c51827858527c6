//! Helpers for all tests: devices made for tests, a small random generator, and a brute-force oracle.

pub mod batches;
pub mod board;
pub mod card;
pub mod heap;
pub mod liar;
pub mod living;
pub mod mock;
pub mod network;
pub mod rig;

use incircle::{Device, Point, Solution};
use incircle_testkit::SplitMix64;

/// The random numbers of the test kit, brought below a bound by their remainder. The seeds of many tests
/// stand for these very numbers.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        let mut random = SplitMix64::new(self.0);
        let word = random.next_u64();
        self.0 = random.state();
        word
    }

    pub fn below(&mut self, limit: u32) -> u32 {
        (self.next() % u64::from(limit)) as u32
    }

    pub fn points(&mut self, count: usize, side: u32) -> Vec<Point> {
        (0..count).map(|_| Point::new(self.below(side), self.below(side))).collect()
    }
}

/// The mesh by the software model, as narrow as the points allow.
pub fn by_model(points: &[Point]) -> Solution {
    let used = points.iter().fold(0, |all, point| all | point.x | point.y);
    let address = if used >> 16 == 0 { "model" } else { "model?coord-bits=31" };
    by(address, points)
}

/// The mesh by the CPU triangulator.
pub fn by_cpu(points: &[Point]) -> Solution {
    let mut device = Device::cpu(None);
    let mesh = device.session().and_then(|mut session| session.triangulate(points)).expect("a mesh");
    assert_right(&mesh);
    mesh
}

/// The mesh by the device at this address.
pub fn by(address: &str, points: &[Point]) -> Solution {
    let mut device = Device::open(address).expect("a device in this process");
    let mesh = device.session().and_then(|mut session| session.triangulate(points)).expect("a mesh");
    assert_right(&mesh);
    mesh
}

/// The canonical triangles by definition.
pub fn brute_force(points: &[Point]) -> Vec<[u32; 3]> {
    let pairs: Vec<[u32; 2]> = points.iter().map(|point| [point.x, point.y]).collect();
    incircle_testkit::delaunay(&pairs)
}

/// Checks that the mesh passes the validator, and that the counts in its report agree with its lists.
pub fn assert_right(solution: &Solution) {
    solution.mesh.verify().unwrap_or_else(|error| panic!("{error}"));
    let report = &solution.report;
    assert_eq!(report.points, solution.mesh.points.len());
    assert_eq!(report.triangles, solution.mesh.triangles.len());
    assert_eq!(report.hull, solution.mesh.hull.len());
    assert_eq!(report.duplicates, solution.mesh.duplicates.len());
    assert_eq!(report.distinct + report.duplicates, report.points);
    assert_eq!(report.collinear, solution.mesh.is_collinear());
}
