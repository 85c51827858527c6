//! A whole device: the core behind a serial link.
//!
//! 1. `reset` is needed once, after power-up, for two clocks or more: a register takes it first, because the pin
//!    may be far away.

use super::core::Core;
use crate::commands::{AnswerSink, CommandSource};
use crate::engine::Write;
use crate::prelude::*;
use crate::serial::{SerialError, SerialLink};
use incircle_protocol::{Config, LinkConfig};

#[derive(LogicBlock, Default)]
pub struct SerialTop {
    /// One clock, and a synchronous reset, active high.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The line in both directions, high when idle.
    pub rx: Signal<In, Bit>,
    pub tx: Signal<Out, Bit>,
    /// Lamps: alive, busy, error, from bit 0 up; see `SerialLink`.
    pub leds: Signal<Out, Bits<3>>,
    /// The write port of the triangle memory, for simulation.
    pub write: Signal<Out, Write>,
    core: Core,
    link: SerialLink,
    resets: DFF<Bit>,
}

impl SerialTop {
    /// The device of a configuration of the core and of the link.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, link: LinkConfig) -> Result<Self, SerialError> {
        Ok(Self { core: Core::new(config)?, link: SerialLink::new(config, link)?, ..Self::default() })
    }
}

impl Logic for SerialTop {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, resets);
        clock!(self, clock, core, link);
        self.resets.d.next = self.reset.val();
        self.link.reset.next = self.resets.q.val();
        self.link.rx.next = self.rx.val();
        self.tx.next = self.link.tx.val();
        self.core.reset.next = self.link.core_reset.val();
        CommandSource::join(&mut self.link.command, &mut self.core.command);
        AnswerSink::join(&mut self.link.response, &mut self.core.response);
        // All that a core of one engine holds shows in its streams.
        self.link.device_busy.next = false;
        self.write.next = self.core.write.val();
        self.leds.next = self.link.lamps.val().into();
    }
}
