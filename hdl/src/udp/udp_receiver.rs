//! The way from the Ethernet port to the core: datagrams, requests, command words.
//!
//! 1. Words enter the FIFO as they come, and count once their datagram has turned out to be sound and the one that is
//!    awaited. Words that find no room are left out, and their datagram does not count.
//!
//! ```text
//! entries -> DatagramReader -> DatagramMatch -> DatagramJudge -> asks
//!                  +--> SenderStore -> whom to answer
//!                  +--> ReceiveFifo -> commands
//!                  +--> DatagramDigest
//! ```

use super::datagram_digest::DatagramDigest;
use super::datagram_judge::DatagramJudge;
use super::datagram_match::DatagramMatch;
use super::datagram_reader::DatagramReader;
use super::sender_store::SenderStore;
use super::types::{DatagramAsks, HeadIndex, UdpSession};
use crate::commands::types::Word;
use crate::commands::CommandSource;
use crate::prelude::*;
use crate::serial::types::{Byte, Receipt};
use crate::serial::ReceiveFifo;
use incircle_protocol::UdpLinkConfig;

#[derive(LogicBlock, Default)]
pub struct UdpReceiver {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The oldest entry of the port, which the block takes at an edge with `entry_pop`.
    pub entry_valid: Signal<In, Bit>,
    pub entry: Signal<In, Bits<9>>,
    pub entry_pop: Signal<Out, Bit>,
    pub session: Signal<In, UdpSession>,
    /// Forget the words of the session: the FIFO and the digest.
    pub forgets: Signal<In, Bit>,
    pub place_is_taken: Signal<In, Bit>,
    /// The request of the last datagram. Until `settles` falls it is being carried out.
    pub asks: Signal<Out, DatagramAsks>,
    pub settles: Signal<Out, Bit>,
    /// Free words of the FIFO, and the digest.
    pub receipt: Signal<Out, Receipt>,
    pub command: CommandSource,
    /// A byte of the addresses and the session of a question, or of the open session.
    pub reads_question: Signal<In, Bit>,
    pub read_index: Signal<In, HeadIndex>,
    pub read_data: Signal<Out, Byte>,
    reader: DatagramReader,
    comparison: DatagramMatch,
    judge: DatagramJudge,
    senders: SenderStore,
    fifo: ReceiveFifo<32>,
    digest: DatagramDigest,
    no_room: DFF<Bit>,
    clears: Signal<Local, Bit>,
    front: Signal<Local, Word>,
}

impl UdpReceiver {
    /// The receiver of a link whose parameters are in range.
    pub fn new(link: UdpLinkConfig) -> Self {
        Self { fifo: ReceiveFifo::new(link.fifo_bytes / 4), ..Self::default() }
    }
}

impl Logic for UdpReceiver {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, no_room);
        clock!(self, clock, reader, comparison, judge, senders, fifo, digest);
        self.reader.reset.next = self.reset.val();
        self.reader.entry_valid.next = self.entry_valid.val();
        self.reader.entry.next = self.entry.val();
        self.entry_pop.next = self.reader.entry_pop.val();
        self.reader.holds.next = self.senders.copies.val();
        self.settles.next = self.reader.settles.val() | self.senders.copies.val();

        self.senders.reset.next = self.reset.val();
        self.senders.head_valid.next = self.reader.head_valid.val();
        self.senders.index.next = self.reader.index.val();
        self.senders.byte_data.next = self.reader.byte_data.val();
        self.senders.keeps.next = self.judge.asks.val().replies;
        self.senders.opens.next = self.judge.asks.val().opens;
        self.senders.reads_question.next = self.reads_question.val();
        self.senders.read_index.next = self.read_index.val();
        self.read_data.next = self.senders.read_data.val();

        self.comparison.head_valid.next = self.reader.head_valid.val();
        self.comparison.index.next = self.reader.index.val();
        self.comparison.byte_data.next = self.reader.byte_data.val();
        self.comparison.session_byte.next = self.senders.session_byte.val();
        self.comparison.session.next = self.session.val();
        self.judge.head.next = self.comparison.head.val();
        self.judge.comes.next = self.reader.comes.val();
        self.judge.verdict.next = self.reader.verdict.val();
        self.judge.session.next = self.session.val();
        self.judge.has_room.next = !self.no_room.q.val();
        self.judge.place_is_taken.next = self.place_is_taken.val();
        self.asks.next = self.judge.asks.val();

        self.clears.next = self.reset.val() | self.forgets.val();
        if self.reader.word_valid.val() & self.fifo.room.val().is_full {
            self.no_room.d.next = true;
        }
        if self.reader.begins.val() {
            self.no_room.d.next = false;
        }
        self.fifo.reset.next = self.clears.val();
        self.fifo.begins.next = self.reader.begins.val();
        self.fifo.push.next = self.reader.word_valid.val() & (!self.fifo.room.val().is_full);
        self.fifo.push_data.next = self.reader.word.val();
        self.fifo.commits.next = self.judge.asks.val().takes;
        self.receipt.next.free = self.fifo.room.val().free;
        self.digest.reset.next = self.clears.val();
        self.digest.begins.next = self.reader.begins.val();
        self.digest.push.next = self.reader.payload_valid.val();
        self.digest.push_data.next = self.reader.payload.val();
        self.digest.commits.next = self.judge.asks.val().takes;
        self.receipt.next.digest = self.digest.state.val();

        self.front.next = self.fifo.entry_data.val();
        self.command.valid.next = self.fifo.entry_valid.val();
        self.command.data.next = self.front.val();
        self.fifo.takes.next = self.fifo.entry_valid.val() & self.command.ready.val();
    }
}
