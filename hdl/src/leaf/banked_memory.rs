//! A small memory in LUTs with a bank of words for each of many users: one write port, and one read port without
//! latency. The read port names its bank by one bit per bank.
//!
//! 1. `read_data` follows `read_banks` and `read_address` without a clock. A word written at an edge can be read
//!    right after that edge.
//! 2. Only the low `banks` bits of `read_banks`, the low `address_bits` of an address and the low `stored_bits` of a
//!    word count. A write to a bank that does not exist is lost.
//! 3. A word is arbitrary until it is written.
//!
//! Latency: none (combinational) from address to data.
//!
//! Source: distributed RAM. Each bank's word is masked with the bank's bit and all are joined by OR, which takes three
//! levels of LUTs for 16 banks of 32 words; choosing one of 512 words by its address takes five.

use super::memory_shape::{assert_shape, low_part, unused_part, zero_extended, MAX_ADDRESS_BITS};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct BankedMemory<const M: usize, const B: usize, const A: usize, const D: usize> {
    /// Clock of the writes, which happen at its rising edge.
    pub clock: Signal<In, Clock>,
    /// Bank and address of the word to write.
    pub write_bank: Signal<In, Bits<B>>,
    pub write_address: Signal<In, Bits<A>>,
    /// New value of that word.
    pub write_data: Signal<In, Bits<D>>,
    /// Write the word at this edge.
    pub write_enable: Signal<In, Bit>,
    /// Bit `b` reads bank `b`; at most one bit is high.
    pub read_banks: Signal<In, Bits<M>>,
    /// Address of the word to read.
    pub read_address: Signal<In, Bits<A>>,
    /// Value of the word read, zero above the stored bits; zero if no bank is named.
    pub read_data: Signal<Out, Bits<D>>,
    _banks: usize,
    _address_bits: usize,
    _stored_bits: usize,
    _stored_mask: Bits<D>,
    _memory: Vec<Bits<D>>,
}

impl<const M: usize, const B: usize, const A: usize, const D: usize> BankedMemory<M, B, A, D> {
    /// Number of clock edges from an address to its data.
    pub const LATENCY: usize = 0;

    /// A memory of `banks` times `2^address_bits` words of `stored_bits` bits.
    ///
    /// # Panics
    /// If `banks` is not in `1..=M`, `address_bits` not in `1..=A` (and at most 20), or `stored_bits` not in `1..=D`.
    pub fn new(banks: usize, address_bits: usize, stored_bits: usize) -> Self {
        assert!((1..=M).contains(&banks) && M <= 1 << B, "a memory here has 1 to {M} banks, not {banks}");
        assert_shape(address_bits, A, stored_bits, D);
        Self {
            clock: Signal::default(),
            write_bank: Signal::default(),
            write_address: Signal::default(),
            write_data: Signal::default(),
            write_enable: Signal::default(),
            read_banks: Signal::default(),
            read_address: Signal::default(),
            read_data: Signal::default(),
            _banks: banks,
            _address_bits: address_bits,
            _stored_bits: stored_bits,
            _stored_mask: Bits::<D>::mask() >> (D - stored_bits) as u64,
            _memory: vec![Bits::default(); banks << address_bits],
        }
    }

    /// Index of a word in the simulated memory.
    fn place(&self, bank: usize, address: usize) -> usize {
        bank << self._address_bits | address & ((1 << self._address_bits) - 1)
    }
}

impl<const M: usize, const B: usize, const A: usize, const D: usize> Default for BankedMemory<M, B, A, D> {
    fn default() -> Self {
        Self::new(M, A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const M: usize, const B: usize, const A: usize, const D: usize> Logic for BankedMemory<M, B, A, D> {
    fn update(&mut self) {
        let bank = self.write_bank.val().index();
        if self.clock.pos_edge() && self.write_enable.val() && bank < self._banks {
            let written = self.place(bank, self.write_address.val().index());
            self._memory[written] = self.write_data.val() & self._stored_mask;
        }
        let address = self.read_address.val().index();
        self.read_data.next = (0..self._banks)
            .filter(|bank| self.read_banks.val().get_bit(*bank))
            .fold(Bits::default(), |joined, bank| joined | self._memory[self.place(bank, address)]);
    }

    fn connect(&mut self) {
        self.read_data.connect();
    }

    fn hdl(&self) -> Verilog {
        let (banks, address_bits, stored_bits) = (self._banks, self._address_bits, self._stored_bits);
        let mut code = unused_part("read_banks", M, banks);
        code += &unused_part("write_address", A, address_bits);
        code += &unused_part("read_address", A, address_bits);
        code += &unused_part("write_data", D, stored_bits);
        let (top, last) = (stored_bits - 1, (1 << address_bits) - 1);
        let (data, write) = (low_part("write_data", D, stored_bits), low_part("write_address", A, address_bits));
        let read = low_part("read_address", A, address_bits);
        for bank in 0..banks {
            let selects = if M == 1 { "read_banks".to_string() } else { format!("read_banks[{bank}]") };
            code += &format!(
                "\
(* ram_style = \"distributed\" *)
reg [{top}:0] memory{bank} [0:{last}];
wire [{top}:0] word{bank} = memory{bank}[{read}] & {{{stored_bits}{{{selects}}}}};
always @(posedge clock) begin
    if (write_enable && write_bank == {B}'d{bank}) memory{bank}[{write}] <= {data};
end
"
            );
        }
        let words: Vec<String> = (0..banks).map(|bank| format!("word{bank}")).collect();
        code += &format!("wire [{top}:0] word = {};\n", words.join(" | "));
        code += &format!("always @(*) read_data = {};\n", zero_extended("word", D, stored_bits));
        Verilog::Custom(code)
    }
}
