//! Verilates every block that incircle-hdl exports, and whole cores for lock-step, sound ones and broken ones, so that tests can
//! run any of them by name.

#[path = "build/cores.rs"]
mod cores;

use verilated::build::{Builder, ModelSource, Optimisation};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=build/cores.rs");
    let mut builder = Builder::new();
    for (name, verilog) in incircle_hdl::export::blocks() {
        builder = builder.model(ModelSource::new(&name, &name, verilog).trace(true).random_initial_state(true));
    }
    for (name, verilog) in cores::all() {
        builder = builder.model(
            ModelSource::new(name, incircle_hdl::top::CORE_NAME, verilog)
                .trace(true)
                .random_initial_state(true)
                .optimisation(Optimisation::Fast),
        );
    }
    builder.compile();
}
