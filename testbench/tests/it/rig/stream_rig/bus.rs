//! The AXI side of a stream link: a host that stalls at random on all channels, and checks that the
//! device keeps the rules of AXI.

use std::collections::VecDeque;

use incircle_testkit::SplitMix64;

use super::Pins;

/// Clocks of the bus that a register access may take.
const REGISTER_PATIENCE: usize = 2000;

/// An access to a register.
#[derive(Clone, Copy, Debug, Default)]
pub struct Access {
    pub offset: u32,
    /// For a write, the value and a mask of its bytes.
    pub write: Option<(u32, u32)>,
    is_address_taken: bool,
    is_data_taken: bool,
    offers_address: bool,
    offers_data: bool,
    for_clocks: usize,
}

/// Offers of the device at an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Offers {
    answer: Option<(u128, bool)>,
    b: Option<u128>,
    r: Option<(u128, u128)>,
}

/// The host's side of the AXI ports.
pub struct Bus {
    /// Bytes of a beat.
    pub beat_bytes: usize,
    /// The streams and the registers' channels go on in one clock out of this many.
    pub pace: u64,
    /// The host takes no answer.
    pub is_deaf: bool,
    pub reset: bool,
    random: SplitMix64,
    to_send: VecDeque<(u128, u128)>,
    offered: Option<(u128, u128)>,
    is_ready: bool,
    takes_response: bool,
    /// Beats of answers that came, each with a mark on the last beat of its answer.
    pub came: Vec<(u128, bool)>,
    pub access: Option<Access>,
    /// Value and response of the last access.
    pub result: Option<(u32, u32)>,
    before: Option<(Offers, bool, bool)>,
    /// Clock in which the last reset by the control register was answered.
    reset_at: Option<u64>,
    /// Counts since the last `bus_reset_n`: edges here; in `counted`, command beats and answer beats taken,
    /// answers, and clocks that either waited.
    pub clocks: u64,
    pub counted: [u32; 5],
}

impl Bus {
    pub fn new(beat_bits: usize, seed: u64) -> Self {
        Self {
            beat_bytes: beat_bits / 8,
            pace: 1,
            is_deaf: false,
            reset: true,
            random: SplitMix64::new(seed),
            to_send: VecDeque::new(),
            offered: None,
            is_ready: false,
            takes_response: false,
            came: Vec::new(),
            access: None,
            result: None,
            before: None,
            reset_at: None,
            clocks: 0,
            counted: [0; 5],
        }
    }

    /// Queues words for the command stream, padded up to whole beats.
    pub fn send(&mut self, words: &[u32]) {
        let all_bytes = (1 << self.beat_bytes) - 1;
        for beat in words.chunks(self.beat_bytes / 4) {
            let data = beat.iter().rev().fold(0, |data, word| data << 32 | u128::from(*word));
            self.to_send.push_back((data, all_bytes));
        }
    }

    /// Queues a beat that lacks bytes.
    pub fn send_partial(&mut self, keep: u128) {
        self.to_send.push_back((u128::MAX >> (128 - 8 * self.beat_bytes), keep));
    }

    /// Number of beats that the device has not taken.
    pub fn unsent(&self) -> usize {
        self.to_send.len() + usize::from(self.offered.is_some())
    }

    /// Drops everything that was still to be sent.
    pub fn drop_unsent(&mut self) {
        self.to_send.clear();
    }

    pub fn begin(&mut self, offset: u32, write: Option<(u32, u32)>) {
        assert!(self.access.is_none(), "one access at a time");
        self.result = None;
        self.access = Some(Access { offset, write, ..Access::default() });
    }

    /// Reads the outputs, and checks that none of them depends on a `ready` within the clock.
    fn offers(&self, pins: &mut impl Pins) -> Offers {
        let look = |pins: &mut dyn FnMut(&'static str) -> u128| Offers {
            answer: (pins("m_axis_tvalid") == 1).then(|| (pins("m_axis_tdata"), pins("m_axis_tlast") == 1)),
            b: (pins("s_axi_bvalid") == 1).then(|| pins("s_axi_bresp")),
            r: (pins("s_axi_rvalid") == 1).then(|| (pins("s_axi_rdata"), pins("s_axi_rresp"))),
        };
        let offers = look(&mut |port| pins.get(port));
        for flip in [true, false] {
            pins.set("m_axis_tready", (self.is_ready ^ flip).into());
            pins.set("s_axi_bready", (self.takes_response ^ flip).into());
            pins.set("s_axi_rready", (self.takes_response ^ flip).into());
            pins.settle();
            assert_eq!(look(&mut |port| pins.get(port)), offers, "an offer depends on a ready");
        }
        offers
    }

