//! Counts events of the core, for the answers to the commands `Counters` and `Latencies`.
//!
//! ```text
//! Events -> Counters     -> CycleCounters, VisitCounters, LatencyRange: one EventCounter for each word
//!        -> Latencies    -> LatencyBucket: a histogram in a memory
//! ```
//! Counters show on what the clocks of a job were spent. Nothing in the engine depends on them.
//!
//! Lock rules: none, because counters only watch.

mod counters;
mod cycle_counters;
mod event_counter;
mod latencies;
mod latency_bucket;
mod latency_range;
mod visit_counters;

pub use counters::Counters;
pub use cycle_counters::CycleCounters;
pub use event_counter::{EventCounter, WideCounter};
pub use latencies::Latencies;
pub use latency_bucket::LatencyBucket;
pub use latency_range::LatencyRange;
pub use visit_counters::VisitCounters;
