//! From a silent port to an open session: greeting, opening, a higher rate checked by an echo, and the way back to a
//! lower one.

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{
    rate_step, DeviceFrame, Greeting, HostFrame, FIRST_RATE, FRAME_END, LINK_MAGIC, LINK_VERSION, MAX_SILENCE_MS,
    SILENCE_MS, STATUS_BAD_RATE,
};

use super::codec::{encode, Message};
use super::fault::SerialFault;
use super::timing::Line;
use crate::transports::identity::check_identity;

const fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// How long the host greets: a device that another host left at a high rate needs its silence first.
const GREET_FOR: Duration = ms(MAX_SILENCE_MS as u64 + 1000);
/// Time from one greeting to the next.
const GREET_EVERY: Duration = ms(200);
/// Time from one opening to the next, and how many there are.
const OPEN_EVERY: Duration = ms(200);
const OPENINGS: u32 = 10;
/// Time for the acknowledgement of a rate.
const RATE_WAIT: Duration = ms(150);
/// Time for both sides to settle on a new rate.
const SETTLE: Duration = ms(3);
/// Time from one question at a new rate to the next, and how many may be asked until it counts as unusable.
const PROBE_EVERY: Duration = ms(50);
const PROBES: u32 = 8;
/// Echoes of the greeting that prove a rate.
const ECHOES: u32 = 2;
/// Questions at the old rate after a new one failed that may never have been heard of.
const RETURNS: u32 = 3;
/// Times the same rate is asked for.
const RATE_TRIES: u32 = 3;
/// Rates that are tried below the one wanted.
const LADDER: [u32; 3] = [3_000_000, 1_000_000, 230_400];
/// Least FIFO of a device: a frame and some.
const LEAST_FIFO: u32 = 2_048;
/// Least and most silence that is believed, in milliseconds.
const SILENCES: (u32, u32) = (20, MAX_SILENCE_MS);
/// Beyond the device's silence, for clocks that differ.
const SILENCE_SLACK: Duration = ms(200);

/// Longest way to an open session where bytes pass: a device that was left at a high rate, then all rates of the
/// ladder, of which none works. Each costs its question, its trial, the way back, the silence, and a greeting and an
/// opening, which are asked for once more if need be.
pub(crate) const LONGEST: Duration = {
    let trial = RATE_WAIT.as_millis() as u64
        + 2 * SETTLE.as_millis() as u64
        + PROBE_EVERY.as_millis() as u64 * (PROBES + RETURNS) as u64;
    let silence = MAX_SILENCE_MS as u64 + SILENCE_SLACK.as_millis() as u64;
    let again = 2 * (GREET_EVERY.as_millis() + OPEN_EVERY.as_millis()) as u64;
    ms(silence + again + LADDER.len() as u64 * (trial + silence + again))
};

/// What the host does now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// It greets.
    Greet,
    /// It opens the session.
    Open,
    /// It asks for a rate.
    Rate,
    /// It tries the new rate. `is_sure`: the device has acknowledged it.
    Probe { is_sure: bool },
    /// It looks whether the device is still at the first rate.
    Return,
    /// It waits until the device is back at the first rate.
    Wait,
}

/// The way to an open session.
#[derive(Debug)]
pub(super) struct Connect {
    step: Step,
    /// When something is to be done if nothing comes.
    due: Duration,
    /// Times it was done in this step.
    tries: u32,
    /// Beginning of the greetings.
    since: Duration,
    /// Rates to try, the highest first.
    rates: VecDeque<u32>,
    /// Times the first of them was asked for.
    asked: u32,
    /// Echoes at the new rate; the first is of a `Poll`.
    echoes: u32,
    session: u8,
    greeting: Option<Greeting>,
    only_greet: bool,
    /// Bytes that came.
    bytes: u64,
}

impl Connect {
    /// From now on: the session's number comes after `session`, the rates are tried in their order.
    pub fn new(now: Duration, session: u8, rates: &[u32], only_greet: bool) -> Self {
        Self {
            step: Step::Greet,
            due: now,
            tries: 0,
            since: now,
            rates: rates.iter().copied().collect(),
            asked: 0,
            echoes: 0,
            session,
            greeting: None,
            only_greet,
            bytes: 0,
        }
    }

    /// The rates for a wish, the highest first; the first rate of all is not among them.
    pub fn ladder(wanted: u32) -> Vec<u32> {
        let lower = LADDER.into_iter().filter(|&rate| rate < wanted);
        std::iter::once(wanted).filter(|&rate| rate > FIRST_RATE).chain(lower).take(LADDER.len()).collect()
    }

