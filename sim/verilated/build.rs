//! Compiles Verilator's runtime for the run side, and the models of this crate's own tests.

// A package cannot be its own build dependency, so the build side comes in as source. Not all of it is used here.
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
    Builder::new().model(adder).model(counter.trace(true).random_initial_state(true)).compile();
    // After the models: what they need stands behind them for the linker.
    build::compile_runtime(&Verilator::locate()?)
}
