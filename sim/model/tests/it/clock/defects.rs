//! Every rule of the engine is needed: a core without one of them is caught, and each test says by which symptom.
//!
//! The symptoms, the strongest first, are a wrong mesh or a lock left set, a job that the watchdog ends, and a number
//! of cycles other than that of the complete core, which the golden table of cycles and lock-step would show. Each test
//! looks for the first of some random jobs with the strongest symptom that the absence of its rule causes. The complete
//! core does all of these jobs right.

use crate::common::batches::{check_single_meshes, teams_word};
use crate::common::bench::Bench;
use crate::common::{sets, Random};
use incircle_model::{CommandModel, Defect};
use incircle_protocol::{command_word, Config, Counter, Opcode, Status};
use incircle_testkit::Batch;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// The outcome of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Symptom {
    /// The right mesh, in this many cycles.
    None { cycles: u64 },
    /// A wrong mesh, malformed records, or a lock that is left set.
    Wrong(String),
    /// The watchdog has ended the job.
    Stuck,
    /// Not even the watchdog has ended the job.
    Hang,
    /// The model has reached a state that no core can be in.
    Panic,
}

impl Symptom {
    fn is_wrong(&self) -> bool {
        matches!(self, Self::Wrong(_))
    }

    fn cycles(&self) -> Option<u64> {
        match *self {
            Self::None { cycles } => Some(cycles),
            _ => None,
        }
    }
}

/// Random jobs of one kind.
struct Jobs {
    contexts: u32,
    /// Number of jobs side by side.
    side_by_side: u32,
    ring: u32,
    points: fn(&mut Random) -> Vec<u32>,
    /// Largest number of jobs to try. The test ends at the first job that shows the symptom.
    most: u32,
}

fn symptom(config: Config, jobs: u32, defect: Option<Defect>, points: &[u32]) -> Symptom {
    let job = AssertUnwindSafe(|| {
        let mut bench = Bench::with_defect(config, defect);
        match bench.insert_after(teams_word(config.contexts, jobs), points) {
            Ok(answer) if answer.is(Status::Stuck) => Symptom::Stuck,
            Ok(_) => match check(&mut bench, jobs, points) {
                Ok(cycles) => Symptom::None { cycles },
                Err(fault) => Symptom::Wrong(fault),
            },
            Err(_) => Symptom::Hang,
        }
    });
    catch_unwind(job).unwrap_or(Symptom::Panic)
}

/// The number of cycles of finished jobs, if their meshes are right.
fn check(bench: &mut Bench, jobs: u32, points: &[u32]) -> Result<u64, String> {
    let config = bench.config;
    let model = CommandModel::new(16, config.points, config.ring).expect("a model that can be built");
    let mut model = model.with_contexts(config.contexts);
    model.send(&[teams_word(config.contexts, jobs), command_word(Opcode::Insert), points.len() as u32]);
    model.send(points);
    let records = model.mesh().records().len() as u32;
    check_single_meshes(&bench.records(records), points, jobs, config)?;
    let counters = bench.counters().map_err(|hang| hang.0)?;
    if counters.counter(Counter::Insertions) != u64::from(records / 2 + jobs) {
        return Err("another number of points".to_string());
    }
    Ok(counters.counter(Counter::InsertCycles))
}

impl Jobs {
    fn config(&self) -> Config {
        let points = 256 * self.side_by_side.next_power_of_two();
        Config { name: "test", points, ring: self.ring, contexts: self.contexts, engines: 1 }
    }

    /// The points of the job of this number, or of as many as work side by side.
    fn job(&self, number: u32) -> Vec<u32> {
        let mut random = Random(u64::from(number));
        let jobs = (0..self.side_by_side).map(|_| (self.points)(&mut random)).collect();
        Batch { jobs }.points()
    }

    fn symptom(&self, defect: Option<Defect>, points: &[u32]) -> Symptom {
        symptom(self.config(), self.side_by_side, defect, points)
    }

    /// Looks for the first job that shows the wanted symptom without the rule.
    fn expect(&self, defect: Defect, is_wanted: fn(&Symptom) -> bool) {
        let mut others = Vec::new();
        for number in 0..self.most {
            let points = self.job(number);
            let whole = self.symptom(None, &points);
            assert!(whole.cycles().is_some(), "the whole core: {whole:?}, job {number}, points {points:x?}");
            let found = self.symptom(Some(defect), &points);
            if is_wanted(&found) {
                println!("{defect:?}, job {number}: {found:?}");
                return;
            }
            others.push(found);
        }
        panic!("{defect:?} does not show: {others:?}");
    }

