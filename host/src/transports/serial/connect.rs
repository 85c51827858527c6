//! Connecting: from a silent port to an open session at the best rate that works.
//!
//! The host greets the device, opens a session, asks for a higher rate, and checks the new rate by echoes of the
//! greeting. If a rate fails, both sides go back to the first rate, and the host tries the next lower one.

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

/// Time for which the host greets. A device that another host left at a high rate first needs its silence, after which
/// it is back at the first rate.
const GREET_FOR: Duration = ms(MAX_SILENCE_MS as u64 + 1000);
/// Time from one greeting to the next.
const GREET_EVERY: Duration = ms(200);
/// Time from one `Open` to the next.
const OPEN_EVERY: Duration = ms(200);
/// Most times that the host sends `Open`.
const OPENINGS: u32 = 10;
/// Time for the acknowledgement of a rate.
const RATE_WAIT: Duration = ms(150);
/// Time for both sides to settle on a new rate.
const SETTLE: Duration = ms(3);
/// Time from one probe of a new rate to the next.
const PROBE_EVERY: Duration = ms(50);
/// Probes without an echo after which a rate is unusable.
const PROBES: u32 = 8;
/// Echoes of the greeting that prove a rate.
const ECHOES: u32 = 2;
/// Most `Poll` frames at the first rate after a new rate failed that the device may not have heard of.
const RETURNS: u32 = 3;
/// Most times that the host asks for the same rate.
const RATE_TRIES: u32 = 3;
/// Rates to try below the one that is wanted, in bits per second.
const LADDER: [u32; 3] = [3_000_000, 1_000_000, 230_400];
/// Least bytes of a device's FIFO: the longest frame must fit.
const LEAST_FIFO: u32 = 2_048;
/// Range of silences, in milliseconds, that a device is believed to have.
const SILENCES: (u32, u32) = (20, MAX_SILENCE_MS);
/// Time to wait beyond the device's silence, since clocks differ.
const SILENCE_SLACK: Duration = ms(200);

/// Longest time from a silent port to an open session on a line that carries bytes.
///
/// The worst device was left at a high rate, and none of the rates of the ladder works. Each rate costs the question,
/// the trial, the way back, the silence, and a greeting and an opening, each of which may be needed twice.
pub(crate) const LONGEST: Duration = {
    let trial = RATE_WAIT.as_millis() as u64
        + 2 * SETTLE.as_millis() as u64
        + PROBE_EVERY.as_millis() as u64 * (PROBES + RETURNS) as u64;
    let silence = MAX_SILENCE_MS as u64 + SILENCE_SLACK.as_millis() as u64;
    let again = 2 * (GREET_EVERY.as_millis() + OPEN_EVERY.as_millis()) as u64;
    ms(silence + again + LADDER.len() as u64 * (trial + silence + again))
};

/// A step of connecting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// Greet the device until it answers.
    Greet,
    /// Open the session on the device.
    Open,
    /// Ask for a rate.
    Rate,
    /// Try the new rate. `is_sure` is true if the device has acknowledged it.
    Probe { is_sure: bool },
    /// Find out whether the device is still at the first rate.
    Return,
    /// Wait until the device is back at the first rate.
    Wait,
}

/// Connects to a device: the state between a silent port and an open session.
#[derive(Debug)]
pub(super) struct Connect {
    step: Step,
    /// Time of the next action if nothing comes before.
    due: Duration,
    /// Actions so far in this step.
    tries: u32,
    /// Time of the first greeting.
    since: Duration,
    /// Rates to try, the highest first.
    rates: VecDeque<u32>,
    /// Number of times that the first rate of the list was asked for.
    asked: u32,
    /// Echoes at the new rate. The first answers a `Poll`, and the others are greetings.
    echoes: u32,
    session: u8,
    greeting: Option<Greeting>,
    only_greet: bool,
    /// Bytes that came from the line.
    bytes: u64,
}

impl Connect {
    /// Begins to connect. The number of the session will be the one after `session`, and the rates are
    /// tried in their order.
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

