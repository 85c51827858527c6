//! Random changes of points and constraints on small sets that are full of ties, with a check after every command
//! against the builder of constrained meshes, which starts from nothing each time.

use std::collections::BTreeMap;

use incircle_testkit::SplitMix64;

use super::scripts::{doubles, integers, places, Script};
use super::structure;
use crate::constraints::{self, constrain, Constrained, Plan};
use crate::living::{Error, Triangulation};
use crate::plane_point::PlanePoint;
use crate::point::Point;

/// A script with constraints. `constraints` has the ends of each living one by its number.
struct Bound<P: PlanePoint> {
    script: Script<P>,
    constraints: BTreeMap<u32, [u32; 2]>,
    next: u32,
    /// Commands that were refused: constraints and moves that would make a crossing, and deletions of ends.
    refused: [usize; 3],
}

impl<P: PlanePoint + core::fmt::Debug + PartialEq> Bound<P> {
    fn new(script: Script<P>) -> Self {
        Self { script, constraints: BTreeMap::new(), next: 0, refused: [0; 3] }
    }

    /// The builder's answer for these points and constraints.
    fn built(&mut self) -> Result<Constrained, constraints::Error> {
        let brute = &mut self.script.brute;
        brute.renew();
        let rank = |index: u32| brute.indices.binary_search(&index).expect("a living point") as u32;
        let pairs: Vec<[u32; 2]> = self.constraints.values().map(|ends| ends.map(rank)).collect();
        constrain(&brute.mesh, &Plan::new(&pairs))
    }

    fn crosses(&mut self) -> bool {
        matches!(self.built(), Err(constraints::Error::Crossing { .. }))
    }

    fn step(&mut self, random: &mut SplitMix64) {
        let index = random.below(self.script.brute.points.len() as u64 + 1) as u32;
        let other = random.below(self.script.brute.points.len() as u64 + 1) as u32;
        let place = random.pick(&self.script.places);
        match random.below(12) {
            0..=3 => self.insert(place),
            4..=6 => self.constrain([index, other]),
            7 => self.free(random),
            8 => self.delete(index),
            9 | 10 => self.move_to(index, place),
            _ => self.move_some(random),
        }
    }

    fn insert(&mut self, place: Point) {
        self.script.log.push(format!("insert {place}"));
        self.script.mesh.insert((self.script.point)(place)).expect("room");
        self.script.brute.points.push(Some(place));
    }

    fn is_living(&self, index: u32) -> bool {
        self.script.brute.points.get(index as usize).is_some_and(Option::is_some)
    }

    fn constrain(&mut self, ends: [u32; 2]) {
        self.script.log.push(format!("constrain {ends:?}"));
        let found = self.script.mesh.insert_constraint(ends[0], ends[1]);
        if !ends.iter().all(|&end| self.is_living(end)) {
            return assert!(matches!(found, Err(Error::Deleted { .. } | Error::Unknown { .. })), "{found:?}");
        }
        self.constraints.insert(self.next, ends);
        if self.crosses() {
            self.constraints.remove(&self.next);
            self.refused[0] += 1;
            return self.check_crossing(found.map(drop), &format!("constraint {}", self.next));
        }
        assert_eq!(found, Ok(self.next), "{:?}", self.script.log);
        self.next += 1;
    }

    fn check_crossing(&self, found: Result<(), Error>, names: &str) {
        let Err(Error::Crossing { constraints, .. }) = found else { panic!("{found:?}: {:?}", self.script.log) };
        assert!(constraints[0] < constraints[1], "{:?}", self.script.log);
        assert!(found.unwrap_err().to_string().contains(names));
    }

    fn free(&mut self, random: &mut SplitMix64) {
        let constraint = random.below(u64::from(self.next) + 1) as u32;
        self.script.log.push(format!("unconstrain {constraint}"));
        let found = self.script.mesh.remove_constraint(constraint);
        let unknown = Error::UnknownConstraint { constraint, next: self.next };
        assert_eq!(found, self.constraints.remove(&constraint).map(drop).ok_or(unknown));
    }

    fn delete(&mut self, index: u32) {
        self.script.log.push(format!("delete {index}"));
        let found = self.script.mesh.delete(index);
        if !self.is_living(index) {
            return assert!(matches!(found, Err(Error::Deleted { .. } | Error::Unknown { .. })));
        }
        if let Some((&constraint, _)) = self.constraints.iter().find(|(_, ends)| ends.contains(&index)) {
            self.refused[2] += 1;
            return assert_eq!(found, Err(Error::EndOfConstraint { index, constraint }));
        }
        let before = self.script.brute.points[index as usize].take();
        if self.crosses() {
            self.script.brute.points[index as usize] = before;
            return self.check_crossing(found, "would cross constraint");
        }
        assert_eq!(found, Ok(()), "{:?}", self.script.log);
    }

    fn move_to(&mut self, index: u32, place: Point) {
        self.script.log.push(format!("move {index} {place}"));
        let found = self.script.mesh.move_to(index, (self.script.point)(place));
        if !self.is_living(index) {
            return assert!(matches!(found, Err(Error::Deleted { .. } | Error::Unknown { .. })));
        }
        let before = self.script.brute.points[index as usize].replace(place);
        if self.crosses() {
            self.script.brute.points[index as usize] = before;
            self.refused[1] += 1;
            return self.check_crossing(found, "make the crossing a point");
        }
        assert_eq!(found, Ok(()), "{:?}", self.script.log);
    }

