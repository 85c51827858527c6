//! Random scripts on tiny sets that are full of ties, with a check after every command.
//!
//! The regular test runs 10,000 scripts, or 1,500 in debug builds. This command runs as many as the variable says:
//!
//! ```text
//! INCIRCLE_SCRIPTS=1000000 cargo test --release -p incircle-geometry living::tests::scripts -- --include-ignored
//! ```

use incircle_testkit::SplitMix64;

use super::brute::Brute;
use super::structure;
use crate::living::{Error, Triangulation};
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
    /// The length of a step of the grid in the coordinates of the points.
    pub unit: f64,
    pub log: Vec<String>,
}

impl<P: PlanePoint + core::fmt::Debug + PartialEq> Script<P> {
    pub fn new(places: Vec<Point>, point: fn(Point) -> P, unit: f64) -> Self {
        Self { mesh: Triangulation::new(), brute: Brute::new(), places, point, unit, log: Vec::new() }
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
        match random.below(13) {
            12 => self.renumber(),
            10 => {
                let moved: Vec<Point> = self.brute.indices.iter().map(|_| random.pick(&self.places)).collect();
                self.move_all(&moved);
            }
            11 => self.drift(random),
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

    /// Moves a few points at once, by short steps.
    fn drift(&mut self, random: &mut SplitMix64) {
        let living: Vec<Point> = self.brute.points.iter().copied().flatten().collect();
        let step = |value: u32, random: &mut SplitMix64| match random.below(16) {
            0 => value.saturating_sub(1),
            1 => value + 1,
            _ => value,
        };
        let moved: Vec<Point> = living.iter().map(|p| Point::new(step(p.x, random), step(p.y, random))).collect();
        self.move_all(&moved);
    }

    fn move_all(&mut self, moved: &[Point]) {
        self.log.push(format!("move all {moved:?}"));
        let points: Vec<P> = moved.iter().map(|&place| (self.point)(place)).collect();
        self.mesh.move_all(&points).expect("finite points");
        let living = self.brute.points.iter_mut().filter(|point| point.is_some());
        living.zip(moved).for_each(|(point, &place)| *point = Some(place));
    }

    /// Gives the living points new indices, from 0 on.
    fn renumber(&mut self) {
        self.log.push("renumber".to_owned());
        assert_eq!(self.mesh.renumber(), self.brute.indices);
        self.brute.points.retain(Option::is_some);
        assert_eq!(self.mesh.next_index() as usize, self.brute.points.len());
    }

    fn compare_change(&mut self, index: u32, found: Result<(), Error>, place: Option<Point>) {
        let next = self.brute.points.len() as u32;
        match self.brute.points.get_mut(index as usize) {
            None => assert_eq!(found, Err(Error::Unknown { index, next })),
            Some(None) => assert_eq!(found, Err(Error::Deleted { index })),
            Some(point) => {
                assert_eq!(found, Ok(()));
                *point = place;
            }
        }
    }

    pub fn check(&self, random: &mut SplitMix64) {
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
        self.check_regions(random, [near, off]);
        self.check_iterators();
    }

    fn check_regions(&self, random: &mut SplitMix64, [one, other]: [Point; 2]) {
        let (mesh, brute, point) = (&self.mesh, &self.brute, self.point);
        let count = random.below(8) as usize;
        let sorted = brute.by_nearness(one);
        assert_eq!(mesh.k_nearest(point(one), count), sorted[..count.min(sorted.len())], "{:?}", self.log);
        assert_eq!(mesh.segment(point(one), point(other)), brute.segment(one, other), "{one}{other}: {:?}", self.log);
        let (low, high) = (|k: u32, l: u32| k.min(l), |k: u32, l: u32| k.max(l));
        let holds = |p: Point| {
            let x = low(one.x, other.x) <= p.x && p.x <= high(one.x, other.x);
            x && low(one.y, other.y) <= p.y && p.y <= high(one.y, other.y)
        };
        let within = |holds: &dyn Fn(Point) -> bool| {
            let mut found: Vec<u32> = brute.places().into_iter().filter(|p| holds(p.1)).map(|p| p.0).collect();
            found.sort_unstable();
            found
        };
        assert_eq!(mesh.within_rectangle(point(one), point(other)), within(&holds), "{one}{other}: {:?}", self.log);
        let radius = random.below(6);
        let circle = within(&|p| Brute::distance(p, one) <= radius * radius);
        let found = mesh.within_circle(point(one), radius as f64 * self.unit);
        assert_eq!(found, circle, "{one} {radius}: {:?}", self.log);
    }

    fn check_iterators(&self) {
        let (mesh, brute) = (&self.mesh, &self.brute);
        let sorted = |mut list: Vec<u32>| {
            list.sort_unstable();
            list
        };
        assert_eq!(sorted(mesh.vertices().collect()), sorted(brute.places().iter().map(|p| p.0).collect()));
        let mut edges: Vec<[u32; 2]> = mesh.edges().collect();
        edges.sort_unstable();
        assert_eq!(edges, brute.edges());
        let mut triangles: Vec<[u32; 3]> = mesh.triangles().collect();
        triangles.sort_unstable();
        assert_eq!(triangles, brute.triangles());
        assert_eq!(mesh.hull().collect::<Vec<_>>(), brute.hull(), "{:?}", self.log);
        for index in mesh.vertices() {
            let around: Vec<u32> = mesh.neighbors(index).expect("a living point").collect();
            let expected =
                edges.iter().filter(|edge| edge.contains(&index)).map(|e| if e[0] == index { e[1] } else { e[0] });
            assert_eq!(sorted(around.clone()), sorted(expected.collect()));
            let star: Vec<[u32; 3]> = mesh.star(index).expect("a living point").collect();
            assert_eq!(star.len(), triangles.iter().filter(|triangle| triangle.contains(&index)).count());
            let is_next = |(k, t): (usize, &[u32; 3])| *t == [index, around[k], around[(k + 1) % around.len()]];
            assert!(star.iter().enumerate().all(is_next), "{star:?} {around:?}");
            let hull = brute.hull();
            let begins = match hull.iter().position(|&other| other == index) {
                _ if triangles.is_empty() => continue,
                Some(place) => hull[(place + 1) % hull.len()],
                None => *around.iter().min().expect("an inner vertex has neighbours"),
            };
            assert_eq!(around[0], begins, "{:?}", self.log);
        }
    }
}

pub fn doubles(p: Point) -> [f64; 2] {
    [p.x, p.y].map(|value| f64::from(value) * 2f64.powi(-340) - 2f64.powi(-338))
}

pub fn integers(p: Point) -> [i64; 2] {
    [p.x, p.y].map(|value| (i64::from(value) << 58) - (1 << 60))
}

/// Runs scripts on all kinds of coordinates in turn.
fn run(seed: u64, scripts: usize) {
    let mut random = SplitMix64::new(seed);
    for script in 0..scripts {
        let places = places(&mut random);
        let commands = 10 + random.below(40) as usize;
        match script % 4 {
            0 | 1 => Script::new(places, |p| p, 1.0).run(&mut random, commands),
            2 => Script::new(places, doubles, 2f64.powi(-340)).run(&mut random, commands),
            _ => Script::new(places, integers, 2f64.powi(58)).run(&mut random, commands),
        }
    }
}

#[test]
fn some_scripts_agree_with_brute_force() {
    run(91, if cfg!(debug_assertions) { 1_500 } else { 10_000 });
}

#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_agree_with_brute_force() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(92, scripts.unwrap_or(100_000));
}
