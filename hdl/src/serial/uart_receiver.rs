//! Receives bytes from a line: 8 data bits, no parity, one stop bit, at any rate.
//!
//! 1. The line passes two registers before any logic uses it. A bit is the majority of three samples around its middle.
//! 2. A start bit that is high in its middle is ignored.
//! 3. After a byte without a stop bit the line must be high before another byte begins, so a break counts
//!    as one such byte.
//! 4. A byte ends in the middle of its stop bit, so the next byte may begin half a bit early.
//!
//! Latency: 5 clocks from the middle of the stop bit to `byte_valid`.
//!
//! Source: the two registers are the usual guard against metastability. All registers hold the line inverted, so that
//! their first value, zero, is an idle line.

use super::bit_clock::BitClock;
use super::types::{Byte, Step};
use crate::prelude::*;

/// The part of a byte that is on the line.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum ReceiveState {
    /// No byte; the receiver awaits a start bit.
    Idle,
    /// The start bit, up to its middle.
    Start,
    /// One of the eight data bits.
    Data,
    /// The stop bit, up to its middle.
    Stop,
    /// A low line where a stop bit should have been; the line must become high first.
    Recover,
}

#[derive(LogicBlock, Default)]
pub struct UartReceiver {
    pub clock: Signal<In, Clock>,
    /// After a reset the receiver awaits a byte.
    pub reset: Signal<In, Bit>,
    /// Rate of the line: a bit lasts `2^24 / step` clocks, at least 8.
    pub step: Signal<In, Step>,
    /// The line, high when idle; `rx` may change at any time.
    pub rx: Signal<In, Bit>,
    /// A byte has come.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_data: Signal<Out, Byte>,
    /// A byte without a stop bit has come and is lost.
    pub noise: Signal<Out, Bit>,
    /// The line is low at present, for the detection of a break.
    pub is_low: Signal<Out, Bit>,
    unsettled: DFF<Bit>,
    sample: DFF<Bit>,
    sample_before: DFF<Bit>,
    sample_first: DFF<Bit>,
    vote: DFF<Bit>,
    state: DFF<ReceiveState>,
    bits: DFF<Byte>,
    place: DFF<Bits<3>>,
    comes: DFF<Bit>,
    is_noise: DFF<Bit>,
    bit_clock: BitClock,
    shifted: Signal<Local, Byte>,
    one: Signal<Local, Byte>,
    one_place: Signal<Local, Bits<3>>,
    last_place: Signal<Local, Bits<3>>,
    top_bit: Signal<Local, Byte>,
}

impl UartReceiver {
    /// A receiver that awaits a byte.
    pub fn new() -> Self {
        Self { bit_clock: BitClock::in_middles(), ..Self::default() }
    }
}

impl Logic for UartReceiver {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, unsettled, sample, sample_before, sample_first, vote);
        dff_setup!(self, clock, state, bits, place, comes, is_noise);
        clock!(self, clock, bit_clock);
        self.one.next = 1.into();
        self.one_place.next = 1.into();
        self.last_place.next = 7.into();
        self.byte_valid.next = self.comes.q.val();
        self.byte_data.next = self.bits.q.val();
        self.noise.next = self.is_noise.q.val();
        self.is_low.next = self.sample.q.val();

        // The vote of three samples keeps a short disturbance of the line from becoming a wrong bit.
        self.unsettled.d.next = !self.rx.val();
        self.sample.d.next = self.unsettled.q.val();
        self.sample_before.d.next = self.sample.q.val();
        self.sample_first.d.next = self.sample_before.q.val();
        self.vote.d.next = (self.sample.q.val() & self.sample_before.q.val())
            | (self.sample.q.val() & self.sample_first.q.val())
            | (self.sample_before.q.val() & self.sample_first.q.val());

        self.bit_clock.step.next = self.step.val();
        self.bit_clock.starts.next = false;
        self.shifted.next = self.bits.q.val() >> self.one.val();
        self.top_bit.next = 0x80.into();
        if self.vote.q.val() {
            self.top_bit.next = 0.into();
        }
        self.comes.d.next = false;
        self.is_noise.d.next = false;
        match self.state.q.val() {
            ReceiveState::Idle => {
                if self.sample.q.val() {
                    self.bit_clock.starts.next = true;
                    self.state.d.next = ReceiveState::Start;
                }
            }
            ReceiveState::Start => {
                if self.bit_clock.ticks.val() {
                    self.place.d.next = 0.into();
                    self.state.d.next = ReceiveState::Idle;
                    if self.vote.q.val() {
                        self.state.d.next = ReceiveState::Data;
                    }
                }
            }
            ReceiveState::Data => {
                if self.bit_clock.ticks.val() {
                    self.bits.d.next = self.shifted.val() | self.top_bit.val();
                    self.place.d.next = self.place.q.val() + self.one_place.val();
                    if self.place.q.val() == self.last_place.val() {
                        self.state.d.next = ReceiveState::Stop;
                    }
                }
            }
            ReceiveState::Stop => {
                if self.bit_clock.ticks.val() {
                    self.comes.d.next = !self.vote.q.val();
                    self.is_noise.d.next = self.vote.q.val();
                    self.state.d.next = ReceiveState::Idle;
                    if self.vote.q.val() {
                        self.state.d.next = ReceiveState::Recover;
                    }
                }
            }
            ReceiveState::Recover => {
                if !self.vote.q.val() {
                    self.state.d.next = ReceiveState::Idle;
                }
            }
            _ => {
                self.state.d.next = ReceiveState::Idle;
            }
        }
        if self.reset.val() {
            self.state.d.next = ReceiveState::Idle;
            self.comes.d.next = false;
            self.is_noise.d.next = false;
        }
    }
}
