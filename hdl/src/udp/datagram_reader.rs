//! Reads a datagram from the Ethernet port: numbers its bytes, joins its words, and checks its sum and its length.
//!
//! 1. A datagram comes as the 12 bytes of its sender, the bytes of its payload, and an end;
//!    [`DatagramGate`](crate::ethernet::DatagramGate) describes the entries.
//! 2. Bytes with an index below 32 are `head_valid`. Words are given from index 28 on, but not the last one, which is
//!    the check sum: a word is given when the first byte behind it comes.
//! 3. Behind an end the block takes no entry for 6 clocks, in which the datagram is judged and carried out. `settles`
//!    is high from the clock before `comes` for as long. So each datagram finds what the one before it has changed.
//! 4. In all other clocks an entry is taken if there is one and `holds` is low.
//!
//! Latency: 1 clock from an entry to its byte; 2 clocks from the end to `comes`.
//!
//! The last two bytes of a word, the check sum and the end of a datagram. The next one waits:
//! ```text
//! entry_valid      /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! entry[8]         __________________/^^\__________________________
//! entry_pop        /^^^^^^^^^^^^^^^^^^^^\_________________/^^^^^^^^
//! payload_valid    _________/^^^^^^^^^^^\__________________________
//! payload            .  .  . 21 22 23 24  .  .  .  .  .  .  .  .  .
//! word_valid       _________/^^\___________________________________
//! settles          _____________________/^^^^^^^^^^^^^^^^^\________
//! comes            ________________________/^^\____________________
//! verdict.is_sound   .  .  .  .  .  .  .  ./^^  .  .  .  .  .  .  .
//! begins           __________________________________________/^^\__
//! ```

use super::types::{ByteIndex, DatagramVerdict, HeadIndex};
use crate::commands::types::Word;
use crate::ethernet::ByteCrc;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::{DATAGRAM_HEADER_BYTES, MAX_DATAGRAM_WORDS, UDP_GREETING_WORDS};

#[derive(LogicBlock, Default)]
pub struct DatagramReader {
    pub clock: Signal<In, Clock>,
    /// A reset awaits the first byte of a datagram.
    pub reset: Signal<In, Bit>,
    /// The oldest entry of the port, which the block takes at an edge with `entry_pop`.
    pub entry_valid: Signal<In, Bit>,
    pub entry: Signal<In, Bits<9>>,
    pub entry_pop: Signal<Out, Bit>,
    /// No entry may be taken.
    pub holds: Signal<In, Bit>,
    /// The first byte of a datagram has come.
    pub begins: Signal<Out, Bit>,
    /// A byte of the sender or the header, and its index.
    pub head_valid: Signal<Out, Bit>,
    pub index: Signal<Out, HeadIndex>,
    pub byte_data: Signal<Out, Byte>,
    /// A word behind the header.
    pub word_valid: Signal<Out, Bit>,
    pub word: Signal<Out, Word>,
    /// A byte of the words behind the header, for their digest.
    pub payload_valid: Signal<Out, Bit>,
    pub payload: Signal<Out, Byte>,
    /// The datagram has ended.
    pub comes: Signal<Out, Bit>,
    pub verdict: Signal<Out, DatagramVerdict>,
    /// A datagram is being judged and carried out.
    pub settles: Signal<Out, Bit>,
    came: DFF<Bit>,
    value: DFF<Bits<9>>,
    count: DFF<ByteIndex>,
    /// The last four bytes, the newest in the highest place.
    tail: DFF<Word>,
    pause: DFF<Bits<3>>,
    ended: DFF<Bit>,
    found: DFF<DatagramVerdict>,
    crc: ByteCrc,
    pops: Signal<Local, Bit>,
    is_end: Signal<Local, Bit>,
    is_byte: Signal<Local, Bit>,
    is_beyond: Signal<Local, Bit>,
    beyond: Signal<Local, Bits<6>>,
    lowest: Signal<Local, Bits<2>>,
    words: Signal<Local, Bits<9>>,
    low_words: Signal<Local, Bits<4>>,
    some_words: Signal<Local, Bits<6>>,
    is_long: Signal<Local, Bit>,
    is_sender: Signal<Local, Bit>,
    wide_byte: Signal<Local, Word>,
    newest: Signal<Local, Word>,
    older: Signal<Local, Word>,
    one: Signal<Local, ByteIndex>,
    one_clock: Signal<Local, Bits<3>>,
    eight: Signal<Local, Word>,
    three_bytes: Signal<Local, Word>,
    bare_words: Signal<Local, Bits<9>>,
    greeting_words: Signal<Local, Bits<9>>,
    sound_state: Signal<Local, Word>,
}

