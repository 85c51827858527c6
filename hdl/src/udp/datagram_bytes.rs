//! The bytes of a datagram to the host, chosen by part and index, and the greeting, which is a table of constants.
//!
//! 1. Part 0 has the receiver's addresses at indices 0 to 11 and the session at 20 to 27, both from `address_byte`, and
//!    `header_byte` between them.
//! 2. Numbers go out low byte first, at indices that are multiples of four and the three behind each. The digest goes
//!    out as its complement, which is the check sum.
//! 3. The check sum and the digest of an answer, parts 5 and 7, come from
//!    [`DatagramSums`](super::DatagramSums), one clock later. What this block gives there means nothing.
//!
//! Latency: 1 clock from the place to the byte.
//!
//! Bytes of each part: 60 answers have been sent, the first word has the index 65,536, and the check sum of the session
//! ends in 46 hexadecimal:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! at.part           0  0  0  0  1  3  6  4  2  .
//! at.index         11 12 19 20 45 28 34 99 32  .
//! address_byte     30 30 30 30 30 30 30 30 30  .
//! header_byte      40 40 40 40 40 40 40 40 40  .
//! word_byte        50 50 50 50 50 50 50 50 50  .
//! byte_data         . 30 40 40 30  7 60  1 50 70
//! ```

use super::types::PartIndex;
use crate::commands::types::Word;
use crate::leaf::LookupTable;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::{
    Config, Identity, UdpGreeting, UdpLinkConfig, CORE_COORD_BITS, CORE_RUNS, CORE_VERSION, FEATURE_SHORT_IDS, MAGIC,
    PROTOCOL_VERSION, UDP_LINK_MAGIC, UDP_LINK_VERSION,
};

/// Index of the first byte behind the header.
const WORDS_INDEX: usize = 28;

#[derive(LogicBlock, Default)]
pub struct DatagramBytes {
    pub clock: Signal<In, Clock>,
    pub at: Signal<In, PartIndex>,
    /// A byte of the addresses or of the session, and of the rest of the header.
    pub address_byte: Signal<In, Byte>,
    pub header_byte: Signal<In, Byte>,
    /// State of the digest of the session.
    pub digest: Signal<In, Word>,
    /// Number of answers, index of the first word, and a byte of the words.
    pub answers: Signal<In, Word>,
    pub first_index: Signal<In, Bits<17>>,
    pub word_byte: Signal<In, Byte>,
    /// The byte, a clock later.
    pub byte_data: Signal<Out, Byte>,
    chosen: DFF<Byte>,
    greeting: LookupTable<6, Byte>,
    place: Signal<Local, Bits<7>>,
    low_place: Signal<Local, Bits<2>>,
    is_rest_of_header: Signal<Local, Bit>,
    digest_byte: Signal<Local, Byte>,
    answers_byte: Signal<Local, Byte>,
    index_byte: Signal<Local, Byte>,
    highest: Signal<Local, Bit>,
    all: Signal<Local, Byte>,
}

impl DatagramBytes {
    /// The bytes of a device with a core of this configuration.
    pub fn new(config: Config, link: UdpLinkConfig) -> Self {
        Self::with_features(config, link, FEATURE_SHORT_IDS)
    }

    /// The bytes of a device with a core with runs of this configuration.
    pub fn with_runs(config: Config, link: UdpLinkConfig) -> Self {
        Self::with_features(config, link, FEATURE_SHORT_IDS | CORE_RUNS)
    }

    /// The bytes of a device with a core with these bits in [`Identity::features`].
    fn with_features(config: Config, link: UdpLinkConfig, features: u32) -> Self {
        let bytes: Vec<u8> = words(config, link, features).into_iter().flat_map(u32::to_le_bytes).collect();
        // The table has the low six bits of an index, which differ for all bytes of the greeting.
        let byte = |row: usize| bytes[(row + 64 - WORDS_INDEX) % 64 % bytes.len()];
        Self { greeting: LookupTable::new(|row| u64::from(byte(row)).into()), ..Self::default() }
    }
}

/// The words of the greeting, in the order of `protocol/UDP.md`.
fn words(config: Config, link: UdpLinkConfig, features: u32) -> [u32; incircle_protocol::UDP_GREETING_WORDS] {
    let UdpLinkConfig { clock_hz, fifo_bytes, silence_ms, mac } = link;
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
    let (magic, link_version) = (UDP_LINK_MAGIC, UDP_LINK_VERSION);
    UdpGreeting { magic, link_version, clock_hz, fifo_bytes, silence_ms, mac, identity }.to_words()
}

impl Logic for DatagramBytes {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen);
        self.byte_data.next = self.chosen.q.val();
        self.all.next = 0xff.into();
        self.place.next = self.at.val().index;
        self.low_place.next = self.place.val().get_bits::<2>(0);
        self.greeting.index.next = self.place.val().get_bits::<6>(0);
        self.highest.next = self.first_index.val().get_bit(16);
        match self.low_place.val().index() {
            0 => {
                self.digest_byte.next = self.digest.val().get_bits::<8>(0);
                self.answers_byte.next = self.answers.val().get_bits::<8>(0);
                self.index_byte.next = self.first_index.val().get_bits::<8>(0);
            }
            1 => {
                self.digest_byte.next = self.digest.val().get_bits::<8>(8);
                self.answers_byte.next = self.answers.val().get_bits::<8>(8);
                self.index_byte.next = self.first_index.val().get_bits::<8>(8);
            }
            2 => {
                self.digest_byte.next = self.digest.val().get_bits::<8>(16);
                self.answers_byte.next = self.answers.val().get_bits::<8>(16);
                self.index_byte.next = 0.into();
                if self.highest.val() {
                    self.index_byte.next = 1.into();
                }
            }
            _ => {
                self.digest_byte.next = self.digest.val().get_bits::<8>(24);
                self.answers_byte.next = self.answers.val().get_bits::<8>(24);
                self.index_byte.next = 0.into();
            }
        }
        // Indices 12 to 19 are kind, status, free bytes and number; before them is the receiver, behind them the
        // session.
        self.is_rest_of_header.next =
            (self.place.val().get_bit(4) & (!self.place.val().get_bit(3)) & (!self.place.val().get_bit(2)))
                | ((!self.place.val().get_bit(4)) & self.place.val().get_bit(3) & self.place.val().get_bit(2));
        match self.at.val().part.index() {
            0 => {
                self.chosen.d.next = self.address_byte.val();
                if self.is_rest_of_header.val() {
                    self.chosen.d.next = self.header_byte.val();
                }
            }
            1 => {
                self.chosen.d.next = self.greeting.value.val();
            }
            2 => {
                self.chosen.d.next = self.digest_byte.val() ^ self.all.val();
            }
            3 => {
                self.chosen.d.next = self.answers_byte.val();
            }
            6 => {
                self.chosen.d.next = self.index_byte.val();
            }
            _ => {
                self.chosen.d.next = self.word_byte.val();
            }
        }
    }
}
