//! An AXI4-Lite port: turns the transactions of its five channels into single reads and writes of registers.
//!
//! 1. All outputs depend on registers only, so no `ready` waits for its `valid` and no `valid` for its `ready`. A
//!    response on offer stays until it is taken.
//! 2. The address and the data of a write may come in either order; together they make one write and one response. The
//!    address of a read makes one read and one response. Responses come in the order of the addresses.
//! 3. A response is SLVERR (2) if the register is not known, otherwise OKAY (0).
//!
//! Latency: 2 clocks to the response, from the later of address and data or from the address of a read, if the response
//! before has been taken.
//!
//! A write whose data comes first, and a read; `write` and `read` are the enables:
//! ```text
//! awvalid         ______/^^\_________________
//! awready         /^^^^^^^^\__/^^^^^^^^^^^^^^
//! wvalid          ___/^^\____________________
//! wready          /^^^^^\_____/^^^^^^^^^^^^^^
//! write           _________/^^\______________
//! bvalid          ____________/^^^^^\________
//! bready          _______________/^^\________
//! arvalid         ______/^^\_________________
//! read            _________/^^\______________
//! rvalid          ____________/^^\___________
//! rdata             .  .  .  .  5  .  .  .  .
//! ```

use super::axi::{Address, AxiLite};
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RegisterPort {
    /// The bus's clock; a reset forgets all transactions.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub s_axi: AxiLite,
    /// A register is written at this edge; `write_bytes` says which of the four bytes count.
    pub write_enable: Signal<Out, Bit>,
    pub write_address: Signal<Out, Address>,
    pub write_data: Signal<Out, Word>,
    pub write_bytes: Signal<Out, Bits<4>>,
    /// The address is that of a register that can be written.
    pub write_is_known: Signal<In, Bit>,
    /// A register is read at this edge.
    pub read_enable: Signal<Out, Bit>,
    pub read_address: Signal<Out, Address>,
    /// Value of the register; `read_is_known` says that the address is that of a register.
    pub read_data: Signal<In, Word>,
    pub read_is_known: Signal<In, Bit>,
    has_address: DFF<Bit>,
    address: DFF<Address>,
    has_data: DFF<Bit>,
    data: DFF<Word>,
    bytes: DFF<Bits<4>>,
    is_written: DFF<Bit>,
    write_response: DFF<Bits<2>>,
    has_read: DFF<Bit>,
    read_from: DFF<Address>,
    is_read: DFF<Bit>,
    value: DFF<Word>,
    read_response: DFF<Bits<2>>,
    writes: Signal<Local, Bit>,
    reads: Signal<Local, Bit>,
}

impl Logic for RegisterPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, has_address, address, has_data, data, bytes, is_written, write_response);
        dff_setup!(self, clock, has_read, read_from, is_read, value, read_response);

        // Address and data may come in either order, so each has a register of its own, and the write waits for both
        // and for the response before.
        self.s_axi.awready.next = !self.has_address.q.val();
        self.s_axi.wready.next = !self.has_data.q.val();
        self.s_axi.bvalid.next = self.is_written.q.val();
        self.s_axi.bresp.next = self.write_response.q.val();
        self.writes.next = self.has_address.q.val() & self.has_data.q.val() & (!self.is_written.q.val());
        self.write_enable.next = self.writes.val();
        self.write_address.next = self.address.q.val();
        self.write_data.next = self.data.q.val();
        self.write_bytes.next = self.bytes.q.val();
        if self.s_axi.bready.val() {
            self.is_written.d.next = false;
        }
        if !self.has_address.q.val() {
            self.has_address.d.next = self.s_axi.awvalid.val();
            self.address.d.next = self.s_axi.awaddr.val();
        }
        if !self.has_data.q.val() {
            self.has_data.d.next = self.s_axi.wvalid.val();
            self.data.d.next = self.s_axi.wdata.val();
            self.bytes.d.next = self.s_axi.wstrb.val();
        }
        if self.writes.val() {
            self.has_address.d.next = false;
            self.has_data.d.next = false;
            self.is_written.d.next = true;
            self.write_response.d.next = 2.into();
            if self.write_is_known.val() {
                self.write_response.d.next = 0.into();
            }
        }

        // A read waits until the response before it is taken, because there is one register for responses.
        self.s_axi.arready.next = !self.has_read.q.val();
        self.s_axi.rvalid.next = self.is_read.q.val();
        self.s_axi.rdata.next = self.value.q.val();
        self.s_axi.rresp.next = self.read_response.q.val();
        self.reads.next = self.has_read.q.val() & (!self.is_read.q.val());
        self.read_enable.next = self.reads.val();
        self.read_address.next = self.read_from.q.val();
        if self.s_axi.rready.val() {
            self.is_read.d.next = false;
        }
        if !self.has_read.q.val() {
            self.has_read.d.next = self.s_axi.arvalid.val();
            self.read_from.d.next = self.s_axi.araddr.val();
        }
        if self.reads.val() {
            self.has_read.d.next = false;
            self.is_read.d.next = true;
            self.value.d.next = self.read_data.val();
            self.read_response.d.next = 2.into();
            if self.read_is_known.val() {
                self.read_response.d.next = 0.into();
            }
        }

        if self.reset.val() {
            self.has_address.d.next = false;
            self.has_data.d.next = false;
            self.is_written.d.next = false;
            self.has_read.d.next = false;
            self.is_read.d.next = false;
        }
    }
}
