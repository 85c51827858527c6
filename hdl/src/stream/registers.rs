//! The map of the registers: what is written where, and what is read.
//!
//! 1. `protocol/STREAM.md` says what stands where.
//!
//! Latency: none.

use crate::leaf::Parameter;
use incircle_protocol::{
    Config, StreamRegister, CORE_COORD_BITS, CORE_VERSION, MAGIC, PROTOCOL_VERSION, STREAM_FIFO_BEATS, STREAM_VERSION,
};
use rust_hdl_core::prelude::*;

/// The registers; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Registers {
    /// A register is written at this edge.
    pub write_enable: Signal<In, Bit>,
    pub write_address: Signal<In, Bits<12>>,
    pub write_data: Signal<In, Bits<32>>,
    pub write_bytes: Signal<In, Bits<4>>,
    /// It can be written.
    pub write_is_known: Signal<Out, Bit>,
    /// What the write does.
    pub asks_reset: Signal<Out, Bit>,
    pub clears_dropped: Signal<Out, Bit>,
    pub clears_failed: Signal<Out, Bit>,
    /// A register is read at this edge.
    pub read_enable: Signal<In, Bit>,
    pub read_address: Signal<In, Bits<12>>,
    /// Its value, 0 if there is none; there is one.
    pub read_data: Signal<Out, Bits<32>>,
    pub read_is_known: Signal<Out, Bit>,
    /// It is the low half of the clocks.
    pub keeps_clocks: Signal<Out, Bit>,
    /// The status.
    pub resets: Signal<In, Bit>,
    pub core_runs: Signal<In, Bit>,
    pub is_busy: Signal<In, Bit>,
    /// What went wrong.
    pub was_dropped: Signal<In, Bit>,
    pub has_failed: Signal<In, Bit>,
    pub fault: Signal<In, Bits<32>>,
    /// The counters.
    pub clocks_low: Signal<In, Bits<32>>,
    pub clocks_high: Signal<In, Bits<32>>,
    pub command_beats: Signal<In, Bits<32>>,
    pub answer_beats: Signal<In, Bits<32>>,
    pub answers: Signal<In, Bits<32>>,
    pub command_waits: Signal<In, Bits<32>>,
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
    magic: Parameter<Bits<32>>,
    stream_version: Parameter<Bits<32>>,
    protocol_version: Parameter<Bits<32>>,
    core_version: Parameter<Bits<32>>,
    coord_bits: Parameter<Bits<32>>,
    capacity: Parameter<Bits<32>>,
    contexts: Parameter<Bits<32>>,
    ring: Parameter<Bits<32>>,
    beat_bits: Parameter<Bits<32>>,
    fifo_beats: Parameter<Bits<32>>,
    control_index: Parameter<Bits<10>>,
    errors_index: Parameter<Bits<10>>,
    clocks_index: Parameter<Bits<10>>,
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
        let word = |value: u32| Parameter::new(Bits::from(u64::from(value)));
        let index = |register: StreamRegister| Parameter::new(Bits::from(u64::from(register.offset() / 4)));
        Self {
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
            ..Self::default()
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
