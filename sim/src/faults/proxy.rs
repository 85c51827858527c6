//! Both directions of a serial line with faults, the lying device behind it, and the cable that can be pulled.

use std::time::Duration;

use super::liar::Liar;
use super::line::FaultyLine;
use super::spec::FaultSpec;
use super::Direction;
use crate::serial::Symbol;

/// The faulty line between a host and a board.
#[derive(Debug)]
pub struct Proxy {
    to_device: FaultyLine,
    to_host: FaultyLine,
    liar: Option<Liar>,
    /// Number of bytes until the cable is pulled, and the time for which it stays out.
    unplug: Option<(u64, Duration)>,
}

impl Proxy {
    /// A line with the faults of `spec`.
    pub fn new(spec: &FaultSpec) -> Self {
        Self {
            to_device: FaultyLine::new(spec, Direction::ToDevice),
            to_host: FaultyLine::new(spec, Direction::ToHost),
            liar: spec.lie.map(Liar::new),
            unplug: spec.unplug_after.map(|bytes| (bytes, Duration::from_millis(spec.unplug_ms))),
        }
    }

    /// Sends a byte of the host into the line.
    pub fn from_host(&mut self, byte: u8, now: u64) {
        self.count();
        self.to_device.carry(byte, now);
    }

    /// Sends a symbol of the board into the line. A symbol without a start bit is lost; one without a stop bit is
    /// passed on, as the hardware of a host does.
    pub fn from_device(&mut self, symbol: Symbol, now: u64) {
        let Some(byte) = symbol.byte() else {
            return;
        };
        self.count();
        let Some(liar) = &mut self.liar else {
            return self.to_host.carry(byte, now);
        };
        liar.take(byte);
        while let Some(byte) = liar.next() {
            self.to_host.carry(byte, now);
        }
    }

    fn count(&mut self) {
        if let Some((left, _)) = &mut self.unplug {
            *left = left.saturating_sub(1);
        }
    }

    /// The next symbol for the board.
    pub fn next_to_device(&mut self, now: u64) -> Option<Symbol> {
        self.to_device.next(now)
    }

    /// The next byte for the host.
    pub fn next_to_host(&mut self, now: u64) -> Option<u8> {
        loop {
            // A symbol whose start bit was flipped makes no byte.
            if let Some(byte) = self.to_host.next(now)?.byte() {
                return Some(byte);
            }
        }
    }

    /// Whether nothing waits for the board.
    pub fn is_empty_to_device(&self) -> bool {
        self.to_device.is_empty()
    }

    /// Whether nothing waits in either direction.
    pub fn is_empty(&self) -> bool {
        self.to_device.is_empty() && self.to_host.is_empty()
    }

    /// The time for which the cable must be pulled now. Each pull is returned once.
    pub fn take_unplug(&mut self) -> Option<Duration> {
        self.unplug.take_if(|(left, _)| *left == 0).map(|(_, length)| length)
    }

    /// Loses everything that is on the line.
    pub fn clear(&mut self) {
        self.to_device.clear();
        self.to_host.clear();
    }

    /// Number of faults so far, in both directions.
    pub fn faults(&self) -> u64 {
        self.to_device.faults() + self.to_host.faults()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_directions_count_for_the_cable() {
        let spec: FaultSpec = "unplug-after=3,unplug-ms=70,drop=1,direction=to-host".parse().unwrap();
        let mut proxy = Proxy::new(&spec);
        proxy.from_host(1, 0);
        proxy.from_device(Symbol::of(2), 0);
        proxy.from_device(Symbol::of(2).flip(0), 0);
        assert_eq!(proxy.take_unplug(), None);
        proxy.from_host(3, 0);
        assert_eq!(proxy.take_unplug(), Some(Duration::from_millis(70)));
        assert_eq!(proxy.take_unplug(), None);
        assert_eq!((proxy.next_to_device(0), proxy.next_to_host(0)), (Some(Symbol::of(1)), None));
        assert_eq!(proxy.faults(), 1);
        proxy.clear();
        assert!(proxy.is_empty_to_device());
    }

    #[test]
    fn what_waits_for_the_host_waits() {
        let mut proxy = Proxy::new(&"stall=1,stall-ms=2,direction=to-host".parse().unwrap());
        [1, 0].into_iter().for_each(|byte| proxy.from_device(Symbol::of(byte), 0));
        assert!(proxy.is_empty_to_device() && !proxy.is_empty());
        assert_eq!((proxy.next_to_host(0), proxy.is_empty()), (None, false));
        assert_eq!([2_000_000; 3].map(|now| proxy.next_to_host(now)), [Some(1), Some(0), None]);
        assert!(proxy.is_empty());
    }
}