// The kernel holds these numbers as literals, because rust-hdl allows no constants there. The words of a datagram are
// counted from its sender on: 3 of the sender, 4 of the header and 1 of the check sum besides the words of its kind.
const _: () = assert!(
    DATAGRAM_HEADER_BYTES == 16 && UDP_GREETING_WORDS + 8 == 22 && MAX_DATAGRAM_WORDS + 8 == 0b1_0111_0000,
    "the lengths of this block follow the protocol"
);
const _: () = assert!(
    ByteCrc::FIRST == 0xffff_ffff && ByteCrc::SOUND == 0xdebb_20e3,
    "the literals of this block follow the check sum"
);

impl Logic for DatagramReader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, came, value, count, tail, pause, ended, found);
        clock!(self, clock, crc);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.eight.next = 8.into();
        self.three_bytes.next = 24.into();
        self.bare_words.next = 8.into();
        self.greeting_words.next = 22.into();
        self.sound_state.next = 0xdebb_20e3u64.into();

        self.pops.next = self.entry_valid.val() & (!self.holds.val()) & (!self.pause.q.val().any());
        self.entry_pop.next = self.pops.val();
        self.came.d.next = self.pops.val();
        self.value.d.next = self.entry.val();
        self.settles.next = self.pause.q.val().any();
        if self.pause.q.val().any() {
            self.pause.d.next = self.pause.q.val() - self.one_clock.val();
        }
        if self.pops.val() & self.entry.val().get_bit(8) {
            self.pause.d.next = 6.into();
        }

        self.is_end.next = self.came.q.val() & self.value.q.val().get_bit(8);
        self.is_byte.next = self.came.q.val() & (!self.value.q.val().get_bit(8));
        if self.is_byte.val() {
            self.count.d.next = self.count.q.val() + self.one.val();
        }
        if self.is_end.val() {
            self.count.d.next = 0.into();
        }
        self.beyond.next = self.count.q.val().get_bits::<6>(5);
        self.is_beyond.next = self.beyond.val().any();
        self.begins.next = self.is_byte.val() & (!self.count.q.val().any());
        self.head_valid.next = self.is_byte.val() & (!self.is_beyond.val());
        self.index.next = self.count.q.val().get_bits::<5>(0);
        self.byte_data.next = self.value.q.val().get_bits::<8>(0);

        self.wide_byte.next = bit_cast::<32, 8>(self.byte_data.val());
        self.newest.next = self.wide_byte.val() << self.three_bytes.val();
        self.older.next = self.tail.q.val() >> self.eight.val();
        if self.is_byte.val() {
            self.tail.d.next = self.newest.val() | self.older.val();
        }
        self.lowest.next = self.count.q.val().get_bits::<2>(0);
        self.word_valid.next = self.is_byte.val() & self.is_beyond.val() & (!self.lowest.val().any());
        self.word.next = self.tail.q.val();
        self.payload_valid.next = self.is_byte.val() & self.is_beyond.val();
        self.payload.next = self.tail.q.val().get_bits::<8>(0);

        // The sum begins behind the 12 bytes of the sender.
        self.is_sender.next = (!self.is_beyond.val())
            & (!self.count.q.val().get_bit(4))
            & (!(self.count.q.val().get_bit(3) & self.count.q.val().get_bit(2)));
        self.crc.start.next = 0xffff_ffffu64.into();
        self.crc.sets.next = self.is_sender.val();
        self.crc.takes.next = self.is_byte.val();
        self.crc.byte_data.next = self.byte_data.val();

        self.words.next = self.count.q.val().get_bits::<9>(2);
        self.low_words.next = self.count.q.val().get_bits::<4>(2);
        self.some_words.next = self.count.q.val().get_bits::<6>(5);
        self.is_long.next = self.words.val().get_bit(8)
            & (self.words.val().get_bit(7)
                | (self.words.val().get_bit(6)
                    & self.words.val().get_bit(5)
                    & self.words.val().get_bit(4)
                    & self.low_words.val().any()));
        self.ended.d.next = self.is_end.val();
        self.comes.next = self.ended.q.val();
        self.found.d.next.counts = self.value.q.val().get_bit(0);
        self.found.d.next.is_sound = self.value.q.val().get_bit(0)
            & (!self.lowest.val().any())
            & (self.crc.state.val() == self.sound_state.val());
        self.found.d.next.is_to_all = self.value.q.val().get_bit(1);
        self.found.d.next.is_bare = self.words.val() == self.bare_words.val();
        self.found.d.next.is_greeting = self.words.val() == self.greeting_words.val();
        self.found.d.next.is_data =
            self.some_words.val().any() & (self.words.val() != self.bare_words.val()) & (!self.is_long.val());
        self.verdict.next = self.found.q.val();
        if self.reset.val() {
            self.came.d.next = false;
            self.count.d.next = 0.into();
            self.pause.d.next = 0.into();
            self.ended.d.next = false;
        }
    }
}
