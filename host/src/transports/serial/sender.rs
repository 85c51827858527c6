//! Sending commands: their words are cut into frames, sent within the window and the credit, and sent again from the
//! frame that the device awaits (go back N).

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{Command, MAX_PAYLOAD, WINDOW};

use super::fault::SerialFault;

/// Fewest bytes of payload to which noise makes frames shrink.
const MIN_SIZE: usize = 64;
/// Bytes of payload of the first frames: a noisy line loses few of them, and on a clean line they soon grow.
const FIRST_SIZE: usize = 256;
/// Frames taken without a loss after which frames grow.
const GROW_AFTER: u32 = 4;

/// A frame that the device has not acknowledged.
#[derive(Debug)]
struct Sent {
    payload: Vec<u8>,
    /// Check sum of all payload of the session up to the end of this frame.
    digest: u32,
    /// Time at which its last byte leaves the line, after the last time that it was handed out.
    left_at: Duration,
    /// Number of times that it was handed out.
    times: u32,
}

/// The content of an acknowledgement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct News {
    /// Number of frames that are newly acknowledged.
    pub taken: usize,
    /// Time at which the last of them was off the line, if it was sent once: only then does it tell the round trip.
    pub left_at: Option<Duration>,
}

/// The sending half of a session.
#[derive(Debug)]
pub(super) struct Sender {
    /// Bytes that are not cut into frames yet.
    stream: VecDeque<u8>,
    /// Frames under way, at most 16. The device awaits the first one.
    sent: VecDeque<Sent>,
    /// Number of frames acknowledged in this session; modulo 256 it is the number of the first frame under way.
    base: u64,
    /// Number of frames of `sent` that are out. The others will be sent again.
    out: usize,
    /// Free bytes of the device's FIFO before the frames under way arrive.
    free: usize,
    /// Bytes of this session so far.
    pushed_bytes: u64,
    /// Bytes of this session that are acknowledged.
    taken_bytes: u64,
    /// Check sum over all payload cut in this session.
    digest: crc32fast::Hasher,
    /// Check sum over all payload acknowledged.
    taken_digest: u32,
    /// Number of frames up to which the device has confirmed the check sum.
    proved: u64,
    /// Bytes of payload of the next frames.
    size: usize,
    /// Frames taken since the last loss or growth.
    clean: u32,
    /// Number of frames sent again.
    resent: u64,
}

impl Sender {
    pub fn new() -> Self {
        Self {
            stream: VecDeque::new(),
            sent: VecDeque::new(),
            base: 0,
            out: 0,
            free: 0,
            pushed_bytes: 0,
            taken_bytes: 0,
            digest: crc32fast::Hasher::new(),
            taken_digest: 0,
            proved: 0,
            size: FIRST_SIZE,
            clean: 0,
            resent: 0,
        }
    }

    /// Takes a command to be sent, and returns the number of bytes of the session up to its end.
    pub fn push_command(&mut self, command: &Command<impl AsRef<[u32]>>) -> u64 {
        let (head, count) = command.head();
        self.push(&head[..count]);
        self.push(command.points())
    }

    /// Takes words to be sent, and returns the number of bytes of the session up to their end.
    fn push(&mut self, words: &[u32]) -> u64 {
        self.stream.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        self.pushed_bytes += 4 * words.len() as u64;
        self.pushed_bytes
    }

    /// Number of bytes of the session that the device has taken.
    pub fn taken_bytes(&self) -> u64 {
        self.taken_bytes
    }

    /// Whether the device has taken everything.
    pub fn is_done(&self) -> bool {
        self.stream.is_empty() && self.sent.is_empty()
    }

    /// Whether the device has confirmed the check sum of everything that it has taken.
    pub fn is_proved(&self) -> bool {
        self.proved == self.base
    }

    /// Number of frames acknowledged in this session.
    pub fn base(&self) -> u64 {
        self.base
    }

    /// Number of frames cut in this session.
    pub fn cut(&self) -> u64 {
        self.base + self.sent.len() as u64
    }

    /// Number of frames sent again.
    pub fn resent(&self) -> u64 {
        self.resent
    }

    /// Whether a frame may go out now.
    pub fn has_due(&self) -> bool {
        self.next_length().is_some()
    }

    /// Bytes of payload of the frame that may go out next.
    fn next_length(&self) -> Option<usize> {
        let credit = self.free.saturating_sub(self.under_way());
        if let Some(again) = self.sent.get(self.out) {
            return (again.payload.len() <= credit).then_some(again.payload.len());
        }
        if self.sent.len() >= usize::from(WINDOW) || self.stream.is_empty() {
            return None;
        }
        let wanted = self.size.min(self.stream.len());
        if wanted <= credit {
            return Some(wanted);
        }
        // A short frame is better than none, but only if no acknowledgement is due that would bring more room.
        let short = credit & !3;
        (self.sent.is_empty() && short >= MIN_SIZE.min(wanted)).then_some(short)
    }

    /// Bytes that are out and not acknowledged.
    fn under_way(&self) -> usize {
        self.sent.iter().take(self.out).map(|frame| frame.payload.len()).sum()
    }

    /// Takes the next frame that may go out, with its number. `left` gives the time at which a frame with this many
    /// bytes of payload is off the line.
    pub fn next(&mut self, left: impl FnOnce(usize) -> Duration) -> Option<(u8, &[u8])> {
        let length = self.next_length()?;
        if self.out == self.sent.len() {
            let payload: Vec<u8> = self.stream.drain(..length).collect();
            self.digest.update(&payload);
            let digest = self.digest.clone().finalize();
            self.sent.push_back(Sent { payload, digest, left_at: Duration::ZERO, times: 0 });
        }
        let number = self.base.wrapping_add(self.out as u64) as u8;
        let frame = self.sent.get_mut(self.out)?;
        self.resent += u64::from(frame.times > 0);
        frame.times = frame.times.saturating_add(1);
        frame.left_at = left(length);
        self.out += 1;
        Some((number, &frame.payload))
    }

