//! Writes registers of a PHY once after reset, over its management interface.
//!
//! 1. `mdc` runs at a 64th of the clock, 1.95 MHz at 125 MHz, where PHYs allow 2.5 MHz or more. `mdio_out` changes when
//!    `mdc` falls, and the PHY reads it when `mdc` rises.
//! 2. The first write begins 2^21 clocks after the reset, 16.8 ms at 125 MHz, because a PHY needs up to 10 ms after its
//!    own reset. A test may ask for less.
//! 3. The block never reads, so it drives `mdio_out` from the first write to the last, and lets go of the pin for good
//!    when `is_done` rises.
//!
//! Latency: 64 bits of 64 clocks for each write.
//!
//! The last two bits of a preamble, 01 for the start, 01 for a write, and the first bit of the address 5. A column is
//! 16 clocks:
//! ```text
//! mdc             ______/^^^^^\_____/^^^^^\_____/^^^^^\_____/^^^^^\_____/^^^^^\_____/^^^^^\_____/^^^^^
//! mdio_out        /^^^^^^^^^^^^^^^^^^^^^^^\___________/^^^^^^^^^^^\___________/^^^^^^^^^^^\___________
//! mdio_drives     /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! is_done         ____________________________________________________________________________________
//! ```
//!
//! Source: IEEE 802.3, clause 22.2.4.5: 32 ones, 01 start, 01 write, address of the PHY, register, 10, and 16 bits of
//! data, each highest bit first.

use crate::leaf::{LookupTable, Parameter};
use crate::prelude::*;

/// Most writes that the block holds.
const MOST_WRITES: usize = 8;

#[derive(LogicBlock, Default)]
pub struct MdioWriter {
    pub clock: Signal<In, Clock>,
    /// After a reset the block waits and then writes.
    pub reset: Signal<In, Bit>,
    /// The pins of the PHY; `mdio_drives` says that `mdio_out` is to be put on the pin.
    pub mdc: Signal<Out, Bit>,
    pub mdio_out: Signal<Out, Bit>,
    pub mdio_drives: Signal<Out, Bit>,
    /// All registers have been written.
    pub is_done: Signal<Out, Bit>,
    bits: LookupTable<8, Bit>,
    /// Clocks since the reset, or since the first write began: 6 bits for a period of `mdc`, 6 for a bit of a write,
    /// and then the number of the write.
    count: DFF<Bits<22>>,
    writes: DFF<Bit>,
    done: DFF<Bit>,
    out: DFF<Bit>,
    drives: DFF<Bit>,
    wait_clocks: Parameter<Bits<22>>,
    last_count: Parameter<Bits<22>>,
    one: Signal<Local, Bits<22>>,
    number: Signal<Local, Bits<3>>,
    place: Signal<Local, Bits<6>>,
    wide_number: Signal<Local, Bits<8>>,
    five: Signal<Local, Bits<8>>,
}

/// The 32 bits of a write behind its preamble, highest bit first.
fn frame(phy: u8, (register, value): (u8, u16)) -> u32 {
    0b0101 << 28 | u32::from(phy & 31) << 23 | u32::from(register & 31) << 18 | 0b10 << 16 | u32::from(value)
}

impl MdioWriter {
    /// A block that writes these registers of the PHY with this address, each a number and a value, in order. The wait
    /// is `2^wait_bits` clocks.
    ///
    /// # Panics
    /// If there are no writes, or more than 8, or if `wait_bits` is above 21.
    pub fn new(phy: u8, writes: &[(u8, u16)], wait_bits: u32) -> Self {
        let count = writes.len();
        assert!((1..=MOST_WRITES).contains(&count), "a PHY gets 1 to {MOST_WRITES} writes at its start, not {count}");
        assert!(wait_bits <= 21, "a PHY is waited for 2^21 clocks at most, not 2^{wait_bits}");
        let frames: Vec<u32> = writes.iter().map(|write| frame(phy, *write)).collect();
        let bit = |row: usize| frames.get(row / 32).is_some_and(|frame| frame >> (31 - row % 32) & 1 == 1);
        Self {
            bits: LookupTable::new(bit),
            wait_clocks: Parameter::new((1u64 << wait_bits).into()),
            last_count: Parameter::new(((count as u64) << 12).into()),
            ..Self::default()
        }
    }
}

impl Logic for MdioWriter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, count, writes, done, out, drives);
        self.one.next = 1.into();
        self.five.next = 5.into();
        self.mdc.next = self.count.q.val().get_bit(5) & self.writes.q.val();
        self.mdio_out.next = self.out.q.val();
        self.mdio_drives.next = self.drives.q.val();
        self.is_done.next = self.done.q.val();
        self.number.next = self.count.q.val().get_bits::<3>(12);
        self.place.next = self.count.q.val().get_bits::<6>(6);
        self.wide_number.next = bit_cast::<8, 3>(self.number.val()) << self.five.val();
        self.bits.index.next = self.wide_number.val() | bit_cast::<8, 5>(self.place.val().get_bits::<5>(0));
        self.out.d.next = self.bits.value.val() | (!self.place.val().get_bit(5));
        self.drives.d.next = self.writes.q.val();
        if !self.done.q.val() {
            self.count.d.next = self.count.q.val() + self.one.val();
        }
        if self.writes.q.val() & (self.count.q.val() == self.last_count.val()) {
            self.writes.d.next = false;
            self.done.d.next = true;
        }
        if (!self.writes.q.val()) & (!self.done.q.val()) & (self.count.q.val() == self.wait_clocks.val()) {
            self.writes.d.next = true;
            self.count.d.next = 0.into();
        }
        if self.reset.val() {
            self.count.d.next = 0.into();
            self.writes.d.next = false;
            self.done.d.next = false;
        }
    }
}
