//! A small memory in LUTs: one write port, and one read port without latency.
//!
//! 1. `read_data` follows `read_address` without a clock. A word written at an edge can be read right after that edge.
//! 2. Only the low `address_bits` of an address and the low `stored_bits` of a word count.
//! 3. A word is arbitrary until it is written.
//!
//! Latency: none (combinational) from address to data.
//!
//! Source: distributed RAM, TRELLIS_DPR16X4 on the ECP5 (16 words of 4 bits each).

use super::memory_shape::{assert_shape, low_part, unused_part, zero_extended, MAX_ADDRESS_BITS};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct LutMemory<const A: usize, const D: usize> {
    /// Clock of the writes, which happen at its rising edge.
    pub clock: Signal<In, Clock>,
    /// Address of the word to write.
    pub write_address: Signal<In, Bits<A>>,
    /// New value of that word.
    pub write_data: Signal<In, Bits<D>>,
    /// Write the word at this edge.
    pub write_enable: Signal<In, Bit>,
    /// Address of the word to read.
    pub read_address: Signal<In, Bits<A>>,
    /// Value of the word read, zero above the stored bits.
    pub read_data: Signal<Out, Bits<D>>,
    _address_bits: usize,
    _stored_bits: usize,
    _stored_mask: Bits<D>,
    _memory: Vec<Bits<D>>,
}

impl<const A: usize, const D: usize> LutMemory<A, D> {
    /// Number of clock edges from an address to its data.
    pub const LATENCY: usize = 0;

    /// A memory of `2^address_bits` words of `stored_bits` bits.
    ///
    /// # Panics
    /// If `address_bits` is not in `1..=A` (and at most 20) or `stored_bits` not in `1..=D`.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        assert_shape(address_bits, A, stored_bits, D);
        Self {
            clock: Signal::default(),
            write_address: Signal::default(),
            write_data: Signal::default(),
            write_enable: Signal::default(),
            read_address: Signal::default(),
            read_data: Signal::default(),
            _address_bits: address_bits,
            _stored_bits: stored_bits,
            _stored_mask: Bits::<D>::mask() >> (D - stored_bits) as u64,
            _memory: vec![Bits::default(); 1 << address_bits],
        }
    }
}

impl<const A: usize, const D: usize> Default for LutMemory<A, D> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for LutMemory<A, D> {
    fn update(&mut self) {
        let last = self._memory.len() - 1;
        if self.clock.pos_edge() && self.write_enable.val() {
            let written = self.write_address.val().index() & last;
            self._memory[written] = self.write_data.val() & self._stored_mask;
        }
        self.read_data.next = self._memory[self.read_address.val().index() & last];
    }

    fn connect(&mut self) {
        self.read_data.connect();
    }

    fn hdl(&self) -> Verilog {
        let (address_bits, stored_bits) = (self._address_bits, self._stored_bits);
        let mut code = unused_part("write_address", A, address_bits);
        code += &unused_part("read_address", A, address_bits);
        code += &unused_part("write_data", D, stored_bits);
        code += &format!(
            "\
(* ram_style = \"distributed\" *)
reg [{top}:0] memory [0:{last}];
wire [{top}:0] word = memory[{read}];
always @(posedge clock) begin
    if (write_enable) memory[{write}] <= {data};
end
always @(*) read_data = {result};
",
            top = stored_bits - 1,
            last = (1 << address_bits) - 1,
            write = low_part("write_address", A, address_bits),
            data = low_part("write_data", D, stored_bits),
            read = low_part("read_address", A, address_bits),
            result = zero_extended("word", D, stored_bits),
        );
        Verilog::Custom(code)
    }
}
