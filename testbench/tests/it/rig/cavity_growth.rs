//! A reference for cavities that several contexts grow in one triangulation, as sets of triangles.
//!
//! The reference has no counts of entries and no bits of half-open triangles. A visit is an element of a set, a
//! triangle of the cavity has a number of edges that no conflict has passed, and the list of locks is a list.

use std::collections::{BTreeMap, BTreeSet};

use crate::rig::flip_mesh::{Mesh, Point, Record};
use crate::rig::stepper::bundles::{commit_job, release_job, Edge, Finding, LockFinding, Visit};
use incircle_testkit::SplitMix64;

/// A point to insert: its place, the triangles that hold it, and the triangles that it removes.
#[derive(Clone, Debug)]
pub struct Target {
    pub point: Point,
    pub places: Vec<u64>,
    pub cavity: BTreeSet<u64>,
}

/// A triangulation whose ids are spread over all their bits.
pub struct Ground {
    mesh: Mesh,
    records: BTreeMap<u64, Record>,
}

/// Spreads numbers over 15 bits, no two to the same value.
pub fn spread(number: u64) -> u64 {
    number * 0x5a6d % (1 << 15)
}

impl Ground {
    /// Inserts these points, of which the first three turn left.
    pub fn of(points: &[Point]) -> Self {
        let mut mesh = Mesh::of([points[0], points[1], points[2]]);
        for point in &points[3..] {
            let root = mesh.places_of(*point)[0];
            mesh.insert(*point, root);
        }
        mesh.assert_delaunay();
        let records = mesh.records.iter().enumerate();
        let records = records.map(|(id, record)| (spread(id as u64), Record { v: record.v, n: record.n.map(spread) }));
        Self { records: records.collect(), mesh }
    }

    /// Returns the point as one to insert if it lies on no circle of the triangulation, or on one of its points.
    pub fn target(&self, point: Point) -> Option<Target> {
        let conflicts = |record: &Record| [0, 1, 2].map(|slot| self.mesh.conflicts(record.turned(slot).v, point));
        let is_decided = |record: &Record| conflicts(record).iter().all(|conflict| *conflict == conflicts(record)[0]);
        let is_corner = self.mesh.points.contains(&point);
        (is_corner || self.records.values().all(is_decided)).then(|| Target {
            point,
            places: self.mesh.places_of(point).into_iter().map(spread).collect(),
            cavity: self.records.iter().filter(|(_, record)| conflicts(record)[0]).map(|(id, _)| *id).collect(),
        })
    }

    /// Returns the record of a visit as it is turned, and the slot that comes first.
    pub fn read(&self, visit: &Visit) -> (Record, u64) {
        let record = self.records[&visit.record];
        let slot = if visit.rotates { record.slot_to(visit.cavity_record) } else { 0 };
        (record.turned(slot), slot as u64)
    }

    /// Returns a random triangle.
    pub fn somewhere(&self, random: &mut SplitMix64) -> u64 {
        spread(random.below(self.records.len() as u64))
    }

    /// Returns what a sound core finds for this point; a walk may also wander.
    pub fn find(&self, visit: &Visit, target: &Target, random: &mut SplitMix64) -> Finding {
        let (record, _) = self.read(visit);
        let near = target.places[random.below(target.places.len() as u64) as usize];
        let is_corner = |v: &u64| self.mesh.points.get(*v as usize) == Some(&target.point);
        Finding {
            conflict: self.mesh.conflicts(record.v, target.point),
            located: target.places.contains(&visit.record),
            falls_onto_corner: record.v.iter().any(is_corner),
            walk_next: if random.below(2) == 0 { near } else { self.somewhere(random) },
            is_left: random.below(2) == 0,
            is_straight: random.below(2) == 0,
        }
    }
}

/// A visit that completes, with the record that was read and the result.
pub struct Completion {
    pub visit: Visit,
    pub record: Record,
    pub slot: u64,
    pub lock: LockFinding,
    pub finding: Finding,
}

/// State of the blocks around a context.
pub struct Around {
    pub seeded: bool,
    pub ring: u64,
    pub holds_priority: bool,
    pub is_busy: bool,
}

/// Outputs that must follow a visit.
#[derive(Default)]
pub struct Outcome {
    /// Number of visits that follow, and the bundle that asks for them.
    pub push: Option<(usize, u128)>,
    pub sleeps: bool,
    pub will_retry: bool,
    pub root: Option<u64>,
    pub entry: Option<(u64, Edge)>,
    pub inner: Option<(u64, u64)>,
    pub lock: Option<(u64, u64)>,
    pub commit: Option<u128>,
    pub triangles: u64,
    pub release: Option<u128>,
    pub asks_for_priority: bool,
    pub returns_priority: bool,
    pub overflows: bool,
    pub duplicate: bool,
    pub looks: bool,
    pub revisit: bool,
    pub aborts: bool,
    pub root_changed: bool,
}

