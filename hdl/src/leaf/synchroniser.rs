//! Two cells that bring a value from another clock.
//!
//! 1. Of a `sent` of several bits, one changes at a time (Gray code), or each is a flag on its own.
//!
//! Latency: 2 clocks, and where `sent` changes at the edge itself perhaps one more.
//!
//! In silicon the first cell may hang between 0 and 1 for a while; the second gives it a clock to decide. `ASYNC_REG` tells tools to
//! place both side by side, and to put nothing between them.

use rust_hdl_core::prelude::*;

/// Two cells; see the top of this file.
#[derive(LogicBlock)]
pub struct Synchroniser<T: Synth> {
    /// The receiver's; everything happens at its rising edge.
    pub clock: Signal<In, Clock>,
    /// A register of the sender's clock, with no logic behind it.
    pub sent: Signal<In, T>,
    /// Its value.
    pub received: Signal<Out, T>,
    _first: T,
}

impl<T: Synth> Synchroniser<T> {
    /// Edges from `sent` to `received`.
    pub const LATENCY: usize = 2;
    /// Name of the first cell in Verilog: what crosses between clocks ends there.
    pub const FIRST_CELL: &'static str = "first";
}

impl<T: Synth> Default for Synchroniser<T> {
    fn default() -> Self {
        Self { clock: Signal::default(), sent: Signal::default(), received: Signal::default(), _first: T::default() }
    }
}

impl<T: Synth> Logic for Synchroniser<T> {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self.received.next = self._first;
            self._first = self.sent.val();
        }
    }

    fn connect(&mut self) {
        self.received.connect();
    }

    fn hdl(&self) -> Verilog {
        let range = if T::BITS == 1 { String::new() } else { format!("[{}:0] ", T::BITS - 1) };
        let first = Self::FIRST_CELL;
        Verilog::Custom(format!(
            "\
(* ASYNC_REG = \"TRUE\" *) reg {range}{first};
(* ASYNC_REG = \"TRUE\" *) reg {range}second;
always @(posedge clock) begin
    {first} <= sent;
    second <= {first};
end
always @(*) received = second;
"
        ))
    }
}
