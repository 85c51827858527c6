//! An 18 x 18 bit signed multiplier with the three register stages of a DSP block.
//!
//! 1. The block takes a new pair of factors at every edge.
//! 2. There is no reset: the product is arbitrary until [`LATENCY`](Multiplier::LATENCY) edges have passed.
//!
//! Latency: factors that are valid before edge 1 give their product after edge 3 (input registers,
//! pipeline register, output register).
//!
//! Source: the register stages of MULT18X18D (Lattice, ECP5 sysDSP usage guide). 36 bits hold every product: the
//! largest is `(-2^17)^2 = 2^34`.
//!
//! With `INCIRCLE_ECP5` defined, the Verilog instantiates the primitive and so uses its registers. Otherwise the
//! Verilog is plain, and any tool maps it to its multipliers.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Multiplier {
    pub clock: Signal<In, Clock>,
    /// The two factors, in two's complement.
    pub a: Signal<In, Bits<18>>,
    pub b: Signal<In, Bits<18>>,
    /// The product `a * b`, in two's complement.
    pub product: Signal<Out, Bits<36>>,
    _a_input: i64,
    _b_input: i64,
    _pipeline: i64,
}

impl Multiplier {
    /// Number of clock edges from factors to product.
    pub const LATENCY: usize = 3;
    /// Number of bits of a factor.
    pub const FACTOR_BITS: usize = 18;
    /// Number of bits of the product.
    pub const PRODUCT_BITS: usize = 36;
}

/// The value of 18 bits in two's complement.
fn factor_value(bits: Bits<18>) -> i64 {
    let unused = i64::BITS - 18;
    ((bits.to_u64() << unused) as i64) >> unused
}

/// A value as 36 bits in two's complement.
fn product_bits(value: i64) -> Bits<36> {
    Bits::from(value as u64 & ((1 << 36) - 1))
}

const VERILOG: &str = "\
`ifdef INCIRCLE_ECP5
wire [35:0] dsp_product;
MULT18X18D #(
    .REG_INPUTA_CLK(\"CLK0\"), .REG_INPUTB_CLK(\"CLK0\"), .REG_INPUTC_CLK(\"NONE\"),
    .REG_PIPELINE_CLK(\"CLK0\"), .REG_OUTPUT_CLK(\"CLK0\")
) dsp (
    .CLK0(clock), .CLK1(1'b0), .CLK2(1'b0), .CLK3(1'b0),
    .CE0(1'b1), .CE1(1'b1), .CE2(1'b1), .CE3(1'b1),
    .RST0(1'b0), .RST1(1'b0), .RST2(1'b0), .RST3(1'b0),
    .SIGNEDA(1'b1), .SIGNEDB(1'b1), .SOURCEA(1'b0), .SOURCEB(1'b0),
    .A0(a[0]), .A1(a[1]), .A2(a[2]), .A3(a[3]), .A4(a[4]), .A5(a[5]),
    .A6(a[6]), .A7(a[7]), .A8(a[8]), .A9(a[9]), .A10(a[10]), .A11(a[11]),
    .A12(a[12]), .A13(a[13]), .A14(a[14]), .A15(a[15]), .A16(a[16]), .A17(a[17]),
    .B0(b[0]), .B1(b[1]), .B2(b[2]), .B3(b[3]), .B4(b[4]), .B5(b[5]),
    .B6(b[6]), .B7(b[7]), .B8(b[8]), .B9(b[9]), .B10(b[10]), .B11(b[11]),
    .B12(b[12]), .B13(b[13]), .B14(b[14]), .B15(b[15]), .B16(b[16]), .B17(b[17]),
    .P0(dsp_product[0]), .P1(dsp_product[1]), .P2(dsp_product[2]), .P3(dsp_product[3]),
    .P4(dsp_product[4]), .P5(dsp_product[5]), .P6(dsp_product[6]), .P7(dsp_product[7]),
    .P8(dsp_product[8]), .P9(dsp_product[9]), .P10(dsp_product[10]), .P11(dsp_product[11]),
    .P12(dsp_product[12]), .P13(dsp_product[13]), .P14(dsp_product[14]), .P15(dsp_product[15]),
    .P16(dsp_product[16]), .P17(dsp_product[17]), .P18(dsp_product[18]), .P19(dsp_product[19]),
    .P20(dsp_product[20]), .P21(dsp_product[21]), .P22(dsp_product[22]), .P23(dsp_product[23]),
    .P24(dsp_product[24]), .P25(dsp_product[25]), .P26(dsp_product[26]), .P27(dsp_product[27]),
    .P28(dsp_product[28]), .P29(dsp_product[29]), .P30(dsp_product[30]), .P31(dsp_product[31]),
    .P32(dsp_product[32]), .P33(dsp_product[33]), .P34(dsp_product[34]), .P35(dsp_product[35])
);
always @(*) product = dsp_product;
`else
reg signed [17:0] a_input;
reg signed [17:0] b_input;
reg signed [35:0] pipeline;
always @(posedge clock) begin
    a_input <= a;
    b_input <= b;
    pipeline <= a_input * b_input;
    product <= pipeline;
end
`endif
";

impl Logic for Multiplier {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self.product.next = product_bits(self._pipeline);
            self._pipeline = self._a_input * self._b_input;
            self._a_input = factor_value(self.a.val());
            self._b_input = factor_value(self.b.val());
        }
    }

    fn connect(&mut self) {
        self.product.connect();
    }

    fn hdl(&self) -> Verilog {
        Verilog::Custom(VERILOG.to_string())
    }
}
