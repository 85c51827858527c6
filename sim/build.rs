//! Exports each named configuration of the core afresh, and verilates it.

use incircle_hdl::export;
use verilated::build::{Builder, ModelSource, Optimisation};

/// Root module of the exported core.
const TOP: &str = "incircle_core";

fn main() {
    let mut builder = Builder::new();
    for config in incircle_protocol::NAMED {
        let verilog =
            export::core(config, false).unwrap_or_else(|error| panic!("configuration {}: {error}", config.name));
        builder = builder.model(
            ModelSource::new(&format!("core_{}", config.name), TOP, verilog)
                .trace(true)
                .optimisation(Optimisation::Fast),
        );
    }
    // For the tests of the device's streams, without a core behind them.
    match ModelSource::file("echo", "echo", "tests/echo.v") {
        Ok(echo) => builder.model(echo.trace(true)).compile(),
        Err(error) => panic!("{error}"),
    }
}