    /// True if all is done.
    pub fn is_done(&self) -> bool {
        match self.step {
            Step::Open => self.only_greet,
            Step::Rate => self.rates.is_empty(),
            Step::Probe { .. } => self.echoes > ECHOES,
            Step::Greet | Step::Return | Step::Wait => false,
        }
    }

    /// True if no session is wanted.
    pub fn only_greets(&self) -> bool {
        self.only_greet
    }

    /// The device's silence, as far as it is believed.
    pub fn silence(&self) -> Duration {
        let claimed = self.greeting.map_or(SILENCE_MS, |greeting| greeting.silence_ms);
        ms(u64::from(claimed.clamp(SILENCES.0, SILENCES.1)))
    }

    /// When [`Connect::act`] is to be called.
    pub fn due(&self) -> Duration {
        self.due
    }

    /// What the device said of itself.
    pub fn greeting(&self) -> Option<&Greeting> {
        self.greeting.as_ref()
    }

    /// The session's number.
    pub fn session(&self) -> u8 {
        self.session
    }

    /// True if the device has opened the session.
    pub fn has_session(&self) -> bool {
        matches!(self.step, Step::Rate | Step::Probe { .. } | Step::Return)
    }

    /// True if the device may have opened the session.
    pub fn may_be_open(&self) -> bool {
        !matches!(self.step, Step::Greet | Step::Wait)
    }

    /// Bytes came, whatever they are.
    pub fn count(&mut self, bytes: usize) {
        self.bytes = self.bytes.saturating_add(bytes as u64);
    }

    fn enter(&mut self, step: Step, due: Duration) {
        (self.step, self.due, self.tries) = (step, due, 0);
    }

    /// The next lower rate is tried from now on.
    fn give_up_rate(&mut self) {
        self.rates.pop_front();
        self.asked = 0;
    }

    fn greet(&mut self, now: Duration) {
        self.since = now;
        self.enter(Step::Greet, now);
    }

    /// The rate under trial failed, and where the device is nobody knows: it comes back by itself.
    fn wait(&mut self, now: Duration, line: &mut Line) {
        self.give_up_rate();
        line.set_rate(FIRST_RATE, now);
        self.enter(Step::Wait, now + self.silence() + SILENCE_SLACK);
    }

    /// Does what is due, and appends what is to be sent. The rate never changes in a call that sends.
    pub fn act(&mut self, now: Duration, line: &mut Line, out: &mut Vec<u8>) -> Result<(), SerialFault> {
        let tries = self.tries;
        self.tries += 1;
        match self.step {
            Step::Greet if now.saturating_sub(self.since) >= GREET_FOR => return Err(self.silent()),
            Step::Greet => self.say(HostFrame::Hello, &[], now + GREET_EVERY, out),
            Step::Open if tries >= OPENINGS => return Err(self.silent()),
            Step::Open => self.say(HostFrame::Open, &[], now + OPEN_EVERY, out),
            Step::Rate => self.ask_rate(tries, now, line, out),
            Step::Probe { .. } if tries < PROBES => {
                let kind = if self.echoes == 0 { HostFrame::Poll } else { HostFrame::Hello };
                self.say(kind, &[], now + PROBE_EVERY, out);
            }
            Step::Probe { is_sure: false } => {
                line.set_rate(FIRST_RATE, now);
                self.enter(Step::Return, now + SETTLE);
            }
            Step::Return if tries < RETURNS => self.say(HostFrame::Poll, &[], now + PROBE_EVERY, out),
            Step::Probe { .. } | Step::Return => self.wait(now, line),
            Step::Wait => self.greet(now),
        }
        Ok(())
    }

    fn say(&mut self, kind: HostFrame, payload: &[u8], due: Duration, out: &mut Vec<u8>) {
        // The zeros end what noise, or another rate, may have left half in the device.
        out.extend([FRAME_END; 2]);
        encode(self.session, kind, 0, payload, out);
        self.due = due;
    }

    fn ask_rate(&mut self, tries: u32, now: Duration, line: &mut Line, out: &mut Vec<u8>) {
        let clock = self.greeting.map_or(0, |greeting| greeting.clock_hz);
        let rate = self.rates.front().copied().unwrap_or(FIRST_RATE);
        if tries == 0 {
            self.asked += 1;
            let step = rate_step(rate, clock).unwrap_or(0).to_le_bytes();
            return self.say(HostFrame::Rate, &step, now + RATE_WAIT, out);
        }
        // Question or acknowledgement is lost: the device may be at either rate.
        self.try_rate(rate, false, now, line);
    }

