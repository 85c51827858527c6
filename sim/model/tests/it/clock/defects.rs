//! Every rule of the engine is needed: a core without one of them is caught, and each test says by which symptom.
//!
//! The symptoms, the strongest first, are a wrong mesh or a lock left set, a job that the watchdog ends, and a number
//! of cycles other than that of the complete core, which the golden table of cycles and lock-step would show. Each test
//! looks for the first of some random jobs with the strongest symptom that the absence of its rule causes. The complete
//! core does all of these jobs right.

use crate::common::bench::Bench;
use crate::common::mesh_check::{canonical, records_of};
use crate::common::{sets, Random};
use incircle_model::{CommandModel, Defect};
use incircle_protocol::{command_word, Config, Counter, Opcode, Status};
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
    ring: u32,
    points: fn(&mut Random) -> Vec<u32>,
    /// Largest number of jobs to try. The test ends at the first job that shows the symptom.
    most: u32,
}

fn symptom(config: Config, defect: Option<Defect>, points: &[u32]) -> Symptom {
    let job = AssertUnwindSafe(|| {
        let mut bench = Bench::with_defect(config, defect);
        match bench.insert(0, points) {
            Ok(answer) if answer.is(Status::Stuck) => Symptom::Stuck,
            Ok(_) => match check(&mut bench, points) {
                Ok(cycles) => Symptom::None { cycles },
                Err(fault) => Symptom::Wrong(fault),
            },
            Err(_) => Symptom::Hang,
        }
    });
    catch_unwind(job).unwrap_or(Symptom::Panic)
}

/// The number of cycles of a finished job, if its mesh is right.
fn check(bench: &mut Bench, points: &[u32]) -> Result<u64, String> {
    let Config { points: capacity, ring, .. } = bench.config;
    let mut model = CommandModel::new(16, capacity, ring).expect("a model that can be built");
    model.send(&[command_word(Opcode::Insert), points.len() as u32]);
    model.send(points);
    let records = model.mesh().records().len() as u32;
    if canonical(&bench.records(records), points, capacity)?
        != canonical(&records_of(model.mesh(), capacity), points, capacity)?
    {
        return Err("another mesh".to_string());
    }
    let counters = bench.counters().map_err(|hang| hang.0)?;
    if counters.counter(Counter::Insertions) != u64::from(records / 2 + 1) {
        return Err("another number of points".to_string());
    }
    Ok(counters.counter(Counter::InsertCycles))
}

impl Jobs {
    fn config(&self) -> Config {
        Config { name: "test", points: 256, ring: self.ring, contexts: self.contexts, engines: 1 }
    }

    /// The points of the job of this number.
    fn job(&self, number: u32) -> Vec<u32> {
        (self.points)(&mut Random(u64::from(number)))
    }

    /// Looks for the first job that shows the wanted symptom without the rule.
    fn expect(&self, defect: Defect, is_wanted: fn(&Symptom) -> bool) {
        let mut others = Vec::new();
        for number in 0..self.most {
            let points = self.job(number);
            let whole = symptom(self.config(), None, &points);
            assert!(whole.cycles().is_some(), "the whole core: {whole:?}, job {number}, points {points:x?}");
            let found = symptom(self.config(), Some(defect), &points);
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
                let found = symptom(self.config(), defect, &points);
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

/// Jobs in which insertions meet all the time.
const CROWD: Jobs =
    Jobs { contexts: 8, ring: 32, points: |random| sets::started(sets::boxed(random, 100, 300)), most: 30 };

/// L1: a foreign lock aborts the attempt. Otherwise two insertions rewrite the same records.
#[test]
fn foreign_locks_count() {
    let jobs = Jobs { contexts: 4, ring: 32, points: |random| sets::started(sets::boxed(random, 17, 40)), most: 200 };
    jobs.expect(Defect::IgnoresForeignLocks, Symptom::is_wrong);
}

/// L1: an attempt that aborts lets all its visits complete before it releases its locks. Otherwise a visit that is
/// still out takes a lock that is never released.
#[test]
fn attempts_drain_before_they_release() {
    let jobs = Jobs { contexts: 12, ring: 32, points: |random| sets::started(sets::boxed(random, 17, 5)), most: 200 };
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

/// L3: while the context with the priority waits in vain, contexts that have aborted do not start again. Otherwise they
/// hold the awaited lock in turns, for ever.
#[test]
fn the_others_yield_to_the_one_that_waits() {
    let points = |random: &mut Random| sets::started(sets::stuttering(random, 100, 300));
    let jobs = Jobs { contexts: 16, ring: 32, points, most: 200 };
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
    let jobs = Jobs { contexts: 2, ring: 64, points, most: 400 };
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
    let jobs = Jobs { contexts: 1, ring: 64, points: |random| sets::parabola(random, 250), most: 60 };
    assert!(differ(&jobs.cycles(Defect::ReadsTheUnwritten)));
}

/// L8: the first points are left to one context. Otherwise all contexts hinder each other in a mesh of a few triangles.
#[test]
fn one_context_begins() {
    let (with, without): (Vec<u64>, Vec<u64>) = CROWD.cycles(Defect::AllFromTheStart).into_iter().unzip();
    assert!(with.iter().sum::<u64>() < without.iter().sum());
}

/// L9: a lock names its holder. A cavity meets its own locks whenever two of its edges border on the same triangle.
#[test]
fn own_locks_are_told_from_foreign_ones() {
    CROWD.expect(Defect::TakesOwnForForeign, |found| *found == Symptom::Stuck);
    Jobs { contexts: 1, ..CROWD }.expect(Defect::TakesOwnForForeign, |found| *found == Symptom::Stuck);
}
