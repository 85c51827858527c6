//! Sending: what the host sends, and when.

use std::time::Duration;

use incircle_protocol::{HostDatagram, UDP_GREETING_WORDS};

use super::{Polled, Stage, UdpProtocol};
use crate::transports::udp::codec::encode;
use crate::transports::udp::fault::UdpFault;

/// Time for which the host greets.
const GREET_FOR: Duration = Duration::from_secs(3);
/// Time from one greeting, or one `Open`, to the next.
const ASK_EVERY: Duration = Duration::from_millis(50);
/// Time beyond the device's silence after which the host believes that the device has forgotten the session.
const SILENCE_SLACK: Duration = Duration::from_millis(300);
/// Least time until the host asks whether a full FIFO has room again: the core takes a datagram of points out of it in
/// about this time.
const STARVED_FOR: Duration = Duration::from_micros(50);
/// Most times that the host sends `Close`.
const CLOSES: u32 = 3;
/// Time from one `Close` to the next.
const CLOSE_EVERY: Duration = Duration::from_millis(20);

impl UdpProtocol {
    /// Appends the datagrams that are due to `out`.
    pub fn transmit(&mut self, now: Duration, out: &mut Vec<Vec<u8>>) {
        let before = out.len();
        match self.stage {
            Stage::Closing { said, due } => self.say_close(said, due, now, out),
            _ if self.fault.is_some() => {}
            Stage::Idle => {}
            Stage::Greeting { since, due, opens } => self.say_hello(since, due, opens, now, out),
            Stage::Opening { since, due, old, was_busy } => self.say_open(since, due, old, was_busy, now, out),
            Stage::Open => self.speak(now, out),
        }
        self.statistics.sent += (out.len() - before) as u64;
    }

    /// Time at which to call [`UdpProtocol::transmit`] again if nothing comes; `None` if there is nothing to wait for.
    pub fn next_wake(&self) -> Option<Duration> {
        match self.stage {
            Stage::Closing { due, .. } => Some(due),
            _ if self.fault.is_some() => None,
            Stage::Idle => None,
            Stage::Greeting { due, .. } | Stage::Opening { due, .. } => Some(due),
            Stage::Open if self.sender.has_due() => Some(Duration::ZERO),
            Stage::Open if !self.is_waiting() => None,
            Stage::Open => {
                let lost_at = self.reader.lost_at(self.grace());
                Some(lost_at.map_or(self.poll_at(), |lost_at| lost_at.min(self.poll_at())).min(self.silent_at()))
            }
        }
    }

    fn is_waiting(&self) -> bool {
        self.reader.is_waiting() || !self.sender.is_done()
    }

    /// Time after which an answer that others overtook counts as lost.
    pub(super) fn grace(&self) -> Duration {
        (self.trips.mean() / 2).max(Duration::from_micros(200))
    }

    /// Time at which the device will have been silent for so long that it has forgotten the session, or is gone.
    fn silent_at(&self) -> Duration {
        self.last_heard + self.silence + SILENCE_SLACK
    }

    /// Time at which the next `Poll` is due.
    fn poll_at(&self) -> Duration {
        let usual = self.trips.patience(Duration::ZERO);
        let patience = if self.sender.is_starved() { usual.min(self.trips.repeated(STARVED_FOR)) } else { usual };
        self.last_heard.max(self.last_said) + patience.min(self.silence / 8)
    }

    fn say_hello(&mut self, since: Duration, due: Duration, opens: bool, now: Duration, out: &mut Vec<Vec<u8>>) {
        if now < due {
            return;
        }
        if now >= since + GREET_FOR {
            self.fault = Some(UdpFault::Silent { milliseconds: milliseconds(GREET_FOR) });
            return;
        }
        self.session = self.next_random();
        out.push(encode(HostDatagram::Hello, 0, self.session, &[0; 4 * UDP_GREETING_WORDS]));
        self.stage = Stage::Greeting { since, due: now + ASK_EVERY, opens };
    }

    fn say_open(
        &mut self,
        since: Duration,
        due: Duration,
        old: Option<u64>,
        was_busy: bool,
        now: Duration,
        out: &mut Vec<Vec<u8>>,
    ) {
        if now < due {
            return;
        }
        let limit = self.silence + SILENCE_SLACK;
        if now >= since + limit {
            let milliseconds = milliseconds(limit);
            self.fault = Some(match (was_busy, self.has_served) {
                (true, _) => UdpFault::Busy { milliseconds },
                // The address is right: the device has answered before.
                (false, true) => UdpFault::Lost { milliseconds },
                (false, false) => UdpFault::Silent { milliseconds },
            });
            return;
        }
        out.extend(old.map(|old| encode(HostDatagram::Close, 0, old, &[])));
        out.push(encode(HostDatagram::Open, 0, self.session, &[]));
        self.stage = Stage::Opening { since, due: now + ASK_EVERY, old, was_busy };
    }

    fn speak(&mut self, now: Duration, out: &mut Vec<Vec<u8>>) {
        if now >= self.silent_at() && self.is_waiting() {
            let silent_for = now.saturating_sub(self.last_heard);
            self.fault = Some(UdpFault::Lost { milliseconds: milliseconds(silent_for) });
            return;
        }
        if self.reader.wants_session(&self.sender) {
            return self.open(now, Some(self.session));
        }
        let counted = self.reader.count(now, self.grace(), false);
        if let Err(fault) = counted.and_then(|()| self.reader.ask_more(&mut self.sender)) {
            self.fault = Some(fault);
            return;
        }
        while let Some((number, words)) = self.sender.next(now) {
            out.push(encode(HostDatagram::Data, number, self.session, words));
            self.last_said = now;
        }
        if self.is_waiting() && now >= self.poll_at() {
            out.push(encode(HostDatagram::Poll, 0, self.session, &[]));
            // An earlier `Poll` without an answer is kept: what was out then is lost all the same.
            let base = self.sender.base();
            if self.polled.is_none_or(|polled| polled.base != base) {
                self.polled = Some(Polled { base, cut: self.sender.cut() });
            }
            self.trips.lengthen();
            self.last_said = now;
            self.statistics.polls += 1;
        }
    }

    fn say_close(&mut self, said: u32, due: Duration, now: Duration, out: &mut Vec<Vec<u8>>) {
        if now < due {
            return;
        }
        if said >= CLOSES {
            self.stage = Stage::Idle;
            return;
        }
        out.push(encode(HostDatagram::Close, 0, self.session, &[]));
        self.stage = Stage::Closing { said: said + 1, due: now + CLOSE_EVERY };
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}
