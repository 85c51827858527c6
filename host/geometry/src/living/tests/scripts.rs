//! Random scripts on tiny sets that are full of ties, with a check after every command.
//!
//! The regular test runs 8,000 scripts. This command runs as many as the variable says:
//!
//! ```text
//! INCIRCLE_SCRIPTS=1000000 cargo test --release -p incircle-geometry living::tests::scripts -- --include-ignored
//! ```

use incircle_testkit::SplitMix64;

use super::brute::Brute;
use super::structure;
use crate::living::{ChangeError, Triangulation};
use crate::plane_point::PlanePoint;
use crate::point::Point;

/// The places of a script: small lattices, lines, circles.
pub fn places(random: &mut SplitMix64) -> Vec<Point> {
    let side = 2 + random.below_u32(5);
    let square = |side: u32| (0..side * side).map(move |cell| Point::new(cell / side, cell % side));
    match random.below(8) {
        0 => (0..8).map(|k| Point::new(2 * k, k)).collect(),
        1 => (0..8).map(|k| Point::new(3, k)).chain([Point::new(1, 4), Point::new(4, 4)]).collect(),
        2 => {
            let far = [(0, 5), (3, 4), (4, 3), (5, 0)];
            let all = far.iter().flat_map(|&(x, y)| [(x, y), (-x, y), (x, -y), (-x, -y), (0, 0)]);
            all.map(|(x, y)| Point::new((5 + x) as u32, (5 + y) as u32)).collect()
        }
        _ => square(side).collect(),
    }
}

/// One run of commands on a triangulation beside brute force. `point` turns a place into a point.
pub struct Script<P: PlanePoint> {
    pub mesh: Triangulation<P>,
    pub brute: Brute,
    pub places: Vec<Point>,
    pub point: fn(Point) -> P,
    pub log: Vec<String>,
}

impl<P: PlanePoint + core::fmt::Debug + PartialEq> Script<P> {
    pub fn new(places: Vec<Point>, point: fn(Point) -> P) -> Self {
        Self { mesh: Triangulation::new(), brute: Brute::new(), places, point, log: Vec::new() }
    }

    /// Begins anew with a list of points.
    fn load(&mut self, random: &mut SplitMix64) {
        let points: Vec<Point> = (0..random.below(20)).map(|_| random.pick(&self.places)).collect();
        self.log = vec![format!("from {points:?}")];
        self.mesh = Triangulation::from(points.iter().map(|&place| (self.point)(place))).expect("finite points");
        self.brute.points = points.into_iter().map(Some).collect();
        self.brute.renew();
        self.check(random);
    }

    pub fn run(&mut self, random: &mut SplitMix64, commands: usize) {
        let growth = 2 + random.below(6);
        if random.once_in(2) {
            self.load(random);
        }
        for _ in 0..commands {
            self.step(random, growth);
            self.brute.renew();
            self.check(random);
        }
    }

    fn step(&mut self, random: &mut SplitMix64, growth: u64) {
        let place = random.pick(&self.places);
        let index = random.below(self.brute.points.len() as u64 + 1) as u32;
        match random.below(10) {
            action if action < growth => {
                self.log.push(format!("insert {place}"));
                let given = self.mesh.insert((self.point)(place)).expect("room");
                assert_eq!(given as usize, self.brute.points.len());
                self.brute.points.push(Some(place));
            }
            8 | 9 => {
                self.log.push(format!("move {index} {place}"));
                let found = self.mesh.move_to(index, (self.point)(place));
                self.compare_change(index, found, Some(place));
            }
            _ => {
                self.log.push(format!("delete {index}"));
                let found = self.mesh.delete(index);
                self.compare_change(index, found, None);
            }
        }
    }

    fn compare_change(&mut self, index: u32, found: Result<(), ChangeError>, place: Option<Point>) {
        let next = self.brute.points.len() as u32;
        match self.brute.points.get_mut(index as usize) {
            None => assert_eq!(found, Err(ChangeError::Unknown { index, next })),
            Some(None) => assert_eq!(found, Err(ChangeError::Deleted { index })),
            Some(point) => {
                assert_eq!(found, Ok(()));
                *point = place;
            }
        }
    }

    fn check(&self, random: &mut SplitMix64) {
        let (mesh, brute) = (&self.mesh, &self.brute);
        structure::check(mesh);
        let found = mesh.mesh();
        assert_eq!(mesh.indices(), brute.indices);
        let expected: Vec<P> = brute.mesh.points.iter().map(|&place| (self.point)(place)).collect();
        assert_eq!(found.points, expected);
        assert_eq!((&found.triangles, &found.hull), (&brute.mesh.triangles, &brute.mesh.hull), "{:?}", self.log);
        assert_eq!(found.duplicates, brute.mesh.duplicates);
        let near = random.pick(&self.places);
        let off = Point::new(random.below_u32(9), random.below_u32(9));
        for place in [near, off] {
            let q = (self.point)(place);
            assert_eq!(mesh.locate(q), brute.locate(place), "locate {place}: {:?}", self.log);
            let sorted = brute.by_nearness(place);
            assert_eq!(mesh.nearest(q), sorted.first().copied(), "nearest {place}: {:?}", self.log);
        }
    }
}

/// Runs scripts on all kinds of coordinates in turn.
fn run(seed: u64, scripts: usize) {
    let mut random = SplitMix64::new(seed);
    for script in 0..scripts {
        let places = places(&mut random);
        let commands = 10 + random.below(40) as usize;
        match script % 4 {
            0 | 1 => Script::new(places, |p| p).run(&mut random, commands),
            2 => Script::new(places, |p| [p.x, p.y].map(|v| f64::from(v) * 2f64.powi(-340) - 2f64.powi(-338)))
                .run(&mut random, commands),
            _ => {
                Script::new(places, |p| [p.x, p.y].map(|v| (i64::from(v) << 59) - (1 << 61))).run(&mut random, commands)
            }
        }
    }
}

#[test]
fn some_scripts_agree_with_brute_force() {
    run(91, 8000);
}

#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_agree_with_brute_force() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(92, scripts.unwrap_or(100_000));
}
