//! Passes the cores through the gate, with the probe and without, and keeps the size of a small
//! core on an ECP5 in bounds.

use incircle_hdl::export;
use incircle_hdl::predicate::VisitPredicates;
use incircle_hdl::top::CORE_NAME;
use incircle_protocol::{Config, FULL, NAMED, SMALL};
use incircle_testbench::gate::{self, Cells};

/// The small core by Yosys 0.23, as `docs/core.md` has it.
const MEASURED: Cells = Cells {
    lut4: 5452,
    carry: 1218,
    distributed_ram: 269,
    flip_flops: 7770,
    multipliers: VisitPredicates::MULTIPLIERS as u64,
    block_ram: 27,
};

fn core(config: Config, with_probe: bool) -> String {
    export::core(config, with_probe).unwrap()
}

#[test]
fn every_named_core_passes_lint_and_synthesis() {
    for config in NAMED {
        for with_probe in [false, true] {
            let passed = gate::pass(&core(config, with_probe), CORE_NAME);
            assert!(passed.is_ok(), "{} with probe {with_probe}: {}", config.name, passed.unwrap_err());
        }
    }
}

#[test]
fn cores_with_runs_pass_lint_and_synthesis() {
    for config in [SMALL, FULL] {
        let passed = gate::pass(&export::core_with_runs(config, false).unwrap(), CORE_NAME);
        assert!(passed.is_ok(), "{} with runs: {}", config.name, passed.unwrap_err());
    }
}

#[test]
fn memories_and_multipliers_of_the_small_core_map_to_theirs() {
    let cells = gate::cell_count(&core(SMALL, false), CORE_NAME).unwrap();
    println!("incircle_core small on ECP5: {cells:?}");
    assert_eq!(cells.multipliers, MEASURED.multipliers);
    assert_eq!(cells.check_near(&MEASURED), Ok(()));
}
