//! Exports each named configuration of the core afresh, and the boards that are simulated, and verilates them.

#[path = "src/serial/board.rs"]
mod board;

use incircle_hdl::export;
use incircle_protocol::{FULL, SMALL};
use verilated::build::{Builder, ModelSource, Optimisation};

/// Root modules of the exported core and of the core behind its serial link.
const TOP: &str = "incircle_core";
const SERIAL_TOP: &str = "incircle_serial_top";

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
    for config in [SMALL, FULL] {
        let verilog = export::serial_top(config, board::board_link(config), false)
            .unwrap_or_else(|error| panic!("board {}: {error}", config.name));
        let name = format!("serial_{}", config.name);
        builder = builder.model(ModelSource::new(&name, SERIAL_TOP, verilog).optimisation(Optimisation::Fast));
    }
    // For the tests of the device's streams, without a core behind them.
    match ModelSource::file("echo", "echo", "tests/echo.v") {
        Ok(echo) => builder.model(echo.trace(true)).compile(),
        Err(error) => panic!("{error}"),
    }
}
