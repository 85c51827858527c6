//! The UDP link: connects the datagrams of an Ethernet port to the two streams of a core, and keeps the session that
//! device and host agree on.
//!
//! 1. `protocol/UDP.md` says what passes on the network.
//! 2. The core is in reset while no session is open, and a session begins with a reset of the core.
//! 3. Datagrams come as entries and go as bytes, as [`UdpPort`](crate::ethernet::UdpPort) describes them.
//!
//! The last entries of an `Open`, the reset of the core, and the first three bytes and the last byte of the answer. The
//! sender's addresses begin with the bytes 20 to 22. Clocks are left out where the session is copied, and where the
//! other bytes of the answer go out:
//! ```text
//! entry_valid     /^^^^^^^^\_______________________________________________
//! entry[8]        ______/^^  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! core_reset      /^^^^^^^^^^^^^^^^^^^^^^^\________________________________
//! byte_valid      _______________________________________/^^^^^^^^^^^\_____
//! byte_data         .  .  .  .  .  .  .  .  .  .  .  .  . 20 21 22  .  .  .
//! byte_is_last      .  .  .  .  .  .  .  .  .  .  .  .  ._________/^^  .  .
//! ```
//!
//! The blocks of the link:
//! ```text
//! entries -> UdpReceiver ------- commands ------------> core
//!               | asks, free words, digest               |
//!               v                                        v
//!             UdpSessionState, LineTimers         CommandProgress
//!               |                                        |
//! bytes <- UdpTransmitter <------ answers ---------------+
//! ```

use super::udp_parameters::{times, UdpError};
use super::udp_receiver::UdpReceiver;
use super::udp_session_state::UdpSessionState;
use super::udp_transmitter::UdpTransmitter;
use crate::commands::{AnswerSink, CommandSource};
use crate::prelude::*;
use crate::serial::types::{Byte, Lamps};
use crate::serial::{CommandProgress, LineTimers};
use incircle_protocol::{Config, UdpLinkConfig};

#[derive(LogicBlock, Default)]
pub struct UdpLink {
    /// One clock; a synchronous reset, active high.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Datagrams of hosts: the oldest entry of the port, which the link takes at an edge with `entry_pop`.
    pub entry_valid: Signal<In, Bit>,
    pub entry: Signal<In, Bits<9>>,
    pub entry_pop: Signal<Out, Bit>,
    /// Datagrams to hosts, byte by byte. With `byte_drops` the port forgets those of a datagram that has not ended.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_ready: Signal<In, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    pub byte_drops: Signal<Out, Bit>,
    pub lamps: Signal<Out, Lamps>,
    /// Synchronous reset of the core.
    pub core_reset: Signal<Out, Bit>,
    pub command: CommandSource,
    pub response: AnswerSink,
    /// The device holds words of commands, or owes answers, that do not show in the streams: those of other engines,
    /// and those in the FIFO of answers.
    pub device_busy: Signal<In, Bit>,
    receiver: UdpReceiver,
    transmitter: UdpTransmitter,
    session: UdpSessionState,
    timers: LineTimers,
    progress: CommandProgress,
    resets_core: DFF<Bit>,
    has_failed: DFF<Bit>,
    dropped: DFF<Bit>,
    is_offered: Signal<Local, Bit>,
    is_busy: Signal<Local, Bit>,
    takes_command: Signal<Local, Bit>,
    clears: Signal<Local, Bit>,
}

impl UdpLink {
    /// The UDP link of a core of this configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, link: UdpLinkConfig) -> Result<Self, UdpError> {
        let (config, times) = (config.check()?, times(link)?);
        Ok(Self {
            receiver: UdpReceiver::new(link),
            transmitter: UdpTransmitter::new(config, link),
            timers: LineTimers::new(times),
            ..Self::default()
        })
    }

    /// The UDP link of a core with runs of this configuration, which names them in its greeting.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config, link: UdpLinkConfig) -> Result<Self, UdpError> {
        Ok(Self { transmitter: UdpTransmitter::with_runs(config, link), ..Self::new(config, link)? })
    }
}

