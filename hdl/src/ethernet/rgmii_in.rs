//! The receiving pins of RGMII: makes GMII of data that comes at both edges of the PHY's clock.
//!
//! 1. The low half of a byte is on the pins at the rising edge and the high half at the falling edge behind it. The
//!    control pin says "valid" at the rising edge and "valid, or else error" at the falling one.
//! 2. With `INCIRCLE_ECP5` defined, the taps given to [`RgmiiIn::new`], 0 to 127 of 25 ps each, delay data and control,
//!    for a PHY that does not delay its clock. The right number is a matter of the board.
//!
//! Latency: the byte whose first half is on the pins at an edge is given behind the next edge.
//!
//! The bytes 35 and 52, then an error without a byte. A column shows the pins before an edge, and the rest behind it:
//! ```text
//! clock           /^^\__/^^\__/^^\__/^^\__/^^\__/^^\__/^^\__/^^\__/^^\__
//! control         ____________/^^^^^^^^^^^\__/^^\_______________________
//! pins              0  0  0  0  3  2  4  3  0  0  0  0  0  0  0  0  0  0
//! data_valid      __________________/^^^^^^^^^^^\_______________________
//! data              .  .  .  .  .  . 35 35 52 52  .  .  .  .  .  .  .  .
//! data_error      ______________________________/^^^^^\_________________
//! ```
//!
//! Source: RGMII 1.3 and 2.0; Lattice, ECP5 High-Speed I/O Interface, IDDRX1F and DELAYG. Without `INCIRCLE_ECP5` the
//! Verilog has plain registers at both edges.

use super::types::Byte;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RgmiiIn {
    /// Clock of the PHY, 125 MHz.
    pub clock: Signal<In, Clock>,
    /// The pins of the PHY: `rx_ctl` and `rxd`.
    pub control: Signal<In, Bit>,
    pub pins: Signal<In, Bits<4>>,
    /// The byte, whether there is one, and whether the PHY saw an error.
    pub data_valid: Signal<Out, Bit>,
    pub data_error: Signal<Out, Bit>,
    pub data: Signal<Out, Byte>,
    _delay: u8,
    _rising: u64,
    _falling: u64,
}

impl RgmiiIn {
    /// Pins whose data is delayed by this many taps on an ECP5.
    ///
    /// # Panics
    /// If there are more than 127 taps.
    pub fn new(delay: u8) -> Self {
        assert!(delay < 128, "a pin of an ECP5 is delayed by 0 to 127 taps, not {delay}");
        Self { _delay: delay, ..Self::default() }
    }
}

impl Logic for RgmiiIn {
    fn update(&mut self) {
        let pins = self.pins.val().to_u64() | u64::from(self.control.val()) << 4;
        if self.clock.neg_edge() {
            self._falling = pins;
        }
        if self.clock.pos_edge() {
            let (rising, falling) = (self._rising, self._falling);
            self._rising = pins;
            self.data.next = (rising & 15 | (falling & 15) << 4).into();
            self.data_valid.next = rising >> 4 == 1;
            self.data_error.next = rising >> 4 != falling >> 4;
        }
    }

    fn connect(&mut self) {
        self.data_valid.connect();
        self.data_error.connect();
        self.data.connect();
    }

    fn hdl(&self) -> Verilog {
        let delay = self._delay;
        Verilog::Custom(format!(
            "\
wire [4:0] all = {{control, pins}};
wire [4:0] rising;
wire [4:0] falling;
`ifdef INCIRCLE_ECP5
genvar pin;
generate for (pin = 0; pin < 5; pin = pin + 1) begin : each_pin
wire delayed;
DELAYG #(.DEL_MODE(\"USER_DEFINED\"), .DEL_VALUE({delay})) delay_line (.A(all[pin]), .Z(delayed));
IDDRX1F both_edges (.D(delayed), .SCLK(clock), .RST(1'b0), .Q0(rising[pin]), .Q1(falling[pin]));
end endgenerate
`else
reg [4:0] first;
reg [4:0] second;
reg [4:0] first_kept;
reg [4:0] second_kept;
always @(posedge clock) begin
    first <= all;
    first_kept <= first;
    second_kept <= second;
end
always @(negedge clock) second <= all;
assign rising = first_kept;
assign falling = second_kept;
`endif
always @(*) begin
    data = {{falling[3:0], rising[3:0]}};
    data_valid = rising[4];
    data_error = rising[4] ^ falling[4];
end
"
        ))
    }
}
