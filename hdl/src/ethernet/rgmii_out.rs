//! The sending pins of RGMII: puts the bytes of GMII on the pins at both edges of the clock.
//!
//! 1. The low half of a byte is on the pins while the clock is high, the high half while the clock is low. The pin of
//!    the clock follows the clock itself, so that something must delay it by about 2 ns: the PHY, the board, or the
//!    pin.
//! 2. With `INCIRCLE_ECP5` defined, the taps given to [`RgmiiOut::new`], 0 to 127 of 25 ps each, delay the pin of the
//!    clock. The right number is a matter of the board.
//!
//! Latency: a byte that is valid before an edge is on the pins behind the next edge.
//!
//! The bytes 35 and 52, in two columns a clock:
//! ```text
//! data_valid      ______/^^^^^^^^^^^\_________________
//! data              .  . 35 35 52 52  .  .  .  .  .  .
//! clock_pin       /^^\__/^^\__/^^\__/^^\__/^^\__/^^\__
//! control         ____________/^^^^^^^^^^^\___________
//! pins              .  .  .  .  3  2  4  3  .  .  .  .
//! ```
//!
//! Source: RGMII 1.3 and 2.0; Lattice, ECP5 High-Speed I/O Interface, ODDRX1F and DELAYG. Without `INCIRCLE_ECP5` the
//! Verilog has plain registers, and a choice by the level of the clock.

use super::types::Byte;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RgmiiOut {
    /// Clock of the bytes, 125 MHz.
    pub clock: Signal<In, Clock>,
    /// The byte, and whether there is one.
    pub data_valid: Signal<In, Bit>,
    pub data: Signal<In, Byte>,
    /// The pins of the PHY: `tx_clk`, `tx_ctl` and `txd`.
    pub clock_pin: Signal<Out, Bit>,
    pub control: Signal<Out, Bit>,
    pub pins: Signal<Out, Bits<4>>,
    _delay: u8,
    _first: u64,
    _held: u64,
}

impl RgmiiOut {
    /// Pins whose clock is delayed by this many taps on an ECP5.
    ///
    /// # Panics
    /// If there are more than 127 taps.
    pub fn new(delay: u8) -> Self {
        assert!(delay < 128, "a pin of an ECP5 is delayed by 0 to 127 taps, not {delay}");
        Self { _delay: delay, ..Self::default() }
    }
}

impl Logic for RgmiiOut {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self._held = self._first;
            self._first = self.data.val().to_u64() | u64::from(self.data_valid.val()) << 8;
        }
        let is_high = self.clock.val().clk;
        let half = if is_high { self._held & 15 } else { self._held >> 4 & 15 };
        self.clock_pin.next = is_high;
        self.control.next = self._held >> 8 == 1;
        self.pins.next = half.into();
    }

    fn connect(&mut self) {
        self.clock_pin.connect();
        self.control.connect();
        self.pins.connect();
    }

    fn hdl(&self) -> Verilog {
        let delayed = match self._delay {
            0 => "wire clock_out = out[5];\n".to_string(),
            delay => format!(
                "wire clock_out;\nDELAYG #(.DEL_MODE(\"USER_DEFINED\"), .DEL_VALUE({delay})) delay_line (\
                 .A(out[5]), .Z(clock_out));\n"
            ),
        };
        Verilog::Custom(format!(
            "\
`ifdef INCIRCLE_ECP5
wire [5:0] high = {{1'b1, data_valid, data[3:0]}};
wire [5:0] low = {{1'b0, data_valid, data[7:4]}};
wire [5:0] out;
genvar pin;
generate for (pin = 0; pin < 6; pin = pin + 1) begin : each_pin
ODDRX1F both_edges (.D0(high[pin]), .D1(low[pin]), .SCLK(clock), .RST(1'b0), .Q(out[pin]));
end endgenerate
{delayed}always @(*) {{clock_pin, control, pins}} = {{clock_out, out[4:0]}};
`else
reg [8:0] first;
reg [8:0] held;
always @(posedge clock) begin
    first <= {{data_valid, data}};
    held <= first;
end
always @(*) begin
    clock_pin = clock;
    control = held[8];
    pins = clock ? held[3:0] : held[7:4];
end
`endif
"
        ))
    }
}
