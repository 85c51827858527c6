//! Sending: what the host sends, and when.

use std::time::Duration;

use incircle_protocol::{HostFrame, CRC_BYTES, FIRST_RATE, FRAME_END, HOST_HEADER_BYTES, MAX_PAYLOAD};

use super::{Polled, SerialProtocol, Stage};
use crate::transports::serial::codec::{encode, MOST_OVERHEAD};
use crate::transports::serial::fault::SerialFault;
use crate::transports::serial::timing::TRIP_BOUNDS;

/// Time by which bytes are handed out ahead of the line: enough to keep it busy, but little to wait for when frames
/// must be sent again.
const AHEAD: Duration = Duration::from_millis(4);
/// Time beyond the device's silence after which the host believes that the device has forgotten the session.
const SILENCE_SLACK: Duration = Duration::from_millis(300);
/// Time for which the host looks for a device that fell silent.
const SEARCH_FOR: Duration = Duration::from_millis(1000);
/// Time from one greeting to the next while the host looks for the device.
const SEARCH_EVERY: Duration = Duration::from_millis(150);
/// Most times that the host sends `Close`.
const CLOSES: u32 = 3;
/// Least time from one `Close` to the next.
const CLOSE_EVERY: Duration = Duration::from_millis(60);
/// Bytes of a frame on the line besides its payload: header, check sum, a length byte, the closing zero.
const FRAME_BYTES: usize = HOST_HEADER_BYTES + CRC_BYTES + 2;

impl SerialProtocol {
    /// Appends the bytes that are due to `out`.
    pub fn transmit(&mut self, now: Duration, out: &mut Vec<u8>) {
        let before = out.len();
        match self.stage {
            Stage::Closing { said, due } => self.say_close(said, due, now, out),
            _ if self.fault.is_some() => {}
            Stage::Idle => {}
            Stage::Connecting(_) => self.go_on_connecting(now, out),
            Stage::Open => self.speak(now, out),
            Stage::Searching { silent_for, until, due } => self.search(silent_for, until, due, now, out),
        }
        self.statistics.bytes_sent += (out.len() - before) as u64;
    }

    /// Time at which to call [`SerialProtocol::transmit`] again if nothing comes; `None` if there is
    /// nothing to wait for.
    pub fn next_wake(&self) -> Option<Duration> {
        match &self.stage {
            Stage::Closing { due, .. } => Some(*due),
            _ if self.fault.is_some() => None,
            Stage::Idle => None,
            Stage::Connecting(connect) => Some(connect.due()),
            Stage::Searching { due, until, .. } => Some(*due.min(until)),
            Stage::Open => {
                // However due a frame is, none is handed out before the line has room for it.
                let has_room_at = self.line.free_at().saturating_sub(AHEAD);
                let due = if self.sender.has_due() { has_room_at } else { self.poll_at() };
                Some(due.min(self.poll_at()).max(has_room_at).min(self.silent_at()))
            }
        }
    }

    fn go_on_connecting(&mut self, now: Duration, out: &mut Vec<u8>) {
        let rate = self.line.rate();
        let before = out.len();
        while let Stage::Connecting(connect) = &mut self.stage {
            if self.fault.is_some() || connect.is_done() || now < connect.due() {
                break;
            }
            if let Err(fault) = connect.act(now, &mut self.line, out) {
                self.fault = Some(fault);
            }
        }
        if rate != self.line.rate() {
            self.decoder.clear();
        }
        self.line.carry(out.len() - before, now);
    }

    /// Time at which the device will have been silent for so long that it has forgotten the session, or is gone.
    fn silent_at(&self) -> Duration {
        self.last_heard + self.silence + SILENCE_SLACK
    }

    /// Time at which the next `Poll` is due.
    fn poll_at(&self) -> Duration {
        let every = TRIP_BOUNDS.poll_every.min(self.silence / 4);
        let keep = self.last_said + every;
        let is_waiting = self.reader.is_waiting() || !self.sender.is_done() || !self.sender.is_proved();
        if !is_waiting || self.sender.has_due() {
            return keep;
        }
        let frame = self.line.time_of(MAX_PAYLOAD + MOST_OVERHEAD);
        keep.min(self.last_heard.max(self.line.free_at()) + self.trips.patience(frame))
    }

    fn speak(&mut self, now: Duration, out: &mut Vec<u8>) {
        if now >= self.silent_at() {
            let silent_for = now.saturating_sub(self.last_heard);
            self.stage = Stage::Searching { silent_for, until: now + SEARCH_FOR, due: now };
            return self.set_rate(FIRST_RATE, now);
        }
        while self.line.ahead(now) <= AHEAD {
            if now >= self.poll_at() {
                self.say_poll(now, out);
                continue;
            }
            let line = &mut self.line;
            let Some((number, payload)) = self.sender.next(|length| line.carry(length + FRAME_BYTES, now)) else {
                return;
            };
            encode(self.session, HostFrame::Data, number, payload, out);
            self.last_said = now;
        }
    }

    fn say_poll(&mut self, now: Duration, out: &mut Vec<u8>) {
        encode(self.session, HostFrame::Poll, 0, &[], out);
        let left_at = self.line.carry(FRAME_BYTES, now);
        // An earlier `Poll` without an answer is kept. An answer that comes before the latest `Poll` has left the line,
        // as from a simulated board, may belong to the earlier one, and frames that were out then are
        // lost all the same.
        let base = self.sender.base();
        if self.polled.as_ref().is_none_or(|polled| polled.base != base) {
            self.polled = Some(Polled { base, cut: self.sender.cut(), left_at });
        }
        self.trips.lengthen();
        self.last_said = now;
        self.statistics.polls += 1;
    }

    fn search(&mut self, silent_for: Duration, until: Duration, due: Duration, now: Duration, out: &mut Vec<u8>) {
        if now >= until {
            let milliseconds = u64::try_from(silent_for.as_millis()).unwrap_or(u64::MAX);
            self.fault = Some(SerialFault::Lost { milliseconds });
        } else if now >= due {
            out.extend([FRAME_END; 2]);
            encode(self.session, HostFrame::Hello, 0, &[], out);
            self.line.carry(FRAME_BYTES, now);
            self.stage = Stage::Searching { silent_for, until, due: now + SEARCH_EVERY };
        }
    }

    fn say_close(&mut self, said: u32, due: Duration, now: Duration, out: &mut Vec<u8>) {
        if now < due {
            return;
        }
        if said >= CLOSES {
            return self.closed(now);
        }
        out.extend([FRAME_END; 2]);
        encode(self.session, HostFrame::Close, 0, &[], out);
        self.line.carry(FRAME_BYTES, now);
        let wait = CLOSE_EVERY.max(self.line.ahead(now) + self.trips.mean() * 2);
        self.stage = Stage::Closing { said: said + 1, due: now + wait };
    }
}
