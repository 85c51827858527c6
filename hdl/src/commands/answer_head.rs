//! Computes the first two words of an answer, status and length, in three ranks of registers.
//!
//! 1. [`ReadRange`] has the first two ranks of a read-out. The third rank chooses by the opcode.
//! 2. `request.opcode`, the form of the ids and `clearing` do not change between the command and the end of its answer,
//!    so they need not pass all ranks.
//! 3. The low half of the header names the engine and the job. Neither changes while an answer is put together, so they
//!    pass no register.
//!
//! Latency: 3 clocks from `request.first` and `request.count` to `head`.

use super::read_range::ReadRange;
use super::types::{Clearing, Head, RecordCount, Request, Word};
use crate::prelude::*;
use incircle_protocol::{Opcode, Status, COUNTER_WORDS, IDENTITY_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS};

#[derive(LogicBlock, Default)]
pub struct AnswerHead {
    pub clock: Signal<In, Clock>,
    pub request: Signal<In, Request>,
    /// The command is a `Clear` that asks for what cannot be had, and the tag of the last `Clear`.
    pub clearing: Signal<In, Clearing>,
    /// Number of this engine on the chip; a constant.
    pub engine: Signal<In, Bits<8>>,
    /// Number of records of the mesh.
    pub records: Signal<In, RecordCount>,
    /// States of the insertion engine in which no further point is inserted: the first three points are collinear, or
    /// the watchdog has reported.
    pub collinear: Signal<In, Bit>,
    pub stuck: Signal<In, Bit>,
    /// The core has refused points since the last `Clear`.
    pub some_refused: Signal<In, Bit>,
    pub head: Signal<Out, Head>,
    range: ReadRange,
    /// Status of an `Insert`, in registers of the first two ranks.
    insert_status: DFF<Bits<3>>,
    report_status: DFF<Bits<3>>,
    /// Registers of the third rank.
    answer_status: DFF<Bits<3>>,
    answer_length: DFF<Bits<17>>,
    has_none: DFF<Bit>,
    status: Signal<Local, Word>,
    shifted_status: Signal<Local, Word>,
    wide_opcode: Signal<Local, Word>,
    shifted_opcode: Signal<Local, Word>,
    wide_engine: Signal<Local, Word>,
    shifted_engine: Signal<Local, Word>,
    job: Signal<Local, Word>,
    status_shift: Signal<Local, Word>,
    opcode_shift: Signal<Local, Word>,
    engine_shift: Signal<Local, Word>,
    read_code: Signal<Local, Bits<8>>,
    packed_code: Signal<Local, Bits<8>>,
    packs: Signal<Local, Bit>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Hello as u8 == 1
        && Opcode::Clear as u8 == 2
        && Opcode::Insert as u8 == 3
        && Opcode::Read as u8 == 4
        && Opcode::Counters as u8 == 5
        && Opcode::Latencies as u8 == 6
        && Opcode::Triangles as u8 == 7
        && Status::UnknownOpcode as u8 == 1
        && Status::BadRange as u8 == 2
        && Status::Collinear as u8 == 3
        && Status::Full as u8 == 4
        && Status::BadContexts as u8 == 5
        && Status::Stuck as u8 == 6
        && IDENTITY_WORDS == 7
        && INSERT_REPORT_WORDS == 5
        && COUNTER_WORDS == 25
        && LATENCY_BUCKETS == 128,
    "the words of this block follow the protocol"
);

impl Logic for AnswerHead {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, insert_status, report_status, answer_status, answer_length, has_none);
        clock!(self, clock, range);
        self.status_shift.next = 16.into();
        self.opcode_shift.next = 24.into();
        self.engine_shift.next = 8.into();
        self.read_code.next = 4.into();
        self.packed_code.next = 7.into();
        self.range.request.next = self.request.val();
        self.range.records.next = self.records.val();

        self.insert_status.d.next = 0.into();
        if self.some_refused.val() {
            self.insert_status.d.next = 4.into();
        }
        if self.collinear.val() {
            self.insert_status.d.next = 3.into();
        }
        if self.stuck.val() {
            self.insert_status.d.next = 6.into();
        }

        self.report_status.d.next = self.insert_status.q.val();

        // The third rank needs the opcode only to choose.
        self.answer_status.d.next = 0.into();
        self.answer_length.d.next = 0.into();
        self.has_none.d.next = false;
        match self.request.val().opcode.index() {
            1 => {
                self.answer_length.d.next = 7.into();
            }
            2 => {
                self.has_none.d.next = true;
                if self.clearing.val().is_refused {
                    self.answer_status.d.next = 5.into();
                }
            }
            3 => {
                self.answer_length.d.next = 5.into();
                self.answer_status.d.next = self.report_status.q.val();
            }
            4 => {
                self.answer_length.d.next = self.range.whole_length.val();
                self.has_none.d.next = self.range.has_none.val();
                if self.range.is_outside.val() {
                    self.answer_status.d.next = 2.into();
                    self.answer_length.d.next = 0.into();
                    self.has_none.d.next = true;
                }
            }
            5 => {
                self.answer_length.d.next = 25.into();
            }
            6 => {
                self.answer_length.d.next = 128.into();
            }
            7 => {
                self.answer_length.d.next = self.range.packed_length.val();
                self.has_none.d.next = self.range.has_none.val();
                if self.range.is_outside.val() {
                    self.answer_status.d.next = 2.into();
                    self.answer_length.d.next = 0.into();
                    self.has_none.d.next = true;
                }
            }
            _ => {
                self.answer_status.d.next = 1.into();
                self.has_none.d.next = true;
            }
        }
        self.packs.next = self.request.val().opcode == self.packed_code.val();
        self.head.next.is_packed = self.packs.val();
        self.head.next.has_short_ids = self.request.val().has_short_ids;
        self.head.next.has_rests = self.request.val().has_rests;
        self.head.next.is_read = self.packs.val() | (self.request.val().opcode == self.read_code.val());
        self.head.next.length = bit_cast::<32, 17>(self.answer_length.q.val());
        self.head.next.is_empty = self.has_none.q.val();
        self.status.next = bit_cast::<32, 3>(self.answer_status.q.val());
        self.shifted_status.next = self.status.val() << self.status_shift.val();
        self.wide_opcode.next = bit_cast::<32, 8>(self.request.val().opcode);
        self.shifted_opcode.next = self.wide_opcode.val() << self.opcode_shift.val();
        self.wide_engine.next = bit_cast::<32, 8>(self.engine.val());
        self.shifted_engine.next = self.wide_engine.val() << self.engine_shift.val();
        self.job.next = bit_cast::<32, 8>(self.clearing.val().tag);
        self.head.next.header =
            self.shifted_opcode.val() | self.shifted_status.val() | self.shifted_engine.val() | self.job.val();
    }
}
