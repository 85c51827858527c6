//! All that a device with a UDP link has beside its core: the Ethernet port and the link, with the crossing of clocks
//! between them, and a FIFO for answers.
//!
//! The core gives words several times faster than the cable takes them, and inserts nothing while words wait. So the
//! FIFO takes the answers of a job, and the core goes on with the next job while the cable carries them. P is the
//! number of bits of a pointer of the FIFO, which holds `2^(P-1)` entries of one or two words.
//!
//! 1. `reset` is needed once, after power-up, for 4 clocks of the core. It may change at any time. A reset ends when
//!    both sides have been in reset, however long the clock of the port stands; see [`ResetHandshake`].
//! 2. The addresses of the device are constants.
//! 3. A reset of the core empties the FIFO. It lasts for the length of a datagram at least, as the FIFO asks.
//!
//! Latency: that of the port and of the link, and five clocks of the core for an answer.
//!
//! ```text
//! PHY <-> UdpPort <-> UdpLink -------------------> core
//!                        ^                          |
//!                        +------- AsyncFifo <-------+
//! ```

use super::reset_handshake::ResetHandshake;
use super::types::{AnswerEntry, ANSWER_ENTRY_BITS};
use super::udp_link::UdpLink;
use super::udp_parameters::{UdpError, UdpParameters};
use crate::commands::{AnswerSink, CommandSource};
use crate::ethernet::types::Station;
use crate::ethernet::UdpPort;
use crate::leaf::{Parameter, Unpack};
use crate::prelude::*;
use crate::serial::types::{Byte, Lamps};
use crate::serial::CommandProgress;
use crate::stream::AsyncFifo;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct UdpDevice<const P: usize> {
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
    /// Lamps: alive, busy, error, from bit 0 up; see [`UdpLink`]. Busy is lit while a datagram waits as well.
    pub leds: Signal<Out, Bits<3>>,
    /// Synchronous reset of the core, and its streams, in the clock of the core.
    pub core_reset: Signal<Out, Bit>,
    pub command: CommandSource,
    pub response: AnswerSink,
    pub device_busy: Signal<In, Bit>,
    port: UdpPort,
    link: UdpLink,
    answers: AsyncFifo<P, ANSWER_ENTRY_BITS>,
    answer: Unpack<AnswerEntry, ANSWER_ENTRY_BITS>,
    /// Whether the core itself is busy: its answers may still wait when it has begun the next command.
    progress: CommandProgress,
    /// The core gave the last word of an answer one clock earlier.
    ended: DFF<Bit>,
    resets: ResetHandshake,
    station: Parameter<Station>,
    lamps: Signal<Local, Lamps>,
    entry: Signal<Local, AnswerEntry>,
    is_offered: Signal<Local, Bit>,
    takes_answer: Signal<Local, Bit>,
}

impl<const P: usize> UdpDevice<P> {
    /// The port and the link of a core of this configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, parameters: UdpParameters) -> Result<Self, UdpError> {
        let UdpParameters { link, .. } = parameters.check()?;
        Ok(Self {
            port: UdpPort::new(),
            link: UdpLink::new(config, link)?,
            answers: AsyncFifo::new(),
            station: Parameter::new(parameters.station()),
            ..Self::default()
        })
    }

    /// The port and the link of a core with runs of this configuration, which names them in its greeting.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config, parameters: UdpParameters) -> Result<Self, UdpError> {
        Ok(Self { link: UdpLink::with_runs(config, parameters.link)?, ..Self::new(config, parameters)? })
    }
}

impl<const P: usize> Logic for UdpDevice<P> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, core_clock, ended);
        clock!(self, core_clock, link, progress);
        self.resets.core_clock.next = self.core_clock.val();
        self.resets.port_clock.next = self.port_clock.val();
        self.resets.reset.next = self.reset.val();
        self.port.port_clock.next = self.port_clock.val();
        self.port.port_reset.next = self.resets.port_resets.val();
        self.port.core_clock.next = self.core_clock.val();
        self.port.core_reset.next = self.resets.core_resets.val();
        self.link.reset.next = self.resets.core_resets.val();
        self.port.station.next = self.station.val();
        self.port.rx_valid.next = self.rx_valid.val();
        self.port.rx_error.next = self.rx_error.val();
        self.port.rx_data.next = self.rx_data.val();
        self.tx_valid.next = self.port.tx_valid.val();
        self.tx_data.next = self.port.tx_data.val();

        self.link.entry_valid.next = self.port.entry_valid.val();
        self.link.entry.next = self.port.entry.val();
        self.port.entry_pop.next = self.link.entry_pop.val();
        self.port.byte_valid.next = self.link.byte_valid.val();
        self.link.byte_ready.next = self.port.byte_ready.val();
        self.port.byte_data.next = self.link.byte_data.val();
        self.port.byte_is_last.next = self.link.byte_is_last.val();
        self.port.byte_drops.next = self.link.byte_drops.val();

        self.core_reset.next = self.link.core_reset.val();
        self.command.valid.next = self.link.command.valid.val();
        self.command.data.next = self.link.command.data.val();
        self.link.command.ready.next = self.command.ready.val();

        self.answers.write_clock.next = self.core_clock.val();
        self.answers.read_clock.next = self.core_clock.val();
        self.answers.write_reset.next = self.link.core_reset.val();
        self.answers.read_reset.next = self.link.core_reset.val();
        self.is_offered.next = self.response.valid.val() & (!self.link.core_reset.val());
        self.takes_answer.next = !self.answers.is_full.val();
        self.entry.next.data = self.response.data.val();
        self.entry.next.both = self.response.both.val();
        self.entry.next.last = self.response.last.val();
        self.answers.push.next = self.is_offered.val();
        self.answers.push_data.next = self.entry.val().into();
        self.response.ready.next = self.takes_answer.val();
        self.answer.bits.next = self.answers.data.val();
        self.link.response.valid.next = self.answers.valid.val();
        self.link.response.data.next = self.answer.value.val().data;
        self.link.response.both.next = self.answer.value.val().both;
        self.link.response.last.next = self.answer.value.val().last;
        self.answers.pop.next = self.answers.valid.val() & self.link.response.ready.val();

        self.progress.reset.next = self.link.core_reset.val();
        self.progress.takes.next =
            self.link.command.valid.val() & self.command.ready.val() & (!self.link.core_reset.val());
        self.progress.word.next = self.link.command.data.val();
        self.progress.offers_last.next = self.is_offered.val() & self.response.last.val();
        self.progress.takes_answer.next = self.takes_answer.val();
        self.ended.d.next = self.is_offered.val() & self.response.last.val() & self.takes_answer.val();
        self.progress.answer_ended.next = self.ended.q.val();
        // An entry is on its way through the FIFO until the reader has fetched it, and from then on not empty.
        self.link.device_busy.next = self.device_busy.val()
            | self.progress.is_busy.val()
            | (!self.answers.is_fetched.val())
            | (!self.answers.is_empty.val());
        self.lamps.next.alive = self.link.lamps.val().alive;
        self.lamps.next.busy = self.link.lamps.val().busy | self.port.on_the_way.val().to_the_reader;
        self.lamps.next.error = self.link.lamps.val().error;
        self.leds.next = self.lamps.val().into();
    }
}