    fn try_rate(&mut self, rate: u32, is_sure: bool, now: Duration, line: &mut Line) {
        line.set_rate(rate, now);
        self.echoes = 0;
        self.enter(Step::Probe { is_sure }, now + SETTLE);
    }

    fn silent(&self) -> SerialFault {
        match self.bytes {
            0 => SerialFault::Silent,
            bytes => SerialFault::Noise { bytes },
        }
    }

    /// Takes a frame of the device. True if it opened the session: all before is forgotten.
    pub fn hear(&mut self, message: &Message<'_>, now: Duration, line: &mut Line) -> Result<bool, SerialFault> {
        let is_ours = message.session == self.session;
        match (self.step, message.kind) {
            (Step::Greet, DeviceFrame::Hello) => self.greeted(message, now)?,
            (Step::Open, DeviceFrame::Opened) if is_ours => {
                self.next_rate(now);
                return Ok(true);
            }
            (Step::Rate, DeviceFrame::Ack) if is_ours && self.tries > 0 => {
                if message.status & STATUS_BAD_RATE != 0 {
                    self.give_up_rate();
                    self.next_rate(now);
                } else {
                    let rate = self.rates.front().copied().unwrap_or(FIRST_RATE);
                    self.try_rate(rate, self.asked == 1, now, line);
                }
            }
            (Step::Probe { .. }, DeviceFrame::Ack) if is_ours && self.echoes == 0 => self.echo(now),
            (Step::Probe { .. }, DeviceFrame::Hello) if self.echoes > 0 && self.is_echo(message) => self.echo(now),
            (Step::Return, DeviceFrame::Ack) if is_ours => {
                if self.asked >= RATE_TRIES {
                    self.give_up_rate();
                }
                self.next_rate(now);
            }
            // The silence was over before we were done: the device is at the first rate, and the one asked for does not
            // work.
            (Step::Rate | Step::Probe { .. } | Step::Return, DeviceFrame::NoSession) => {
                if self.asked > 0 {
                    self.give_up_rate();
                }
                line.set_rate(FIRST_RATE, now);
                self.greet(now);
            }
            _ => {}
        }
        Ok(false)
    }

    /// True if it is the greeting from before.
    fn is_echo(&self, message: &Message<'_>) -> bool {
        self.greeting.is_some() && message.words().map(Greeting::from_words) == self.greeting
    }

    fn echo(&mut self, now: Duration) {
        self.echoes += 1;
        self.due = now;
    }

    fn next_rate(&mut self, now: Duration) {
        self.enter(Step::Rate, now);
    }

    fn greeted(&mut self, message: &Message<'_>, now: Duration) -> Result<(), SerialFault> {
        let Some(words) = message.words() else {
            return Ok(());
        };
        let greeting = Greeting::from_words(words);
        check(&greeting)?;
        let can = |rate: u32| rate <= greeting.max_rate && rate_step(rate, greeting.clock_hz).is_some();
        self.rates.retain(|&rate| can(rate));
        self.greeting = Some(greeting);
        // Another number than that of a session that is open, or was just now.
        self.session = self.session.checked_add(1).unwrap_or(1);
        if self.session == message.session {
            self.session = self.session.checked_add(1).unwrap_or(1);
        }
        self.enter(Step::Open, now);
        Ok(())
    }
}

/// A greeting is hostile until it passes here.
fn check(greeting: &Greeting) -> Result<(), SerialFault> {
    if greeting.magic != LINK_MAGIC {
        return Err(SerialFault::Magic { found: greeting.magic, expected: LINK_MAGIC });
    }
    let (found, expected) = (greeting.link_version, LINK_VERSION);
    if found >> 16 != expected >> 16 || found < expected {
        return Err(SerialFault::Version { found, expected });
    }
    if greeting.fifo_bytes < LEAST_FIFO {
        let what = "bytes of its FIFO";
        return Err(SerialFault::Greeting { what, found: greeting.fifo_bytes, least: LEAST_FIFO });
    }
    if greeting.max_rate < FIRST_RATE {
        let what = "bits per second";
        return Err(SerialFault::Greeting { what, found: greeting.max_rate, least: FIRST_RATE });
    }
    check_identity(&greeting.identity)?;
    Ok(())
}
