//! Runs `LatencyBucket` in Rust and in Verilog beside a table of counts: all three must agree in every clock. The
//! bucket of a latency is the protocol's.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::LatencyBucket;
use incircle_protocol::{latency_bucket, latency_of_bucket, LATENCY_BITS, LATENCY_BUCKETS};
use incircle_testkit::SplitMix64;

named_ports!(LatencyBucket, [latency], [bucket], clock);

#[test]
fn latency_bucket_is_that_of_the_protocol() {
    let mut random = SplitMix64::new(40);
    let mut block = Stepper::new("latency_bucket", LatencyBucket::default(), 1);
    let edges = (0..LATENCY_BUCKETS).flat_map(|bucket| {
        let least = latency_of_bucket(bucket);
        [least - 1, least, least + 1]
    });
    let powers = (0..LATENCY_BITS).flat_map(|bit| [(1 << bit) - 1, 1 << bit, (1 << bit) + 1]);
    let all: Vec<u32> = edges
        .chain(powers)
        .chain(0..300)
        .chain((0..4000).map(|_| random.below(1 << LATENCY_BITS) as u32 >> random.below(LATENCY_BITS.into())))
        .chain([(1 << LATENCY_BITS) - 1])
        .collect();
    for latency in all {
        block.set("latency", latency);
        block.settle();
        block.edge();
        block.settle();
        block.edge();
        block.settle();
        block.expect("bucket", latency_bucket(latency) as u32);
    }
}