/// A cavity as it grows.
#[derive(Clone, Debug, Default)]
pub struct Growth {
    pub has_failed: bool,
    /// Locks, in the order in which they were taken.
    pub log: Vec<u64>,
    pub entries: BTreeMap<u64, Edge>,
    /// Triangles of the cavity, each with the number of its edges that no conflict has passed. The edge by which a
    /// triangle was entered does not count.
    pub closed_edges: BTreeMap<u64, u64>,
    pub inner: Vec<u64>,
}

/// A context: its point, and those of its visits that are out.
#[derive(Clone, Debug, Default)]
pub struct Context {
    pub index: u64,
    pub target: usize,
    pub vertex: u64,
    pub since: u64,
    pub out: Vec<Visit>,
    pub growth: Growth,
}

impl Context {
    /// Completes a visit of the context, which is not out any more.
    pub fn complete(&mut self, done: &Completion, around: &Around) -> Outcome {
        let mut outcome = match (done.visit.rotates, done.visit.locks) {
            (false, false) => self.complete_walk(done, around),
            (false, true) => self.complete_root(done, around),
            _ => self.complete_test(done, around),
        };
        if outcome.revisit {
            outcome.push = Some((1, done.visit.bundle(1, 0, 0, 0)));
            self.out.push(done.visit);
        }
        outcome.sleeps = self.out.is_empty();
        outcome
    }

    fn push(&mut self, visits: &[Visit]) -> Option<(usize, u128)> {
        self.out.extend(visits);
        let [second, third] = [1, 2].map(|place| visits.get(place).copied().unwrap_or_default());
        Some((visits.len(), visits[0].bundle(visits.len() as u64, second.after, second.record, third.record)))
    }

    fn complete_walk(&mut self, done: &Completion, around: &Around) -> Outcome {
        let look = Visit { context: self.index, ..Visit::look(done.finding.walk_next) };
        if !around.seeded {
            return Outcome { looks: true, ..Outcome::default() };
        }
        if done.lock.again {
            return Outcome { revisit: true, ..Outcome::default() };
        }
        if done.finding.falls_onto_corner {
            return Outcome { duplicate: true, returns_priority: true, ..Outcome::default() };
        }
        if !done.finding.conflict {
            return Outcome { push: self.push(&[look]), ..Outcome::default() };
        }
        if around.is_busy {
            return Outcome { revisit: true, ..Outcome::default() };
        }
        Outcome { push: self.push(&[Visit { locks: true, ..done.visit }]), ..Outcome::default() }
    }

    fn complete_root(&mut self, done: &Completion, around: &Around) -> Outcome {
        let record = done.visit.record;
        let root = Some(record);
        if done.lock.foreign {
            let waits = around.holds_priority;
            return Outcome {
                root,
                revisit: waits,
                will_retry: !waits,
                aborts: !waits,
                asks_for_priority: !waits,
                ..Outcome::default()
            };
        }
        let (lock, release) = (Some((0, record)), Some(release_job(self.index, 1)));
        if done.finding.falls_onto_corner {
            return Outcome { root, lock, release, duplicate: true, returns_priority: true, ..Outcome::default() };
        }
        if !done.finding.conflict {
            let root = Some(done.finding.walk_next);
            return Outcome { root, lock, release, will_retry: true, root_changed: true, ..Outcome::default() };
        }
        self.growth = Growth { log: vec![record], closed_edges: [(record, 3)].into(), ..Growth::default() };
        let test = |entry, after, neighbour| {
            let cavity_entry = 0;
            Visit {
                context: self.index,
                rotates: true,
                locks: true,
                entry,
                after,
                cavity_entry,
                cavity_record: record,
                record: neighbour,
            }
        };
        let [n0, n1, n2] = done.record.n;
        Outcome { root, lock, push: self.push(&[test(0, 1, n0), test(1, 2, n1), test(2, 0, n2)]), ..Outcome::default() }
    }

