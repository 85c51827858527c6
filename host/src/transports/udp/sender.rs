//! Sending commands: their words are cut into datagrams, sent within the credit, and sent again from the datagram that
//! the device awaits (go back N).

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{Command, MAX_DATAGRAM_WORDS};

use super::fault::UdpFault;

/// Most bytes of words in a datagram.
const MOST: usize = 4 * MAX_DATAGRAM_WORDS;
/// The smallest datagram that the host sends when the credit does not allow a full one.
const LEAST: usize = 64;

/// A datagram that the device has not acknowledged.
#[derive(Debug)]
struct Sent {
    payload: Vec<u8>,
    /// Check sum of all words of the session up to the end of this datagram.
    digest: u32,
    /// Time at which it was sent last.
    left_at: Duration,
    /// Number of times that it was sent.
    times: u32,
}

/// The content of an acknowledgement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct News {
    /// Number of datagrams that are newly acknowledged.
    pub taken: usize,
    /// Whether the FIFO has more room than was known.
    pub has_more_room: bool,
    /// Time at which the last of them was sent, if it was sent once: only then does it tell the round trip.
    pub left_at: Option<Duration>,
}

/// The sending half of a session.
#[derive(Debug, Default)]
pub(super) struct Sender {
    /// Bytes that are not cut into datagrams yet.
    stream: VecDeque<u8>,
    /// Datagrams under way. The device awaits the first one.
    sent: VecDeque<Sent>,
    /// Number of the first datagram under way.
    base: u64,
    /// Number of datagrams of `sent` that are out. The others will be sent again.
    out: usize,
    /// Free bytes of the device's FIFO before the datagrams under way arrive.
    free: usize,
    /// Bytes of this session so far.
    pushed_bytes: u64,
    /// Bytes of this session that are acknowledged, and those of which the device has confirmed the check sum.
    taken_bytes: u64,
    proved_bytes: u64,
    /// Check sum over all words cut in this session.
    digest: crc32fast::Hasher,
    /// Check sum over all words acknowledged.
    taken_digest: u32,
    /// Number of datagrams sent again.
    resent: u64,
}

impl Sender {
    /// The sender of a session that has used so many numbers.
    #[cfg(test)]
    pub fn of_base(base: u64) -> Self {
        Self { base, ..Self::default() }
    }

    /// Takes a command to be sent, and returns the number of bytes of the session up to its end.
    pub fn push(&mut self, command: &Command<impl AsRef<[u32]>>) -> u64 {
        let (head, count) = command.head();
        for words in [&head[..count], command.points()] {
            self.stream.extend(words.iter().flat_map(|word| word.to_le_bytes()));
            self.pushed_bytes += 4 * words.len() as u64;
        }
        self.pushed_bytes
    }

    /// Number of bytes of the session that the device has taken.
    pub fn taken_bytes(&self) -> u64 {
        self.taken_bytes
    }

    /// Number of bytes of the session of which the device has confirmed the check sum.
    pub fn proved_bytes(&self) -> u64 {
        self.proved_bytes
    }

    /// Whether the device has taken everything.
    pub fn is_done(&self) -> bool {
        self.stream.is_empty() && self.sent.is_empty()
    }

    /// Number of the first datagram that is not acknowledged.
    pub fn base(&self) -> u64 {
        self.base
    }

    /// Number of datagrams cut in this session.
    pub fn cut(&self) -> u64 {
        self.base + self.sent.len() as u64
    }

    /// Number of datagrams sent again.
    pub fn resent(&self) -> u64 {
        self.resent
    }

    /// Bytes of words of the datagram that may go out next.
    fn next_length(&self) -> Option<usize> {
        let under_way: usize = self.sent.iter().take(self.out).map(|sent| sent.payload.len()).sum();
        let credit = self.free.saturating_sub(under_way);
        if let Some(again) = self.sent.get(self.out) {
            return (again.payload.len() <= credit).then_some(again.payload.len());
        }
        let wanted = MOST.min(self.stream.len());
        if wanted == 0 || self.base + self.out as u64 >= u64::from(u32::MAX) {
            return None;
        }
        if wanted <= credit {
            return Some(wanted);
        }
        // A short datagram is better than none, but only if no acknowledgement is due that would bring more room.
        let short = credit & !3;
        (self.sent.is_empty() && short >= LEAST.min(wanted)).then_some(short)
    }

    /// Whether the device has taken all that went out, and has no room for the rest. Only a `Poll` tells when there is
    /// room again, because the device does not speak while its core takes words out of the FIFO.
    pub fn is_starved(&self) -> bool {
        self.sent.is_empty() && !self.stream.is_empty() && self.next_length().is_none()
    }

    /// Whether a datagram may go out now.
    pub fn has_due(&self) -> bool {
        self.next_length().is_some()
    }

