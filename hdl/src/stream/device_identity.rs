//! The registers that say what the device is, so that a host can refuse one that it does not know: constants.
//!
//! Latency: none (combinational) from `index` to `value`.

use super::axi::RegisterIndex;
use crate::commands::types::Word;
use crate::leaf::Parameter;
use incircle_protocol::{
    Config, StreamRegister, CORE_COORD_BITS, CORE_RUNS, CORE_VERSION, ENGINES_SHIFT, FEATURES_SHIFT, FEATURE_SHORT_IDS,
    MAGIC, PROTOCOL_VERSION, STREAM_FIFO_BEATS, STREAM_VERSION,
};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DeviceIdentity {
    /// Number of the register that is read.
    pub index: Signal<In, RegisterIndex>,
    /// Value of that register, or 0 if it is none of this block; `is_known` says that it is one.
    pub value: Signal<Out, Word>,
    pub is_known: Signal<Out, Bit>,
    magic: Parameter<Word>,
    stream_version: Parameter<Word>,
    protocol_version: Parameter<Word>,
    core_version: Parameter<Word>,
    coord_bits: Parameter<Word>,
    capacity: Parameter<Word>,
    contexts: Parameter<Word>,
    ring_capacity: Parameter<Word>,
    beat_bits: Parameter<Word>,
    fifo_beats: Parameter<Word>,
}

// The kernel holds the offsets as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = {
    let mut index = 0;
    while index < 10 {
        assert!(
            StreamRegister::ALL[index].offset() == 4 * index as u32,
            "the offsets of this block follow the protocol"
        );
        index += 1;
    }
};

impl DeviceIdentity {
    /// The registers of a core of this configuration behind streams with beats of `beat_bits` bits.
    pub fn new(config: Config, beat_bits: usize) -> Self {
        Self::with_features(config, beat_bits, FEATURE_SHORT_IDS)
    }

    /// The registers of a core with runs of this configuration behind such streams.
    pub fn with_runs(config: Config, beat_bits: usize) -> Self {
        Self::with_features(config, beat_bits, FEATURE_SHORT_IDS | CORE_RUNS)
    }

    /// The registers of a core with these bits in the features of its identity.
    fn with_features(config: Config, beat_bits: usize, features: u32) -> Self {
        let word = |value: u32| Parameter::new(Bits::from(u64::from(value)));
        Self {
            magic: word(MAGIC),
            stream_version: word(STREAM_VERSION),
            protocol_version: word(PROTOCOL_VERSION),
            core_version: word(CORE_VERSION),
            coord_bits: word(CORE_COORD_BITS),
            capacity: word(config.points),
            contexts: word(config.engines << ENGINES_SHIFT | config.contexts),
            ring_capacity: word(features << FEATURES_SHIFT | config.ring),
            beat_bits: word(beat_bits as u32),
            fifo_beats: word(STREAM_FIFO_BEATS),
            ..Self::default()
        }
    }
}

impl Logic for DeviceIdentity {
    #[hdl_gen]
    fn update(&mut self) {
        self.is_known.next = true;
        match self.index.val().index() {
            0 => {
                self.value.next = self.magic.val();
            }
            1 => {
                self.value.next = self.stream_version.val();
            }
            2 => {
                self.value.next = self.protocol_version.val();
            }
            3 => {
                self.value.next = self.core_version.val();
            }
            4 => {
                self.value.next = self.coord_bits.val();
            }
            5 => {
                self.value.next = self.capacity.val();
            }
            6 => {
                self.value.next = self.contexts.val();
            }
            7 => {
                self.value.next = self.ring_capacity.val();
            }
            8 => {
                self.value.next = self.beat_bits.val();
            }
            9 => {
                self.value.next = self.fifo_beats.val();
            }
            _ => {
                self.value.next = 0.into();
                self.is_known.next = false;
            }
        }
    }
}
