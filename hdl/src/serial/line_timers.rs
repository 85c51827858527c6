//! Times the line: a silent host, a break, and the blinking of a lamp.
//!
//! 1. The unit of time is an eighth of a millisecond. The first unit of a silence or a break may be short, so both last
//!    up to one unit longer than their limit.
//! 2. `is_silent` falls one clock after `hears`.
//!
//! Latency: 2 clocks from the end of a time.

use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::{LinkConfig, BREAK_MS};

const _: () = assert!(BREAK_MS == 1, "eight eighths of this block are a break, and a short one");

#[derive(LogicBlock, Default)]
pub struct LineTimers {
    /// After a reset the silence begins anew.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The line is low at present.
    pub is_low: Signal<In, Bit>,
    /// A sound frame has come.
    pub hears: Signal<In, Bit>,
    /// The line has been low for a millisecond and still is.
    pub is_broken: Signal<Out, Bit>,
    /// No sound frame has come for `silence_ms` of the parameters.
    pub is_silent: Signal<Out, Bit>,
    /// High for about half a second, then low for as long.
    pub beat: Signal<Out, Bit>,
    clocks: DFF<Bits<16>>,
    ticks: DFF<Bit>,
    low_for: DFF<Bits<4>>,
    breaks: DFF<Bit>,
    left: DFF<Bits<16>>,
    silent: DFF<Bit>,
    beats: DFF<Bits<13>>,
    one: Signal<Local, Bits<16>>,
    one_eighth: Signal<Local, Bits<4>>,
    one_beat: Signal<Local, Bits<13>>,
    longest: Signal<Local, Bits<4>>,
    last_clock: Parameter<Bits<16>>,
    silence: Parameter<Bits<16>>,
}

impl LineTimers {
    /// Units of time in a millisecond.
    pub const PARTS: u32 = 8;

    /// The timers of a link that has passed [`LinkConfig::check`].
    pub fn new(link: LinkConfig) -> Self {
        let part = link.clock_hz.div_ceil(1000 * Self::PARTS);
        Self {
            last_clock: Parameter::new(u64::from(part - 1).into()),
            silence: Parameter::new(u64::from(link.silence_ms * Self::PARTS + 1).into()),
            ..Self::default()
        }
    }
}

impl Logic for LineTimers {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clocks, ticks, low_for, breaks, left, silent, beats);
        self.one.next = 1.into();
        self.one_eighth.next = 1.into();
        self.one_beat.next = 1.into();
        self.longest.next = 9.into();
        self.is_broken.next = self.breaks.q.val();
        self.is_silent.next = self.silent.q.val();
        self.beat.next = self.beats.q.val().get_bit(12);

        self.ticks.d.next = !self.clocks.q.val().any();
        self.clocks.d.next = self.clocks.q.val() - self.one.val();
        if !self.clocks.q.val().any() {
            self.clocks.d.next = self.last_clock.val();
        }
        self.breaks.d.next = self.low_for.q.val() == self.longest.val();
        self.silent.d.next = !self.left.q.val().any();
        if self.ticks.q.val() {
            self.beats.d.next = self.beats.q.val() + self.one_beat.val();
            if self.low_for.q.val() != self.longest.val() {
                self.low_for.d.next = self.low_for.q.val() + self.one_eighth.val();
            }
            if self.left.q.val().any() {
                self.left.d.next = self.left.q.val() - self.one.val();
            }
        }
        if !self.is_low.val() {
            self.low_for.d.next = 0.into();
            self.breaks.d.next = false;
        }
        if self.hears.val() | self.reset.val() {
            self.left.d.next = self.silence.val();
            self.silent.d.next = false;
        }
        if self.reset.val() {
            self.clocks.d.next = 0.into();
            self.ticks.d.next = false;
            self.low_for.d.next = 0.into();
            self.breaks.d.next = false;
            self.beats.d.next = 0.into();
        }
    }
}
