//! The trait of a back end: what does the jobs of a session.

use incircle_protocol::{Command, Identity, Opcode};

use crate::error::{DeviceFault, Error};
use crate::job::{Answer, Options, Solution};
use crate::limit::Limit;
use incircle_geometry::lattice::Numbers;
use incircle_geometry::Point;

/// A back end: the CPU triangulator, or a device that takes commands.
pub(crate) trait Backend {
    /// Name of the back end in reports and errors.
    fn name(&self) -> String;

    /// Asks for the identity and refuses one that no sound device has.
    fn greet(&mut self, limit: Limit) -> Result<Identity, Error>;

    /// Factor by which this back end is slower than real hardware; 1 unless it is simulated.
    fn slow(&self) -> u32 {
        1
    }

    /// Clocks since the device was opened, where they are counted.
    fn clocks(&self) -> Option<u64> {
        None
    }

    /// Does one job and tells its listener about the progress.
    fn triangulate(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error>;

    /// Whether the back end can do jobs whose points lie on no lattice: doubles and long integers.
    fn takes_all_numbers(&self) -> bool {
        false
    }

    /// Whether this is the CPU triangulator, which can force constraints into a mesh that is not sorted yet.
    fn is_cpu(&self) -> bool {
        false
    }

    /// Does one job on points in any numbers, if [`takes_all_numbers`](Self::takes_all_numbers).
    fn triangulate_numbers(&mut self, _numbers: &Numbers<'_>, terms: Terms<'_>) -> Result<Answer, Error> {
        Err(Error::NoLattice { coord_bits: terms.identity.coord_bits, device: self.name() })
    }

    /// Does those of many jobs that go well together, and returns the others.
    fn triangulate_together(&mut self, jobs: Vec<Vec<Point>>, terms: Terms<'_>) -> Result<Together, Error>;

    /// Sends one command and receives the payload of its answer, for a mesh that lives on the device.
    fn exchange(&mut self, command: Command<&[u32]>, payload: &mut Vec<u32>, limit: Limit) -> Result<(), Error> {
        let _ = (command, payload, limit);
        Err(Error::NoRuns { device: self.name() })
    }

    /// Most words of payload of the answer to a run.
    fn run_words(&self) -> usize {
        usize::MAX
    }

    /// Number of commands that were sent again so far, and that the device may have carried out more than once.
    fn repeats(&self) -> u64 {
        0
    }

    /// Turns a wrong answer into an error, after which nothing more is asked of the device.
    fn distrust(&mut self, opcode: Opcode, fault: DeviceFault) -> Error {
        let _ = (opcode, fault);
        Error::OutOfStep { device: self.name() }
    }
}

/// The terms on which a job is done. The session has already checked the points and the number of contexts.
#[derive(Clone, Copy)]
pub(crate) struct Terms<'t> {
    pub(crate) identity: Identity,
    /// Contexts that may work on the job.
    pub(crate) contexts: u32,
    pub(crate) limit: Limit,
    /// Whether every job of a batch must end within this limit. If not, exclusive jobs have times of their own.
    pub(crate) shares_limit: bool,
    pub(crate) options: &'t Options<'t>,
}

/// Outcome of [`Backend::triangulate_together`]: each job is in one of the two lists.
pub(crate) struct Together {
    /// Solutions in the order of the caller, `None` for each job that is left.
    pub(crate) solutions: Vec<Option<Solution>>,
    /// Jobs that must go one by one.
    pub(crate) left: Vec<JobLeft>,
}

/// A job that the back end has left for a call of its own.
pub(crate) struct JobLeft {
    /// Index of the job in the list of the caller.
    pub(crate) job: usize,
    pub(crate) points: Vec<Point>,
    /// Contexts that are to work on the job.
    pub(crate) contexts: u32,
}
