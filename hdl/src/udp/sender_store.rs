//! Keeps whom to answer: the addresses and session of the datagram that is coming, of the question whose answer waits
//! in the one place, and of the open session.
//!
//! 1. The bytes of a datagram are kept as they come. With `keeps` they become those of the question, and the next
//!    datagram is written elsewhere; `keeps` may come only while the one place is free.
//! 2. With `opens`, in the clock of `keeps`, the question becomes the open session as well. That takes 32 clocks, in
//!    which `copies` is high: no datagram may come or go.
//! 3. Indices are those of a datagram with its sender or receiver before it: 0 to 11 are addresses, 20 to 27 the
//!    session. Bytes with other indices mean nothing.
//!
//! Latency: none (combinational) from an index to its byte.
//!
//! The last byte of a question, which opens a session. Byte 27 of the question and of the session are read when it has
//! been copied. Clocks in between are left out:
//! ```text
//! head_valid      /^^\_____________________________
//! keeps           ______/^^\_______________________
//! opens           ______/^^\_______________________
//! copies          _________/^^^^^^^^^^^^^^\________
//! reads_question  /^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! read_data         .  .  .  .  .  .  .  . 70 70 70
//! ```

use super::types::HeadIndex;
use crate::leaf::LutMemory;
use crate::prelude::*;
use crate::serial::types::Byte;

#[derive(LogicBlock)]
pub struct SenderStore {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A byte of the datagram that is coming, and the byte of the open session that has the same meaning.
    pub head_valid: Signal<In, Bit>,
    pub index: Signal<In, HeadIndex>,
    pub byte_data: Signal<In, Byte>,
    pub session_byte: Signal<Out, Byte>,
    /// The datagram that came is the question; and it opens a session.
    pub keeps: Signal<In, Bit>,
    pub opens: Signal<In, Bit>,
    pub copies: Signal<Out, Bit>,
    /// A byte of the question (`reads_question`), or of the open session.
    pub reads_question: Signal<In, Bit>,
    pub read_index: Signal<In, HeadIndex>,
    pub read_data: Signal<Out, Byte>,
    questions: LutMemory<6, 8>,
    /// Address, port and session of the open session, 14 bytes, to compare with.
    compared: LutMemory<4, 8>,
    session: LutMemory<5, 8>,
    /// The half of `questions` into which the incoming datagram is written.
    half: DFF<Bit>,
    copying: DFF<Bit>,
    copied: DFF<HeadIndex>,
    one: Signal<Local, HeadIndex>,
    last: Signal<Local, HeadIndex>,
    from: Signal<Local, HeadIndex>,
    upper_half: Signal<Local, Bits<6>>,
    written_half: Signal<Local, Bits<6>>,
    read_half: Signal<Local, Bits<6>>,
    upper: Signal<Local, Bits<4>>,
    compared_half: Signal<Local, Bits<4>>,
    copied_half: Signal<Local, Bits<4>>,
    low_index: Signal<Local, Bits<3>>,
    low_copied: Signal<Local, Bits<3>>,
}

impl Default for SenderStore {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            head_valid: Signal::default(),
            index: Signal::default(),
            byte_data: Signal::default(),
            session_byte: Signal::default(),
            keeps: Signal::default(),
            opens: Signal::default(),
            copies: Signal::default(),
            reads_question: Signal::default(),
            read_index: Signal::default(),
            read_data: Signal::default(),
            questions: LutMemory::new(6, 8),
            compared: LutMemory::new(4, 8),
            session: LutMemory::new(5, 8),
            half: DFF::default(),
            copying: DFF::default(),
            copied: DFF::default(),
            one: Signal::default(),
            last: Signal::default(),
            from: Signal::default(),
            upper_half: Signal::default(),
            written_half: Signal::default(),
            read_half: Signal::default(),
            upper: Signal::default(),
            compared_half: Signal::default(),
            copied_half: Signal::default(),
            low_index: Signal::default(),
            low_copied: Signal::default(),
        }
    }
}

impl Logic for SenderStore {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, half, copying, copied);
        clock!(self, clock, questions, compared, session);
        self.one.next = 1.into();
        self.last.next = 31.into();
        self.upper_half.next = 32.into();
        self.upper.next = 8.into();
        self.copies.next = self.copying.q.val();

        self.from.next = self.read_index.val();
        if self.copying.q.val() {
            self.from.next = self.copied.q.val();
        }
        self.written_half.next = 0.into();
        self.read_half.next = self.upper_half.val();
        if self.half.q.val() {
            self.written_half.next = self.upper_half.val();
            self.read_half.next = 0.into();
        }
        self.questions.write_address.next = bit_cast::<6, 5>(self.index.val()) | self.written_half.val();
        self.questions.write_data.next = self.byte_data.val();
        self.questions.write_enable.next = self.head_valid.val();
        self.questions.read_address.next = bit_cast::<6, 5>(self.from.val()) | self.read_half.val();
        self.session.write_address.next = self.copied.q.val();
        self.session.write_data.next = self.questions.read_data.val();
        self.session.write_enable.next = self.copying.q.val();
        self.session.read_address.next = self.read_index.val();
        self.read_data.next = self.session.read_data.val();
        if self.reads_question.val() {
            self.read_data.next = self.questions.read_data.val();
        }

        // The bytes that are compared have indices 6 to 11 and 20 to 27. Their lowest three bits differ in each group.
        // Indices 12 to 15 and 28 to 31 are left out, because they would overwrite others.
        self.low_index.next = self.index.val().get_bits::<3>(0);
        self.low_copied.next = self.copied.q.val().get_bits::<3>(0);
        self.compared_half.next = 0.into();
        if self.index.val().get_bit(4) {
            self.compared_half.next = self.upper.val();
        }
        self.copied_half.next = 0.into();
        if self.copied.q.val().get_bit(4) {
            self.copied_half.next = self.upper.val();
        }
        self.compared.write_address.next = bit_cast::<4, 3>(self.low_copied.val()) | self.copied_half.val();
        self.compared.write_data.next = self.questions.read_data.val();
        self.compared.write_enable.next =
            self.copying.q.val() & (!(self.copied.q.val().get_bit(3) & self.copied.q.val().get_bit(2)));
        self.compared.read_address.next = bit_cast::<4, 3>(self.low_index.val()) | self.compared_half.val();
        self.session_byte.next = self.compared.read_data.val();

        self.copied.d.next = self.copied.q.val() + self.one.val();
        if !self.copying.q.val() {
            self.copied.d.next = 0.into();
        }
        if self.copied.q.val() == self.last.val() {
            self.copying.d.next = false;
        }
        if self.keeps.val() {
            self.half.d.next = !self.half.q.val();
            if self.opens.val() {
                self.copying.d.next = true;
            }
        }
        if self.reset.val() {
            self.half.d.next = false;
            self.copying.d.next = false;
            self.copied.d.next = 0.into();
        }
    }
}
