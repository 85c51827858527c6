//! Many jobs over a line that turns bits.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::rc::Rc;
use std::time::Duration;

use incircle::{Device, Error, Options};
use incircle_protocol::Config;
use incircle_sim::faults::FaultSpec;
use incircle_sim::SimError;

use super::jobs::{is_one_mesh, random_points};
use super::virtual_line::{VirtualLine, VirtualTransport};
use super::Detail;

/// Time of the board for one command of a job.
const LIMIT: Duration = Duration::from_secs(10);
/// Round trip besides the bits: short, as every clock of it is simulated.
const TRIP: Duration = Duration::from_micros(200);
/// Jobs of a driver; then the next one opens a session of its own.
const JOBS_OF_DRIVER: u64 = 20;

/// What is run.
#[derive(Clone, Debug)]
pub struct Soak {
    /// How much of the board is simulated.
    pub detail: Detail,
    /// The core.
    pub config: Config,
    /// Faults of the line; the seed is that of the first driver.
    pub faults: FaultSpec,
    /// Bits per second.
    pub rate: u32,
    /// Jobs.
    pub jobs: u64,
    /// Most points of a job.
    pub points: usize,
}

/// What came of it.
#[derive(Clone, Debug, Default)]
pub struct SoakReport {
    /// Jobs that ended with the right mesh.
    pub right: u64,
    /// Jobs that ended with another mesh.
    pub wrong: u64,
    /// Jobs that ended with an error, by its sentence.
    pub errors: BTreeMap<String, u64>,
    /// Jobs that met a fault of the line, however they ended; only these say anything about faults.
    pub met: u64,
    /// Faults that the line did.
    pub faults: u64,
    /// `Data` frames sent again.
    pub frames_resent: u64,
    /// Answers asked for again.
    pub answers_repeated: u64,
    /// Longest job, in the board's time.
    pub longest: Duration,
}

impl SoakReport {
    /// All jobs.
    pub fn jobs(&self) -> u64 {
        self.right + self.wrong + self.errors.values().sum::<u64>()
    }

    /// All of so many jobs ended, none with a wrong mesh, this share of them at least with the right one; and so many met a fault.
    pub fn is_good(&self, jobs: u64, least: f64, met: u64) -> bool {
        let all_ended = jobs > 0 && self.jobs() == jobs;
        all_ended && self.wrong == 0 && self.right as f64 >= least * jobs as f64 && self.met >= met
    }
}

impl fmt::Display for SoakReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors: u64 = self.errors.values().sum();
        write!(
            f,
            "{} jobs, {} of which met a fault: {} right, {} wrong, {errors} with an error; {} faults, {} frames sent again, {} answers asked for again; longest job {} ms",
            self.jobs(),
            self.met,
            self.right,
            self.wrong,
            self.faults,
            self.frames_resent,
            self.answers_repeated,
            self.longest.as_millis()
        )?;
        self.errors.iter().try_for_each(|(sentence, count)| write!(f, "\n  {count} x {sentence}"))
    }
}

/// Runs the jobs. The board stays; drivers come and go.
///
/// # Errors
/// The board was not translated. What goes wrong on the line is in the report.
pub fn soak(what: &Soak) -> Result<SoakReport, SimError> {
    let mut report = SoakReport::default();
    let mut job = 0;
    while job < what.jobs {
        let faults = FaultSpec { seed: what.faults.seed + job, ..what.faults.clone() };
        let line = VirtualLine::new(what.detail.board(what.config)?, what.rate, TRIP, &faults);
        let line = Rc::new(RefCell::new(line));
        let mut device = Device::from_transport(Box::new(VirtualTransport::new(Rc::clone(&line), LIMIT)));
        let end = what.jobs.min(job + JOBS_OF_DRIVER);
        while job < end {
            job += 1;
            if !run_job(what, job, &mut device, &line, &mut report) {
                break;
            }
        }
        line.borrow_mut().close();
        let line = line.borrow();
        let statistics = line.statistics();
        report.faults += line.faults();
        report.frames_resent += statistics.frames_resent;
        report.answers_repeated += statistics.answers_repeated;
    }
    Ok(report)
}

/// One job; false if the device cannot be used any more.
fn run_job(
    what: &Soak,
    job: u64,
    device: &mut Device,
    line: &Rc<RefCell<VirtualLine>>,
    report: &mut SoakReport,
) -> bool {
    let points = random_points(3 + (job * 37) as usize % (what.points - 2), job);
    let expected = incircle::triangulate(&points);
    let (begun, faults) = (line.borrow().now(), line.borrow().faults());
    let mesh = mesh_of(device, &points);
    report.met += u64::from(line.borrow().faults() > faults);
    report.longest = report.longest.max(line.borrow().now() - begun);
    match (mesh, expected) {
        (Ok(mesh), Ok(expected)) if is_one_mesh(&mesh, &expected) => report.right += 1,
        (Ok(_), _) => report.wrong += 1,
        (Err(error), _) => {
            *report.errors.entry(error.to_string()).or_default() += 1;
            return false;
        }
    }
    true
}

fn mesh_of(device: &mut Device, points: &[incircle::Point]) -> Result<incircle::Mesh, Error> {
    let options = Options::default().timeout(Duration::from_secs(3600));
    device.session_within(Duration::from_secs(3600))?.triangulate_with(points, &options).map(|solution| solution.mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_soak_is_good_if_enough_is_right_and_nothing_wrong() {
        let report = |right, wrong, failed| SoakReport {
            right,
            wrong,
            errors: BTreeMap::from([("a sentence".to_owned(), failed)]),
            ..SoakReport::default()
        };
        assert!(report(200, 0, 0).is_good(200, 1.0, 0));
        assert!(report(190, 0, 10).is_good(200, 0.95, 0));
        for (bad, least) in [(report(199, 0, 1), 1.0), (report(189, 0, 11), 0.95), (report(199, 1, 0), 0.95)] {
            assert!(!bad.is_good(200, least, 0), "{bad}");
        }
        assert!(!report(0, 0, 200).is_good(200, 0.95, 0) && !report(0, 0, 0).is_good(0, 0.95, 0));
        assert!(!report(150, 0, 0).is_good(200, 0.5, 0), "jobs are missing");
        let met = SoakReport { met: 3, ..report(200, 0, 0) };
        assert!(met.is_good(200, 1.0, 3) && !met.is_good(200, 1.0, 4), "too few jobs met a fault");
    }
}
