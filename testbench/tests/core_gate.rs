//! The cores pass the gate, with the probe and without; and what a small one takes on an ECP5 stays in bounds.

use incircle_hdl::export;
use incircle_hdl::predicate::VisitPredicates;
use incircle_hdl::top::CORE_NAME;
use incircle_protocol::{Config, NAMED, SMALL};
use incircle_testbench::gate;

fn core(config: Config, with_probe: bool) -> String {
    export::core(config, with_probe).unwrap()
}

#[test]
fn every_named_core_passes_lint_and_synthesis() {
    for config in NAMED {
        for with_probe in [false, true] {
            let passed = gate::pass(&core(config, with_probe), CORE_NAME);
            assert!(
                passed.is_ok(),
                "{} with probe {with_probe}: {}",
                config.name,
                passed.unwrap_err()
            );
        }
    }
}

#[test]
fn memories_and_multipliers_of_the_small_core_map_to_theirs() {
    let cells = gate::cell_count(&core(SMALL, false), CORE_NAME).unwrap();
    println!("incircle_core small on ECP5: {cells:?}");
    assert_eq!(cells.multipliers, VisitPredicates::MULTIPLIERS as u64);
    // One column of the triangle memory in flip-flops would be 2048 words of 30 bits.
    assert!(
        cells.block_ram > 0 && cells.flip_flops < 10_000,
        "{cells:?}"
    );
}
