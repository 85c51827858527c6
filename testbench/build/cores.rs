//! The cores that lock-step runs: sound ones, and two with faults behind switches.

use incircle_hdl::export;
use incircle_hdl::top::CORE_NAME;
use incircle_protocol::{Config, FULL, LARGE, SMALL, TINY};

use super::faults::{Fault, Piece, CHANGE_FAULTS, FAULTS, QUESTION_FAULTS};

const ONE_CONTEXT: Config = Config { contexts: 1, ..SMALL };
const LONG_LIST: Config = Config { ring: 64, contexts: 8, ..SMALL };
const TWELVE_CONTEXTS: Config = Config { contexts: 12, ..SMALL };

/// A tiny chip of two engines.
pub const DUAL_TINY: Config = Config { engines: 2, ..TINY };
const QUAD_TINY: Config = Config { points: 16, engines: 4, ..TINY };
const DUAL_OF_64: Config = Config { points: 64, ring: 9, engines: 2, ..TINY };

/// A core in which eight contexts meet in a mesh of few records, with lists that overflow.
const CROWD: Config = Config { points: 64, ring: 6, contexts: 8, ..TINY };

/// The core whose text is rewritten for fast clocks, as the cores of `incircle-sim` are.
pub const FAST_CLOCKS: &str = "core_fast_clocks";

/// Name and Verilog of every core; each has the probe.
pub fn all() -> Vec<(&'static str, String)> {
    let ring9 = Config { ring: 9, ..SMALL };
    let ring64 = Config { ring: 64, ..SMALL };
    let least = Config { points: 4, ring: 3, ..SMALL };
    vec![
        ("core_least", core(least)),
        ("core_tiny", core(TINY)),
        ("core_tiny_questions", with_runs(TINY)),
        ("core_small_questions", with_runs(SMALL)),
        ("core_crowd_questions", with_runs(CROWD)),
        ("core_small", core(SMALL)),
        (FAST_CLOCKS, core(SMALL)),
        ("core_small_ring9", core(ring9)),
        ("core_small_ring64", core(ring64)),
        ("core_small_one", core(ONE_CONTEXT)),
        ("core_small_twelve", core(TWELVE_CONTEXTS)),
        ("core_full", core(FULL)),
        ("core_large", core(LARGE)),
        ("core_dual_tiny", core(DUAL_TINY)),
        ("core_quad_tiny", core(QUAD_TINY)),
        ("faulty_core_dual", with_broken_engine(DUAL_OF_64)),
        ("faulty_core_small", with_switches(&core(SMALL), FAULTS)),
        ("faulty_core_long_list", with_switches(&core(LONG_LIST), FAULTS)),
        ("faulty_core_questions", with_switches(&with_runs(TINY), QUESTION_FAULTS)),
        ("faulty_core_changes", with_switches(&with_runs(CROWD), CHANGE_FAULTS)),
    ]
}

fn core(config: Config) -> String {
    export::core(config, true).unwrap_or_else(|error| panic!("core {}: {error}", config.name))
}

fn with_runs(config: Config) -> String {
    export::core_with_runs(config, true).unwrap_or_else(|error| panic!("core {}: {error}", config.name))
}

/// A core with all these faults in its Verilog, each behind a switch: one bit of the port `faults` of the root module.
fn with_switches(sound: &str, faults: &[Fault]) -> String {
    let replaced = |text: &str, what: &str, place: &str, new: &str| {
        let places = text.matches(place).count();
        assert_eq!(places, 1, "{what}: the Verilog holds {place:?} {places} times, not once");
        text.replace(place, new)
    };
    let head = format!("module {CORE_NAME} (\n");
    let mut text = replaced(sound, "ports", &head, &format!("{head}    input wire [63:0] faults,\n"));
    for (place, Fault { name, pieces }) in faults.iter().enumerate() {
        for Piece { around, sound, broken } in *pieces {
            let switched = format!("({CORE_NAME}.faults[{place}] ? ({broken}) : ({sound}))");
            text = replaced(&text, name, &around.replace('@', sound), &around.replace('@', &switched));
        }
    }
    text
}

/// A chip of several engines of which engine 1 takes its own locks for those of another context, so that it gets stuck.
fn with_broken_engine(config: Config) -> String {
    let fault = FAULTS.iter().find(|fault| fault.name == "own_lock").expect("a fault of this name");
    let mut broken = 0;
    let design = core(config);
    let modules = design.split_inclusive("endmodule").map(|module| {
        let is_of_engine = module
            .split_once("module ")
            .is_some_and(|(_, text)| text.split(['(', ';']).next().is_some_and(|name| name.contains("$slot1$")));
        let mut text = module.to_string();
        for Piece { around, sound, broken: wrong } in fault.pieces.iter().filter(|_| is_of_engine) {
            let place = around.replace('@', sound);
            broken += text.matches(&place).count();
            text = text.replace(&place, &around.replace('@', wrong));
        }
        text
    });
    let text = modules.collect();
    assert_eq!(broken, fault.pieces.len(), "each place of the fault is once in an engine");
    text
}
