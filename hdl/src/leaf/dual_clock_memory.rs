//! A memory in block RAM that one clock writes and another clock reads.
//!
//! 1. Without `read_enable` both stages of the read port, array and output register, hold
//!    their values. Writes continue.
//! 2. Only the low `address_bits` of an address and the low `stored_bits` of a word count.
//! 3. In silicon, a word that is written at the same time as it is read, or less than a clock of either side before,
//!    reads as an undefined value. The design never uses such a read; simulation in Rust answers a read at the same
//!    time with a fixed pattern of alternating bits.
//! 4. A word is arbitrary until it is written.
//!
//! Latency: an address that is valid before an edge of `read_clock` with `read_enable` gives its data after
//! the next such edge.
//!
//! Source: block RAM with two clocks, which every family of FPGAs has. The Verilog is plain for all of them, because no
//! device with primitives of its own has two clocks yet.

use super::memory_shape::{assert_shape, low_part, unused_part, zero_extended};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct DualClockMemory<const A: usize, const D: usize> {
    /// Clock of the writes, which happen at its rising edge.
    pub write_clock: Signal<In, Clock>,
    /// Address of the word to write.
    pub write_address: Signal<In, Bits<A>>,
    /// New value of that word.
    pub write_data: Signal<In, Bits<D>>,
    /// Write the word at this edge.
    pub write_enable: Signal<In, Bit>,
    /// Clock of the reads, which happen at its rising edge.
    pub read_clock: Signal<In, Clock>,
    /// Address of the word to read.
    pub read_address: Signal<In, Bits<A>>,
    /// The read port advances at this edge.
    pub read_enable: Signal<In, Bit>,
    /// Value of the word read, zero above the stored bits.
    pub read_data: Signal<Out, Bits<D>>,
    _address_bits: usize,
    _stored_bits: usize,
    _stored_mask: Bits<D>,
    _memory: Vec<Bits<D>>,
    _array_read: Bits<D>,
}

impl<const A: usize, const D: usize> DualClockMemory<A, D> {
    /// Number of edges with `read_enable` from an address to its data.
    pub const LATENCY: usize = 2;

    /// A memory of `2^address_bits` words of `stored_bits` bits.
    ///
    /// # Panics
    /// If `address_bits` is not in `1..=A` (and at most 20) or `stored_bits` not in `1..=D`.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        assert_shape(address_bits, A, stored_bits, D);
        Self {
            write_clock: Signal::default(),
            write_address: Signal::default(),
            write_data: Signal::default(),
            write_enable: Signal::default(),
            read_clock: Signal::default(),
            read_address: Signal::default(),
            read_enable: Signal::default(),
            read_data: Signal::default(),
            _address_bits: address_bits,
            _stored_bits: stored_bits,
            _stored_mask: Bits::<D>::mask() >> (D - stored_bits) as u64,
            _memory: vec![Bits::default(); 1 << address_bits],
            _array_read: Bits::default(),
        }
    }

    /// The word that simulation gives for a read that meets a write of the same word.
    fn poison(&self) -> Bits<D> {
        (0..D).step_by(2).fold(Bits::default(), |word: Bits<D>, bit| word.replace_bit(bit, true)) & self._stored_mask
    }
}

impl<const A: usize, const D: usize> Default for DualClockMemory<A, D> {
    fn default() -> Self {
        Self::new(A.min(super::memory_shape::MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for DualClockMemory<A, D> {
    fn update(&mut self) {
        let last = self._memory.len() - 1;
        let written =
            (self.write_clock.pos_edge() && self.write_enable.val()).then(|| self.write_address.val().index() & last);
        if self.read_clock.pos_edge() && self.read_enable.val() {
            self.read_data.next = self._array_read;
            let read = self.read_address.val().index() & last;
            self._array_read = if written == Some(read) { self.poison() } else { self._memory[read] };
        }
        if let Some(written) = written {
            self._memory[written] = self.write_data.val() & self._stored_mask;
        }
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
(* ram_style = \"block\", no_rw_check *)
reg [{top}:0] memory [0:{last}];
reg [{top}:0] word;
always @(posedge write_clock) begin
    if (write_enable) memory[{write}] <= {data};
end
always @(posedge read_clock) begin
    if (read_enable) begin
        word <= memory[{read}];
        read_data <= {result};
    end
end
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
