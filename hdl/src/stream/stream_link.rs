//! The stream link: AXI on one side, the streams of a core on the other, each with its own clock.
//!
//! 1. `protocol/STREAM.md` says what passes. W is 64 or 128, K the bytes of a beat, E the bits of an entry of the answer FIFO: W and one.
//! 2. What is named after the core, `command` and `response` belong to `core_clock`, all else to `bus_clock`. What crosses is a register that
//!    goes into a `Synchroniser`, or passes through the memory of an `AsyncFifo`.
//!
//! ```text
//!                  BusSide, bus_clock           |              CoreSide, core_clock
//! s_axis -> BeatGate ----------------------> AsyncFifo -> BeatWords -------------> core
//!               | events                        |             Progress <-----------+
//! s_axi  -> RegisterBlock <-> ResetRequest <-----> ResetReply --> core_reset       |
//!               | events                        |                                  v
//! m_axis <- AnswerWatch <------------------- AsyncFifo <- AnswerBeats <- AnswerPairs
//! ```
//! Latency: see the blocks.

use incircle_protocol::{Config, ConfigError, STREAM_FIFO_BEATS};
use rust_hdl_core::prelude::*;

use super::{AsyncFifo, BusSide, CoreSide};

/// Bits of a pointer of the FIFOs.
const POINTER_BITS: usize = 10;
const _: () = assert!(AsyncFifo::<POINTER_BITS, 1>::DEPTH == STREAM_FIFO_BEATS as usize);

/// The stream link; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct StreamLink<const W: usize, const K: usize, const E: usize> {
    /// Clock and reset of the AXI ports; the reset is active low and synchronous.
    pub bus_clock: Signal<In, Clock>,
    pub bus_reset_n: Signal<In, Bit>,
    /// Command beats.
    pub s_axis_tvalid: Signal<In, Bit>,
    pub s_axis_tready: Signal<Out, Bit>,
    pub s_axis_tdata: Signal<In, Bits<W>>,
    pub s_axis_tkeep: Signal<In, Bits<K>>,
    /// Answer beats.
    pub m_axis_tvalid: Signal<Out, Bit>,
    pub m_axis_tready: Signal<In, Bit>,
    pub m_axis_tdata: Signal<Out, Bits<W>>,
    pub m_axis_tkeep: Signal<Out, Bits<K>>,
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
    /// Clock of the core; its reset.
    pub core_clock: Signal<In, Clock>,
    pub core_reset: Signal<Out, Bit>,
    /// The command stream.
    pub command_valid: Signal<Out, Bit>,
    pub command_ready: Signal<In, Bit>,
    pub command_data: Signal<Out, Bits<32>>,
    /// The answer stream, as in `AnswerPairs`.
    pub response_valid: Signal<In, Bit>,
    pub response_ready: Signal<Out, Bit>,
    pub response_data: Signal<In, Bits<64>>,
    pub response_both: Signal<In, Bit>,
    pub response_last: Signal<In, Bit>,
    bus: BusSide<W, K, E>,
    commands: AsyncFifo<POINTER_BITS, W>,
    answers: AsyncFifo<POINTER_BITS, E>,
    core: CoreSide<W, E>,
}

impl<const W: usize, const K: usize, const E: usize> StreamLink<W, K, E> {
    /// The link of a core of this configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which and what is possible.
    ///
    /// # Panics
    /// If W is not 64 or 128, K not W / 8, or E not W + 1.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Ok(Self {
            bus: BusSide::new(config.check()?),
            commands: AsyncFifo::new(),
            answers: AsyncFifo::new(),
            core: CoreSide::new(),
            ..Self::default()
        })
    }
}

