//! The rate of the line: 115,200 bits per second until the host asks for another.
//!
//! 1. `value` must be stable from 2 clocks before `asked`. A step of 0 or above 2^21 is refused.
//! 2. The device changes to a new rate when the first `Ack` or `Nak` that began after the `Rate` has left the line
//!    with its last byte.
//! 3. The device returns to the first rate when a `Closed` has left the line.
//!
//! Latency: 1 clock from `asked` to `is_refused`, and from `is_quiet` to `step`.

use super::frame_judge::Asked;
use super::types::Step;
use crate::commands::types::Word;
use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::{LinkConfig, FIRST_RATE, MAX_STEP};

#[derive(LogicBlock, Default)]
pub struct RateControl {
    pub clock: Signal<In, Clock>,
    /// A reset returns the line to the first rate.
    pub reset: Signal<In, Bit>,
    /// The request of a frame; `value` is the step if the frame is a `Rate`.
    pub asked: Signal<In, Asked>,
    pub value: Signal<In, Word>,
    /// Silence or a break: return to the first rate at this edge.
    pub fails: Signal<In, Bit>,
    /// The control frame that begins at this edge is an `Ack` or `Nak` (`acknowledges`), or a `Closed` (`closes`).
    pub acknowledges: Signal<In, Bit>,
    pub closes: Signal<In, Bit>,
    /// No frame to the host is under way, and the last stop bit has ended.
    pub is_quiet: Signal<In, Bit>,
    /// Rate of the line: a bit lasts `2^24 / step` clocks.
    pub step: Signal<Out, Step>,
    /// The device refused the last `Rate` of the session.
    pub is_refused: Signal<Out, Bit>,
    /// No frame may begin, because the rate is about to change.
    pub holds: Signal<Out, Bit>,
    present: DFF<Step>,
    wanted: DFF<Step>,
    coming: DFF<Step>,
    is_some: DFF<Bit>,
    is_small: DFF<Bit>,
    is_large: DFF<Bit>,
    is_wanted: DFF<Bit>,
    changes: DFF<Bit>,
    returns: DFF<Bit>,
    refused: DFF<Bit>,
    is_fit: Signal<Local, Bit>,
    low: Signal<Local, Bits<21>>,
    high: Signal<Local, Bits<10>>,
    first: Parameter<Step>,
}

const _: () = assert!(MAX_STEP == 1 << 21, "the largest step of this block is the protocol's");

impl RateControl {
    /// The rate control of a link that has passed [`LinkConfig::check`].
    pub fn new(link: LinkConfig) -> Self {
        let first = incircle_protocol::rate_step(FIRST_RATE, link.clock_hz).unwrap_or(MAX_STEP);
        Self { first: Parameter::new(u64::from(first).into()), ..Self::default() }
    }
}

impl Logic for RateControl {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, present, wanted, coming, is_some, is_small, is_large);
        dff_setup!(self, clock, is_wanted, changes, returns, refused);
        self.step.next = self.present.q.val();
        self.is_refused.next = self.refused.q.val();
        self.holds.next = self.changes.q.val() | self.returns.q.val();

        // No comparator is needed: bit 21 is set in the largest step alone. A step fits if nothing above bit 21 is set,
        // and either bit 21 or some bit below it, but not both.
        self.low.next = self.value.val().get_bits::<21>(0);
        self.high.next = self.value.val().get_bits::<10>(22);
        self.is_some.d.next = self.low.val().any();
        self.is_large.d.next = self.value.val().get_bit(21);
        self.is_small.d.next = !self.high.val().any();
        self.is_fit.next = self.is_small.q.val() & (self.is_some.q.val() ^ self.is_large.q.val());

        if self.acknowledges.val() {
            self.coming.d.next = self.wanted.q.val();
            self.changes.d.next = self.is_wanted.q.val();
            self.is_wanted.d.next = false;
        }
        if self.closes.val() {
            self.returns.d.next = true;
        }
        if self.asked.val().rate {
            self.refused.d.next = !self.is_fit.val();
            self.is_wanted.d.next = self.is_fit.val();
            self.wanted.d.next = self.value.val().get_bits::<22>(0);
        }
        if self.is_quiet.val() & self.changes.q.val() {
            self.present.d.next = self.coming.q.val();
            self.changes.d.next = false;
        }
        if self.is_quiet.val() & self.returns.q.val() {
            self.present.d.next = self.first.val();
            self.returns.d.next = false;
        }
        if self.asked.val().opens | self.asked.val().closes {
            self.is_wanted.d.next = false;
            self.refused.d.next = false;
        }
        if self.fails.val() | self.reset.val() {
            self.present.d.next = self.first.val();
            self.is_wanted.d.next = false;
            self.changes.d.next = false;
            self.returns.d.next = false;
            self.refused.d.next = false;
        }
    }
}
