//! Verilates what the tests run by name: every block that `incircle-hdl` exports, whole cores for lock-step (sound ones
//! and ones with faults), a core as the netlist that synthesis makes of it, stream links and boards. All but netlists
//! and boards are built without the initial values of their flip-flops, so they start at random.

#[path = "build/boards.rs"]
mod boards;
#[path = "build/cells.rs"]
mod cells;
#[path = "build/cores.rs"]
mod cores;
#[path = "src/lockstep/faults.rs"]
mod faults;
#[path = "build/initial.rs"]
mod initial;
#[path = "build/netlists.rs"]
mod netlists;
#[path = "build/streams.rs"]
mod streams;

use initial::without_initial_values;
use verilated::build::{Builder, ModelSource, Optimisation};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=build/boards.rs");
    println!("cargo:rerun-if-changed=build/cells.rs");
    println!("cargo:rerun-if-changed=build/cores.rs");
    println!("cargo:rerun-if-changed=build/initial.rs");
    println!("cargo:rerun-if-changed=build/netlists.rs");
    println!("cargo:rerun-if-changed=build/streams.rs");
    println!("cargo:rerun-if-changed=src/lockstep/faults.rs");
    println!("cargo:rerun-if-changed=cells");
    println!("cargo:rerun-if-changed=../constraints");
    println!("cargo:rerun-if-env-changed=INCIRCLE_ONLY");
    // For work on a few blocks: `INCIRCLE_ONLY` lists prefixes, separated by commas, and only models whose name begins
    // with one of them are built.
    let only = std::env::var("INCIRCLE_ONLY").unwrap_or_default();
    let is_wanted = |name: &str| only.is_empty() || only.split(',').any(|prefix| name.starts_with(prefix));
    let mut builder = Builder::new();
    for (name, verilog) in incircle_blocks::blocks().into_iter().filter(|(name, _)| is_wanted(name)) {
        let verilog = without_initial_values(&verilog);
        let block = |model: &str, text| ModelSource::new(model, &name, text).trace(true).random_initial_state(true);
        if let Some(with_primitives) = cells::with_primitives(&name, &verilog) {
            builder = builder.model(block(&format!("{name}_ecp5"), with_primitives));
        }
        builder = builder.model(block(&name, verilog));
    }
    let cores = if only.is_empty() || only.contains("core") { cores::all() } else { Vec::new() };
    for (name, verilog) in cores.into_iter().filter(|(name, _)| is_wanted(name)) {
        builder = builder.model(
            ModelSource::new(name, incircle_hdl::top::CORE_NAME, without_initial_values(&verilog))
                .trace(true)
                .random_initial_state(true)
                .optimisation(Optimisation::Fast)
                .fast_clocks(name == cores::FAST_CLOCKS),
        );
    }
    let netlists = if only.is_empty() || only.contains("netlist") {
        netlists::all(only.contains("netlist_living"))
    } else {
        Vec::new()
    };
    for (name, verilog) in netlists.into_iter().filter(|(name, _)| is_wanted(name)) {
        // A netlist is compiled without optimisation: the text is large, and runs no
        // more than some hundred thousand clocks.
        builder =
            builder.model(ModelSource::new(name, incircle_hdl::top::CORE_NAME, verilog).random_initial_state(true));
    }
    let streams = if only.is_empty() || only.contains("stream") { streams::all() } else { Vec::new() };
    for (name, verilog) in streams.into_iter().filter(|(name, _)| is_wanted(name)) {
        builder = builder.model(
            ModelSource::new(name, incircle_hdl::top::STREAM_TOP_NAME, without_initial_values(&verilog))
                .random_initial_state(true)
                .optimisation(Optimisation::Fast),
        );
    }
    for (name, verilog) in boards::all().into_iter().filter(|(name, _)| is_wanted(name)) {
        builder = builder.model(ModelSource::new(&name, boards::NAME, verilog).random_initial_state(true));
    }
    builder.compile();
}
