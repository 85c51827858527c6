//! Runs many jobs over a line with bit errors.

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

/// Time limit, on the board's clock, for one command of a job.
const LIMIT: Duration = Duration::from_secs(10);
/// Round trip of the line besides the bits. It is short because every clock of it is simulated.
const TRIP: Duration = Duration::from_micros(200);
/// Number of jobs of a driver; the next driver opens a session of its own.
const JOBS_OF_DRIVER: u64 = 20;

/// The jobs to run, and the line to run them over.
#[derive(Clone, Debug)]
pub struct Soak {
    /// Level of detail at which the board is simulated.
    pub detail: Detail,
    /// Configuration of the core.
    pub config: Config,
    /// Faults of the line; their seed is that of the first driver.
    pub faults: FaultSpec,
    /// Rate of the line in bits per second.
    pub rate: u32,
    /// Number of jobs to run.
    pub jobs: u64,
    /// Largest number of points of a job.
    pub points: usize,
}

/// Result of the jobs.
#[derive(Clone, Debug, Default)]
pub struct SoakReport {
    /// Jobs that ended with the right mesh.
    pub right: u64,
    /// Jobs that ended with another mesh.
    pub wrong: u64,
    /// Number of jobs that ended with an error, by the error's sentence.
    pub errors: BTreeMap<String, u64>,
    /// Number of jobs that met a fault of the line, however they ended. Only these jobs say anything about faults.
    pub met: u64,
    /// Number of faults on the line.
    pub faults: u64,
    /// Number of `Data` frames sent again.
    pub frames_resent: u64,
    /// Number of answers asked for again.
    pub answers_repeated: u64,
    /// Time of the longest job, on the board's clock.
    pub longest: Duration,
}

impl SoakReport {
    /// Number of all jobs.
    pub fn jobs(&self) -> u64 {
        self.right + self.wrong + self.errors.values().sum::<u64>()
    }

    /// True if all `jobs` jobs ended, none with a wrong mesh, at least the share `least` with the right mesh, and at
    /// least `met` of them met a fault.
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
            "{} jobs, {} of which met a fault: {} right, {} wrong, {errors} with an error; \
             {} faults, {} frames sent again, {} answers asked for again; longest job {} ms",
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

/// Runs the jobs. Each driver has a line and a board of its own.
///
/// # Errors
/// The board is not part of this build. Faults of the line are in the report, not an error.
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

/// Runs one job; returns false if the device cannot be used any more.
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
