//! Verilates what this crate runs.

use verilated::build::{Builder, ModelSource};

fn main() {
    // For the tests of the device's streams, without a core behind them.
    match ModelSource::file("echo", "echo", "tests/echo.v") {
        Ok(echo) => Builder::new().model(echo.trace(true)).compile(),
        Err(error) => panic!("{error}"),
    }
}