impl<const W: usize, const K: usize, const E: usize> Logic for StreamLink<W, K, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, bus_clock, bus);
        clock!(self, core_clock, core);
        self.commands.write_clock.next = self.bus_clock.val();
        self.commands.read_clock.next = self.core_clock.val();
        self.answers.write_clock.next = self.core_clock.val();
        self.answers.read_clock.next = self.bus_clock.val();

        // Between the clocks.
        self.core.request.next = self.bus.request.val();
        self.bus.reply.next = self.core.reply.val();
        self.bus.core_beat.next = self.core.core_beat.val();
        self.bus.core_busy.next = self.core.core_busy.val();
        self.commands.write_reset.next = self.bus.resets.val();
        self.commands.read_reset.next = self.core.core_reset.val();
        self.answers.write_reset.next = self.core.core_reset.val();
        self.answers.read_reset.next = self.bus.resets.val();
        self.core_reset.next = self.core.core_reset.val();

        // Commands.
        self.bus.bus_reset_n.next = self.bus_reset_n.val();
        self.bus.s_axis_tvalid.next = self.s_axis_tvalid.val();
        self.bus.s_axis_tkeep.next = self.s_axis_tkeep.val();
        self.s_axis_tready.next = !self.commands.is_full.val();
        self.commands.push.next = self.bus.push.val();
        self.commands.push_data.next = self.s_axis_tdata.val();
        self.bus.is_full.next = self.commands.is_full.val();
        self.bus.is_fetched.next = self.commands.is_fetched.val();
        self.core.beat_valid.next = self.commands.valid.val();
        self.core.beat_data.next = self.commands.data.val();
        self.core.is_empty.next = self.commands.is_empty.val();
        self.commands.pop.next = self.core.takes.val();
        self.command_valid.next = self.core.command_valid.val();
        self.command_data.next = self.core.command_data.val();
        self.core.command_ready.next = self.command_ready.val();

        // Answers.
        self.core.response_valid.next = self.response_valid.val();
        self.core.response_data.next = self.response_data.val();
        self.core.response_both.next = self.response_both.val();
        self.core.response_last.next = self.response_last.val();
        self.response_ready.next = self.core.response_ready.val();
        self.answers.push.next = self.core.entry_valid.val();
        self.answers.push_data.next = self.core.entry.val();
        self.core.is_full.next = self.answers.is_full.val();
        self.core.is_fetched.next = self.answers.is_fetched.val();
        self.bus.entry_valid.next = self.answers.valid.val();
        self.bus.entry.next = self.answers.data.val();
        self.bus.is_empty.next = self.answers.is_empty.val();
        self.answers.pop.next = self.bus.pop.val();
        self.m_axis_tvalid.next = self.bus.m_axis_tvalid.val();
        self.bus.m_axis_tready.next = self.m_axis_tready.val();
        self.m_axis_tdata.next = self.bus.m_axis_tdata.val();
        self.m_axis_tkeep.next = self.bus.m_axis_tkeep.val();
        self.m_axis_tlast.next = self.bus.m_axis_tlast.val();

        // Registers.
        self.bus.s_axi_awvalid.next = self.s_axi_awvalid.val();
        self.s_axi_awready.next = self.bus.s_axi_awready.val();
        self.bus.s_axi_awaddr.next = self.s_axi_awaddr.val();
        self.bus.s_axi_wvalid.next = self.s_axi_wvalid.val();
        self.s_axi_wready.next = self.bus.s_axi_wready.val();
        self.bus.s_axi_wdata.next = self.s_axi_wdata.val();
        self.bus.s_axi_wstrb.next = self.s_axi_wstrb.val();
        self.s_axi_bvalid.next = self.bus.s_axi_bvalid.val();
        self.bus.s_axi_bready.next = self.s_axi_bready.val();
        self.s_axi_bresp.next = self.bus.s_axi_bresp.val();
        self.bus.s_axi_arvalid.next = self.s_axi_arvalid.val();
        self.s_axi_arready.next = self.bus.s_axi_arready.val();
        self.bus.s_axi_araddr.next = self.s_axi_araddr.val();
        self.s_axi_rvalid.next = self.bus.s_axi_rvalid.val();
        self.bus.s_axi_rready.next = self.s_axi_rready.val();
        self.s_axi_rdata.next = self.bus.s_axi_rdata.val();
        self.s_axi_rresp.next = self.bus.s_axi_rresp.val();
    }
}