    /// Takes an acknowledgement: the device awaits frame `expected`, has room for `free` bytes, and may report the
    /// check sum of everything that it took. `None` if the acknowledgement is not up to date: it was overtaken, or
    /// doubled on the way.
    pub fn acknowledge(&mut self, expected: u8, free: usize, digest: Option<u32>) -> Result<Option<News>, SerialFault> {
        let taken = usize::from(expected.wrapping_sub(self.base as u8));
        if taken > self.sent.len() {
            return Ok(None);
        }
        let mut news = News { taken, left_at: None };
        for _ in 0..taken {
            let Some(frame) = self.sent.pop_front() else { break };
            self.taken_digest = frame.digest;
            self.taken_bytes += frame.payload.len() as u64;
            news.left_at = (frame.times == 1).then_some(frame.left_at);
            self.base += 1;
            self.out = self.out.saturating_sub(1);
        }
        self.free = free;
        if let Some(found) = digest {
            if found != self.taken_digest {
                return Err(SerialFault::PayloadDigest { found, expected: self.taken_digest });
            }
            self.proved = self.base;
        }
        self.clean = self.clean.saturating_add(taken as u32);
        if self.clean >= GROW_AFTER {
            self.clean = 0;
            self.size = (2 * self.size).min(MAX_PAYLOAD);
        }
        Ok(Some(news))
    }

    /// Time at which the frame that the device awaits is off the line, if it is out.
    pub fn first_left_at(&self) -> Option<Duration> {
        self.sent.front().filter(|_| self.out > 0).map(|frame| frame.left_at)
    }

    /// Whether the frame that the device awaits was sent more than once already.
    pub fn first_was_repeated(&self) -> bool {
        self.out > 0 && self.sent.front().is_some_and(|frame| frame.times > 1)
    }

    /// Sends all frames under way again. They are not cut anew, since the device may yet take one that is on the line.
    pub fn go_back(&mut self) {
        if self.out == 0 {
            return;
        }
        self.out = 0;
        self.clean = 0;
        self.size = (self.size / 2).max(MIN_SIZE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn next(sender: &mut Sender) -> Option<(u8, usize)> {
        sender.next(|_| Duration::ZERO).map(|(number, payload)| (number, payload.len()))
    }

    fn digest(words: &[u32]) -> Option<u32> {
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        Some(crc32fast::hash(&bytes))
    }

    #[test]
    fn credit_bounds_what_is_out() {
        let mut sender = Sender::new();
        let words: Vec<u32> = (0..1000).collect();
        sender.push(&words);
        assert_eq!(next(&mut sender), None);
        assert_eq!(sender.acknowledge(0, 600, digest(&[])), Ok(Some(News::default())));
        assert_eq!(next(&mut sender), Some((0, 256)));
        assert_eq!(next(&mut sender), Some((1, 256)));
        assert_eq!(next(&mut sender), None);
        let news = sender.acknowledge(1, 600, digest(&words[..64])).expect("sound");
        assert_eq!(news, Some(News { taken: 1, left_at: Some(Duration::ZERO) }));
        assert_eq!(next(&mut sender), Some((2, 256)));
        assert_eq!(next(&mut sender), None);
        // With nothing under way, a single short frame may go out.
        sender.acknowledge(3, 100, digest(&words[..192])).expect("sound");
        assert_eq!(next(&mut sender), Some((3, 100)));
        sender.acknowledge(4, 63, None).expect("sound");
        assert_eq!(next(&mut sender), None);
    }

    #[test]
    fn the_window_is_sixteen() {
        let mut sender = Sender::new();
        sender.push(&[7; 9999]);
        sender.acknowledge(0, 65_535, None).expect("sound");
        for number in 0..16 {
            assert_eq!(next(&mut sender), Some((number, 256)));
        }
        assert_eq!(next(&mut sender), None);
        assert_eq!(sender.acknowledge(17, 0, None), Ok(None), "more than was sent");
        assert_eq!(sender.acknowledge(255, 0, None), Ok(None), "less than was acknowledged");
    }

    #[test]
    fn going_back_sends_the_same_frames_and_then_shorter_ones() {
        let mut sender = Sender::new();
        sender.push(&[7; 9999]);
        sender.acknowledge(0, 2000, None).expect("sound");
        for _ in 0..7 {
            next(&mut sender);
        }
        sender.acknowledge(2, 2000, None).expect("sound");
        sender.go_back();
        for number in 2..7 {
            assert_eq!(next(&mut sender), Some((number, 256)));
        }
        assert_eq!(next(&mut sender), Some((7, 128)));
        assert_eq!(sender.resent(), 5);
        // A frame that was sent twice tells no round trip.
        assert_eq!(sender.acknowledge(3, 2000, None), Ok(Some(News { taken: 1, left_at: None })));
        // The device took more frames than it seemed, and none of those is sent again.
        sender.go_back();
        sender.acknowledge(7, 2000, None).expect("sound");
        assert_eq!(next(&mut sender), Some((7, 128)));
    }

    #[test]
    fn a_wrong_digest_is_a_fault() {
        let mut sender = Sender::new();
        sender.push(&[7; 64]);
        sender.acknowledge(0, 2000, digest(&[])).expect("sound");
        next(&mut sender);
        assert_eq!(
            sender.acknowledge(1, 2000, digest(&[8; 64])),
            Err(SerialFault::PayloadDigest { found: digest(&[8; 64]).unwrap(), expected: digest(&[7; 64]).unwrap() })
        );
    }
}
