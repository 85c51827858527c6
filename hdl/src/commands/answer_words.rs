//! Chooses the words of a payload that has no records, in two ranks of registers.
//!
//! 1. The first rank chooses a word of each kind of payload; for the counters and the histogram, their own blocks do
//!    that. The second rank chooses the kind.
//! 2. `opcode` does not change between the command and the end of its answer.
//!
//! Latency: 2 clocks from `index`, and 1 from `counter` and `latency`, at an edge with `chooses`.

use super::types::{RecordCount, Tally, VertexCount, Word};
use crate::prelude::*;
use incircle_protocol::{
    Opcode, CORE_COORD_BITS, CORE_VERSION, ENGINES_SHIFT, FEATURES_SHIFT, FEATURE_SHORT_IDS, MAGIC, PROTOCOL_VERSION,
};

#[derive(LogicBlock, Default)]
pub struct AnswerWords {
    pub clock: Signal<In, Clock>,
    /// Opcode of the command.
    pub opcode: Signal<In, Bits<8>>,
    /// Parameters of the core, and the number of engines on the chip; constants.
    pub capacity: Signal<In, VertexCount>,
    pub contexts: Signal<In, Bits<5>>,
    pub engines: Signal<In, Bits<8>>,
    pub ring_capacity: Signal<In, Bits<7>>,
    /// In a core with runs: the word of the identity with the features alone; a constant.
    pub own_features: Vec<Signal<In, Word>>,
    pub tally: Signal<In, Tally>,
    pub insertions: Signal<In, Word>,
    pub duplicates: Signal<In, Word>,
    pub records: Signal<In, RecordCount>,
    /// Index of the wanted word in the payload.
    pub index: Signal<In, Bits<7>>,
    /// The counter, and the bucket of the histogram, whose number was `index` a clock ago.
    pub counter: Signal<In, Word>,
    pub latency: Signal<In, Word>,
    /// Load the word whose number was `index` a clock ago.
    pub chooses: Signal<In, Bit>,
    /// The loaded word, valid until the next one is loaded.
    pub word: Signal<Out, Word>,
    identity: DFF<Word>,
    report: DFF<Word>,
    chosen: DFF<Word>,
    /// Place in the identity or the report, which are both shorter than 8 words.
    place: Signal<Local, Bits<3>>,
    wide_contexts: Signal<Local, Word>,
    wide_engines: Signal<Local, Word>,
    shifted_engines: Signal<Local, Word>,
    engines_shift: Signal<Local, Word>,
    features: Signal<Local, Word>,
}

impl AnswerWords {
    /// The block of a core that says its own features.
    pub fn with_features() -> Self {
        Self { own_features: vec![Signal::default()], ..Self::default() }
    }
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Hello as u8 == 1
        && Opcode::Insert as u8 == 3
        && Opcode::Latencies as u8 == 6
        && MAGIC == 0x696e_4369
        && PROTOCOL_VERSION == 0x0002_0000
        && CORE_VERSION == 0x0000_0300
        && CORE_COORD_BITS == 16
        && ENGINES_SHIFT == 8
        && FEATURE_SHORT_IDS << FEATURES_SHIFT == 0x0002_0000,
    "the words of this block follow the protocol"
);

impl Logic for AnswerWords {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, identity, report, chosen);
        self.word.next = self.chosen.q.val();
        self.place.next = self.index.val().get_bits::<3>(0);
        self.engines_shift.next = 8.into();
        self.features.next = 0x0002_0000.into();
        for i in 0..self.own_features.len() {
            self.features.next = self.own_features[i].val();
        }
        self.wide_contexts.next = bit_cast::<32, 5>(self.contexts.val());
        self.wide_engines.next = bit_cast::<32, 8>(self.engines.val());
        self.shifted_engines.next = self.wide_engines.val() << self.engines_shift.val();
        match self.place.val().index() {
            0 => {
                self.identity.d.next = 0x696e_4369.into();
                self.report.d.next = bit_cast::<32, 15>(self.tally.val().arrived);
            }
            1 => {
                self.identity.d.next = 0x0002_0000.into();
                self.report.d.next = self.insertions.val();
            }
            2 => {
                self.identity.d.next = 0x0000_0300.into();
                self.report.d.next = self.duplicates.val();
            }
            3 => {
                self.identity.d.next = 16.into();
                self.report.d.next = self.tally.val().refused;
            }
            4 => {
                self.identity.d.next = bit_cast::<32, 15>(self.capacity.val());
                self.report.d.next = bit_cast::<32, 15>(self.records.val());
            }
            5 => {
                self.identity.d.next = self.wide_contexts.val() | self.shifted_engines.val();
                self.report.d.next = 0.into();
            }
            _ => {
                self.identity.d.next = bit_cast::<32, 7>(self.ring_capacity.val()) | self.features.val();
                self.report.d.next = 0.into();
            }
        }
        if self.chooses.val() {
            match self.opcode.val().index() {
                1 => {
                    self.chosen.d.next = self.identity.q.val();
                }
                3 => {
                    self.chosen.d.next = self.report.q.val();
                }
                6 => {
                    self.chosen.d.next = self.latency.val();
                }
                _ => {
                    self.chosen.d.next = self.counter.val();
                }
            }
        }
    }
}
