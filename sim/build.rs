//! Exports the named configurations of the core, and the simulated boards and cards, from `hdl`, and
//! translates them with Verilator.

#[path = "src/serial/board.rs"]
mod board;
#[path = "src/network/parameters.rs"]
mod network;
#[path = "build/states.rs"]
mod states;

use std::collections::BTreeSet;
use std::path::PathBuf;

use incircle_hdl::export;
use incircle_hdl::top::{UdpPins, UDP_TOP_NAME};
use incircle_hdl::udp::UdpParameters;
use incircle_protocol::{Config, DUAL, FULL, SMALL};
use verilated::build::{Builder, ModelSource, Optimisation};

/// Root modules: the core, the core behind its serial link, and the core behind its stream link. The one behind a UDP
/// link has its name from `hdl`.
const TOP: &str = "incircle_core";
const SERIAL_TOP: &str = "incircle_serial_top";
const STREAM_TOP: &str = "incircle_stream_top";
/// The cores with runs. A core more takes the C++ compiler a minute or more.
const LIVING: [Config; 1] = [SMALL];
/// The simulated cards, with the bits of their beats.
const CARDS: [(Config, u32); 3] = [(SMALL, 64), (SMALL, 128), (FULL, 64)];
/// Bits of a beat of the cards whose core has runs.
const LIVING_BEAT: u32 = 64;

fn main() {
    println!("cargo:rerun-if-env-changed=INCIRCLE_ONLY");
    // For work on a few models: if the variable is set, only models whose name begins with one of its prefixes,
    // separated by commas, are built.
    let only = std::env::var("INCIRCLE_ONLY").unwrap_or_default();
    let is_wanted = |name: &str| only.is_empty() || only.split(',').any(|prefix| name.starts_with(prefix));
    let mut builder = Builder::new();
    let mut enumerations = BTreeSet::new();
    for config in incircle_protocol::NAMED {
        let name = format!("core_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::core(config, false));
            enumerations.extend(states::named_states(&verilog));
            let source = ModelSource::new(&name, TOP, verilog.as_str()).fast_clocks(true);
            // What a model needs for waveforms costs up to a fifth of its speed, also while it writes none.
            let traced = ModelSource::new(&format!("traced_{name}"), TOP, verilog.as_str()).fast_clocks(true);
            builder = builder.model(source.optimisation(Optimisation::Fast)).model(traced.trace(true));
        }
    }
    for config in LIVING {
        let name = format!("living_core_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::core_with_runs(config, false));
            let source = ModelSource::new(&name, TOP, verilog).fast_clocks(true);
            builder = builder.model(source.optimisation(Optimisation::Fast));
        }
        let name = format!("living_serial_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::serial_top_with_runs(config, board::board_link(config), false));
            builder = builder.model(ModelSource::new(&name, SERIAL_TOP, verilog).optimisation(Optimisation::Fast));
        }
    }
    for config in LIVING {
        let name = format!("living_network_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::udp_top_with_runs(config, network(config), UdpPins::Gmii, false));
            builder = builder.model(ModelSource::new(&name, UDP_TOP_NAME, verilog).optimisation(Optimisation::Fast));
        }
        let name = format!("living_stream_{}_{LIVING_BEAT}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::stream_top_with_runs(config, LIVING_BEAT, false));
            builder = builder.model(ModelSource::new(&name, STREAM_TOP, verilog).optimisation(Optimisation::Fast));
        }
    }
    for config in [SMALL, FULL] {
        let name = format!("serial_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::serial_top(config, board::board_link(config), false));
            builder = builder.model(ModelSource::new(&name, SERIAL_TOP, verilog).optimisation(Optimisation::Fast));
        }
    }
    for config in [SMALL, FULL, DUAL] {
        let name = format!("network_{}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::udp_top(config, network(config), UdpPins::Gmii, false));
            builder = builder.model(ModelSource::new(&name, UDP_TOP_NAME, verilog).optimisation(Optimisation::Fast));
        }
    }
    for (config, beat_bits) in CARDS {
        let name = format!("stream_{}_{beat_bits}", config.name);
        if is_wanted(&name) {
            let verilog = exported(&name, export::stream_top(config, beat_bits, false));
            builder = builder.model(ModelSource::new(&name, STREAM_TOP, verilog).optimisation(Optimisation::Fast));
        }
    }
    write_states(&enumerations);
    // A small model for the tests of `SimDevice`, which need the two streams but no core.
    match ModelSource::file("echo", "echo", "tests/echo.v") {
        Ok(echo) => builder.model(echo.trace(true)).compile(),
        Err(error) => panic!("{error}"),
    }
}

/// The parameters of a simulated board on a network.
fn network(config: Config) -> UdpParameters {
    let (link, address, prefix) = (network::network_link(config), network::ADDRESS, network::PREFIX);
    UdpParameters { link, address, prefix, port: network::PORT }
}

/// Writes the named states of all cores into a file that the crate includes.
fn write_states(states: &BTreeSet<String>) {
    let text: String = states.iter().flat_map(|state| [state, "\n"]).collect();
    let folder = std::env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    let path = folder.join("states.txt");
    std::fs::write(&path, text).unwrap_or_else(|error| panic!("cannot write {}: {error}", path.display()));
}

fn exported(name: &str, verilog: Result<String, export::ExportError>) -> String {
    verilog.unwrap_or_else(|error| panic!("{name}: {error}"))
}
