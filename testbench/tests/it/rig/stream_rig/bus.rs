//! The AXI side of a stream link: a host that stalls at random on all channels, and holds the device to the rules of AXI.

use std::collections::VecDeque;

use incircle_testkit::SplitMix64;

use super::Pins;

/// Bus clocks that a register access may take.
const REGISTER_PATIENCE: usize = 2000;

/// An access to a register.
#[derive(Clone, Copy, Debug, Default)]
pub struct Access {
    pub offset: u32,
    /// What to write, and which bytes of it.
    pub write: Option<(u32, u32)>,
    is_address_taken: bool,
    is_data_taken: bool,
    offers_address: bool,
    offers_data: bool,
    for_clocks: usize,
}

/// What a bus shows at an edge.
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
    /// Of so many clocks one goes on, on the streams and on the registers' channels.
    pub pace: u64,
    /// No answer is taken.
    pub is_deaf: bool,
    pub reset: bool,
    random: SplitMix64,
    to_send: VecDeque<(u128, u128)>,
    offered: Option<(u128, u128)>,
    is_ready: bool,
    takes_response: bool,
    /// Beats of answers that came, and whether each was its answer's last.
    pub came: Vec<(u128, bool)>,
    pub access: Option<Access>,
    /// Value and response of the last access.
    pub result: Option<(u32, u32)>,
    before: Option<(Offers, bool, bool)>,
    /// When a reset by the control register was answered last.
    reset_at: Option<u64>,
    /// Edges, command beats and answer beats taken, answers, clocks either waited: since the last `bus_reset_n`.
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

    /// Words for the command stream, with padding up to whole beats.
    pub fn send(&mut self, words: &[u32]) {
        let all_bytes = (1 << self.beat_bytes) - 1;
        for beat in words.chunks(self.beat_bytes / 4) {
            let data = beat.iter().rev().fold(0, |data, word| data << 32 | u128::from(*word));
            self.to_send.push_back((data, all_bytes));
        }
    }

    /// A beat that lacks bytes.
    pub fn send_partial(&mut self, keep: u128) {
        self.to_send.push_back((u128::MAX >> (128 - 8 * self.beat_bytes), keep));
    }

    /// Beats that the device has not taken.
    pub fn unsent(&self) -> usize {
        self.to_send.len() + usize::from(self.offered.is_some())
    }

    /// Nothing more of what was to be sent.
    pub fn drop_unsent(&mut self) {
        self.to_send.clear();
    }

    pub fn begin(&mut self, offset: u32, write: Option<(u32, u32)>) {
        assert!(self.access.is_none(), "one access at a time");
        self.result = None;
        self.access = Some(Access { offset, write, ..Access::default() });
    }

    /// Looks at the outputs, and that none depends on a `ready` within the clock.
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
            assert_eq!(look(&mut |port| pins.get(port)), offers, "an offer that follows a ready");
        }
        offers
    }

    /// An edge of the bus's clock is about to come: what passes at it, and the rules.
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

    /// A reset by the control register was written lately.
    fn may_withdraw(&self) -> bool {
        let is_reset = |access: &Access| access.offset == 0x40 && access.write.is_some();
        self.access.as_ref().is_some_and(is_reset) || self.reset_at.is_some_and(|at| self.clocks - at < 3)
    }

    fn go_on_with_access(&mut self, pins: &mut impl Pins, offers: Offers) {
        let Some(access) = &mut self.access else {
            assert!(offers.b.is_none() && offers.r.is_none(), "an answer to nothing");
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
            assert!(access.is_address_taken && (access.write.is_none() || access.is_data_taken), "an answer too early");
            if self.takes_response {
                let is_reset = access.offset == 0x40 && access.write.is_some();
                self.reset_at = is_reset.then_some(self.clocks).or(self.reset_at);
                self.result = Some(answer);
                self.access = None;
            }
        }
    }

    /// An edge has come: new inputs.
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