    /// The rates to try for a wanted rate, the highest first. The first rate, at which every link begins,
    /// is not among them.
    pub fn ladder(wanted: u32) -> Vec<u32> {
        let lower = LADDER.into_iter().filter(|&rate| rate < wanted);
        std::iter::once(wanted).filter(|&rate| rate > FIRST_RATE).chain(lower).take(LADDER.len()).collect()
    }

    /// Whether connecting is done.
    pub fn is_done(&self) -> bool {
        match self.step {
            Step::Open => self.only_greet,
            Step::Rate => self.rates.is_empty(),
            Step::Probe { .. } => self.echoes > ECHOES,
            Step::Greet | Step::Return | Step::Wait => false,
        }
    }

    /// Whether a greeting is all that is wanted, without a session.
    pub fn only_greets(&self) -> bool {
        self.only_greet
    }

    /// The device's silence: the time without a frame from the host after which it forgets the session. A claim
    /// outside [`SILENCES`] is clamped.
    pub fn silence(&self) -> Duration {
        let claimed = self.greeting.map_or(SILENCE_MS, |greeting| greeting.silence_ms);
        ms(u64::from(claimed.clamp(SILENCES.0, SILENCES.1)))
    }

    /// The time at which [`Connect::act`] is to be called.
    pub fn due(&self) -> Duration {
        self.due
    }

    /// The device's greeting, once it has come.
    pub fn greeting(&self) -> Option<&Greeting> {
        self.greeting.as_ref()
    }

    /// The number of the session.
    pub fn session(&self) -> u8 {
        self.session
    }

    /// Whether the device has opened the session.
    pub fn has_session(&self) -> bool {
        matches!(self.step, Step::Rate | Step::Probe { .. } | Step::Return)
    }

    /// Whether the device may have opened the session.
    pub fn may_be_open(&self) -> bool {
        !matches!(self.step, Step::Greet | Step::Wait)
    }

    /// Counts bytes from the line, whatever they are, to tell noise from silence.
    pub fn count(&mut self, bytes: usize) {
        self.bytes = self.bytes.saturating_add(bytes as u64);
    }

    fn enter(&mut self, step: Step, due: Duration) {
        (self.step, self.due, self.tries) = (step, due, 0);
    }

    /// Drops the rate under trial, so that the next lower one is tried.
    fn drop_rate(&mut self) {
        self.rates.pop_front();
        self.asked = 0;
    }

    fn greet(&mut self, now: Duration) {
        self.since = now;
        self.enter(Step::Greet, now);
    }

    /// Waits after a rate that failed. The device may be at either rate, but returns to the first one by itself.
    fn wait(&mut self, now: Duration, line: &mut Line) {
        self.drop_rate();
        line.set_rate(FIRST_RATE, now);
        self.enter(Step::Wait, now + self.silence() + SILENCE_SLACK);
    }

    /// Does the action that is due, and appends the bytes to be sent. The rate never changes in a call that sends.
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
        // Zeros end an unfinished frame that noise, or another rate, may have left in the device.
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
        // Either the question or its acknowledgement is lost, so the device may be at either rate.
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

    /// Takes a frame of the device. Returns true if the frame opened the session, which begins
    /// with nothing from before.
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
                    self.drop_rate();
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
                    self.drop_rate();
                }
                self.next_rate(now);
            }
            // The device's silence was over before the trial was: the device is at the first rate again, and the rate
            // that was asked for does not work.
            (Step::Rate | Step::Probe { .. } | Step::Return, DeviceFrame::NoSession) => {
                if self.asked > 0 {
                    self.drop_rate();
                }
                line.set_rate(FIRST_RATE, now);
                self.greet(now);
            }
            _ => {}
        }
        Ok(false)
    }

    /// Whether this is the same greeting as the first one.
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
        // The new session must not have the number of one that is open, or that was open just before.
        self.session = self.session.checked_add(1).unwrap_or(1);
        if self.session == message.session {
            self.session = self.session.checked_add(1).unwrap_or(1);
        }
        self.enter(Step::Open, now);
        Ok(())
    }
}

/// Refuses a greeting that no sound device sends. No word of a greeting may be used before it passes here.
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
