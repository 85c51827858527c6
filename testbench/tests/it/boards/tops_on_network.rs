//! Runs the tops of the boards with an Ethernet port in simulation, with a tiny device behind them: the PHY and the
//! device leave their resets in order, and a question at the pins of RGMII is answered there.

use incircle_hdl::board::BOARDS;
use incircle_testbench::blocks;
use verilated::{Model, PortId};

/// Clocks of the board until its reset has surely ended, and clocks for which the PHY is held in reset then.
const STARTED: usize = 100 + 2 + 255 + 2;
const PHY_WAIT: usize = 1 << 6;
/// Clocks of the PHY until the values with which the registers at the pins woke up have left them.
const WAKING: usize = 4;

/// The addresses of the device in `build/boards.rs`, and those of a host.
const DEVICE: ([u8; 6], [u8; 4]) = (incircle_blocks::QUICK_UDP_LINK.mac, [10, 0, 7, 2]);
const HOST: ([u8; 6], [u8; 4]) = ([0x02, 1, 2, 3, 4, 5], [10, 0, 7, 9]);

/// A board, with a PHY that gives its clock or not.
struct Bench {
    model: Model,
    clocks: [PortId; 2],
    receive: [PortId; 2],
    send: [PortId; 2],
    phy_reset_n: PortId,
    phy_gives_clock: bool,
    /// The bytes that the board sent, with a gap as `None`.
    sent: Vec<Option<u8>>,
}

impl Bench {
    fn new(top: &str) -> Self {
        let model = blocks::randomized(&format!("board_{top}_udp"), 1);
        let port = |name: &str| model.port(name).unwrap_or_else(|error| panic!("{error}"));
        let [clocks, receive, send] =
            [["clock", "phy_clock"], ["rx_ctl", "rxd"], ["tx_ctl", "txd"]].map(|pair| pair.map(port));
        let phy_reset_n = port("phy_reset_n");
        Self { model, clocks, receive, send, phy_reset_n, phy_gives_clock: true, sent: Vec::new() }
    }

    /// Sets a clock, if it runs, and lets the board settle.
    fn level(&mut self, clock: usize, level: u64) {
        if clock == 0 || self.phy_gives_clock {
            self.model.set(self.clocks[clock], level);
            self.model.eval();
        }
    }

    /// Puts half a byte on the pins before an edge of the PHY, and returns the half that the board shows behind it.
    fn half(&mut self, bits: Option<u64>, level: u64) -> Option<u8> {
        self.model.set(self.receive[0], u64::from(bits.is_some()));
        self.model.set(self.receive[1], bits.unwrap_or(0));
        self.level(1, level);
        (self.model.get(self.send[0]) == 1).then(|| self.model.get(self.send[1]) as u8)
    }

    /// One period of both clocks.
    fn period(&mut self, byte: Option<u8>) {
        let halves = byte.map(|byte| (u64::from(byte & 15), u64::from(byte >> 4)));
        let low = self.half(halves.map(|halves| halves.0), 1);
        self.level(0, 1);
        let high = self.half(halves.map(|halves| halves.1), 0);
        self.level(0, 0);
        self.sent.push(low.zip(high).map(|(low, high)| low | high << 4));
    }

    /// Sends a frame, waits, and returns the frame that the board sent, without preamble and check sum.
    fn ask(&mut self, frame: &[u8]) -> Vec<u8> {
        self.sent.clear();
        let begin = [[0x55; 7].as_slice(), &[0xd5]].concat();
        let sum = incircle_model::serial::Crc32::of(frame).to_le_bytes();
        for byte in [&begin, frame, &sum].concat() {
            self.period(Some(byte));
        }
        (0..400).for_each(|_| self.period(None));
        let bytes: Vec<u8> = self.sent.iter().copied().flatten().collect();
        let Some(sent) = bytes.strip_prefix(begin.as_slice()) else { return bytes };
        let (frame, sum) = sent.split_at(sent.len().saturating_sub(4));
        assert_eq!(sum, incircle_model::serial::Crc32::of(frame).to_le_bytes());
        frame.to_vec()
    }
}

/// A message of ARP, with the operation, sender and target, in a frame of 60 bytes.
fn arp(to: [u8; 6], operation: u8, sender: ([u8; 6], [u8; 4]), target: ([u8; 6], [u8; 4])) -> Vec<u8> {
    let head = [0x08, 0x06, 0, 1, 8, 0, 6, 4, 0, operation];
    let mut frame = [&to[..], &sender.0, &head, &sender.0, &sender.1, &target.0, &target.1].concat();
    frame.resize(60, 0);
    frame
}

#[test]
fn every_ethernet_port_answers_who_has_its_address() {
    for board in BOARDS.iter().filter(|board| board.ethernet.is_some()) {
        let mut bench = Bench::new(board.top);
        let question = arp([0xff; 6], 1, HOST, ([0; 6], DEVICE.1));
        (0..WAKING).for_each(|_| bench.period(None));
        assert_eq!(bench.ask(&question), Vec::<u8>::new(), "{}: an answer during the reset", board.name);
        (0..STARTED + PHY_WAIT + 100).for_each(|_| bench.period(None));
        assert_eq!(bench.ask(&question), arp(HOST.0, 2, DEVICE, HOST), "{}", board.name);
    }
}

#[test]
fn the_device_waits_for_the_phy_and_its_clock() {
    for board in BOARDS.iter().filter(|board| board.ethernet.is_some()) {
        let mut bench = Bench::new(board.top);
        bench.phy_gives_clock = false;
        let mut levels = Vec::new();
        for _ in 0..STARTED + PHY_WAIT + 10 {
            bench.period(None);
            levels.push(bench.model.get(bench.phy_reset_n) == 1);
        }
        let rises = levels.iter().position(|level| *level).expect("the PHY leaves its reset");
        assert!((PHY_WAIT + 255..=STARTED + PHY_WAIT).contains(&rises), "{}: {rises}", board.name);
        assert!(levels[rises..].iter().all(|level| *level), "{}", board.name);
        // Without the clock of the PHY the device stays in reset; with it the device answers soon.
        (0..1000).for_each(|_| bench.period(None));
        bench.phy_gives_clock = true;
        (0..WAKING).for_each(|_| bench.period(None));
        let question = arp([0xff; 6], 1, HOST, ([0; 6], DEVICE.1));
        assert_eq!(bench.ask(&question[..8]), Vec::<u8>::new(), "{}: an answer during the reset", board.name);
        assert_eq!(bench.ask(&question), arp(HOST.0, 2, DEVICE, HOST), "{}", board.name);
    }
}
