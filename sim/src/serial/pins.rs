//! The board itself: the Verilated `incircle_serial_top`, with its pins driven and sampled bit by bit.

use std::collections::VecDeque;

use incircle_protocol::{Config, LinkConfig, FIRST_RATE};
use verilated::{Model, ModelDescription, PortId};

use super::uart::Symbol;
use super::uart::{bit_length, UartReceiver, UartSender};
use super::Board;
use crate::device::{built, find, RESET_CLOCKS};
use crate::error::SimError;

/// Number of clocks after which a board that was reset has cleared its memories.
const SETTLING: u64 = 100_000;

/// Prefixes that the build script puts before the name of a configuration, without and with runs.
const SERIAL: &str = "serial_";
const LIVING: &str = "living_serial_";

/// A board at its pins. Every clock is simulated.
#[derive(Debug)]
pub struct PinBoard {
    link: LinkConfig,
    model: Model,
    reset: PortId,
    rx: PortId,
    tx: PortId,
    clocks: u64,
    /// Number of clocks of silence after which the session is forgotten, and a millisecond more.
    silence: u64,
    /// Length of a bit of the host, in fractions of a clock.
    bit: u64,
    sender: UartSender,
    receiver: UartReceiver,
    waiting: VecDeque<Symbol>,
    received: VecDeque<(u64, Symbol)>,
    /// The clock from which on nothing changes unless a byte comes.
    rests_at: u64,
}

impl PinBoard {
    /// A board with the core of this configuration and the serial link of [`board_link`](super::board_link).
    ///
    /// # Errors
    /// [`SimError::NoBoard`]: boards of this configuration were not translated when this crate was built.
    pub fn new(config: Config) -> Result<Self, SimError> {
        let missing = || SimError::NoBoard { name: config.name, built: built(SERIAL).join(", ") };
        Self::of(config, find(SERIAL, config).ok_or_else(missing)?)
    }

    /// A board with the core with runs of this configuration, and the same link.
    ///
    /// # Errors
    /// [`SimError::NoRuns`]: boards of this configuration with runs were not translated when this crate was built.
    pub fn living(config: Config) -> Result<Self, SimError> {
        let missing = || SimError::NoRuns { name: config.name, built: built(LIVING).join(", ") };
        Self::of(config, find(LIVING, config).ok_or_else(missing)?)
    }

    fn of(config: Config, description: &'static ModelDescription) -> Result<Self, SimError> {
        let model = Model::new(description);
        let link = super::board::board_link(config);
        let mut board = Self {
            link,
            reset: model.port("reset")?,
            rx: model.port("rx")?,
            tx: model.port("tx")?,
            model,
            clocks: 0,
            silence: u64::from(link.clock_hz / 1000) * u64::from(link.silence_ms + 1),
            bit: bit_length(link.clock_hz, FIRST_RATE),
            sender: UartSender::default(),
            receiver: UartReceiver::default(),
            waiting: VecDeque::new(),
            received: VecDeque::new(),
            rests_at: 0,
        };
        board.model.port("clock")?;
        board.press_reset();
        Ok(board)
    }

    fn press_reset(&mut self) {
        self.model.set(self.rx, 1);
        self.model.set(self.reset, 1);
        for _ in 0..RESET_CLOCKS {
            self.model.clock();
        }
        self.model.set(self.reset, 0);
        self.model.eval();
        self.clocks += u64::from(RESET_CLOCKS);
        // After a reset no session is open, so no silence must pass before the board is at rest.
        self.rests_at = self.clocks + SETTLING;
    }

    /// Postpones rest by a silence: the line is in use, so a session may be open.
    #[inline]
    fn keep_awake(&mut self) {
        self.rests_at = self.clocks + self.silence;
    }

    /// Simulates one clock: drives the bits that are due on the line to the board, and samples the line from it.
    #[inline]
    fn clock(&mut self) {
        if !self.waiting.is_empty() && self.sender.is_free(self.clocks) {
            if let Some(symbol) = self.waiting.pop_front() {
                self.sender.begin(symbol, self.clocks);
            }
        }
        if let Some(level) = self.sender.level(self.clocks, self.bit) {
            self.model.set(self.rx, u64::from(level));
            self.keep_awake();
        }
        self.model.clock();
        self.clocks += 1;
        let level = self.model.get(self.tx) != 0;
        if !level {
            self.keep_awake();
        }
        if let Some(symbol) = self.receiver.sample(level, self.clocks, self.bit) {
            self.received.push_back((self.clocks, symbol));
        }
    }
}

impl Board for PinBoard {
    fn link(&self) -> LinkConfig {
        self.link
    }

    fn clocks(&self) -> u64 {
        self.clocks
    }

    fn set_rate(&mut self, rate: u32) {
        self.bit = bit_length(self.link.clock_hz, rate);
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
        for _ in 0..clocks {
            self.clock();
        }
    }

    /// The pins do not show the session, so the board is at rest only when the session must be
    /// forgotten: after the silence.
    fn is_at_rest(&self) -> bool {
        self.waiting.is_empty() && self.received.is_empty() && self.clocks > self.rests_at
    }

    fn power_cycle(&mut self) {
        self.waiting.clear();
        self.received.clear();
        (self.sender, self.receiver) = (UartSender::default(), UartReceiver::default());
        self.press_reset();
    }
}
