//! A whole device: the core behind a UDP link, with the pins of a PHY in the form of GMII.
//!
//! P is the number of bits of a pointer of the FIFO for answers; see [`UdpDevice`].
//!
//! 1. `reset` is needed once, after power-up, for 4 clocks of the core, and may change at any time; see [`UdpDevice`].

use super::core::Core;
use crate::commands::{AnswerSink, CommandSource};
use crate::engine::Write;
use crate::prelude::*;
use crate::serial::types::Byte;
use crate::udp::{UdpDevice, UdpError, UdpParameters};
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct UdpTop<const P: usize> {
    /// Clock of the PHY's bytes, 125 MHz; clock of the core; reset, active high.
    pub port_clock: Signal<In, Clock>,
    pub core_clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The pins of the PHY, as GMII names them: `rx_dv`, `rx_er`, `rxd`, `tx_en`, `txd`.
    pub rx_valid: Signal<In, Bit>,
    pub rx_error: Signal<In, Bit>,
    pub rx_data: Signal<In, Byte>,
    pub tx_valid: Signal<Out, Bit>,
    pub tx_data: Signal<Out, Byte>,
    /// Lamps: alive, busy, error, from bit 0 up; see `UdpLink`.
    pub leds: Signal<Out, Bits<3>>,
    /// The write port of the triangle memory, in the core's clock, for simulation.
    pub write: Signal<Out, Write>,
    core: Core,
    device: UdpDevice<P>,
}

impl<const P: usize> UdpTop<P> {
    /// The device of a configuration of the core and of the link.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, parameters: UdpParameters) -> Result<Self, UdpError> {
        Ok(Self { core: Core::new(config)?, device: UdpDevice::new(config, parameters)?, ..Self::default() })
    }
}

impl<const P: usize> Logic for UdpTop<P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, core_clock, core);
        self.device.port_clock.next = self.port_clock.val();
        self.device.core_clock.next = self.core_clock.val();
        self.device.reset.next = self.reset.val();
        self.device.rx_valid.next = self.rx_valid.val();
        self.device.rx_error.next = self.rx_error.val();
        self.device.rx_data.next = self.rx_data.val();
        self.tx_valid.next = self.device.tx_valid.val();
        self.tx_data.next = self.device.tx_data.val();
        self.leds.next = self.device.leds.val();
        self.core.reset.next = self.device.core_reset.val();
        CommandSource::join(&mut self.device.command, &mut self.core.command);
        AnswerSink::join(&mut self.device.response, &mut self.core.response);
        // All that a core of one engine holds shows in its streams.
        self.device.device_busy.next = false;
        self.write.next = self.core.write.val();
    }
}