impl Logic for UdpLink {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, resets_core, has_failed, dropped);
        clock!(self, clock, receiver, transmitter, session, timers, progress);
        self.receiver.reset.next = self.reset.val();
        self.transmitter.reset.next = self.reset.val();
        self.session.reset.next = self.reset.val();
        self.timers.reset.next = self.reset.val();
        self.clears.next = self.session.forgets.val() | self.reset.val();
        self.progress.reset.next = self.clears.val();
        self.resets_core.d.next = self.clears.val();
        self.core_reset.next = self.resets_core.q.val();

        // While the core is in reset, no command word counts as taken: the core would lose it.
        self.receiver.entry_valid.next = self.entry_valid.val();
        self.receiver.entry.next = self.entry.val();
        self.entry_pop.next = self.receiver.entry_pop.val();
        self.receiver.session.next = self.session.session.val();
        self.receiver.forgets.next = self.session.forgets.val();
        self.receiver.place_is_taken.next = self.transmitter.place_is_taken.val();
        self.takes_command.next =
            self.receiver.command.valid.val() & self.command.ready.val() & (!self.resets_core.q.val());
        self.command.valid.next = self.receiver.command.valid.val();
        self.command.data.next = self.receiver.command.data.val();
        self.receiver.command.ready.next = self.takes_command.val();

        // Silence ends a session only while no datagram is being carried out, which might end it. Ethernet has no
        // break, so `is_low` stays low.
        self.timers.is_low.next = false;
        self.timers.hears.next = self.receiver.asks.val().hears;
        self.has_failed.d.next = (self.timers.is_silent.val() | self.timers.is_broken.val())
            & self.session.session.val().is_open
            & (!self.receiver.settles.val());
        self.session.asks.next = self.receiver.asks.val();
        self.session.fails.next = self.has_failed.q.val();
        self.is_offered.next = self.response.valid.val() & (!self.resets_core.q.val());
        self.progress.takes.next = self.takes_command.val();
        self.progress.word.next = self.receiver.command.data.val();
        self.progress.offers_last.next = self.is_offered.val() & self.response.last.val();
        self.progress.takes_answer.next = self.transmitter.response_ready.val();
        self.progress.answer_ended.next = self.transmitter.answer_ended.val();
        self.is_busy.next = self.progress.is_busy.val() | self.device_busy.val();

        self.transmitter.asks.next = self.receiver.asks.val();
        self.transmitter.saw_gap.next = self.session.saw_gap.val();
        self.transmitter.state.next.is_open = self.session.session.val().is_open;
        self.transmitter.state.next.expected = self.session.session.val().expected;
        self.transmitter.state.next.free = self.receiver.receipt.val().free;
        self.transmitter.state.next.is_busy = self.is_busy.val();
        self.transmitter.state.next.digest = self.receiver.receipt.val().digest;
        self.transmitter.forgets.next = self.session.forgets.val();
        self.transmitter.holds.next = self.receiver.settles.val();
        self.receiver.reads_question.next = self.transmitter.reads_question.val();
        self.receiver.read_index.next = self.transmitter.read_index.val();
        self.transmitter.read_data.next = self.receiver.read_data.val();
        self.transmitter.response_valid.next = self.is_offered.val();
        self.transmitter.response_data.next = self.response.data.val();
        self.transmitter.response_both.next = self.response.both.val();
        self.response.ready.next = self.transmitter.response_ready.val();
        self.byte_valid.next = self.transmitter.byte_valid.val();
        self.byte_data.next = self.transmitter.byte_data.val();
        self.byte_is_last.next = self.transmitter.byte_is_last.val();
        self.byte_drops.next = self.transmitter.byte_drops.val();
        self.transmitter.byte_ready.next = self.byte_ready.val();

        // The error lamp keeps a dropped datagram visible until the session ends or another one begins.
        if self.receiver.asks.val().drops {
            self.dropped.d.next = true;
        }
        if self.clears.val() {
            self.dropped.d.next = false;
        }
        self.lamps.next.alive = self.session.session.val().is_open | self.timers.beat.val();
        self.lamps.next.busy = self.is_busy.val();
        self.lamps.next.error = self.dropped.q.val();
    }
}