    /// Moves some points at once, and sometimes gives all new indices.
    fn move_some(&mut self, random: &mut SplitMix64) {
        let living: Vec<Point> = self.script.brute.points.iter().copied().flatten().collect();
        let moved = living.iter().map(|&old| if random.once_in(6) { random.pick(&self.script.places) } else { old });
        let moved: Vec<Point> = moved.collect();
        self.script.log.push(format!("move all {moved:?}"));
        let points: Vec<P> = moved.iter().map(|&place| (self.script.point)(place)).collect();
        let found = self.script.mesh.move_all(&points);
        let before = self.script.brute.points.clone();
        self.script.brute.points.iter_mut().filter_map(Option::as_mut).zip(moved).for_each(|(old, new)| *old = new);
        if self.crosses() {
            self.script.brute.points = before;
            return self.check_crossing(found, "would cross constraint");
        }
        assert_eq!(found, Ok(()), "{:?}", self.script.log);
        self.script.log.push("renumber".to_owned());
        let old = self.script.mesh.renumber();
        let rank = |index: u32| old.binary_search(&index).expect("a living point") as u32;
        self.constraints.values_mut().for_each(|ends| *ends = ends.map(rank));
        self.script.brute.points.retain(Option::is_some);
    }

    fn check(&mut self, random: &mut SplitMix64) {
        let built = self.built().expect("no crossing");
        let numbers: Vec<u32> = self.constraints.keys().copied().collect();
        let mesh = &self.script.mesh;
        assert!(mesh.constraints().eq(self.constraints.iter().map(|(&number, &ends)| (number, ends))));
        let brute = &mut self.script.brute;
        let name = |rank: u32| brute.indices[rank as usize];
        let expected = built.pieces.iter().map(|(edge, own)| {
            let own: Vec<u32> = own.iter().map(|&place| numbers[place as usize]).collect();
            (edge.map(name), own)
        });
        let found = mesh.pieces();
        let found = found.iter().map(|(edge, own)| (edge, own.to_vec()));
        assert_eq!(found.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{:?}", self.script.log);
        brute.mesh.triangles = built.triangles;
        self.script.check(random);
    }

    fn run(mut self, random: &mut SplitMix64, commands: usize) -> [usize; 3] {
        for _ in 0..commands {
            self.step(random);
            self.check(random);
        }
        self.refused
    }
}

fn run(seed: u64, scripts: usize) {
    let mut random = SplitMix64::new(seed);
    let mut refused = [0; 3];
    for script in 0..scripts {
        let places = places(&mut random);
        let commands = 10 + random.below(40) as usize;
        let counts = match script % 4 {
            0 | 1 => Bound::new(Script::new(places, |p| p, 1.0)).run(&mut random, commands),
            2 => Bound::new(Script::new(places, doubles, 2f64.powi(-340))).run(&mut random, commands),
            _ => Bound::new(Script::new(places, integers, 2f64.powi(58))).run(&mut random, commands),
        };
        (0..3).for_each(|kind| refused[kind] += counts[kind]);
    }
    assert!(refused.iter().all(|&count| count > scripts / 40), "{refused:?}");
}

#[test]
fn some_scripts_with_constraints_agree_with_the_builder() {
    run(61, if cfg!(debug_assertions) { 1_500 } else { 10_000 });
}

#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_with_constraints_agree_with_the_builder() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(62, scripts.unwrap_or(100_000));
}

#[test]
fn a_point_at_a_crossing_stays_as_long_as_both_constraints_do() {
    let mut mesh = Triangulation::from([[0, 0], [6, 6], [0, 6], [6, 0], [3, 3], [3, 3]]).expect("finite points");
    let one = mesh.insert_constraint(0, 1).expect("no crossing");
    let other = mesh.insert_constraint(3, 2).expect("a point at the crossing");
    mesh.delete(4).expect("another point lies there");
    let before = mesh.mesh();
    let error = mesh.delete(5).expect_err("a crossing");
    assert_eq!(
        error.to_string(),
        "constraint 1 (from point 3 to point 2) would cross constraint 0 (from point 0 to point 1) at (3, 3): make the \
         crossing a point, or remove one of the two"
    );
    assert_eq!((mesh.move_to(5, [1, 2]), mesh.delete(2).is_err(), mesh.mesh()), (Err(error), true, before));
    assert_eq!(mesh.delete(2), Err(Error::EndOfConstraint { index: 2, constraint: other }));
    mesh.remove_constraint(one).expect("a constraint");
    assert_eq!(mesh.delete(5), Ok(()));
    assert_eq!(mesh.pieces().edges(), [[2, 3]]);
    structure::check(&mesh);
}

#[test]
fn constraints_in_larger_sets_come_and_go() {
    let mut random = SplitMix64::new(63);
    for side in [30, 1 << 20] {
        let any = |random: &mut SplitMix64| Point::new(random.below_u32(side), random.below_u32(side));
        let points: Vec<Point> = (0..600).map(|_| any(&mut random)).collect();
        let mut mesh = Triangulation::from(points).expect("finite points");
        let before = mesh.mesh();
        let mut own = Vec::new();
        for _ in 0..400 {
            let ends = [random.below_u32(600), random.below_u32(600)];
            own.extend(mesh.insert_constraint(ends[0], ends[1]));
        }
        assert!(own.len() > 8, "{}", own.len());
        let pairs: Vec<[u32; 2]> = mesh.constraints().map(|(_, ends)| ends).collect();
        let built = constrain(&before, &Plan::new(&pairs)).expect("no crossing");
        assert_eq!(mesh.mesh().triangles, built.triangles);
        let added: Vec<u32> = (0..300).map(|_| mesh.insert(any(&mut random)).expect("room")).collect();
        structure::check(&mesh);
        for index in added {
            match mesh.delete(index) {
                Ok(()) | Err(Error::Crossing { .. }) => {}
                Err(error) => panic!("{error}"),
            }
        }
        for constraint in own {
            mesh.remove_constraint(constraint).expect("a constraint");
        }
        super::changes::check(&mesh);
    }
}