    /// Prepares for an edge of the bus's clock: notes what passes at it, and checks the rules.
    pub fn before_edge(&mut self, pins: &mut impl Pins) {
        if self.reset {
            // Nothing is defined before the first reset.
            self.before = None;
            return;
        }
        let offers = self.offers(pins);
        if let Some((before, was_ready, took_response)) = self.before {
            let is_reset = pins.get("m_axis_tvalid") == 0 && self.may_withdraw();
            assert!(
                before.answer.is_none() || was_ready || before.answer == offers.answer || is_reset,
                "an answer moved"
            );
            assert!(before.b.is_none() || took_response || before.b == offers.b, "the answer to a write moved");
            assert!(before.r.is_none() || took_response || before.r == offers.r, "the answer to a read moved");
        }
        self.before = Some((offers, self.is_ready, self.takes_response));
        self.clocks += 1;
        if self.offered.is_some() {
            let is_taken = pins.get("s_axis_tready") == 1;
            self.counted[if is_taken { 0 } else { 3 }] += 1;
            if is_taken {
                self.offered = None;
            }
        }
        if let Some((data, is_last)) = offers.answer {
            if self.is_ready {
                assert_eq!(pins.get("m_axis_tkeep"), (1 << self.beat_bytes) - 1);
                self.came.push((data, is_last));
                self.counted[1] += 1;
                self.counted[2] += u32::from(is_last);
            } else {
                self.counted[4] += 1;
            }
        }
        self.go_on_with_access(pins, offers);
    }

    /// True shortly after a reset was written to the control register.
    fn may_withdraw(&self) -> bool {
        let is_reset = |access: &Access| access.offset == 0x40 && access.write.is_some();
        self.access.as_ref().is_some_and(is_reset) || self.reset_at.is_some_and(|at| self.clocks - at < 3)
    }

    fn go_on_with_access(&mut self, pins: &mut impl Pins, offers: Offers) {
        let Some(access) = &mut self.access else {
            assert!(offers.b.is_none() && offers.r.is_none(), "an answer without a request");
            return;
        };
        access.for_clocks += 1;
        assert!(access.for_clocks < REGISTER_PATIENCE, "no answer to {access:?}");
        let (address_ready, data_ready) = match access.write {
            Some(_) => (pins.get("s_axi_awready") == 1, pins.get("s_axi_wready") == 1),
            None => (pins.get("s_axi_arready") == 1, true),
        };
        access.is_address_taken |= access.offers_address && address_ready;
        access.is_data_taken |= access.offers_data && data_ready;
        let answer = match access.write {
            Some(_) => offers.b.map(|response| (0, response as u32)),
            None => offers.r.map(|(value, response)| (value as u32, response as u32)),
        };
        if let Some(answer) = answer {
            assert!(
                access.is_address_taken && (access.write.is_none() || access.is_data_taken),
                "the answer comes too early"
            );
            if self.takes_response {
                let is_reset = access.offset == 0x40 && access.write.is_some();
                self.reset_at = is_reset.then_some(self.clocks).or(self.reset_at);
                self.result = Some(answer);
                self.access = None;
            }
        }
    }

    /// Sets new inputs after an edge.
    pub fn after_edge(&mut self, pins: &mut impl Pins) {
        if self.reset {
            self.offered = None;
            self.access = None;
            (self.clocks, self.counted, self.reset_at) = (0, [0; 5], None);
        }
        if !self.reset && self.offered.is_none() && self.random.below(self.pace) == 0 {
            self.offered = self.to_send.pop_front();
        }
        self.is_ready = !self.is_deaf && self.random.below(self.pace) == 0;
        self.takes_response = self.random.below(self.pace) == 0;
        let (begins_address, begins_data) = (self.random.below(self.pace) == 0, self.random.below(self.pace) == 0);
        let access = self.access.as_mut().map(|access| {
            access.offers_address = !access.is_address_taken && (access.offers_address || begins_address);
            access.offers_data = access.write.is_some() && !access.is_data_taken && (access.offers_data || begins_data);
            *access
        });
        let access = access.unwrap_or_default();
        let writes = access.write.is_some();
        let (data, bytes) = access.write.unwrap_or((0, 0));
        let (beat, keep) = self.offered.unwrap_or((self.random.next_u64().into(), 0));
        for (port, value) in [
            ("bus_reset_n", u128::from(!self.reset)),
            ("s_axis_tvalid", self.offered.is_some().into()),
            ("s_axis_tdata", beat),
            ("s_axis_tkeep", keep),
            ("m_axis_tready", self.is_ready.into()),
            ("s_axi_awvalid", (writes && access.offers_address).into()),
            ("s_axi_awaddr", access.offset.into()),
            ("s_axi_wvalid", access.offers_data.into()),
            ("s_axi_wdata", data.into()),
            ("s_axi_wstrb", bytes.into()),
            ("s_axi_bready", self.takes_response.into()),
            ("s_axi_arvalid", (!writes && access.offers_address).into()),
            ("s_axi_araddr", access.offset.into()),
            ("s_axi_rready", self.takes_response.into()),
        ] {
            pins.set(port, value);
        }
    }
}
