//! The map of the registers: what is written where, and what is read.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `write_enable`, `write_address`, `write_data`, `write_bytes` | in | 1, 12, 32, 4 | a register is written at this edge |
//! | `write_is_known` | out | 1 | it can be written |
//! | `asks_reset`, `clears_dropped`, `clears_failed` | out | 1 | what the write does |
//! | `read_enable`, `read_address` | in | 1, 12 | a register is read at this edge |
//! | `read_data`, `read_is_known` | out | 32, 1 | its value, 0 if there is none; there is one |
//! | `keeps_clocks` | out | 1 | it is the low half of the clocks |
//! | `resets`, `core_runs`, `is_busy` | in | 1 | the status |
//! | `was_dropped`, `has_failed`, `fault` | in | 1, 1, 32 | what went wrong |
//! | `clocks_low`, `clocks_high`, `command_beats`, `answer_beats`, `answers`, `command_waits`, `answer_waits` | in | 32 | the counters |
//!
//! 1. `protocol/STREAM.md` says what stands where.
//!
//! Latency: none.

use incircle_protocol::{
    Config, StreamRegister, CORE_COORD_BITS, CORE_VERSION, MAGIC, PROTOCOL_VERSION, STREAM_FIFO_BEATS, STREAM_VERSION,
};
use rust_hdl_core::prelude::*;

/// The registers; see the top of this file.
#[derive(LogicBlock)]
pub struct Registers {
    /// A register is written.
    pub write_enable: Signal<In, Bit>,
    /// Which one.
    pub write_address: Signal<In, Bits<12>>,
    /// With what.
    pub write_data: Signal<In, Bits<32>>,
    /// Bytes of it that count.
    pub write_bytes: Signal<In, Bits<4>>,
    /// It can be written.
    pub write_is_known: Signal<Out, Bit>,
    /// A register is read.
    pub read_enable: Signal<In, Bit>,
    /// Which one.
    pub read_address: Signal<In, Bits<12>>,
    /// Its value.
    pub read_data: Signal<Out, Bits<32>>,
    /// There is one.
    pub read_is_known: Signal<Out, Bit>,
    /// A reset is under way.
    pub resets: Signal<In, Bit>,
    /// The core's clock runs.
    pub core_runs: Signal<In, Bit>,
    /// Something is held or under way.
    pub is_busy: Signal<In, Bit>,
    /// A beat was dropped.
    pub was_dropped: Signal<In, Bit>,
    /// An answer failed.
    pub has_failed: Signal<In, Bit>,
    /// Its header.
    pub fault: Signal<In, Bits<32>>,
    /// A reset is asked for.
    pub asks_reset: Signal<Out, Bit>,
    /// Forget that a beat was dropped.
    pub clears_dropped: Signal<Out, Bit>,
    /// Forget that an answer failed.
    pub clears_failed: Signal<Out, Bit>,
    /// The low half of the clocks is read.
    pub keeps_clocks: Signal<Out, Bit>,
    /// Clocks, low half.
    pub clocks_low: Signal<In, Bits<32>>,
    /// Clocks, high half.
    pub clocks_high: Signal<In, Bits<32>>,
    /// Command beats.
    pub command_beats: Signal<In, Bits<32>>,
    /// Answer beats.
    pub answer_beats: Signal<In, Bits<32>>,
    /// Answers.
    pub answers: Signal<In, Bits<32>>,
    /// Clocks that a command beat waited.
    pub command_waits: Signal<In, Bits<32>>,
    /// Clocks that an answer beat waited.
    pub answer_waits: Signal<In, Bits<32>>,
    read_index: Signal<Local, Bits<10>>,
    write_index: Signal<Local, Bits<10>>,
    writes_low: Signal<Local, Bit>,
    clears: Signal<Local, Bit>,
    runs_bit: Signal<Local, Bits<32>>,
    busy_bit: Signal<Local, Bits<32>>,
    resets_bit: Signal<Local, Bits<32>>,
    error_bit: Signal<Local, Bits<32>>,
    control: Signal<Local, Bits<32>>,
    dropped_bit: Signal<Local, Bits<32>>,
    failed_bit: Signal<Local, Bits<32>>,
    magic: Constant<Bits<32>>,
    stream_version: Constant<Bits<32>>,
    protocol_version: Constant<Bits<32>>,
    core_version: Constant<Bits<32>>,
    coord_bits: Constant<Bits<32>>,
    capacity: Constant<Bits<32>>,
    contexts: Constant<Bits<32>>,
    ring: Constant<Bits<32>>,
    beat_bits: Constant<Bits<32>>,
    fifo_beats: Constant<Bits<32>>,
    control_index: Constant<Bits<10>>,
    errors_index: Constant<Bits<10>>,
    clocks_index: Constant<Bits<10>>,
}

// The kernel writes offsets as literals, because rust-hdl takes no constants of Rust; a change in the protocol must come here.
const _: () = {
    let expected = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 17, 18, 19, 32, 33, 34, 35, 36, 37, 38];
    let mut index = 0;
    while index < expected.len() {
        assert!(
            StreamRegister::ALL[index].offset() == 4 * expected[index],
            "the offsets of this block follow the protocol"
        );
        index += 1;
    }
};

