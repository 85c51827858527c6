//! The stream link: connects AXI4-Streams and AXI4-Lite registers to the two streams of a core, each side
//! in its own clock.
//!
//! 1. `protocol/STREAM.md` says what passes. W, the bits of a beat, is 64 or 128; K is the bytes of a beat; E, the bits
//!    of an entry of the answer FIFO, is W + 1.
//! 2. The signals with core in their names, `command` and `response` belong to `core_clock`, all others to `bus_clock`.
//!    A signal crosses as a register that goes into a `Synchroniser`, or through the memory of an `AsyncFifo`.
//!
//! ```text
//!                  BusSide, bus_clock           |              CoreSide, core_clock
//! s_axis -> BeatGate ----------------------> AsyncFifo -> BeatWords -------------> core
//!               | events                        |      CommandUnderWay <-----------+
//! s_axi  -> RegisterBlock <-> ResetRequest <-----> ResetReply --> core_reset       |
//!               | events                        |                                  v
//! m_axis <- AnswerWatch <------------------- AsyncFifo <- AnswerBeats <- AnswerPairs
//! ```

use super::async_fifo::AsyncFifo;
use super::axi::{AxiLite, AxisSink, AxisSource};
use super::bus_side::BusSide;
use super::core_side::CoreSide;
use crate::commands::{AnswerSink, CommandSource};
use incircle_protocol::{Config, ConfigError, STREAM_FIFO_BEATS};
use rust_hdl_core::prelude::*;

/// Number of bits of a pointer of the FIFOs.
const POINTER_BITS: usize = 10;
const _: () = assert!(AsyncFifo::<POINTER_BITS, 1>::DEPTH == STREAM_FIFO_BEATS as usize);

#[derive(LogicBlock, Default)]
pub struct StreamLink<const W: usize, const K: usize, const E: usize> {
    /// Clock and reset of the AXI ports; the reset is active low and synchronous.
    pub bus_clock: Signal<In, Clock>,
    pub bus_reset_n: Signal<In, Bit>,
    pub s_axis: AxisSink<W, K>,
    pub m_axis: AxisSource<W, K>,
    pub s_axi: AxiLite,
    /// The core's clock, and the reset that the link gives to the core.
    pub core_clock: Signal<In, Clock>,
    pub core_reset: Signal<Out, Bit>,
    pub command: CommandSource,
    pub response: AnswerSink,
    /// High while a chip of several engines holds words of commands, or owes answers, that the two streams do not show.
    /// A core of one engine has 0 here.
    pub device_busy: Signal<In, Bit>,
    bus: BusSide<W, K, E>,
    commands: AsyncFifo<POINTER_BITS, W>,
    answers: AsyncFifo<POINTER_BITS, E>,
    core: CoreSide<W, E>,
}

impl<const W: usize, const K: usize, const E: usize> StreamLink<W, K, E> {
    /// The stream link of a core of this configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
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

    /// The stream link of a core with runs of this configuration. Only the identity in its registers differs.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config) -> Result<Self, ConfigError> {
        Ok(Self { bus: BusSide::with_runs(config.check()?), ..Self::new(config)? })
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

        AxisSink::<W, K>::link(&mut self.s_axis, &mut self.bus.s_axis);
        AxisSource::<W, K>::link(&mut self.m_axis, &mut self.bus.m_axis);
        AxiLite::link(&mut self.s_axi, &mut self.bus.s_axi);
        CommandSource::link(&mut self.command, &mut self.core.command);
        AnswerSink::link(&mut self.response, &mut self.core.response);
        self.core.device_busy.next = self.device_busy.val();

        // Only the next four signals and the two FIFOs cross between the clocks;
        // `protocol/STREAM.md` lists them.
        self.core.request.next = self.bus.request.val();
        self.bus.reply.next = self.core.reply.val();
        self.bus.core_beat.next = self.core.core_beat.val();
        self.bus.core_busy.next = self.core.core_busy.val();
        self.commands.write_reset.next = self.bus.resets.val();
        self.commands.read_reset.next = self.core.core_reset.val();
        self.answers.write_reset.next = self.core.core_reset.val();
        self.answers.read_reset.next = self.bus.resets.val();
        self.core_reset.next = self.core.core_reset.val();

        self.bus.bus_reset_n.next = self.bus_reset_n.val();
        self.commands.push.next = self.bus.push.val();
        self.commands.push_data.next = self.bus.push_data.val();
        self.bus.is_full.next = self.commands.is_full.val();
        self.bus.is_fetched.next = self.commands.is_fetched.val();
        self.core.beat_valid.next = self.commands.valid.val();
        self.core.beat_data.next = self.commands.data.val();
        self.core.is_empty.next = self.commands.is_empty.val();
        self.commands.pop.next = self.core.takes.val();

        self.answers.push.next = self.core.entry_valid.val();
        self.answers.push_data.next = self.core.entry.val();
        self.core.is_full.next = self.answers.is_full.val();
        self.core.is_fetched.next = self.answers.is_fetched.val();
        self.bus.entry_valid.next = self.answers.valid.val();
        self.bus.entry.next = self.answers.data.val();
        self.bus.is_empty.next = self.answers.is_empty.val();
        self.answers.pop.next = self.bus.pop.val();
    }
}
