//! Verilates every block that incircle-hdl exports, so that tests can run any of them by name.

use verilated::build::{Builder, ModelSource};

fn main() {
    let mut builder = Builder::new();
    for (name, verilog) in incircle_hdl::export::blocks() {
        builder = builder.model(
            ModelSource::new(&name, &name, verilog)
                .trace(true)
                .random_initial_state(true),
        );
    }
    builder.compile();
}
