//! The serial link: connects a serial line to the two streams of a core, and keeps the session that both ends agree on.
//!
//! 1. `protocol/SERIAL.md` says what passes on the line.
//! 2. The core is in reset while no session is open, and a session begins with a reset of the core.
//!
//! ```text
//! rx -> LinkReceiver ------ commands -----------> core
//!         | asked, credit, digest                  |
//!         v                                        |
//!       SessionState, RateControl, LineTimers      |
//!         |                                        v
//! tx <- LinkTransmitter <---- answers ----- CommandProgress
//! ```

use super::command_progress::CommandProgress;
use super::line_timers::LineTimers;
use super::link_receiver::LinkReceiver;
use super::link_transmitter::LinkTransmitter;
use super::rate_control::RateControl;
use super::session_state::SessionState;
use super::types::Lamps;
use crate::commands::{AnswerSink, CommandSource};
use crate::prelude::*;
use incircle_protocol::{Config, ConfigError, LinkConfig, LinkConfigError};

#[derive(LogicBlock, Default)]
pub struct SerialLink {
    /// One clock; a synchronous reset, active high.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The line in both directions, high when idle.
    pub rx: Signal<In, Bit>,
    pub tx: Signal<Out, Bit>,
    pub lamps: Signal<Out, Lamps>,
    /// Synchronous reset of the core.
    pub core_reset: Signal<Out, Bit>,
    pub command: CommandSource,
    pub response: AnswerSink,
    /// The device holds words of commands, or owes answers, that do not show in the streams: so only a chip of several
    /// engines says.
    pub device_busy: Signal<In, Bit>,
    receiver: LinkReceiver,
    transmitter: LinkTransmitter,
    session: SessionState,
    rate: RateControl,
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

/// Parameters with which no device with a serial link can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SerialError {
    /// A parameter of the core is out of range.
    Core(ConfigError),
    /// A parameter of the link is out of range.
    Link(LinkConfigError),
}

impl From<ConfigError> for SerialError {
    fn from(error: ConfigError) -> Self {
        Self::Core(error)
    }
}

impl From<LinkConfigError> for SerialError {
    fn from(error: LinkConfigError) -> Self {
        Self::Link(error)
    }
}

impl SerialLink {
    /// The serial link of a core of this configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, link: LinkConfig) -> Result<Self, SerialError> {
        let (config, link) = (config.check()?, link.check()?);
        Ok(Self {
            receiver: LinkReceiver::new(link),
            transmitter: LinkTransmitter::new(config, link),
            rate: RateControl::new(link),
            timers: LineTimers::new(link),
            ..Self::default()
        })
    }

    /// The serial link of a core with runs of this configuration, which names them in its greeting.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config, link: LinkConfig) -> Result<Self, SerialError> {
        Ok(Self { transmitter: LinkTransmitter::with_runs(config, link), ..Self::new(config, link)? })
    }
}

impl Logic for SerialLink {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, resets_core, has_failed, dropped);
        clock!(self, clock, receiver, transmitter, session, rate, timers, progress);
        self.receiver.reset.next = self.reset.val();
        self.transmitter.reset.next = self.reset.val();
        self.session.reset.next = self.reset.val();
        self.rate.reset.next = self.reset.val();
        self.timers.reset.next = self.reset.val();
        self.clears.next = self.session.forgets.val() | self.reset.val();
        self.progress.reset.next = self.clears.val();
        self.resets_core.d.next = self.clears.val();
        self.core_reset.next = self.resets_core.q.val();

        // While the core is in reset, no command word counts as taken: the core would lose it.
        self.receiver.step.next = self.rate.step.val();
        self.receiver.rx.next = self.rx.val();
        self.receiver.open.next = self.session.open.val();
        self.receiver.forgets.next = self.session.forgets.val();
        self.takes_command.next =
            self.receiver.command.valid.val() & self.command.ready.val() & (!self.resets_core.q.val());
        self.command.valid.next = self.receiver.command.valid.val();
        self.command.data.next = self.receiver.command.data.val();
        self.receiver.command.ready.next = self.takes_command.val();

        // A break counts at any time. Silence counts in a session only, and not if a sound frame ends it
        // in this very clock.
        self.timers.is_low.next = self.receiver.is_low.val();
        self.timers.hears.next = self.receiver.asked.val().hears;
        self.has_failed.d.next = self.timers.is_broken.val()
            | (self.timers.is_silent.val() & self.session.open.val().is_open & (!self.receiver.asked.val().hears));
        self.session.asked.next = self.receiver.asked.val();
        self.session.session.next = self.receiver.named.val();
        self.session.fails.next = self.has_failed.q.val();
        self.rate.asked.next = self.receiver.asked.val();
        self.rate.value.next = self.receiver.value.val();
        self.rate.fails.next = self.has_failed.q.val();
        self.rate.acknowledges.next = self.transmitter.acknowledges.val();
        self.rate.closes.next = self.transmitter.closes.val();
        self.rate.is_quiet.next = self.transmitter.is_quiet.val();
        self.is_offered.next = self.response.valid.val() & (!self.resets_core.q.val());
        self.progress.takes.next = self.takes_command.val();
        self.progress.word.next = self.receiver.command.data.val();
        self.progress.offers_last.next = self.is_offered.val() & self.response.last.val();
        self.progress.takes_answer.next = self.transmitter.response_ready.val();
        self.progress.answer_ended.next = self.transmitter.answer_ended.val();

        self.transmitter.step.next = self.rate.step.val();
        self.transmitter.asked.next = self.receiver.asked.val();
        self.transmitter.saw_gap.next = self.session.saw_gap.val();
        self.transmitter.open.next = self.session.open.val();
        self.transmitter.receipt.next = self.receiver.receipt.val();
        self.transmitter.is_refused.next = self.rate.is_refused.val();
        self.is_busy.next = self.progress.is_busy.val() | self.device_busy.val();
        self.transmitter.is_busy.next = self.is_busy.val();
        self.transmitter.fails.next = self.has_failed.q.val();
        self.transmitter.forgets.next = self.session.forgets.val();
        self.transmitter.holds.next = self.rate.holds.val() | self.session.settles.val();
        self.transmitter.response_valid.next = self.is_offered.val();
        self.transmitter.response_data.next = self.response.data.val();
        self.transmitter.response_both.next = self.response.both.val();
        self.response.ready.next = self.transmitter.response_ready.val();
        self.tx.next = self.transmitter.tx.val();

        // The error lamp keeps a dropped frame visible until the session ends or another one begins.
        if self.receiver.asked.val().drops {
            self.dropped.d.next = true;
        }
        if self.clears.val() {
            self.dropped.d.next = false;
        }
        self.lamps.next.alive = self.session.open.val().is_open | self.timers.beat.val();
        self.lamps.next.busy = self.is_busy.val();
        self.lamps.next.error = self.dropped.q.val();
    }
}
