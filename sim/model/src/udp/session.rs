//! A session of the UDP link: its host, numbers of datagrams, and the parts of answers that datagrams carry.

use std::net::SocketAddrV4;

use incircle_protocol::{MAX_DATAGRAM_WORDS, UDP_ANSWER_WORDS};

use crate::link::{Flow, Taken};

/// The part of an answer that one datagram carries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// Number of the answer, from 0 after `Open`.
    pub number: u32,
    /// Index of the first word in the answer.
    pub index: u32,
    pub words: Vec<u32>,
    /// The CRC-32 of all words of the answer, if it ends with this part.
    pub digest: Option<u32>,
}

/// The open session of a device.
#[derive(Clone, Debug)]
pub(super) struct Session {
    pub(super) number: u64,
    /// Address and port of the host.
    pub(super) host: SocketAddrV4,
    /// Number of the `Data` datagram that is expected next.
    pub(super) expected: u32,
    pub(super) flow: Flow,
}

impl Session {
    pub(super) fn new(number: u64, host: SocketAddrV4, patience: u64) -> Self {
        Self { number, host, expected: 0, flow: Flow::new(UDP_ANSWER_WORDS, patience) }
    }

    /// The part of an answer that is due, once all its words have come: a datagram cannot wait for words in its middle.
    pub(super) fn next_part(&mut self) -> Option<Part> {
        let answers = &mut self.flow.answers;
        let left = answers.left()?;
        let count = left.min(MAX_DATAGRAM_WORDS as u64);
        if (answers.waiting() as u64) < count {
            return None;
        }
        let (number, index) = (answers.sent(), answers.index());
        let words = (0..count).map_while(|_| answers.take()).collect();
        let digest = (left == count).then(|| answers.crc());
        if digest.is_some() {
            self.flow.end_answer();
        }
        Some(Part { number, index, words, digest })
    }

    /// Takes a `Data` datagram of this session, if it is the expected one and there is room.
    pub(super) fn take_data(&mut self, number: u32, words: &[u32], fifo_bytes: u32) -> Taken {
        let has_room = self.flow.waiting_bytes() + 4 * words.len() <= fifo_bytes as usize;
        if number == self.expected && has_room {
            self.expected = self.expected.wrapping_add(1);
            return self.flow.take(words.iter().copied());
        }
        if number < self.expected {
            return Taken::Before;
        }
        self.flow.refuse()
    }
}