    /// Takes the next datagram that may go out: its number and its words.
    pub fn next(&mut self, now: Duration) -> Option<(u32, &[u8])> {
        let length = self.next_length()?;
        if self.out == self.sent.len() {
            let payload: Vec<u8> = self.stream.drain(..length).collect();
            self.digest.update(&payload);
            let digest = self.digest.clone().finalize();
            self.sent.push_back(Sent { payload, digest, left_at: now, times: 0 });
        }
        let number = u32::try_from(self.base + self.out as u64).ok()?;
        let sent = self.sent.get_mut(self.out)?;
        self.resent += u64::from(sent.times > 0);
        sent.times = sent.times.saturating_add(1);
        sent.left_at = now;
        self.out += 1;
        Some((number, &sent.payload))
    }

    /// Takes an acknowledgement: the device awaits datagram `expected`, has room for `free` bytes, and may report the
    /// check sum of everything that it took. `None` if the acknowledgement is not up to date: it was overtaken or
    /// doubled on the way.
    pub fn acknowledge(&mut self, expected: u32, free: usize, digest: Option<u32>) -> Result<Option<News>, UdpFault> {
        let taken = u64::from(expected).checked_sub(self.base).and_then(|taken| usize::try_from(taken).ok());
        let Some(taken) = taken.filter(|&taken| taken <= self.sent.len()) else { return Ok(None) };
        let mut news = News { taken, has_more_room: free > self.free, left_at: None };
        for sent in self.sent.drain(..taken) {
            self.taken_digest = sent.digest;
            self.taken_bytes += sent.payload.len() as u64;
            news.left_at = (sent.times == 1).then_some(sent.left_at);
        }
        self.base += taken as u64;
        self.out = self.out.saturating_sub(taken);
        // While the device takes nothing, its FIFO only empties, so the larger of two numbers is the later one.
        self.free = if taken == 0 { self.free.max(free) } else { free };
        if let Some(found) = digest {
            if found != self.taken_digest {
                return Err(UdpFault::PayloadDigest { found, expected: self.taken_digest });
            }
            self.proved_bytes = self.taken_bytes;
        }
        Ok(Some(news))
    }

    /// Time at which the datagram that the device awaits was sent, if it is out and was sent more than once.
    pub fn first_repeated_at(&self) -> Option<Duration> {
        self.sent.front().filter(|sent| self.out > 0 && sent.times > 1).map(|sent| sent.left_at)
    }

    /// Sends all datagrams under way again. They are not cut anew, since the device may yet take one that is on its
    /// way.
    pub fn go_back(&mut self) {
        self.out = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::RecordRange;

    fn next(sender: &mut Sender) -> Option<(u32, usize)> {
        sender.next(Duration::ZERO).map(|(number, payload)| (number, payload.len()))
    }

    #[test]
    fn credit_bounds_what_is_out_and_going_back_repeats_it() {
        let mut sender = Sender::default();
        sender.push(&Command::Insert { count: 1000, points: vec![7; 1000] });
        assert_eq!(next(&mut sender), None);
        sender.acknowledge(0, 3000, Some(0)).expect("sound");
        assert_eq!((next(&mut sender), next(&mut sender), next(&mut sender)), (Some((0, 1440)), Some((1, 1440)), None));
        sender.go_back();
        assert_eq!(next(&mut sender), Some((0, 1440)));
        // A datagram that was sent twice tells no round trip.
        assert_eq!(sender.acknowledge(1, 1400, None), Ok(Some(News { taken: 1, has_more_room: false, left_at: None })));
        assert_eq!(next(&mut sender), None);
        assert_eq!(sender.acknowledge(0, 9000, None), Ok(None), "overtaken");
        assert_eq!(sender.acknowledge(3, 9000, None), Ok(None), "more than was sent");
        sender.acknowledge(1, 3000, None).expect("sound");
        assert_eq!((next(&mut sender), next(&mut sender)), (Some((1, 1440)), Some((2, 1128))));
        assert_eq!(sender.resent(), 2);
    }

    #[test]
    fn a_full_fifo_starves_the_sender_until_it_has_room() {
        let mut sender = Sender::default();
        assert!(!sender.is_starved(), "there is nothing to send");
        sender.push(&Command::Insert { count: 600, points: vec![7; 600] });
        sender.acknowledge(0, 2000, Some(0)).expect("sound");
        assert_eq!(next(&mut sender), Some((0, 1440)));
        assert!(!sender.is_starved(), "an acknowledgement is due");
        let digest = sender.sent[0].digest;
        sender.acknowledge(1, 20, Some(digest)).expect("sound");
        assert_eq!(next(&mut sender), None);
        assert!(sender.is_starved());
        let news = sender.acknowledge(1, 900, Some(digest)).expect("sound").expect("up to date");
        assert!(news.has_more_room && news.taken == 0);
        assert!(!sender.is_starved() && next(&mut sender) == Some((1, 900)));
    }

    #[test]
    fn a_wrong_digest_is_a_fault() {
        let mut sender = Sender::default();
        let end = sender.push(&Command::<[u32; 0]>::Read(RecordRange { first: 0, count: 1 }));
        sender.acknowledge(0, 2000, Some(0)).expect("sound");
        next(&mut sender);
        assert!(matches!(sender.acknowledge(1, 2000, Some(9)), Err(UdpFault::PayloadDigest { found: 9, .. })));
        assert_eq!(end, 12);
    }
}
