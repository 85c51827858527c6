//! The rate of the line: the first one, until the host asks for another.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset returns to the first rate |
//! | `asked`, `value` | in | Asked, 32 | what a frame asks for, and the step if it is a `Rate` |
//! | `fails` | in | 1 | return to the first rate at this edge |
//! | `acknowledges`, `closes` | in | 1 | an `Ack` or `Nak` begins; a `Closed` |
//! | `is_quiet` | in | 1 | no frame to the host is under way, and the last stop bit is over |
//! | `step` | out | 22 | a bit takes `2^24 / step` clocks |
//! | `is_refused` | out | 1 | the last `Rate` of the session was refused |
//! | `holds` | out | 1 | no frame may begin: the rate is about to change |
//!
//! 1. `value` stands 2 clocks before `asked`. A step of 0, and one above 2^21, is refused.
//! 2. The rate changes when the first `Ack` or `Nak` that begins after the `Rate` is over, to the last byte.
//! 3. It returns to the first rate when a `Closed` is over.
//!
//! Latency: 1 clock.

use super::Asked;
use incircle_protocol::{LinkConfig, FIRST_RATE, MAX_STEP};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The rate of the line; see the top of this file.
#[derive(LogicBlock)]
pub struct RateControl {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Returns to the first rate.
    pub reset: Signal<In, Bit>,
    /// What a frame asks for.
    pub asked: Signal<In, Asked>,
    /// The step.
    pub value: Signal<In, Bits<32>>,
    /// Return to the first rate.
    pub fails: Signal<In, Bit>,
    /// An `Ack` or `Nak` begins.
    pub acknowledges: Signal<In, Bit>,
    /// A `Closed` begins.
    pub closes: Signal<In, Bit>,
    /// The line to the host is idle.
    pub is_quiet: Signal<In, Bit>,
    /// A bit takes `2^24 / step` clocks.
    pub step: Signal<Out, Bits<22>>,
    /// The last `Rate` was refused.
    pub is_refused: Signal<Out, Bit>,
    /// No frame may begin.
    pub holds: Signal<Out, Bit>,
    present: DFF<Bits<22>>,
    wanted: DFF<Bits<22>>,
    coming: DFF<Bits<22>>,
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
    first: Constant<Bits<22>>,
}

const _: () = assert!(MAX_STEP == 1 << 21, "the largest step of this block is the protocol's");

impl RateControl {
    /// The rate of a link that has passed [`LinkConfig::check`].
    pub fn new(link: LinkConfig) -> Self {
        let first = incircle_protocol::rate_step(FIRST_RATE, link.clock_hz).unwrap_or(MAX_STEP);
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            asked: Signal::default(),
            value: Signal::default(),
            fails: Signal::default(),
            acknowledges: Signal::default(),
            closes: Signal::default(),
            is_quiet: Signal::default(),
            step: Signal::default(),
            is_refused: Signal::default(),
            holds: Signal::default(),
            present: DFF::default(),
            wanted: DFF::default(),
            coming: DFF::default(),
            is_some: DFF::default(),
            is_small: DFF::default(),
            is_large: DFF::default(),
            is_wanted: DFF::default(),
            changes: DFF::default(),
            returns: DFF::default(),
            refused: DFF::default(),
            is_fit: Signal::default(),
            low: Signal::default(),
            high: Signal::default(),
            first: Constant::new(u64::from(first).into()),
        }
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

        // The largest step has one bit, which no other has.
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
