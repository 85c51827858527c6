//! Two cells that bring a value from one clock into another.
//!
//! 1. If `sent` has several bits, either only one changes at a time (Gray code), or each is a flag of its own.
//!
//! Latency: 2 clocks, and perhaps one more if `sent` changes at the very edge.
//!
//! In silicon the first cell may be neither 0 nor 1 for a while; the second cell gives it a clock to settle.
//! `ASYNC_REG` makes tools place both side by side, and put nothing between them.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct Synchroniser<T: Synth> {
    /// Clock of the receiver; all happens at its rising edge.
    pub clock: Signal<In, Clock>,
    /// A register of the sender's clock, with no logic behind it.
    pub sent: Signal<In, T>,
    /// Value of `sent` in the receiver's clock.
    pub received: Signal<Out, T>,
    _first: T,
}

impl<T: Synth> Synchroniser<T> {
    /// Number of clock edges from `sent` to `received`.
    pub const LATENCY: usize = 2;
    /// Name of the first cell in the Verilog, at which every path between the clocks must end.
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
