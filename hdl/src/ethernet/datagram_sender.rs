//! Makes Ethernet frames of datagrams: puts Ethernet, IPv4 and UDP headers before the payload.
//!
//! 1. The receiver's addresses are the first 12 bytes of the datagram as `DatagramQueue` holds it.
//! 2. The header of IPv4 has identification 0, "do not fragment" and a time to live of 64. The check sum of UDP is 0,
//!    which means that there is none.
//! 3. After `begins` a byte comes at every clock, until `byte_is_last`. `MacOut` says when the first one comes.
//!
//! Latency: 21 clocks from `holds` to `waits`; 4 clocks from `begins` to the first byte.
//!
//! The last clock before `waits`, the first three bytes, and the last six of a datagram with a payload of two bytes.
//! The clocks between are left out:
//! ```text
//! holds           /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\___________
//! waits           ___/^^\______________________________________
//! begins          ___/^^\______________________________________
//! byte_data         .  .  .  .  . 40 41 42  0 10  0  0 71 72  .
//! lets_go         ______________________________/^^\___________
//! byte_is_last    _______________________________________/^^\__
//! ```
//!
//! Source: RFC 768, 791, 6864. The block runs over the header of IPv4 twice: first for its check sum, which stands
//! before the addresses that it covers, then to send it. The first run takes 20 clocks, and `MacOut` needs as many for
//! check sum and gap of the frame before.

use super::header_bytes::HeaderBytes;
use super::ones_sum::OnesSum;
use super::types::{Byte, HeaderRow, Place, Station};
use crate::leaf::LookupTable;
use crate::prelude::*;

/// The step of the sender, which takes the oldest datagram.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum DatagramPhase {
    /// Awaits a datagram.
    Await,
    /// Sums the header of IPv4.
    Sum,
    /// Offers the frame.
    Offer,
    /// Sends the frame.
    Send,
}

#[derive(LogicBlock)]
pub struct DatagramSender {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub station: Signal<In, Station>,
    /// The oldest datagram: its length with the 12 bytes of its receiver, and a byte of it, 2 clocks after its index.
    pub holds: Signal<In, Bit>,
    pub length: Signal<In, Place>,
    pub read_index: Signal<Out, Place>,
    pub read_data: Signal<In, Byte>,
    /// The datagram has been read to its end.
    pub lets_go: Signal<Out, Bit>,
    /// A frame waits for `begins`.
    pub waits: Signal<Out, Bit>,
    pub begins: Signal<In, Bit>,
    /// The bytes of the frame.
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    rows: LookupTable<6, HeaderRow>,
    bytes: HeaderBytes,
    sum: OnesSum,
    phase: DFF<DatagramPhase>,
    at: DFF<Place>,
    next_index: DFF<Place>,
    last: DFF<Place>,
    ip_length: DFF<Place>,
    udp_length: DFF<Place>,
    /// What the memory reads for, in its two stages and behind: a row, whether the byte is summed, and the last byte.
    row1: DFF<HeaderRow>,
    row2: DFF<HeaderRow>,
    is_low1: DFF<Bit>,
    is_low2: DFF<Bit>,
    is_low3: DFF<Bit>,
    sums1: DFF<Bit>,
    sums2: DFF<Bit>,
    sums3: DFF<Bit>,
    is_last1: DFF<Bit>,
    is_last2: DFF<Bit>,
    is_last3: DFF<Bit>,
    row: Signal<Local, HeaderRow>,
    is_at_last: Signal<Local, Bit>,
    runs: Signal<Local, Bit>,
    memory_source: Signal<Local, Bits<3>>,
    /// The part of the place that only places from 64 on have.
    beyond: Signal<Local, Bits<5>>,
    one: Signal<Local, Place>,
    tail: Signal<Local, Place>,
    udp_less: Signal<Local, Place>,
    ip_more: Signal<Local, Place>,
    header_end: Signal<Local, Place>,
}

/// The row of a place; row 63 is for all places from 63 on.
fn row(place: usize) -> HeaderRow {
    let (source, literal) = match place {
        6..=11 => (1, place - 6),
        12 => (0, 0x08),
        14 => (0, 0x45),
        16 | 17 => (3 + place - 16, 0),
        20 => (0, 0x40),
        22 => (0, 0x40),
        23 => (0, 0x11),
        24 | 25 => (7, place - 24),
        26..=29 => (1, place - 20),
        34 | 35 => (1, place - 24),
        38 | 39 => (5 + place - 38, 0),
        13 | 15 | 18 | 19 | 21 | 40 | 41 => (0, 0),
        _ => (2, 0),
    };
    HeaderRow { source: (source as u64).into(), literal: (literal as u64).into() }
}

