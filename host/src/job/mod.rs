//! The life of a job on a device.
//!
//! ```text
//!   points ──prepare──> Prepared ──> Group ──> Load ──flight──> records ──assemble──> Answer
//!            duplicates,  an order    jobs that   the commands,      to triangles and hull,
//!            a triangle   for the     share the   one by one or      with its Report
//!            first        contexts    memory      sent ahead
//! ```
//!
//! A single job is a group of one. Its commands go one by one, so that a listener hears the progress. A [`batch`] makes
//! groups of many jobs, whose commands are sent ahead where the transport takes them. From there on both go the same
//! way: [`flight`] sends a load, checks the answers, and tries once more after a passing fault.

pub(crate) mod answer;
pub(crate) mod assemble;
pub(crate) mod batch;
mod counters;
pub(crate) mod deal;
pub(crate) mod flight;
pub(crate) mod group;
pub(crate) mod load;
mod options;
pub(crate) mod prepare;
pub(crate) mod read_form;
mod report;
pub(crate) mod watch;

pub(crate) use answer::Answer;
pub use answer::Solution;
pub use counters::{Counters, Latencies};
pub use options::{Options, Progress, ProgressListener, Stage};
pub use report::{Report, Share};
