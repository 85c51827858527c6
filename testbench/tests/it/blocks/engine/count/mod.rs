//! Tests of the blocks in `hdl/src/engine/count`.

mod counters;
mod event_counter;
mod latencies;
mod latency_bucket;
mod latency_range;
