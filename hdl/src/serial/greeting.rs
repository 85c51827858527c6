//! The bytes of the greeting, which tells the host the link's and the core's parameters: a memory of constants.
//!
//! Latency: 1 clock from `index` to the byte.

use super::types::Byte;
use crate::commands::types::Word;
use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::{
    Config, Greeting as GreetingWords, Identity, LinkConfig, CORE_COORD_BITS, CORE_RUNS, CORE_VERSION,
    FEATURE_SHORT_IDS, GREETING_WORDS, LINK_MAGIC, LINK_VERSION, MAGIC, PROTOCOL_VERSION,
};

const _: () = assert!(GREETING_WORDS == 13, "the kernel of this block lists the words of the greeting");

#[derive(LogicBlock, Default)]
pub struct Greeting {
    pub clock: Signal<In, Clock>,
    /// Index of a byte of the greeting, 0 to 51; `byte_data` is that byte, a clock later.
    pub index: Signal<In, Bits<6>>,
    pub byte_data: Signal<Out, Byte>,
    chosen: DFF<Byte>,
    word: Signal<Local, Word>,
    word_index: Signal<Local, Bits<4>>,
    place: Signal<Local, Bits<2>>,
    word0: Parameter<Word>,
    word1: Parameter<Word>,
    word2: Parameter<Word>,
    word3: Parameter<Word>,
    word4: Parameter<Word>,
    word5: Parameter<Word>,
    word6: Parameter<Word>,
    word7: Parameter<Word>,
    word8: Parameter<Word>,
    word9: Parameter<Word>,
    word10: Parameter<Word>,
    word11: Parameter<Word>,
    word12: Parameter<Word>,
}

impl Greeting {
    /// The greeting of a core of this configuration behind this link.
    pub fn new(config: Config, link: LinkConfig) -> Self {
        Self::with_features(config, link, FEATURE_SHORT_IDS)
    }

    /// The greeting of a core with runs of this configuration behind this link.
    pub fn with_runs(config: Config, link: LinkConfig) -> Self {
        Self::with_features(config, link, FEATURE_SHORT_IDS | CORE_RUNS)
    }

    /// The greeting of a core with these bits in [`Identity::features`].
    fn with_features(config: Config, link: LinkConfig, features: u32) -> Self {
        let words = Self::words(config, link, features);
        let word = |index: usize| Parameter::new(u64::from(words[index]).into());
        Self {
            word0: word(0),
            word1: word(1),
            word2: word(2),
            word3: word(3),
            word4: word(4),
            word5: word(5),
            word6: word(6),
            word7: word(7),
            word8: word(8),
            word9: word(9),
            word10: word(10),
            word11: word(11),
            word12: word(12),
            ..Self::default()
        }
    }

    /// The words of the greeting, in the order of `protocol/SERIAL.md`.
    fn words(config: Config, link: LinkConfig, features: u32) -> [u32; GREETING_WORDS] {
        let LinkConfig { clock_hz, fifo_bytes, silence_ms } = link;
        let identity = Identity {
            magic: MAGIC,
            protocol_version: PROTOCOL_VERSION,
            core_version: CORE_VERSION,
            coord_bits: CORE_COORD_BITS,
            capacity: config.points,
            contexts: config.contexts,
            engines: config.engines,
            ring_capacity: config.ring,
            features,
        };
        let max_rate = link.max_rate();
        GreetingWords {
            magic: LINK_MAGIC,
            link_version: LINK_VERSION,
            clock_hz,
            fifo_bytes,
            max_rate,
            silence_ms,
            identity,
        }
        .to_words()
    }
}

impl Logic for Greeting {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen);
        self.byte_data.next = self.chosen.q.val();
        self.word_index.next = self.index.val().get_bits::<4>(2);
        self.place.next = self.index.val().get_bits::<2>(0);
        self.word.next = self.word12.val();
        match self.word_index.val().index() {
            0 => {
                self.word.next = self.word0.val();
            }
            1 => {
                self.word.next = self.word1.val();
            }
            2 => {
                self.word.next = self.word2.val();
            }
            3 => {
                self.word.next = self.word3.val();
            }
            4 => {
                self.word.next = self.word4.val();
            }
            5 => {
                self.word.next = self.word5.val();
            }
            6 => {
                self.word.next = self.word6.val();
            }
            7 => {
                self.word.next = self.word7.val();
            }
            8 => {
                self.word.next = self.word8.val();
            }
            9 => {
                self.word.next = self.word9.val();
            }
            10 => {
                self.word.next = self.word10.val();
            }
            11 => {
                self.word.next = self.word11.val();
            }
            _ => {}
        }
        match self.place.val().index() {
            0 => {
                self.chosen.d.next = self.word.val().get_bits::<8>(0);
            }
            1 => {
                self.chosen.d.next = self.word.val().get_bits::<8>(8);
            }
            2 => {
                self.chosen.d.next = self.word.val().get_bits::<8>(16);
            }
            _ => {
                self.chosen.d.next = self.word.val().get_bits::<8>(24);
            }
        }
    }
}
