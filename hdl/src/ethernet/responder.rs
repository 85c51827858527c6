//! Answers ARP requests and echo requests: it keeps the frame that asks, and sends it back with some bytes changed.
//!
//! 1. A frame is kept from its first byte if no answer is under way at that time. So a question that comes while the
//!    one before is not answered gets no answer.
//! 2. An answer to ARP carries the device's addresses as the sender's; its target is the one who asked. An answer to an
//!    echo request has the addresses swapped, type 0, and a check sum that is larger by 0x0800 in ones' complement. All
//!    other bytes come back as they were, the time to live and the padding among them, up to the longest frame.
//! 3. The check sum of an echo request is not checked: a request with a wrong one gets an answer with a wrong one.
//! 4. After `begins` a byte comes at every clock, until `byte_is_last`. `MacOut` says when the first one comes.
//!
//! Latency: 4 clocks from `begins` to the first byte.
//!
//! The last byte of an ARP request of 40:41:42:43:44:45 (decimal), the first four bytes of the answer, and the last
//! two, which are padding. The clocks between are left out:
//! ```text
//! head_valid      /^^\_____________________________________________________
//! asks_address    ___/^^\__________________________________________________
//! waits           ______/^^^^^\____________________________________________
//! begins          _________/^^\____________________________________________
//! byte_data         .  .  .  .  .  .  . 40 41 42 43  0  0  .  .  .  .  .  .
//! byte_is_last    ____________________________________/^^\_________________
//! ```
//!
//! Source: RFC 826 and 792; RFC 1624 for the check sum. The check sum of the header of IPv4 stays, because swapped
//! words have the same sum.

use super::ones_sum::OnesSum;
use super::own_bytes::OwnBytes;
use super::types::{AnswerRow, Byte, HeadByte, Place, Station};
use crate::leaf::{BlockMemory, LookupTable};
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct Responder {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub station: Signal<In, Station>,
    /// A frame begins, and a byte of the frame comes.
    pub frame_begins: Signal<In, Bit>,
    pub head_valid: Signal<In, Bit>,
    pub head: Signal<In, HeadByte>,
    pub place: Signal<In, Place>,
    /// The frame has ended, and is a sound request by ARP, or a sound echo request.
    pub asks_address: Signal<In, Bit>,
    pub asks_echo: Signal<In, Bit>,
    /// An answer waits for `begins`.
    pub waits: Signal<Out, Bit>,
    pub begins: Signal<In, Bit>,
    /// The bytes of the answer.
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    memory: BlockMemory<11, 8>,
    rows: LookupTable<7, AnswerRow>,
    own: OwnBytes,
    sum: OnesSum,
    keeps: DFF<Bit>,
    is_echo: DFF<Bit>,
    offers: DFF<Bit>,
    sends: DFF<Bit>,
    last: DFF<Place>,
    at: DFF<Place>,
    /// What the memory reads for: a row and the last byte, in its two stages.
    row1: DFF<AnswerRow>,
    row2: DFF<AnswerRow>,
    is_last1: DFF<Bit>,
    is_last2: DFF<Bit>,
    is_last3: DFF<Bit>,
    chosen: DFF<Byte>,
    keeps_byte: Signal<Local, Bit>,
    is_at_last: Signal<Local, Bit>,
    row_index: Signal<Local, Bits<7>>,
    echo_rows: Signal<Local, Bits<7>>,
    /// The part of the place that only places from 64 on have.
    beyond: Signal<Local, Bits<5>>,
    tail: Signal<Local, Place>,
    one: Signal<Local, Place>,
    sum_place: Signal<Local, Place>,
    sum_end: Signal<Local, Place>,
    row_kept: Signal<Local, AnswerRow>,
}

/// The row of a place, from 64 on those of an echo; rows 63 and 127 stand for all places from 63 on.
fn row(index: usize) -> AnswerRow {
    let (is_echo, place) = (index >= 64, index % 64);
    let (source, index, offset): (u64, u64, i64) = match (is_echo, place) {
        (_, 0..=5) => (0, 0, 6),
        (_, 6..=11) => (1, place as u64 - 6, 0),
        (false, 21) => (2, 2, 0),
        (false, 22..=31) => (1, place as u64 - 22, 0),
        (false, 32..=41) => (0, 0, -10),
        (true, 26..=29) => (1, place as u64 - 20, 0),
        (true, 30..=33) => (0, 0, -4),
        (true, 34) => (2, 0, 0),
        (true, 36..=37) => (3, place as u64 - 36, 0),
        _ => (0, 0, 0),
    };
    AnswerRow { source: source.into(), index: index.into(), offset: (offset.rem_euclid(2048) as u64).into() }
}

