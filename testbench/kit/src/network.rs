//! A network that loses, doubles, swaps, delays and damages datagrams, in virtual or real time.

use std::collections::BTreeMap;

use crate::random::SplitMix64;

/// Nanoseconds that a swapped datagram comes late, so that others overtake it.
const SWAP_NS: u64 = 50_000;
/// One datagram in so many is delayed, if there are delays.
const DELAYED: u64 = 16;
/// Bytes on the wire besides the datagram: the headers of UDP, IPv4 and Ethernet, preamble, check sum and gap.
const FRAME_BYTES: u64 = 66;
/// Nanoseconds of a byte at a gigabit.
const BYTE_NS: u64 = 8;

/// Faults of a network. Chances are from 0 to 1, for each datagram and each direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkFaults {
    /// Chance that a datagram is lost.
    pub loss: f64,
    /// Chance that it comes twice.
    pub double: f64,
    /// Chance that it comes 50 µs late, behind others.
    pub swap: f64,
    /// Most milliseconds by which a datagram is late. One in 16 is.
    pub delay_ms: u64,
    /// Chance that a bit of it is turned.
    pub flip: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl std::str::FromStr for NetworkFaults {
    type Err = String;

    /// Parses faults such as `loss=0.01,delay=20,seed=3`.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut faults = Self::default();
        for item in text.split(',').filter(|item| !item.is_empty()) {
            let (key, value) = item.split_once('=').unwrap_or((item, ""));
            let chance = || {
                let parsed = value.parse().ok().filter(|chance: &f64| (0.0..=1.0).contains(chance));
                parsed.ok_or_else(|| format!("\"{key}\" must be a chance from 0 to 1, not \"{value}\""))
            };
            let number = |most: u64| {
                let parsed = value.parse().ok().filter(|&number: &u64| number <= most);
                parsed.ok_or_else(|| format!("\"{key}\" must be a whole number from 0 to {most}, not \"{value}\""))
            };
            match key {
                "loss" => faults.loss = chance()?,
                "double" => faults.double = chance()?,
                "swap" => faults.swap = chance()?,
                "flip" => faults.flip = chance()?,
                "delay" => faults.delay_ms = number(10_000)?,
                "seed" => faults.seed = number(u64::MAX)?,
                _ => {
                    return Err(format!(
                        "\"{key}\" is no fault of a network: there are loss, double, swap, delay, flip and seed"
                    ))
                }
            }
        }
        Ok(faults)
    }
}

/// One direction of a network at a gigabit. All times are in nanoseconds.
#[derive(Clone, Debug)]
pub struct Network<A> {
    faults: NetworkFaults,
    random: SplitMix64,
    latency: u64,
    /// Datagrams on their way, by time of arrival and number, with their addresses.
    on_the_way: BTreeMap<(u64, u64), (A, Vec<u8>)>,
    /// Number of datagrams that were put on their way.
    count: u64,
    /// Time at which the wire is free.
    free_at: u64,
    met: u64,
}

impl<A: Clone> Network<A> {
    /// A network with these faults that takes `latency` besides the time on the wire. `direction` gives two directions
    /// different random numbers.
    pub fn new(faults: &NetworkFaults, latency: u64, direction: u64) -> Self {
        Self {
            random: SplitMix64::new(faults.seed.wrapping_mul(2).wrapping_add(direction)),
            faults: faults.clone(),
            latency,
            on_the_way: BTreeMap::new(),
            count: 0,
            free_at: 0,
            met: 0,
        }
    }

    /// Number of faults so far.
    pub fn met(&self) -> u64 {
        self.met
    }

    /// Time at which the wire is free for the next datagram.
    pub fn free_at(&self) -> u64 {
        self.free_at
    }

    /// Sends a datagram.
    pub fn send(&mut self, now: u64, address: A, datagram: &[u8]) {
        self.free_at = self.free_at.max(now) + (datagram.len() as u64 + FRAME_BYTES) * BYTE_NS;
        if self.happens(self.faults.loss) {
            return;
        }
        let copies = 1 + u32::from(self.happens(self.faults.double));
        for _ in 0..copies {
            let mut bytes = datagram.to_vec();
            if self.happens(self.faults.flip) {
                let bit = self.random.next_u64() % (8 * bytes.len().max(1) as u64);
                if let Some(byte) = bytes.get_mut(bit as usize / 8) {
                    *byte ^= 1 << (bit % 8);
                }
            }
            let mut arrives = self.free_at + self.latency;
            if self.happens(self.faults.swap) {
                arrives += SWAP_NS;
            }
            if self.faults.delay_ms > 0 && self.random.next_u64().is_multiple_of(DELAYED) {
                self.met += 1;
                arrives += self.random.next_u64() % (self.faults.delay_ms * 1_000_000 + 1);
            }
            self.count += 1;
            self.on_the_way.insert((arrives, self.count), (address.clone(), bytes));
        }
    }

    fn happens(&mut self, chance: f64) -> bool {
        let happens = chance > 0.0 && (self.random.next_u64() >> 11) as f64 / (1u64 << 53) as f64 <= chance;
        self.met += u64::from(happens);
        happens
    }

    /// Time at which the next datagram arrives.
    pub fn next_at(&self) -> Option<u64> {
        self.on_the_way.first_key_value().map(|((at, _), _)| *at)
    }

    /// The next datagram that has arrived, with its address.
    pub fn next(&mut self, now: u64) -> Option<(A, Vec<u8>)> {
        let (at, number) = *self.on_the_way.first_key_value()?.0;
        if at > now {
            return None;
        }
        self.on_the_way.remove(&(at, number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_parsed() {
        let all = "loss=0.1,double=0.2,swap=0.3,delay=4,flip=0.5,seed=6".parse();
        let expected = NetworkFaults { loss: 0.1, double: 0.2, swap: 0.3, delay_ms: 4, flip: 0.5, seed: 6 };
        assert_eq!(all, Ok(expected));
        assert_eq!("".parse(), Ok(NetworkFaults::default()));
        for bad in ["loss=2", "loss", "delay=-1", "jitter=1", "loss=nan"] {
            assert!(bad.parse::<NetworkFaults>().is_err(), "{bad}");
        }
    }

    #[test]
    fn each_fault_happens_as_often_as_it_should() {
        let faults = NetworkFaults { loss: 0.25, double: 0.5, ..NetworkFaults::default() };
        let mut network = Network::new(&faults, 1000, 0);
        for number in 0..10_000_u32 {
            network.send(0, (), &number.to_le_bytes());
        }
        let came = std::iter::from_fn(|| network.next(u64::MAX)).count();
        assert!((11_000..11_500).contains(&came), "{came}");
    }

    #[test]
    fn a_datagram_takes_its_time() {
        let mut network = Network::new(&NetworkFaults::default(), 1000, 0);
        network.send(5, 'a', &[7; 59]);
        assert_eq!(network.next_at(), Some(5 + 125 * 8 + 1000));
        assert_eq!(network.next(2004), None);
        assert_eq!(network.next(2005), Some(('a', vec![7; 59])));
    }
}
