//! A whole device: the core behind its stream link.
//!
//! 1. `bus_reset_n` is needed once, after power-up. The core's reset follows from it.
//!
//! Latency: see the blocks.

use super::Core;
use crate::engine::Write;
use crate::stream::StreamLink;
use incircle_protocol::{Config, ConfigError};
use rust_hdl_core::prelude::*;

/// The core behind its stream link; see the top of this file.
#[derive(LogicBlock)]
pub struct StreamTop<const W: usize, const K: usize, const E: usize> {
    /// Clock and reset of the AXI ports; the reset is active low and synchronous.
    pub bus_clock: Signal<In, Clock>,
    pub bus_reset_n: Signal<In, Bit>,
    /// A command beat is offered.
    pub s_axis_tvalid: Signal<In, Bit>,
    /// It is taken.
    pub s_axis_tready: Signal<Out, Bit>,
    /// It.
    pub s_axis_tdata: Signal<In, Bits<W>>,
    /// Its bytes.
    pub s_axis_tkeep: Signal<In, Bits<K>>,
    /// An answer beat is offered.
    pub m_axis_tvalid: Signal<Out, Bit>,
    /// It is taken.
    pub m_axis_tready: Signal<In, Bit>,
    /// It.
    pub m_axis_tdata: Signal<Out, Bits<W>>,
    /// Its bytes: all.
    pub m_axis_tkeep: Signal<Out, Bits<K>>,
    /// It is the last one of its answer.
    pub m_axis_tlast: Signal<Out, Bit>,
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
    /// Clock of the core.
    pub core_clock: Signal<In, Clock>,
    /// The write port of the triangle memory, in the core's clock, for simulation.
    pub write: Signal<Out, Write>,
    core: Core,
    link: StreamLink<W, K, E>,
}

impl<const W: usize, const K: usize, const E: usize> StreamTop<W, K, E> {
    /// The device of a configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which and what is possible.
    ///
    /// # Panics
    /// If W is not 64 or 128, K not W / 8, or E not W + 1.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Ok(Self {
            bus_clock: Signal::default(),
            bus_reset_n: Signal::default(),
            s_axis_tvalid: Signal::default(),
            s_axis_tready: Signal::default(),
            s_axis_tdata: Signal::default(),
            s_axis_tkeep: Signal::default(),
            m_axis_tvalid: Signal::default(),
            m_axis_tready: Signal::default(),
            m_axis_tdata: Signal::default(),
            m_axis_tkeep: Signal::default(),
            m_axis_tlast: Signal::default(),
            s_axi_awvalid: Signal::default(),
            s_axi_awready: Signal::default(),
            s_axi_awaddr: Signal::default(),
            s_axi_wvalid: Signal::default(),
            s_axi_wready: Signal::default(),
            s_axi_wdata: Signal::default(),
            s_axi_wstrb: Signal::default(),
            s_axi_bvalid: Signal::default(),
            s_axi_bready: Signal::default(),
            s_axi_bresp: Signal::default(),
            s_axi_arvalid: Signal::default(),
            s_axi_arready: Signal::default(),
            s_axi_araddr: Signal::default(),
            s_axi_rvalid: Signal::default(),
            s_axi_rready: Signal::default(),
            s_axi_rdata: Signal::default(),
            s_axi_rresp: Signal::default(),
            core_clock: Signal::default(),
            write: Signal::default(),
            core: Core::new(config)?,
            link: StreamLink::new(config)?,
        })
    }
}

impl<const W: usize, const K: usize, const E: usize> Logic for StreamTop<W, K, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, core_clock, core);
        self.link.bus_clock.next = self.bus_clock.val();
        self.link.bus_reset_n.next = self.bus_reset_n.val();
        self.link.s_axis_tvalid.next = self.s_axis_tvalid.val();
        self.s_axis_tready.next = self.link.s_axis_tready.val();
        self.link.s_axis_tdata.next = self.s_axis_tdata.val();
        self.link.s_axis_tkeep.next = self.s_axis_tkeep.val();
        self.m_axis_tvalid.next = self.link.m_axis_tvalid.val();
        self.link.m_axis_tready.next = self.m_axis_tready.val();
        self.m_axis_tdata.next = self.link.m_axis_tdata.val();
        self.m_axis_tkeep.next = self.link.m_axis_tkeep.val();
        self.m_axis_tlast.next = self.link.m_axis_tlast.val();
        self.link.s_axi_awvalid.next = self.s_axi_awvalid.val();
        self.s_axi_awready.next = self.link.s_axi_awready.val();
        self.link.s_axi_awaddr.next = self.s_axi_awaddr.val();
        self.link.s_axi_wvalid.next = self.s_axi_wvalid.val();
        self.s_axi_wready.next = self.link.s_axi_wready.val();
        self.link.s_axi_wdata.next = self.s_axi_wdata.val();
        self.link.s_axi_wstrb.next = self.s_axi_wstrb.val();
        self.s_axi_bvalid.next = self.link.s_axi_bvalid.val();
        self.link.s_axi_bready.next = self.s_axi_bready.val();
        self.s_axi_bresp.next = self.link.s_axi_bresp.val();
        self.link.s_axi_arvalid.next = self.s_axi_arvalid.val();
        self.s_axi_arready.next = self.link.s_axi_arready.val();
        self.link.s_axi_araddr.next = self.s_axi_araddr.val();
        self.s_axi_rvalid.next = self.link.s_axi_rvalid.val();
        self.link.s_axi_rready.next = self.s_axi_rready.val();
        self.s_axi_rdata.next = self.link.s_axi_rdata.val();
        self.s_axi_rresp.next = self.link.s_axi_rresp.val();
        self.link.core_clock.next = self.core_clock.val();

        self.core.reset.next = self.link.core_reset.val();
        self.core.command_valid.next = self.link.command_valid.val();
        self.core.command_data.next = self.link.command_data.val();
        self.link.command_ready.next = self.core.command_ready.val();
        self.link.response_valid.next = self.core.response_valid.val();
        self.link.response_data.next = self.core.response_data.val();
        self.link.response_both.next = self.core.response_both.val();
        self.link.response_last.next = self.core.response_last.val();
        self.core.response_ready.next = self.link.response_ready.val();
        self.write.next = self.core.write.val();
    }
}
