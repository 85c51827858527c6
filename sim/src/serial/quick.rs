//! A board without bits: the software model of the serial link around the Verilated core. `PinBoard` simulates the
//! hardware of the link; `QuickBoard` exchanges whole bytes with its model, and is faster.

use std::collections::VecDeque;

use incircle_model::serial::SerialModel;
use incircle_protocol::{Config, LinkConfig, FIRST_RATE};

use super::core::StreamCore;
use super::uart::Symbol;
use super::uart::{bit_length, bit_length_of_step, symbol_clocks};
use super::Board;
use crate::error::SimError;

/// Number of clocks that pass at once while the core works, fewer than a byte takes.
const QUANTUM: u64 = 64;
/// Two rates count as different if they differ by more than one part in this many.
const TOLERANCE: u64 = 25;

/// A board that exchanges whole bytes. Each byte takes as long as its bits would, and idle time is skipped. If the two
/// ends have different rates, no byte arrives unchanged.
pub struct QuickBoard {
    config: Config,
    has_runs: bool,
    link: LinkConfig,
    model: SerialModel<StreamCore>,
    clocks: u64,
    rate: u32,
    waiting: VecDeque<Symbol>,
    /// The symbol on the line to the board, and the clock at which it has passed.
    arriving: Option<(Symbol, u64)>,
    /// The byte on the line to the host, the clock at which it has passed, and the length of its bits.
    leaving: Option<(u8, u64, u64)>,
    received: VecDeque<(u64, Symbol)>,
}

impl QuickBoard {
    /// A board with the core of this configuration.
    ///
    /// # Errors
    /// The errors of [`SimDevice::new`](crate::SimDevice::new).
    pub fn new(config: Config, link: LinkConfig) -> Result<Self, SimError> {
        Self::of(config, false, link)
    }

    /// A board whose core of this configuration has runs.
    ///
    /// # Errors
    /// The errors of [`SimDevice::living`](crate::SimDevice::living).
    pub fn living(config: Config, link: LinkConfig) -> Result<Self, SimError> {
        Self::of(config, true, link)
    }

    fn of(config: Config, has_runs: bool, link: LinkConfig) -> Result<Self, SimError> {
        Ok(Self {
            config,
            has_runs,
            link,
            model: powered(config, has_runs, link)?,
            clocks: 0,
            rate: FIRST_RATE,
            waiting: VecDeque::new(),
            arriving: None,
            leaving: None,
            received: VecDeque::new(),
        })
    }

    /// Length of a bit of the host, in fractions of a clock.
    fn host_bit(&self) -> u64 {
        bit_length(self.link.clock_hz, self.rate)
    }

    /// Whether bits of the other end have nearly the length of the host's.
    fn is_near(&self, device_bit: u64) -> bool {
        device_bit.abs_diff(self.host_bit()) * TOLERANCE <= device_bit
    }

    /// Puts the next byte or symbol on each line that is free.
    fn exchange(&mut self) {
        if self.leaving.is_none() {
            let bit = bit_length_of_step(self.model.rate_step());
            let end = self.clocks + symbol_clocks(bit);
            self.leaving = self.model.give().map(|byte| (byte, end, bit));
        }
        if self.arriving.is_none() {
            let end = self.clocks + symbol_clocks(self.host_bit());
            self.arriving = self.waiting.pop_front().map(|symbol| (symbol, end));
        }
    }

    /// Delivers the bytes and symbols that have passed by this clock.
    fn deliver(&mut self) {
        if let Some((symbol, _)) = self.arriving.take_if(|(_, end)| *end <= self.clocks) {
            let is_near = self.is_near(bit_length_of_step(self.model.rate_step()));
            match symbol.byte() {
                Some(byte) if symbol.is_sound() && is_near => self.model.take(byte),
                Some(_) => self.model.spoil(),
                None => {}
            }
        }
        if let Some((byte, end, bit)) = self.leaving.take_if(|(_, end, _)| *end <= self.clocks) {
            // At another rate the receiver samples the wrong bits, and finds no stop bit.
            let symbol = if self.is_near(bit) { Symbol::of(byte) } else { Symbol::of(byte ^ 0x5a).flip(9) };
            self.received.push_back((end, symbol));
        }
    }
}

/// The software model of the serial link around a fresh core.
fn powered(config: Config, has_runs: bool, link: LinkConfig) -> Result<SerialModel<StreamCore>, SimError> {
    Ok(SerialModel::new(link, StreamCore::identity(config, has_runs), StreamCore::new(config, has_runs)?))
}

impl Board for QuickBoard {
    fn link(&self) -> LinkConfig {
        self.link
    }

    fn clocks(&self) -> u64 {
        self.clocks
    }

    fn set_rate(&mut self, rate: u32) {
        self.rate = rate;
    }

    fn send(&mut self, symbol: Symbol) {
        self.waiting.push_back(symbol);
    }

    fn waiting(&self) -> usize {
        self.waiting.len()
    }

    fn receive(&mut self) -> Option<(u64, Symbol)> {
        self.received.pop_front()
    }

    fn run(&mut self, clocks: u64) {
        let end = self.clocks + clocks;
        while self.clocks < end {
            self.exchange();
            let mut until = end;
            if self.model.is_busy() {
                until = until.min(self.clocks + QUANTUM);
            }
            if let Some((_, at)) = self.arriving {
                until = until.min(at);
            }
            if let Some((_, at, _)) = self.leaving {
                until = until.min(at);
            }
            let until = until.max(self.clocks + 1);
            self.model.pass(until - self.clocks);
            self.clocks = until;
            self.deliver();
        }
    }

    fn is_at_rest(&self) -> bool {
        let line_is_idle = self.arriving.is_none() && self.leaving.is_none() && self.waiting.is_empty();
        line_is_idle && self.received.is_empty() && self.model.is_at_rest()
    }

    fn power_cycle(&mut self) {
        // The same call succeeded when the board was made, so it succeeds again.
        if let Ok(model) = powered(self.config, self.has_runs, self.link) {
            self.model = model;
        }
        self.waiting.clear();
        self.received.clear();
        (self.arriving, self.leaving) = (None, None);
    }
}