impl Registers {
    /// The registers of a core of this configuration, behind streams of so many bits a beat.
    pub fn new(config: Config, beat_bits: usize) -> Self {
        let word = |value: u32| Constant::new(Bits::from(u64::from(value)));
        let index = |register: StreamRegister| Constant::new(Bits::from(u64::from(register.offset() / 4)));
        Self {
            write_enable: Signal::default(),
            write_address: Signal::default(),
            write_data: Signal::default(),
            write_bytes: Signal::default(),
            write_is_known: Signal::default(),
            read_enable: Signal::default(),
            read_address: Signal::default(),
            read_data: Signal::default(),
            read_is_known: Signal::default(),
            resets: Signal::default(),
            core_runs: Signal::default(),
            is_busy: Signal::default(),
            was_dropped: Signal::default(),
            has_failed: Signal::default(),
            fault: Signal::default(),
            asks_reset: Signal::default(),
            clears_dropped: Signal::default(),
            clears_failed: Signal::default(),
            keeps_clocks: Signal::default(),
            clocks_low: Signal::default(),
            clocks_high: Signal::default(),
            command_beats: Signal::default(),
            answer_beats: Signal::default(),
            answers: Signal::default(),
            command_waits: Signal::default(),
            answer_waits: Signal::default(),
            read_index: Signal::default(),
            write_index: Signal::default(),
            writes_low: Signal::default(),
            clears: Signal::default(),
            runs_bit: Signal::default(),
            busy_bit: Signal::default(),
            resets_bit: Signal::default(),
            error_bit: Signal::default(),
            control: Signal::default(),
            dropped_bit: Signal::default(),
            failed_bit: Signal::default(),
            magic: word(MAGIC),
            stream_version: word(STREAM_VERSION),
            protocol_version: word(PROTOCOL_VERSION),
            core_version: word(CORE_VERSION),
            coord_bits: word(CORE_COORD_BITS),
            capacity: word(config.points),
            contexts: word(config.contexts),
            ring: word(config.ring),
            beat_bits: word(beat_bits as u32),
            fifo_beats: word(STREAM_FIFO_BEATS),
            control_index: index(StreamRegister::Control),
            errors_index: index(StreamRegister::Errors),
            clocks_index: index(StreamRegister::ClocksLow),
        }
    }
}

impl Logic for Registers {
    #[hdl_gen]
    fn update(&mut self) {
        self.read_index.next = self.read_address.val().get_bits::<10>(2);
        self.write_index.next = self.write_address.val().get_bits::<10>(2);

        // Writes: all that can be written stands in the low byte.
        self.write_is_known.next =
            (self.write_index.val() == self.control_index.val()) | (self.write_index.val() == self.errors_index.val());
        self.writes_low.next = self.write_enable.val() & self.write_bytes.val().get_bit(0);
        self.asks_reset.next = self.writes_low.val()
            & (self.write_index.val() == self.control_index.val())
            & self.write_data.val().get_bit(0);
        self.clears.next = self.writes_low.val() & (self.write_index.val() == self.errors_index.val());
        self.keeps_clocks.next = self.read_enable.val() & (self.read_index.val() == self.clocks_index.val());
        self.clears_dropped.next = self.clears.val() & self.write_data.val().get_bit(0);
        self.clears_failed.next = self.clears.val() & self.write_data.val().get_bit(1);

        // Bits where they stand.
        self.runs_bit.next = 0.into();
        self.busy_bit.next = 0.into();
        self.resets_bit.next = 0.into();
        self.error_bit.next = 0.into();
        self.control.next = 0.into();
        self.dropped_bit.next = 0.into();
        self.failed_bit.next = 0.into();
        if self.core_runs.val() & (!self.resets.val()) {
            self.runs_bit.next = 1.into();
        }
        if self.is_busy.val() {
            self.busy_bit.next = 2.into();
        }
        if self.resets.val() {
            self.resets_bit.next = 4.into();
            self.control.next = 1.into();
        }
        if self.was_dropped.val() | self.has_failed.val() {
            self.error_bit.next = 8.into();
        }
        if self.was_dropped.val() {
            self.dropped_bit.next = 1.into();
        }
        if self.has_failed.val() {
            self.failed_bit.next = 2.into();
        }

        // Reads.
        self.read_is_known.next = true;
        match self.read_index.val().index() {
            0 => {
                self.read_data.next = self.magic.val();
            }
            1 => {
                self.read_data.next = self.stream_version.val();
            }
            2 => {
                self.read_data.next = self.protocol_version.val();
            }
            3 => {
                self.read_data.next = self.core_version.val();
            }
            4 => {
                self.read_data.next = self.coord_bits.val();
            }
            5 => {
                self.read_data.next = self.capacity.val();
            }
            6 => {
                self.read_data.next = self.contexts.val();
            }
            7 => {
                self.read_data.next = self.ring.val();
            }
            8 => {
                self.read_data.next = self.beat_bits.val();
            }
            9 => {
                self.read_data.next = self.fifo_beats.val();
            }
            16 => {
                self.read_data.next = self.control.val();
            }
            17 => {
                self.read_data.next =
                    self.runs_bit.val() | self.busy_bit.val() | self.resets_bit.val() | self.error_bit.val()
            }
            18 => {
                self.read_data.next = self.dropped_bit.val() | self.failed_bit.val();
            }
            19 => {
                self.read_data.next = self.fault.val();
            }
            32 => {
                self.read_data.next = self.clocks_low.val();
            }
            33 => {
                self.read_data.next = self.clocks_high.val();
            }
            34 => {
                self.read_data.next = self.command_beats.val();
            }
            35 => {
                self.read_data.next = self.answer_beats.val();
            }
            36 => {
                self.read_data.next = self.answers.val();
            }
            37 => {
                self.read_data.next = self.command_waits.val();
            }
            38 => {
                self.read_data.next = self.answer_waits.val();
            }
            _ => {
                self.read_data.next = 0.into();
                self.read_is_known.next = false;
            }
        }
    }
}
