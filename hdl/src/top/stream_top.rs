//! A whole device: the core behind a stream link.
//!
//! 1. `bus_reset_n` is needed once, after power-up; the reset of the core follows from it.

use super::core::Core;
use crate::commands::{AnswerSink, CommandSource};
use crate::engine::Write;
use crate::stream::{AxiLite, AxisSink, AxisSource, StreamLink};
use incircle_protocol::{Config, ConfigError};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StreamTop<const W: usize, const K: usize, const E: usize> {
    /// Clock and reset of the AXI ports; the reset is active low and synchronous.
    pub bus_clock: Signal<In, Clock>,
    pub bus_reset_n: Signal<In, Bit>,
    pub s_axis: AxisSink<W, K>,
    pub m_axis: AxisSource<W, K>,
    pub s_axi: AxiLite,
    /// The clock of the core.
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
    /// If a parameter is out of range; the error says which one and what is possible.
    ///
    /// # Panics
    /// If W is not 64 or 128, K not W / 8, or E not W + 1.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Ok(Self { core: Core::new(config)?, link: StreamLink::new(config)?, ..Self::default() })
    }
}

impl<const W: usize, const K: usize, const E: usize> Logic for StreamTop<W, K, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, core_clock, core);
        self.link.bus_clock.next = self.bus_clock.val();
        self.link.bus_reset_n.next = self.bus_reset_n.val();
        AxisSink::<W, K>::link(&mut self.s_axis, &mut self.link.s_axis);
        AxisSource::<W, K>::link(&mut self.m_axis, &mut self.link.m_axis);
        AxiLite::link(&mut self.s_axi, &mut self.link.s_axi);
        self.link.core_clock.next = self.core_clock.val();

        self.core.reset.next = self.link.core_reset.val();
        CommandSource::join(&mut self.link.command, &mut self.core.command);
        AnswerSink::join(&mut self.link.response, &mut self.core.response);
        // All that a core of one engine holds shows in its streams.
        self.link.device_busy.next = false;
        self.write.next = self.core.write.val();
    }
}