    fn complete_test(&mut self, done: &Completion, around: &Around) -> Outcome {
        let mut outcome = Outcome::default();
        let visit = done.visit;
        if done.lock.took {
            outcome.lock = Some((self.growth.log.len() as u64, visit.record));
            self.growth.log.push(visit.record);
        }
        let is_full = self.growth.closed_edges.len() as u64 + 2 == around.ring;
        match (done.lock.foreign, done.finding.conflict) {
            _ if self.growth.has_failed => {}
            (true, _) if around.holds_priority => outcome.revisit = true,
            (true, _) => {
                self.growth.has_failed = true;
                outcome.aborts = true;
                outcome.asks_for_priority = true;
            }
            (false, true) if is_full => {
                self.growth.has_failed = true;
                outcome.overflows = true;
                outcome.returns_priority = true;
            }
            (false, true) => self.pass(done, &mut outcome),
            (false, false) => {
                let edge = Edge {
                    first_vertex: spread(done.record.v[2]),
                    outside_record: visit.record,
                    slot: done.slot,
                    cavity_record: visit.cavity_record,
                    after: visit.after,
                };
                assert!(
                    self.growth.entries.insert(visit.entry, edge).is_none(),
                    "entry {} is final twice",
                    visit.entry
                );
                outcome.entry = Some((visit.entry, edge));
            }
        }
        if self.out.is_empty() && !outcome.revisit {
            self.end(&mut outcome);
        }
        outcome
    }

    /// Grows the cavity through the edge of a visit.
    fn pass(&mut self, done: &Completion, outcome: &mut Outcome) {
        let visit = done.visit;
        let y = self.growth.closed_edges.len() as u64 + 2;
        let behind = self.growth.closed_edges.get_mut(&visit.cavity_record).expect("a triangle of the cavity");
        *behind -= 1;
        if *behind == 0 {
            outcome.inner = Some((self.growth.inner.len() as u64, visit.cavity_record));
            self.growth.inner.push(visit.cavity_record);
        }
        assert!(self.growth.closed_edges.insert(visit.record, 2).is_none(), "the cavity meets itself");
        let [_, n1, n2] = done.record.n;
        let half = Visit { cavity_record: visit.record, cavity_entry: y, ..visit };
        outcome.push = self.push(&[Visit { after: y, record: n1, ..half }, Visit { entry: y, record: n2, ..half }]);
    }

    fn end(&mut self, outcome: &mut Outcome) {
        let locks = self.growth.log.len() as u64;
        if self.growth.has_failed {
            outcome.will_retry = true;
            outcome.release = Some(release_job(self.index, locks));
        } else {
            outcome.returns_priority = true;
            outcome.triangles = self.growth.closed_edges.len() as u64;
            let inners = self.growth.inner.len() as u64;
            outcome.commit = Some(commit_job(self.index, self.vertex, inners, locks, self.since));
        }
    }
}

impl Growth {
    /// Checks that the ring is that of the cavity, by the triangulation alone.
    pub fn assert_ring(&self, ground: &Ground, target: &Target) {
        let cavity: BTreeSet<u64> = self.closed_edges.keys().copied().collect();
        assert_eq!(cavity, target.cavity);
        assert_eq!(self.entries.len(), cavity.len() + 2);
        let mut place = 0;
        for _ in 0..self.entries.len() {
            let edge = self.entries[&place];
            let outside = ground.records[&edge.outside_record].turned(edge.slot as usize);
            assert!(!cavity.contains(&edge.outside_record) && cavity.contains(&edge.cavity_record));
            assert_eq!((outside.n[0], spread(outside.v[2])), (edge.cavity_record, edge.first_vertex));
            // The next edge begins at the end of this one.
            assert_eq!(self.entries[&edge.after].first_vertex, spread(outside.v[1]));
            place = edge.after;
        }
        assert_eq!(place, 0, "the ring closes after its last edge and not before");
        let starts: BTreeSet<u64> = self.entries.values().map(|edge| edge.first_vertex).collect();
        assert_eq!(starts.len(), self.entries.len());

        let has_boundary = |id: &u64| self.entries.values().any(|edge| edge.cavity_record == *id);
        let inner: BTreeSet<u64> = cavity.iter().copied().filter(|id| !has_boundary(id)).collect();
        assert_eq!(self.inner.iter().copied().collect::<BTreeSet<_>>(), inner);
        assert_eq!(self.inner.len(), inner.len());
        let around = self.entries.values().map(|edge| edge.outside_record);
        let touched: BTreeSet<u64> = cavity.iter().copied().chain(around).collect();
        assert_eq!(self.log.iter().copied().collect::<BTreeSet<_>>(), touched);
        assert_eq!(self.log.len(), touched.len(), "every lock is logged once");
    }
}
