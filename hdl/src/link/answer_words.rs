//! What an answer says: status, length, and the words of a payload that is no record.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `opcode`, `first`, `count` | in | 8, 32, 32 | the command and its arguments |
//! | `is_refused` | in | 1 | it is a `Clear` that asks for more contexts than there are |
//! | `capacity`, `contexts`, `ring` | in | 15, 5, 7 | parameters of the core, constants |
//! | `collinear`, `stuck` | in | 1 | the first three points are collinear; nothing is finished any more |
//! | `arrived`, `refused`, `insertions`, `duplicates`, `records` | in | | counts of the mesh |
//! | `index` | in | 7 | word of the payload |
//! | `counter`, `latency` | in | 32 | the counter, and the bucket of the histogram, of that number |
//! | `header` | out | 32 | first word of the answer |
//! | `length` | out | 32 | words of the payload |
//! | `word` | out | 32 | word `index` of the payload |
//! | `is_read` | out | 1 | the payload consists of records |
//!
//! Latency: none (combinational).

use incircle_protocol::{
    Opcode, Status, CORE_COORD_BITS, CORE_VERSION, COUNTER_WORDS, IDENTITY_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS,
    MAGIC, PROTOCOL_VERSION,
};
use rust_hdl_core::prelude::*;

/// Words of an answer; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AnswerWords {
    /// The command.
    pub opcode: Signal<In, Bits<8>>,
    /// First record of a read.
    pub first: Signal<In, Bits<32>>,
    /// Records of a read.
    pub count: Signal<In, Bits<32>>,
    /// The command asks for too many contexts.
    pub is_refused: Signal<In, Bit>,
    /// Points the core holds.
    pub capacity: Signal<In, Bits<15>>,
    /// Contexts it has.
    pub contexts: Signal<In, Bits<5>>,
    /// Entries of a boundary list.
    pub ring: Signal<In, Bits<7>>,
    /// The start was collinear.
    pub collinear: Signal<In, Bit>,
    /// Nothing is finished any more.
    pub stuck: Signal<In, Bit>,
    /// Points with an id.
    pub arrived: Signal<In, Bits<15>>,
    /// Points refused.
    pub refused: Signal<In, Bits<32>>,
    /// Points inserted.
    pub insertions: Signal<In, Bits<32>>,
    /// Duplicates.
    pub duplicates: Signal<In, Bits<32>>,
    /// Records.
    pub records: Signal<In, Bits<15>>,
    /// Word of the payload.
    pub index: Signal<In, Bits<7>>,
    /// Counter of that number.
    pub counter: Signal<In, Bits<32>>,
    /// Bucket of that number.
    pub latency: Signal<In, Bits<32>>,
    /// First word of the answer.
    pub header: Signal<Out, Bits<32>>,
    /// Words of the payload.
    pub length: Signal<Out, Bits<32>>,
    /// Word of the payload.
    pub word: Signal<Out, Bits<32>>,
    /// The payload consists of records.
    pub is_read: Signal<Out, Bit>,
    status: Signal<Local, Bits<32>>,
    shifted_status: Signal<Local, Bits<32>>,
    wide_opcode: Signal<Local, Bits<32>>,
    shifted_opcode: Signal<Local, Bits<32>>,
    wide_first: Signal<Local, Bits<33>>,
    wide_count: Signal<Local, Bits<33>>,
    range_end: Signal<Local, Bits<33>>,
    wide_records: Signal<Local, Bits<33>>,
    double_count: Signal<Local, Bits<32>>,
    identity: Signal<Local, Bits<32>>,
    report: Signal<Local, Bits<32>>,
    none_refused: Signal<Local, Bits<32>>,
    one: Signal<Local, Bits<32>>,
    status_shift: Signal<Local, Bits<32>>,
    opcode_shift: Signal<Local, Bits<32>>,
}

