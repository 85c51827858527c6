//! The cores that lock-step runs.

use incircle_hdl::export;
use incircle_protocol::{Config, FULL, LARGE, SMALL, TINY};

/// A core with a fault that lock-step must find: name, configuration, and the pieces of its Verilog that are replaced.
struct Fault {
    name: &'static str,
    config: Config,
    pieces: &'static [(&'static str, &'static str)],
}

const FAULTS: [Fault; 7] = [
    // One comparison reversed: which of two sides is lower, in the walk.
    Fault {
        name: "broken_comparison",
        config: SMALL,
        pieces: &[("= e1_below_e0 & (~e2_below_e1);", "= (~e1_below_e0) & (~e2_below_e1);")],
    },
    // One link column never written.
    Fault {
        name: "broken_link",
        config: SMALL,
        pieces: &[("links$2$write_enable = enables[(64'h3)+:(1)];", "links$2$write_enable = 1'b0;")],
    },
    // One tie wrong: the apex is not asked.
    Fault {
        name: "broken_tie",
        config: SMALL,
        pieces: &[(
            "takes_tie = (p_before_r1 & p_before_r2) | (r0_before_r1 & r0_before_r2);",
            "takes_tie = p_before_r1 & p_before_r2;",
        )],
    },
    // A test does not mind that another context holds the lock.
    Fault {
        name: "broken_foreign_lock",
        config: SMALL,
        pieces: &[
            ("test_counts$d = tests & (~foreign);", "test_counts$d = tests;"),
            ("test_is_refused$d = tests & foreign & (~is_waiter);", "test_is_refused$d = 1'b0;"),
        ],
    },
    // Locks are released when the ring is finished, before the star is written.
    Fault {
        name: "broken_release",
        config: SMALL,
        pieces: &[
            ("lock_release$commit_enable = commit$ends;", "lock_release$commit_enable = commit_enable;"),
            (
                "lock_release$commit_job[(64'h0)+:(5)] = commit$job[(64'h0)+:(5)];",
                "lock_release$commit_job[(64'h0)+:(5)] = commit_job[(64'h0)+:(5)];",
            ),
            (
                "lock_release$commit_job[(64'h5)+:(7)] = commit$job[(64'h1b)+:(7)];",
                "lock_release$commit_job[(64'h5)+:(7)] = commit_job[(64'h1b)+:(7)];",
            ),
        ],
    },
    // A locked root is believed to hold the point still.
    Fault {
        name: "broken_root",
        config: SMALL,
        pieces: &[
            ("opens = root_is_held$q & is_located;", "opens = root_is_held$q;"),
            ("(root_is_held$q & is_located)", "root_is_held$q"),
            ("retries = root_is_held$q & (~verdict[(64'h1)+:(1)]);", "retries = 1'b0;"),
            ("root_duplicate = root_is_held$q & is_corner;", "root_duplicate = 1'b0;"),
        ],
    },
    // A walk does not mind that a record is not written yet.
    Fault {
        name: "broken_watermark",
        config: ONE_CONTEXT_LONG_LIST,
        pieces: &[("again1$d = is_torn | (~is_written);", "again1$d = is_torn;")],
    },
];

const ONE_CONTEXT: Config = Config { contexts: 1, ..SMALL };
const ONE_CONTEXT_LONG_LIST: Config = Config { ring: 64, contexts: 1, ..SMALL };
const SIXTEEN_CONTEXTS: Config = Config { contexts: 16, ..SMALL };

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
        ("core_small_one", core(ONE_CONTEXT)),
        ("core_small_sixteen", core(SIXTEEN_CONTEXTS)),
        ("core_long_list_one", core(ONE_CONTEXT_LONG_LIST)),
        ("core_full", core(FULL)),
        ("core_large", core(LARGE)),
    ];
    for Fault { name, config, pieces } in FAULTS {
        let mut verilog = core(config);
        for (sound, broken) in pieces {
            let places = verilog.matches(sound).count();
            assert_eq!(places, 1, "{name}: the Verilog holds {sound:?} {places} times, not once");
            verilog = verilog.replace(sound, broken);
        }
        cores.push((name, verilog));
    }
    cores
}

fn core(config: Config) -> String {
    export::core(config, true).unwrap_or_else(|error| panic!("core {}: {error}", config.name))
}
