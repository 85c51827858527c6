//! The register block: AXI4-Lite port, registers and counters.
//!
//! 1. `protocol/STREAM.md` says what stands where.
//!
//! Latency: see the blocks.

use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

use super::{Faults, RegisterPort, Registers, Traffic};

/// The register block; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RegisterBlock {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// An address to write is offered.
    pub s_axi_awvalid: Signal<In, Bit>,
    /// It is taken.
    pub s_axi_awready: Signal<Out, Bit>,
    /// It.
    pub s_axi_awaddr: Signal<In, Bits<12>>,
    /// Data to write is offered.
    pub s_axi_wvalid: Signal<In, Bit>,
    /// It is taken.
    pub s_axi_wready: Signal<Out, Bit>,
    /// It.
    pub s_axi_wdata: Signal<In, Bits<32>>,
    /// Its bytes that count.
    pub s_axi_wstrb: Signal<In, Bits<4>>,
    /// A write is answered.
    pub s_axi_bvalid: Signal<Out, Bit>,
    /// That is taken.
    pub s_axi_bready: Signal<In, Bit>,
    /// Whether it was done.
    pub s_axi_bresp: Signal<Out, Bits<2>>,
    /// An address to read is offered.
    pub s_axi_arvalid: Signal<In, Bit>,
    /// It is taken.
    pub s_axi_arready: Signal<Out, Bit>,
    /// It.
    pub s_axi_araddr: Signal<In, Bits<12>>,
    /// A read is answered.
    pub s_axi_rvalid: Signal<Out, Bit>,
    /// That is taken.
    pub s_axi_rready: Signal<In, Bit>,
    /// The value.
    pub s_axi_rdata: Signal<Out, Bits<32>>,
    /// Whether it is one.
    pub s_axi_rresp: Signal<Out, Bits<2>>,
    /// For the status.
    pub resets: Signal<In, Bit>,
    pub core_runs: Signal<In, Bit>,
    pub is_busy: Signal<In, Bit>,
    /// What happened to a command beat.
    pub took_command: Signal<In, Bit>,
    pub command_waited: Signal<In, Bit>,
    pub dropped: Signal<In, Bit>,
    /// What happened to an answer beat.
    pub took_answer: Signal<In, Bit>,
    pub answer_waited: Signal<In, Bit>,
    pub answer_ended: Signal<In, Bit>,
    /// An answer failed; its header.
    pub failed: Signal<In, Bit>,
    pub header: Signal<In, Bits<32>>,
    /// A reset is written to the control register.
    pub asks_reset: Signal<Out, Bit>,
    port: RegisterPort,
    registers: Registers,
    faults: Faults,
    traffic: Traffic,
}

impl RegisterBlock {
    /// The registers of a core of this configuration, behind streams of so many bits a beat.
    pub fn new(config: Config, beat_bits: usize) -> Self {
        Self { registers: Registers::new(config, beat_bits), ..Self::default() }
    }
}

impl Logic for RegisterBlock {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, port, faults, traffic);
        self.port.reset.next = self.reset.val();
        self.faults.reset.next = self.reset.val();
        self.traffic.reset.next = self.reset.val();
        self.port.s_axi_awvalid.next = self.s_axi_awvalid.val();
        self.s_axi_awready.next = self.port.s_axi_awready.val();
        self.port.s_axi_awaddr.next = self.s_axi_awaddr.val();
        self.port.s_axi_wvalid.next = self.s_axi_wvalid.val();
        self.s_axi_wready.next = self.port.s_axi_wready.val();
        self.port.s_axi_wdata.next = self.s_axi_wdata.val();
        self.port.s_axi_wstrb.next = self.s_axi_wstrb.val();
        self.s_axi_bvalid.next = self.port.s_axi_bvalid.val();
        self.port.s_axi_bready.next = self.s_axi_bready.val();
        self.s_axi_bresp.next = self.port.s_axi_bresp.val();
        self.port.s_axi_arvalid.next = self.s_axi_arvalid.val();
        self.s_axi_arready.next = self.port.s_axi_arready.val();
        self.port.s_axi_araddr.next = self.s_axi_araddr.val();
        self.s_axi_rvalid.next = self.port.s_axi_rvalid.val();
        self.port.s_axi_rready.next = self.s_axi_rready.val();
        self.s_axi_rdata.next = self.port.s_axi_rdata.val();
        self.s_axi_rresp.next = self.port.s_axi_rresp.val();

        self.registers.write_enable.next = self.port.write_enable.val();
        self.registers.write_address.next = self.port.write_address.val();
        self.registers.write_data.next = self.port.write_data.val();
        self.registers.write_bytes.next = self.port.write_bytes.val();
        self.port.write_is_known.next = self.registers.write_is_known.val();
        self.registers.read_enable.next = self.port.read_enable.val();
        self.registers.read_address.next = self.port.read_address.val();
        self.port.read_data.next = self.registers.read_data.val();
        self.port.read_is_known.next = self.registers.read_is_known.val();
        self.registers.resets.next = self.resets.val();
        self.registers.core_runs.next = self.core_runs.val();
        self.registers.is_busy.next = self.is_busy.val();
        self.faults.dropped.next = self.dropped.val();
        self.faults.failed.next = self.failed.val();
        self.faults.header.next = self.header.val();
        self.faults.clears_dropped.next = self.registers.clears_dropped.val();
        self.faults.clears_failed.next = self.registers.clears_failed.val();
        self.registers.was_dropped.next = self.faults.was_dropped.val();
        self.registers.has_failed.next = self.faults.has_failed.val();
        self.registers.fault.next = self.faults.fault.val();
        self.asks_reset.next = self.registers.asks_reset.val();

        self.traffic.keeps.next = self.registers.keeps_clocks.val();
        self.traffic.took_command.next = self.took_command.val();
        self.traffic.command_waited.next = self.command_waited.val();
        self.traffic.took_answer.next = self.took_answer.val();
        self.traffic.answer_ended.next = self.answer_ended.val();
        self.traffic.answer_waited.next = self.answer_waited.val();
        self.registers.clocks_low.next = self.traffic.clocks_low.val();
        self.registers.clocks_high.next = self.traffic.clocks_high.val();
        self.registers.command_beats.next = self.traffic.command_beats.val();
        self.registers.command_waits.next = self.traffic.command_waits.val();
        self.registers.answer_beats.next = self.traffic.answer_beats.val();
        self.registers.answers.next = self.traffic.answers.val();
        self.registers.answer_waits.next = self.traffic.answer_waits.val();
    }
}