    /// The cycles of all jobs, with all rules and without this one. The absence must change no mesh.
    fn cycles(&self, defect: Defect) -> Vec<(u64, u64)> {
        let job = |number| {
            let points = self.job(number);
            let of = |defect| {
                let found = self.symptom(defect, &points);
                found.cycles().unwrap_or_else(|| panic!("{defect:?}: {found:?}, job {number}, points {points:x?}"))
            };
            (of(None), of(Some(defect)))
        };
        (0..self.most).map(job).collect()
    }
}

/// Whether some job takes another number of cycles.
fn differ(cycles: &[(u64, u64)]) -> bool {
    cycles.iter().any(|(with, without)| with != without)
}

/// Cycles of all jobs together, with and without a rule.
fn sums(cycles: &[(u64, u64)]) -> (u64, u64) {
    cycles.iter().fold((0, 0), |sums, of| (sums.0 + of.0, sums.1 + of.1))
}

/// Jobs in which insertions meet all the time.
const CROWD: Jobs = Jobs {
    contexts: 8,
    side_by_side: 1,
    ring: 32,
    points: |random| sets::started(sets::boxed(random, 100, 300)),
    most: 30,
};

/// The same, as three jobs side by side with four contexts each.
const TEAMS: Jobs = Jobs { contexts: 12, side_by_side: 3, ..CROWD };

/// L1: a foreign lock aborts the attempt. Otherwise two insertions rewrite the same records.
#[test]
fn foreign_locks_count() {
    let jobs = Jobs {
        contexts: 4,
        side_by_side: 1,
        ring: 32,
        points: |random| sets::started(sets::boxed(random, 17, 40)),
        most: 200,
    };
    jobs.expect(Defect::IgnoresForeignLocks, Symptom::is_wrong);
}

/// L1: an attempt that aborts lets all its visits complete before it releases its locks. Otherwise a visit that is
/// still out takes a lock that is never released.
#[test]
fn attempts_drain_before_they_release() {
    let jobs = Jobs {
        contexts: 12,
        side_by_side: 1,
        ring: 32,
        points: |random| sets::started(sets::boxed(random, 17, 5)),
        most: 200,
    };
    jobs.expect(Defect::ReleasesBeforeDrained, Symptom::is_wrong);
    CROWD.expect(Defect::ReleasesBeforeDrained, |found| *found == Symptom::Stuck);
}

/// L1: a context that has aborted rests before it tries again. No mesh and no termination depends on that, because the
/// other contexts yield to the one with the priority.
#[test]
fn aborted_attempts_rest() {
    let jobs = Jobs { contexts: 16, ..CROWD };
    assert!(differ(&jobs.cycles(Defect::NeverRests)));
}

/// L2: one context may wait at foreign locks. Otherwise contexts abort each other for ever.
#[test]
fn somebody_waits() {
    CROWD.expect(Defect::NobodyTakesPriority, |found| *found == Symptom::Stuck);
}

/// L2: each team has a priority of its own. Otherwise jobs wait for each other: contexts of one team abort again and
/// again while a context of another holds the priority. The meshes stay right.
#[test]
fn each_team_has_its_own_priority() {
    let (with, without) = sums(&TEAMS.cycles(Defect::OnePriority));
    assert!(with < without, "{with} {without}");
}

/// L3: while the context with the priority waits in vain, contexts that have aborted do not start again. Otherwise they
/// hold the awaited lock in turns, for ever.
#[test]
fn the_others_yield_to_the_one_that_waits() {
    let points = |random: &mut Random| sets::started(sets::stuttering(random, 100, 300));
    let jobs = Jobs { contexts: 16, side_by_side: 1, ring: 32, points, most: 200 };
    jobs.expect(Defect::NobodyYields, |found| *found == Symptom::Stuck);
}

/// L4: locks are released after the last write. Otherwise other contexts see half a star.
#[test]
fn locks_are_held_until_the_last_write() {
    CROWD.expect(Defect::ReleasesBeforeWritten, Symptom::is_wrong);
}

