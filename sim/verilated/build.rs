//! Compiles Verilator's runtime for the run side of this crate, and the models of this crate's own tests.

// A package cannot be its own build dependency, so the build side comes in as source. The script uses a part of it.
#[allow(dead_code)]
#[path = "src/build/mod.rs"]
pub mod build;

use build::{BuildError, Builder, ModelSource, Verilator};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=src/build");
    println!("cargo:rerun-if-changed=src/shim.hpp");
    if std::env::var_os("CARGO_FEATURE_RUN").is_none() {
        return;
    }
    if let Err(error) = compile() {
        panic!("{error}");
    }
}

fn compile() -> Result<(), BuildError> {
    let tests = "tests/models.v";
    let adder = ModelSource::file("wide_adder", "wide_adder", tests)?;
    let counter = ModelSource::file("counter", "counter", tests)?;
    let fast = ModelSource::file("fast_counter", "fast_counter", tests)?.fast_clocks(true);
    Builder::new()
        .model(adder)
        .model(counter.trace(true).random_initial_state(true))
        .model(fast.trace(true).optimisation(build::Optimisation::Fast))
        .compile();
    // The runtime comes after the models, since a linker looks for symbols only in what follows.
    build::compile_runtime(&Verilator::locate()?)
}
