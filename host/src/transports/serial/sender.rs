//! Command words on their way to the device: cut into frames, sent within window and credit, and sent again from where
//! the device says (go back N).

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{Command, MAX_PAYLOAD, WINDOW};

use super::fault::SerialFault;

/// Smallest frame that noise makes us cut.
const MIN_SIZE: usize = 64;
/// First frames: a noisy line loses few of them, and a clean one soon carries the longest.
const FIRST_SIZE: usize = 256;
/// Frames taken without a loss before they grow.
const GROW_AFTER: u32 = 4;

/// A frame that the device has not acknowledged.
#[derive(Debug)]
struct Sent {
    payload: Vec<u8>,
    /// Check sum of all payload of the session up to its end.
    digest: u32,
    /// When its last byte leaves, of the last time.
    left_at: Duration,
    /// Times it was handed out.
    times: u32,
}

/// What an acknowledgement told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct News {
    /// Frames that are acknowledged now.
    pub taken: usize,
    /// When the last of them was off the line, if it was sent once.
    pub left_at: Option<Duration>,
}

/// The sending half of a session.
#[derive(Debug)]
pub(super) struct Sender {
    /// Bytes not yet cut into frames.
    stream: VecDeque<u8>,
    /// Frames under way, the first of which the device awaits: at most 16.
    sent: VecDeque<Sent>,
    /// Frames acknowledged in this session; modulo 256 the number of the first frame under way.
    base: u64,
    /// How many of `sent` are out; the others go again.
    out: usize,
    /// Free bytes of the FIFO before the first frame under way.
    free: usize,
    /// Bytes of this session, and those of them that are acknowledged.
    pushed_bytes: u64,
    taken_bytes: u64,
    /// Over all payload cut in this session.
    digest: crc32fast::Hasher,
    /// Of all payload acknowledged.
    taken_digest: u32,
    /// Frames whose digest the device has told, and it was ours.
    proved: u64,
    /// Bytes of the next frames.
    size: usize,
    /// Frames taken since the last loss or growth.
    clean: u32,
    /// Frames sent again, in all.
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

    /// Takes a command to be sent: the bytes of the session up to its end.
    pub fn push_command(&mut self, command: &Command<impl AsRef<[u32]>>) -> u64 {
        let (head, count) = command.head();
        self.push(&head[..count]);
        self.push(command.points())
    }

    /// Takes words to be sent: the bytes of the session up to their end.
    fn push(&mut self, words: &[u32]) -> u64 {
        self.stream.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        self.pushed_bytes += 4 * words.len() as u64;
        self.pushed_bytes
    }

    /// Bytes of the session that the device has taken.
    pub fn taken_bytes(&self) -> u64 {
        self.taken_bytes
    }

    /// True if the device has taken all.
    pub fn is_done(&self) -> bool {
        self.stream.is_empty() && self.sent.is_empty()
    }

    /// True if the digest of all that the device has taken is known to be right.
    pub fn is_proved(&self) -> bool {
        self.proved == self.base
    }

    /// Frames acknowledged in this session.
    pub fn base(&self) -> u64 {
        self.base
    }

    /// Frames cut in this session.
    pub fn cut(&self) -> u64 {
        self.base + self.sent.len() as u64
    }

    /// Frames sent again, in all.
    pub fn resent(&self) -> u64 {
        self.resent
    }

    /// True if a frame could go out now.
    pub fn has_due(&self) -> bool {
        self.next_length().is_some()
    }

    /// Bytes of the frame that may go out next.
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
        // A short frame is better than none, but only where no acknowledgement will bring more room.
        let short = credit & !3;
        (self.sent.is_empty() && short >= MIN_SIZE.min(wanted)).then_some(short)
    }

    /// Bytes out after the last one acknowledged.
    fn under_way(&self) -> usize {
        self.sent.iter().take(self.out).map(|frame| frame.payload.len()).sum()
    }

    /// The next frame that may go out, with its number; `left` gives the time when so many bytes of payload are off the
    /// line.
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

    /// Takes what the device says: it awaits frame `expected`, has `free` bytes, and, if told, this check sum of all it
    /// took. `None` if this is no news of now: it overtook, or was doubled on the way.
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

    /// When the frame that the device awaits is off the line, if it is out.
    pub fn first_left_at(&self) -> Option<Duration> {
        self.sent.front().filter(|_| self.out > 0).map(|frame| frame.left_at)
    }

    /// True if the frame that the device awaits was sent again already.
    pub fn first_was_repeated(&self) -> bool {
        self.out > 0 && self.sent.front().is_some_and(|frame| frame.times > 1)
    }

    /// All frames under way go out again. Their cut stays: the device may yet take one that is still on the line.
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
        // A single short frame, where nothing is under way.
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
        // What was sent twice gives no round trip.
        assert_eq!(sender.acknowledge(3, 2000, None), Ok(Some(News { taken: 1, left_at: None })));
        // The device took more than it seemed: nothing of that goes again.
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