// The kernel writes these as literals, because rust-hdl takes no constants of Rust; a change in the protocol must come here.
const _: () = assert!(
    Opcode::Hello as u8 == 1
        && Opcode::Clear as u8 == 2
        && Opcode::Insert as u8 == 3
        && Opcode::Read as u8 == 4
        && Opcode::Counters as u8 == 5
        && Opcode::Latencies as u8 == 6
        && Status::UnknownOpcode as u8 == 1
        && Status::BadRange as u8 == 2
        && Status::Collinear as u8 == 3
        && Status::Full as u8 == 4
        && Status::BadContexts as u8 == 5
        && Status::Stuck as u8 == 6
        && IDENTITY_WORDS == 7
        && INSERT_REPORT_WORDS == 5
        && COUNTER_WORDS == 25
        && LATENCY_BUCKETS == 128
        && MAGIC == 0x696e_4369
        && PROTOCOL_VERSION == 0x0001_0001
        && CORE_VERSION == 0x0000_0200
        && CORE_COORD_BITS == 16,
    "the words of this block follow the protocol"
);

impl Logic for AnswerWords {
    #[hdl_gen]
    fn update(&mut self) {
        self.none_refused.next = 0.into();
        self.one.next = 1.into();
        self.status_shift.next = 16.into();
        self.opcode_shift.next = 24.into();
        self.wide_first.next = bit_cast::<33, 32>(self.first.val());
        self.wide_count.next = bit_cast::<33, 32>(self.count.val());
        self.range_end.next = self.wide_first.val() + self.wide_count.val();
        self.wide_records.next = bit_cast::<33, 15>(self.records.val());
        self.double_count.next = self.count.val() << self.one.val();

        match self.index.val().index() {
            0 => {
                self.identity.next = 0x696e_4369.into();
                self.report.next = bit_cast::<32, 15>(self.arrived.val());
            }
            1 => {
                self.identity.next = 0x0001_0001.into();
                self.report.next = self.insertions.val();
            }
            2 => {
                self.identity.next = 0x0000_0200.into();
                self.report.next = self.duplicates.val();
            }
            3 => {
                self.identity.next = 16.into();
                self.report.next = self.refused.val();
            }
            4 => {
                self.identity.next = bit_cast::<32, 15>(self.capacity.val());
                self.report.next = bit_cast::<32, 15>(self.records.val());
            }
            5 => {
                self.identity.next = bit_cast::<32, 5>(self.contexts.val());
                self.report.next = 0.into();
            }
            _ => {
                self.identity.next = bit_cast::<32, 7>(self.ring.val());
                self.report.next = 0.into();
            }
        }

        self.is_read.next = false;
        self.status.next = 0.into();
        self.length.next = 0.into();
        self.word.next = self.counter.val();
        match self.opcode.val().index() {
            1 => {
                self.length.next = 7.into();
                self.word.next = self.identity.val();
            }
            2 => {
                if self.is_refused.val() {
                    self.status.next = 5.into();
                }
            }
            3 => {
                self.length.next = 5.into();
                self.word.next = self.report.val();
                if self.refused.val() != self.none_refused.val() {
                    self.status.next = 4.into();
                }
                if self.collinear.val() {
                    self.status.next = 3.into();
                }
                if self.stuck.val() {
                    self.status.next = 6.into();
                }
            }
            4 => {
                self.is_read.next = true;
                self.length.next = self.double_count.val() + self.count.val();
                if self.range_end.val() > self.wide_records.val() {
                    self.status.next = 2.into();
                    self.length.next = 0.into();
                }
            }
            5 => {
                self.length.next = 25.into();
            }
            6 => {
                self.length.next = 128.into();
                self.word.next = self.latency.val();
            }
            _ => {
                self.status.next = 1.into();
            }
        }
        self.shifted_status.next = self.status.val() << self.status_shift.val();
        self.wide_opcode.next = bit_cast::<32, 8>(self.opcode.val());
        self.shifted_opcode.next = self.wide_opcode.val() << self.opcode_shift.val();
        self.header.next = self.shifted_opcode.val() | self.shifted_status.val();
    }
}
