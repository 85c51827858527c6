//! One lock bit per word, with a port that tests and sets a lock and a port that clears one.
//!
//! 1. Every edge tests one lock, and with `test_set` also sets that lock. The test gives the lock as it
//!    was before the edge.
//! 2. With `clear_enable` the other port clears one lock; tests from the next edge on see it clear.
//! 3. The two ports never meet at one lock and one edge while the test sets it. Clearing and setting together has no
//!    winner in silicon, and simulation in Rust panics. A plain test that meets a clear is undefined in silicon;
//!    simulation in Rust answers `true`.
//! 4. Only the low `address_bits` of an address count.
//! 5. At power-up all locks are clear: a bitstream fills block RAM without stated contents with zeros, and simulation
//!    begins the same way. (Stating the zeros costs yosys most of a minute.) A reset does not clear the locks.
//!
//! Latency: an address that is valid before edge 1 gives `was_set` after edge 2, in step with `BlockMemory`.
//!
//! Source: one ECP5 block RAM of 16K x 1, true dual port, with port A in read-before-write mode.
//!
//! With `INCIRCLE_ECP5` defined and up to 14 address bits, the Verilog instantiates that block RAM. Otherwise the
//! Verilog is plain, and any tool maps it to its block memories.

use super::memory_shape::{assert_shape, low_part, unused_part, MAX_ADDRESS_BITS};
use rust_hdl_core::prelude::*;

use super::ecp5;

#[derive(LogicBlock)]
pub struct LockMemory<const A: usize> {
    pub clock: Signal<In, Clock>,
    /// Number of the lock to test.
    pub test_address: Signal<In, Bits<A>>,
    /// Set that lock at this edge.
    pub test_set: Signal<In, Bit>,
    /// The lock was set before the edge that tested it.
    pub was_set: Signal<Out, Bit>,
    /// Number of the lock to clear.
    pub clear_address: Signal<In, Bits<A>>,
    /// Clear that lock at this edge.
    pub clear_enable: Signal<In, Bit>,
    _address_bits: usize,
    _memory: Vec<bool>,
    _array_read: bool,
}

impl<const A: usize> LockMemory<A> {
    /// Number of clock edges from an address to `was_set`.
    pub const LATENCY: usize = 2;

    /// A memory of `2^address_bits` locks, all clear.
    ///
    /// # Panics
    /// If `address_bits` is not in `1..=A` (and at most 20).
    pub fn new(address_bits: usize) -> Self {
        assert_shape(address_bits, A, 1, 1);
        Self {
            clock: Signal::default(),
            test_address: Signal::default(),
            test_set: Signal::default(),
            was_set: Signal::default(),
            clear_address: Signal::default(),
            clear_enable: Signal::default(),
            _address_bits: address_bits,
            _memory: vec![false; 1 << address_bits],
            _array_read: false,
        }
    }
}

impl<const A: usize> Default for LockMemory<A> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS))
    }
}

impl<const A: usize> Logic for LockMemory<A> {
    fn update(&mut self) {
        if self.clock.pos_edge() {
            self.was_set.next = self._array_read;
            let last = self._memory.len() - 1;
            let tested = self.test_address.val().index() & last;
            let cleared = self.clear_address.val().index() & last;
            let meet = self.clear_enable.val() && tested == cleared;
            assert!(
                !(meet && self.test_set.val()),
                "lock {tested} is set and cleared at one clock edge: the two never may meet"
            );
            self._array_read = self._memory[tested] || meet;
            if self.test_set.val() {
                self._memory[tested] = true;
            }
            if self.clear_enable.val() {
                self._memory[cleared] = false;
            }
        }
    }

    fn connect(&mut self) {
        self.was_set.connect();
    }

    fn hdl(&self) -> Verilog {
        let address_bits = self._address_bits;
        let mut code = unused_part("test_address", A, address_bits);
        code += &unused_part("clear_address", A, address_bits);
        let test = low_part("test_address", A, address_bits);
        let clear = low_part("clear_address", A, address_bits);
        let neutral = format!(
            "\
(* ram_style = \"block\", no_rw_check *)
reg memory [0:{last}];
reg array_read;
`ifndef SYNTHESIS
integer word;
initial for (word = 0; word <= {last}; word = word + 1) memory[word] = 1'b0;
`endif
always @(posedge clock) begin
    array_read <= memory[{test}];
    if (test_set) memory[{test}] <= 1'b1;
    was_set <= array_read;
end
always @(posedge clock) begin
    if (clear_enable) memory[{clear}] <= 1'b0;
end
",
            last = (1 << address_bits) - 1,
        );
        code += &ecp5::locks(address_bits, &test, &clear, &neutral);
        Verilog::Custom(code)
    }
}
