//! A memory in block RAM with one write port and one read port that can stand still, for users that may have to wait.
//!
//! 1. One write and one read can happen at every edge.
//! 2. Without `read_enable` both stages of the read port, array and output register, hold
//!    their values. Writes continue.
//! 3. Only the low `address_bits` of an address and the low `stored_bits` of a word count.
//! 4. In silicon, reading (with `read_enable`) and writing one word at the same edge gives an undefined value. The
//!    design never uses such a read; simulation in Rust answers it with a fixed pattern of alternating bits.
//! 5. A word is arbitrary until it is written.
//!
//! Latency: an address that is valid before an edge with `read_enable` gives its data after the next edge with
//! `read_enable`. A word written at an edge can be read from the next edge on.
//!
//! Source: [`BlockMemory`](super::BlockMemory) with the clock enables of an ECP5 block RAM.
//!
//! With `INCIRCLE_ECP5` defined and up to 14 address bits, the Verilog instantiates DP16KD with its output registers,
//! as many of them side by side as are needed to leave out a multiplexer. Otherwise the Verilog is plain, and any tool
//! maps it to its block memories.

use super::memory_shape::{assert_shape, low_part, unused_part, zero_extended, MAX_ADDRESS_BITS};
use rust_hdl_core::prelude::*;

use super::ecp5;

#[derive(LogicBlock)]
pub struct PacedMemory<const A: usize, const D: usize> {
    pub clock: Signal<In, Clock>,
    /// Address of the word to write.
    pub write_address: Signal<In, Bits<A>>,
    /// New value of that word.
    pub write_data: Signal<In, Bits<D>>,
    /// Write the word at this edge.
    pub write_enable: Signal<In, Bit>,
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

impl<const A: usize, const D: usize> PacedMemory<A, D> {
    /// Number of edges with `read_enable` from an address to its data.
    pub const LATENCY: usize = 2;

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

impl<const A: usize, const D: usize> Default for PacedMemory<A, D> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for PacedMemory<A, D> {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            let last = self._memory.len() - 1;
            let read = self.read_address.val().index() & last;
            let written = self.write_address.val().index() & last;
            let is_enabled = self.read_enable.val();
            if is_enabled {
                self.read_data.next = self._array_read;
                self._array_read = self._memory[read];
            }
            if self.write_enable.val() {
                self._memory[written] = self.write_data.val() & self._stored_mask;
                if is_enabled && written == read {
                    self._array_read = self.poison();
                }
            }
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
        let write = low_part("write_address", A, address_bits);
        let data = low_part("write_data", D, stored_bits);
        let read = low_part("read_address", A, address_bits);
        let result = zero_extended("word", D, stored_bits);
        let neutral = format!(
            "\
(* ram_style = \"block\", no_rw_check *)
reg [{top}:0] memory [0:{last}];
reg [{top}:0] word;
always @(posedge clock) begin
    if (write_enable) memory[{write}] <= {data};
    if (read_enable) begin
        word <= memory[{read}];
        read_data <= {result};
    end
end
",
            top = stored_bits - 1,
            last = (1 << address_bits) - 1,
        );
        let memory = ecp5::Memory {
            address_bits,
            stored_bits,
            write_address: &write,
            write_data: &data,
            read_address: &read,
            read_enable: "read_enable",
            result: &result,
            shared_result: None,
        };
        code += &memory.verilog(&neutral);
        Verilog::Custom(code)
    }
}