impl Default for DatagramSender {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            station: Signal::default(),
            holds: Signal::default(),
            length: Signal::default(),
            read_index: Signal::default(),
            read_data: Signal::default(),
            lets_go: Signal::default(),
            waits: Signal::default(),
            begins: Signal::default(),
            byte_data: Signal::default(),
            byte_is_last: Signal::default(),
            rows: LookupTable::new(row),
            bytes: HeaderBytes::default(),
            sum: OnesSum::default(),
            phase: DFF::default(),
            at: DFF::default(),
            next_index: DFF::default(),
            last: DFF::default(),
            ip_length: DFF::default(),
            udp_length: DFF::default(),
            row1: DFF::default(),
            row2: DFF::default(),
            is_low1: DFF::default(),
            is_low2: DFF::default(),
            is_low3: DFF::default(),
            sums1: DFF::default(),
            sums2: DFF::default(),
            sums3: DFF::default(),
            is_last1: DFF::default(),
            is_last2: DFF::default(),
            is_last3: DFF::default(),
            row: Signal::default(),
            is_at_last: Signal::default(),
            runs: Signal::default(),
            memory_source: Signal::default(),
            beyond: Signal::default(),
            one: Signal::default(),
            tail: Signal::default(),
            udp_less: Signal::default(),
            ip_more: Signal::default(),
            header_end: Signal::default(),
        }
    }
}

impl Logic for DatagramSender {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, phase, at, next_index, last, ip_length, udp_length, row1, row2);
        dff_setup!(self, clock, is_low1, is_low2, is_low3, sums1, sums2, sums3, is_last1, is_last2, is_last3);
        clock!(self, clock, sum, bytes);
        self.memory_source.next = 2.into();
        self.beyond.next = self.at.q.val().get_bits::<5>(6);
        self.one.next = 1.into();
        self.tail.next = 29.into();
        self.udp_less.next = 4.into();
        self.ip_more.next = 16.into();
        self.header_end.next = 33.into();
        self.read_index.next = self.next_index.q.val();
        self.waits.next = self.phase.q.val() == DatagramPhase::Offer;
        self.byte_data.next = self.bytes.byte_data.val();
        self.byte_is_last.next = self.is_last3.q.val();

        // The 12 bytes of the receiver are part of `length`.
        self.last.d.next = self.length.val() + self.tail.val();
        self.ip_length.d.next = self.length.val() + self.ip_more.val();
        self.udp_length.d.next = self.length.val() - self.udp_less.val();
        self.rows.index.next = self.at.q.val().get_bits::<6>(0);
        if self.beyond.val().any() {
            self.rows.index.next = 63.into();
        }
        self.row.next = self.rows.value.val();
        self.runs.next = (self.phase.q.val() == DatagramPhase::Sum) | (self.phase.q.val() == DatagramPhase::Send);
        self.is_at_last.next = (self.phase.q.val() == DatagramPhase::Send) & (self.at.q.val() == self.last.q.val());
        self.lets_go.next = self.is_at_last.val();
        self.at.d.next = self.at.q.val() + self.one.val();
        if self.runs.val() & (self.row.val().source == self.memory_source.val()) {
            self.next_index.d.next = self.next_index.q.val() + self.one.val();
        }
        match self.phase.q.val() {
            DatagramPhase::Await => {
                self.at.d.next = 14.into();
                self.next_index.d.next = 6.into();
                if self.holds.val() {
                    self.phase.d.next = DatagramPhase::Sum;
                }
            }
            DatagramPhase::Sum => {
                if self.at.q.val() == self.header_end.val() {
                    self.phase.d.next = DatagramPhase::Offer;
                }
            }
            DatagramPhase::Offer => {
                self.at.d.next = 0.into();
                self.next_index.d.next = 0.into();
                if self.begins.val() {
                    self.phase.d.next = DatagramPhase::Send;
                }
            }
            _ => {
                if self.is_at_last.val() {
                    self.phase.d.next = DatagramPhase::Await;
                }
            }
        }
        if self.reset.val() {
            self.phase.d.next = DatagramPhase::Await;
        }

        self.row1.d.next = self.row.val();
        self.row2.d.next = self.row1.q.val();
        self.is_low1.d.next = self.at.q.val().get_bit(0);
        self.is_low2.d.next = self.is_low1.q.val();
        self.is_low3.d.next = self.is_low2.q.val();
        self.is_last1.d.next = self.is_at_last.val();
        self.is_last2.d.next = self.is_last1.q.val();
        self.is_last3.d.next = self.is_last2.q.val();
        self.sums1.d.next = self.phase.q.val() == DatagramPhase::Sum;
        self.sums2.d.next = self.sums1.q.val();
        self.sums3.d.next = self.sums2.q.val();
        self.sum.sets.next = self.phase.q.val() == DatagramPhase::Await;
        self.sum.start.next = 0.into();
        self.sum.takes.next = self.sums3.q.val();
        self.sum.is_low.next = self.is_low3.q.val();
        self.sum.byte_data.next = self.bytes.byte_data.val();
        self.bytes.station.next = self.station.val();
        self.bytes.row.next = self.row2.q.val();
        self.bytes.datagram_byte.next = self.read_data.val();
        self.bytes.ip_length.next = self.ip_length.q.val();
        self.bytes.udp_length.next = self.udp_length.q.val();
        self.bytes.sum.next = self.sum.sum.val();
        self.bytes.sum_is_open.next = self.sums2.q.val();
    }
}
