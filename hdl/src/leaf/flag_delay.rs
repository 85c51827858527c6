//! Delays one bit by a fixed number of clocks, in plain registers.
//!
//! 1. There is no reset: the output is arbitrary until `stages` edges have passed.
//!
//! Latency: a flag that is valid before edge 1 is on the output after edge `stages`.
//!
//! Source: a shift register, of which the output is the last stage.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FlagDelay {
    pub clock: Signal<In, Clock>,
    /// The flag to delay, read at every edge.
    pub flag_in: Signal<In, Bit>,
    /// Value of `flag_in` `stages` edges ago.
    pub flag_out: Signal<Out, Bit>,
    _line: Vec<bool>,
}

impl FlagDelay {
    /// A delay of `stages` clocks.
    ///
    /// # Panics
    /// If `stages` is 0.
    pub fn new(stages: usize) -> Self {
        assert!(stages >= 1, "a flag delay has at least 1 stage, not 0");
        // The last stage is the output register.
        Self { _line: vec![false; stages - 1], ..Self::default() }
    }
}

impl Logic for FlagDelay {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self._line.insert(0, self.flag_in.val());
            if let Some(last) = self._line.pop() {
                self.flag_out.next = last;
            }
        }
    }

    fn connect(&mut self) {
        self.flag_out.connect();
    }

    fn hdl(&self) -> Verilog {
        let always = "always @(posedge clock)";
        Verilog::Custom(match self._line.len() {
            0 => format!("{always} flag_out <= flag_in;\n"),
            1 => format!("reg line;\n{always} {{flag_out, line}} <= {{line, flag_in}};\n"),
            held => format!("reg [{top}:0] line;\n{always} {{flag_out, line}} <= {{line, flag_in}};\n", top = held - 1),
        })
    }
}
