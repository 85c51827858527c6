//! Keeps which answers besides those of the core are due: one to a question, in the one place, and a receipt (`Ack` or
//! `Nak`) for the host of the session. [`Replies`](crate::serial::Replies) of the UDP link.
//!
//! 1. The answer in the place goes first. The place is free again when its datagram has ended.
//! 2. Where an `Ack` and a `Nak` are due, one `Nak` stands for both. `Data` that is taken cancels the `Nak`.
//! 3. A receipt that is asked for while another begins is due after it.
//! 4. The end of a session cancels its receipts.
//!
//! Latency: 1 clock from `asks` to `is_due`.
//!
//! A receipt (83) is due, and then a greeting (81), which goes first. Kinds are shown without their highest bit:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10 11 12
//! asks.takes      ___/^^\________________________________
//! asks.replies    ______/^^\_____________________________
//! is_due          ______/^^^^^^^^^^^^^^^^^^^^^^^\________
//! kind[6:0]         .  .  3  1  1  1  1  1  3  3  .  .  .
//! starts          ____________/^^\___________/^^\________
//! ended           _____________________/^^\________/^^\__
//! is_in_place     _______________/^^^^^^^^\______________
//! place_is_taken  _________/^^^^^^^^^^^^^^\______________
//! ```

use super::types::DatagramAsks;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::DeviceDatagram;

#[derive(LogicBlock, Default)]
pub struct DatagramReplies {
    /// After a reset nothing is due.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub asks: Signal<In, DatagramAsks>,
    pub saw_gap: Signal<In, Bit>,
    /// No session is open.
    pub forgets: Signal<In, Bit>,
    /// A datagram of kind `kind` is due. It begins at the edge of `starts`.
    pub is_due: Signal<Out, Bit>,
    pub kind: Signal<Out, Byte>,
    pub starts: Signal<In, Bit>,
    /// The datagram under way is the answer in the place; that datagram ends at the edge of `ended`.
    pub is_in_place: Signal<Out, Bit>,
    pub ended: Signal<In, Bit>,
    pub place_is_taken: Signal<Out, Bit>,
    taken: DFF<Bit>,
    reply: DFF<Bits<4>>,
    sending: DFF<Bit>,
    ack: DFF<Bit>,
    nak: DFF<Bit>,
    device_kinds: Signal<Local, Byte>,
}

// The kernel holds the kinds as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    DeviceDatagram::Ack as u8 == 0x83 && DeviceDatagram::Nak as u8 == 0x84,
    "the kinds of this block follow the protocol"
);

impl Logic for DatagramReplies {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, taken, reply, sending, ack, nak);
        self.device_kinds.next = 0x80.into();
        self.is_due.next = self.taken.q.val() | self.ack.q.val() | self.nak.q.val();
        self.is_in_place.next = self.sending.q.val();
        self.place_is_taken.next = self.taken.q.val();
        self.kind.next = 0x83.into();
        if self.nak.q.val() {
            self.kind.next = 0x84.into();
        }
        if self.taken.q.val() {
            self.kind.next = bit_cast::<8, 4>(self.reply.q.val()) | self.device_kinds.val();
        }

        if self.ended.val() {
            self.sending.d.next = false;
            if self.sending.q.val() {
                self.taken.d.next = false;
            }
        }
        if self.starts.val() {
            self.sending.d.next = self.taken.q.val();
            if !self.taken.q.val() {
                self.ack.d.next = false;
                self.nak.d.next = false;
            }
        }
        if self.asks.val().replies {
            self.taken.d.next = true;
            self.reply.d.next = self.asks.val().reply;
        }
        if self.asks.val().repeats | (self.asks.val().polls & (!self.saw_gap.val())) {
            self.ack.d.next = true;
        }
        if (self.asks.val().gap & (!self.saw_gap.val())) | (self.asks.val().polls & self.saw_gap.val()) {
            self.nak.d.next = true;
        }
        if self.asks.val().takes {
            self.ack.d.next = true;
            self.nak.d.next = false;
        }
        if self.forgets.val() | self.asks.val().closes {
            self.ack.d.next = false;
            self.nak.d.next = false;
        }
        if self.reset.val() {
            self.taken.d.next = false;
            self.sending.d.next = false;
        }
    }
}
