//! The cores that lock-step runs.

use incircle_hdl::export;
use incircle_protocol::{Config, FULL, LARGE, SMALL, TINY};

/// A core with a fault that lock-step must find: name, and a piece of the Verilog that is replaced.
const FAULTS: [(&str, &str, &str); 3] = [
    // One comparison reversed: which of two sides is lower, in the walk.
    ("broken_comparison", "= e1_below_e0 & (~e2_below_e1);", "= (~e1_below_e0) & (~e2_below_e1);"),
    // One link write dropped.
    (
        "broken_link",
        "links$2$write_enable = write[(64'h0)+:(1)] & write[(64'h13)+:(1)];",
        "links$2$write_enable = 1'b0;",
    ),
    // One tie wrong: the apex is not asked.
    (
        "broken_tie",
        "takes_tie = (p_before_r1 & p_before_r2) | (r0_before_r1 & r0_before_r2);",
        "takes_tie = p_before_r1 & p_before_r2;",
    ),
];

/// Every core, with the probe.
pub fn all() -> Vec<(&'static str, String)> {
    let ring9 = Config { ring: 9, ..SMALL };
    let ring64 = Config { ring: 64, ..SMALL };
    let least = Config { points: 4, ring: 3, ..SMALL };
    let mut cores = vec![
        ("core_least", core(least)),
        ("core_tiny", core(TINY)),
        ("core_small", core(SMALL)),
        ("core_small_ring9", core(ring9)),
        ("core_small_ring64", core(ring64)),
        ("core_full", core(FULL)),
        ("core_large", core(LARGE)),
    ];
    for (name, sound, broken) in [] as [(&str, &str, &str); 0] {
        let verilog = core(SMALL);
        let places = verilog.matches(sound).count();
        assert_eq!(places, 1, "{name}: the Verilog holds {sound:?} {places} times, not once");
        cores.push((name, verilog.replace(sound, broken)));
    }
    cores
}

fn core(config: Config) -> String {
    export::core(config, true).unwrap_or_else(|error| panic!("core {}: {error}", config.name))
}