impl Default for Responder {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            station: Signal::default(),
            frame_begins: Signal::default(),
            head_valid: Signal::default(),
            head: Signal::default(),
            place: Signal::default(),
            asks_address: Signal::default(),
            asks_echo: Signal::default(),
            waits: Signal::default(),
            begins: Signal::default(),
            byte_data: Signal::default(),
            byte_is_last: Signal::default(),
            memory: BlockMemory::new(11, 8),
            rows: LookupTable::new(row),
            own: OwnBytes::default(),
            sum: OnesSum::default(),
            keeps: DFF::default(),
            is_echo: DFF::default(),
            offers: DFF::default(),
            sends: DFF::default(),
            last: DFF::default(),
            at: DFF::default(),
            row1: DFF::default(),
            row2: DFF::default(),
            is_last1: DFF::default(),
            is_last2: DFF::default(),
            is_last3: DFF::default(),
            chosen: DFF::default(),
            keeps_byte: Signal::default(),
            is_at_last: Signal::default(),
            row_index: Signal::default(),
            echo_rows: Signal::default(),
            beyond: Signal::default(),
            tail: Signal::default(),
            one: Signal::default(),
            sum_place: Signal::default(),
            sum_end: Signal::default(),
            row_kept: Signal::default(),
        }
    }
}

impl Logic for Responder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, keeps, is_echo, offers, sends, last, at);
        dff_setup!(self, clock, row1, row2, is_last1, is_last2, is_last3, chosen);
        clock!(self, clock, memory, sum);
        self.beyond.next = self.at.q.val().get_bits::<5>(6);
        self.tail.next = 4.into();
        self.one.next = 1.into();
        self.sum_place.next = 36.into();
        self.sum_end.next = 37.into();
        self.echo_rows.next = 64.into();
        self.waits.next = self.offers.q.val();
        self.byte_data.next = self.chosen.q.val();
        self.byte_is_last.next = self.is_last3.q.val();

        // The frame comes in.
        self.keeps_byte.next = self.head_valid.val() & self.keeps.q.val();
        self.memory.write_enable.next = self.keeps_byte.val();
        self.memory.write_address.next = self.place.val();
        self.memory.write_data.next = self.head.val().data;
        self.sum.sets.next = self.frame_begins.val() & (!self.offers.q.val()) & (!self.sends.q.val());
        self.sum.start.next = 0x0800.into();
        self.sum.takes.next = self.keeps_byte.val()
            & ((self.place.val() == self.sum_place.val()) | (self.place.val() == self.sum_end.val()));
        self.sum.is_low.next = self.head.val().is_low;
        self.sum.byte_data.next = self.head.val().data;
        if self.frame_begins.val() {
            self.keeps.d.next = (!self.offers.q.val()) & (!self.sends.q.val());
        }
        if self.keeps_byte.val() {
            self.last.d.next = self.place.val();
        }
        if self.keeps.q.val() & (self.asks_address.val() | self.asks_echo.val()) {
            self.keeps.d.next = false;
            self.is_echo.d.next = self.asks_echo.val();
            // The check sum of the frame is not part of the answer.
            self.last.d.next = self.last.q.val() - self.tail.val();
            self.offers.d.next = true;
        }

        // The answer goes out.
        self.row_index.next = bit_cast::<7, 11>(self.at.q.val());
        if self.beyond.val().any() {
            self.row_index.next = 63.into();
        }
        self.rows.index.next = self.row_index.val();
        if self.is_echo.q.val() {
            self.rows.index.next = self.row_index.val() | self.echo_rows.val();
        }
        self.memory.read_address.next = self.at.q.val() + self.rows.value.val().offset;
        self.is_at_last.next = self.sends.q.val() & (self.at.q.val() == self.last.q.val());
        self.row1.d.next = self.rows.value.val();
        self.row2.d.next = self.row1.q.val();
        self.is_last1.d.next = self.is_at_last.val();
        self.is_last2.d.next = self.is_last1.q.val();
        self.is_last3.d.next = self.is_last2.q.val();
        self.row_kept.next = self.row2.q.val();
        self.own.station.next = self.station.val();
        self.own.index.next = self.row_kept.val().index;
        match self.row_kept.val().source.index() {
            0 => {
                self.chosen.d.next = self.memory.read_data.val();
            }
            1 => {
                self.chosen.d.next = self.own.byte_data.val();
            }
            2 => {
                self.chosen.d.next = bit_cast::<8, 4>(self.row_kept.val().index);
            }
            _ => {
                self.chosen.d.next = self.sum.sum.val().get_bits::<8>(8);
                if self.row_kept.val().index.any() {
                    self.chosen.d.next = self.sum.sum.val().get_bits::<8>(0);
                }
            }
        }
        self.at.d.next = self.at.q.val() + self.one.val();
        if self.is_at_last.val() {
            self.sends.d.next = false;
        }
        if self.begins.val() {
            self.offers.d.next = false;
            self.sends.d.next = true;
            self.at.d.next = 0.into();
        }
        if self.reset.val() {
            self.keeps.d.next = false;
            self.offers.d.next = false;
            self.sends.d.next = false;
        }
    }
}