/// L5: the root is read again under its lock. Otherwise a point is inserted into a triangle that has
/// changed since the walk.
#[test]
fn roots_are_looked_at_again() {
    CROWD.expect(Defect::TrustsTheWalk, Symptom::is_wrong);
}

/// L6: a context opens no cavity while its own commit or release is due. Otherwise the commit reads a boundary that the
/// next cavity is writing, and the release clears locks that the next attempt holds.
#[test]
fn a_context_ends_before_it_begins() {
    let points = |random: &mut Random| sets::started(sets::wheel_from_outside(random, 30));
    let jobs = Jobs { contexts: 2, side_by_side: 1, ring: 64, points, most: 400 };
    jobs.expect(Defect::OpensWhileBusy, Symptom::is_wrong);
    let jobs = Jobs { contexts: 1, ..jobs };
    jobs.expect(Defect::OpensWhileBusy, |found| found.cycles().is_none());
}

/// L7: a walk that meets a record being written reads it again. The data of such a read are invalid, so the walk goes
/// astray; the lock of the root keeps the mesh right all the same.
#[test]
fn records_being_written_are_read_again() {
    assert!(differ(&CROWD.cycles(Defect::ReadsTheTorn)));
}

/// L7: new ids stay behind the watermark until the star is written. Only a long commit is still in progress when a walk
/// reaches a new record of its first half: a record is written a few clocks after the first neighbour that names it,
/// and the next visit of the walk comes later than that.
#[test]
fn new_records_are_met_when_all_are_written() {
    let points = |random: &mut Random| sets::started(sets::wheel_from_outside(random, 120));
    let jobs = Jobs { contexts: 8, side_by_side: 1, ring: 64, points, most: 60 };
    assert!(differ(&jobs.cycles(Defect::ReadsTheUnwritten)));
}

/// L8: the first points are left to one context. Otherwise all contexts hinder each other in a mesh of a few triangles.
#[test]
fn one_context_begins() {
    let (with, without) = sums(&CROWD.cycles(Defect::AllFromTheStart));
    assert!(with < without, "{with} {without}");
}

/// L8: the contexts of a team wait for the first round of their own job. Otherwise they meet in a mesh of a few
/// triangles as soon as another team is further on.
#[test]
fn a_team_waits_for_its_own_first_round() {
    assert!(differ(&TEAMS.cycles(Defect::TeamsStartTogether)));
}

/// L9: a lock names its holder. A cavity meets its own locks whenever two of its edges border on the same triangle.
#[test]
fn own_locks_are_told_from_foreign_ones() {
    CROWD.expect(Defect::TakesOwnForForeign, |found| *found == Symptom::Stuck);
    Jobs { contexts: 1, ..CROWD }.expect(Defect::TakesOwnForForeign, |found| *found == Symptom::Stuck);
}

/// L10: a walk ends at the first record that conflicts with the point. The cavity is the same from any of its records,
/// so a longer walk costs only cycles.
#[test]
fn walks_end_at_the_cavity() {
    let jobs = Jobs { contexts: 1, ..CROWD };
    let cycles = jobs.cycles(Defect::WalksToTheEnd);
    assert!(cycles.iter().all(|(with, without)| with <= without) && differ(&cycles), "{cycles:?}");
}

/// L10: the side of a record that faces the point decides a tie. The root need not hold the point, so a test may come
/// to a record from the side on which the point lies, and the edge that it comes across says nothing.
#[test]
fn the_side_that_faces_the_point_decides_a_tie() {
    let jobs = Jobs {
        contexts: 1,
        side_by_side: 1,
        ring: 32,
        points: |random| sets::started(sets::boxed(random, 60, 12)),
        most: 200,
    };
    jobs.expect(Defect::TiesByTheWayIn, Symptom::is_wrong);
}

/// L11: a context walks in the mesh of its own job only. Otherwise its first point is inserted into another mesh. If
/// more points follow, the contexts with the priorities of two teams wait for each other's locks, for ever.
#[test]
fn a_context_walks_in_the_mesh_of_its_own_job() {
    let jobs = Jobs { points: |random| sets::started(sets::boxed(random, 1, 300)), ..TEAMS };
    jobs.expect(Defect::StartsInAnyMesh, Symptom::is_wrong);
    TEAMS.expect(Defect::StartsInAnyMesh, |found| *found == Symptom::Stuck);
}
