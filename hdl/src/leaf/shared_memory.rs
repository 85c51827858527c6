//! A memory in block RAM with one port that reads and one port that reads or writes, where a second read port
//! would cost another copy.
//!
//! 1. Two reads, or a read and a write, can happen at every edge.
//! 2. Only the low `address_bits` of an address and the low `stored_bits` of a word count.
//! 3. In silicon, reading and writing one word at the same edge gives an undefined value, and so does `shared_data` for
//!    an edge that wrote. The design uses neither; simulation in Rust answers with a fixed pattern of alternating bits.
//! 4. A word is arbitrary until it is written.
//!
//! Latency: an address that is valid before edge 1 gives its data after edge 2 (array, output register), as in
//! `BlockMemory`. A word written at an edge can be read from the next edge on.
//!
//! Source: ECP5 block RAM as a true dual port memory with output registers. Such a memory is at most 18 bits wide, so
//! for fewer than 512 words it takes twice the blocks of `BlockMemory`. `no_rw_check` keeps synthesis from adding
//! bypass logic for rule 3.
//!
//! With `INCIRCLE_ECP5` defined and up to 14 address bits, the Verilog instantiates DP16KD with its output registers,
//! as many of them side by side as are needed to leave out a multiplexer. Otherwise the Verilog is plain, and any tool
//! maps it to its block memories.

use super::memory_shape::{assert_shape, low_part, unused_part, zero_extended, MAX_ADDRESS_BITS};
use rust_hdl_core::prelude::*;

use super::ecp5;

#[derive(LogicBlock)]
pub struct SharedMemory<const A: usize, const D: usize> {
    pub clock: Signal<In, Clock>,
    /// Address of the word to read.
    pub read_address: Signal<In, Bits<A>>,
    /// Value of the word read, zero above the stored bits.
    pub read_data: Signal<Out, Bits<D>>,
    /// Address of the word to write or to read at the shared port.
    pub shared_address: Signal<In, Bits<A>>,
    /// New value of that word.
    pub write_data: Signal<In, Bits<D>>,
    /// Write that word at this edge; otherwise read it.
    pub write_enable: Signal<In, Bit>,
    /// Value of the word read at the shared port, zero above the stored bits.
    pub shared_data: Signal<Out, Bits<D>>,
    _address_bits: usize,
    _stored_bits: usize,
    _stored_mask: Bits<D>,
    _memory: Vec<Bits<D>>,
    _array_read: Bits<D>,
    _shared_read: Bits<D>,
}

impl<const A: usize, const D: usize> SharedMemory<A, D> {
    /// Number of clock edges from an address to its data.
    pub const LATENCY: usize = 2;

    /// A memory of `2^address_bits` words of `stored_bits` bits.
    ///
    /// # Panics
    /// If `address_bits` is not in `1..=A` (and at most 20) or `stored_bits` not in `1..=D`.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        assert_shape(address_bits, A, stored_bits, D);
        Self {
            clock: Signal::default(),
            read_address: Signal::default(),
            read_data: Signal::default(),
            shared_address: Signal::default(),
            write_data: Signal::default(),
            write_enable: Signal::default(),
            shared_data: Signal::default(),
            _address_bits: address_bits,
            _stored_bits: stored_bits,
            _stored_mask: Bits::<D>::mask() >> (D - stored_bits) as u64,
            _memory: vec![Bits::default(); 1 << address_bits],
            _array_read: Bits::default(),
            _shared_read: Bits::default(),
        }
    }

    /// The word that simulation gives for a read that rule 3 leaves undefined.
    fn poison(&self) -> Bits<D> {
        (0..D).step_by(2).fold(Bits::default(), |word: Bits<D>, bit| word.replace_bit(bit, true)) & self._stored_mask
    }
}

impl<const A: usize, const D: usize> Default for SharedMemory<A, D> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for SharedMemory<A, D> {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self.read_data.next = self._array_read;
            self.shared_data.next = self._shared_read;
            let last = self._memory.len() - 1;
            let read = self.read_address.val().index() & last;
            let shared = self.shared_address.val().index() & last;
            self._array_read = self._memory[read];
            self._shared_read = self._memory[shared];
            if self.write_enable.val() {
                self._memory[shared] = self.write_data.val() & self._stored_mask;
                self._shared_read = self.poison();
                if shared == read {
                    self._array_read = self.poison();
                }
            }
        }
    }

    fn connect(&mut self) {
        self.read_data.connect();
        self.shared_data.connect();
    }

    fn hdl(&self) -> Verilog {
        let (address_bits, stored_bits) = (self._address_bits, self._stored_bits);
        let mut code = unused_part("read_address", A, address_bits);
        code += &unused_part("shared_address", A, address_bits);
        code += &unused_part("write_data", D, stored_bits);
        let read = low_part("read_address", A, address_bits);
        let shared = low_part("shared_address", A, address_bits);
        let data = low_part("write_data", D, stored_bits);
        let result = zero_extended("word", D, stored_bits);
        let shared_result = zero_extended("shared_word", D, stored_bits);
        let neutral = format!(
            "\
(* ram_style = \"block\", no_rw_check *)
reg [{top}:0] memory [0:{last}];
reg [{top}:0] word;
reg [{top}:0] shared_word;
always @(posedge clock) begin
    word <= memory[{read}];
    read_data <= {result};
end
always @(posedge clock) begin
    if (write_enable) memory[{shared}] <= {data};
    else shared_word <= memory[{shared}];
    shared_data <= {shared_result};
end
",
            top = stored_bits - 1,
            last = (1 << address_bits) - 1,
        );
        let memory = ecp5::Memory {
            address_bits,
            stored_bits,
            write_address: &shared,
            write_data: &data,
            read_address: &read,
            read_enable: "1'b1",
            result: &result,
            shared_result: Some(&shared_result),
        };
        code += &memory.verilog(&neutral);
        Verilog::Custom(code)
    }
}
