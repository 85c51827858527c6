//! Runs `UdpLink` between datagrams and a stand-in for a core, beside the software model of the link: what both say to
//! the same datagrams must be the same, but for the free bytes and the bit that says that a command is under way, which
//! depend on the clock. The Verilog runs beside the Rust form for some datagrams, and alone for many.

use std::collections::VecDeque;
use std::net::{Ipv4Addr, SocketAddrV4};

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use crate::rig::stream_rig::{Pins, Verilog};
use incircle_blocks::QUICK_UDP_LINK;
use incircle_hdl::udp::UdpLink;
use incircle_model::serial::{core_identity, Instantly, WordDevice};
use incircle_model::udp::{ToDevice, ToHost, UdpModel};
use incircle_protocol::{clear_word, command_word, DeviceDatagram, HostDatagram, Opcode, SMALL, STATUS_BUSY};
use incircle_testkit::SplitMix64;

named_ports!(
    UdpLink,
    [
        clock,
        reset,
        entry_valid,
        entry,
        byte_ready,
        command.ready,
        response.valid,
        response.data,
        response.both,
        response.last,
        device_busy
    ],
    [
        entry_pop,
        byte_valid,
        byte_data,
        byte_is_last,
        byte_drops,
        lamps,
        core_reset,
        command.valid,
        command.data,
        response.ready
    ]
);

/// Clocks in which nothing moves, after which nothing will.
const STILL: usize = 300;
const SESSION: u64 = 0x1122_3344_5566_7788;

/// The model by commands behind the two streams of a core. Answers wait whole, each as its words.
struct StandIn {
    device: Instantly,
    answers: VecDeque<VecDeque<u32>>,
    offers: bool,
}

impl StandIn {
    fn new() -> Self {
        Self { device: Instantly::of(SMALL).unwrap(), answers: VecDeque::new(), offers: false }
    }

    fn reset(&mut self) {
        self.device.reset();
        self.answers.clear();
        self.offers = false;
    }

    /// The beat on offer: its words, and whether it ends an answer.
    fn beat(&self) -> Option<(Vec<u32>, bool)> {
        let answer = self.answers.front().filter(|_| self.offers)?;
        let count = if answer.len().is_multiple_of(3) { 1 } else { answer.len().min(2) };
        Some((answer.iter().take(count).copied().collect(), count == answer.len()))
    }

    fn take_beat(&mut self, words: usize) {
        let answer = self.answers.front_mut().expect("an answer");
        answer.drain(..words);
        if answer.is_empty() {
            self.answers.pop_front();
        }
        self.offers = false;
    }

    fn command(&mut self, word: u32) {
        self.device.step(Some(word), false);
        let mut words = std::iter::from_fn(|| self.device.step(None, true).answer[0]);
        while let Some(header) = words.next() {
            let length = words.next().expect("a length");
            self.answers.push_back([header, length].into_iter().chain(words.by_ref().take(length as usize)).collect());
        }
    }
}

/// A link between hosts and a core.
struct Rig<P> {
    pins: P,
    core: StandIn,
    random: SplitMix64,
    entries: VecDeque<u16>,
    /// The port is ready for a datagram, and the clocks until it is again.
    is_ready: bool,
    busy_for: u64,
    coming: Vec<u8>,
    sent: Vec<Vec<u8>>,
    dropped: usize,
    clocks: usize,
}

impl<P: Pins> Rig<P> {
    fn new(mut pins: P, seed: u64) -> Self {
        for port in ["clock", "entry_valid", "entry", "byte_ready", "command_ready", "response_valid", "device_busy"] {
            pins.set(port, 0);
        }
        for port in ["response_data", "response_both", "response_last"] {
            pins.set(port, 0);
        }
        pins.set("reset", 1);
        let mut rig = Self {
            pins,
            core: StandIn::new(),
            random: SplitMix64::new(seed),
            entries: VecDeque::new(),
            is_ready: true,
            busy_for: 0,
            coming: Vec::new(),
            sent: Vec::new(),
            dropped: 0,
            clocks: 0,
        };
        for _ in 0..4 {
            rig.edge();
        }
        rig.pins.set("reset", 0);
        rig.clocks = 0;
        rig
    }

    fn edge(&mut self) {
        for level in [1, 0] {
            self.pins.set("clock", level);
            self.pins.settle();
        }
        self.clocks += 1;
    }

    /// Passes a clock, and returns whether anything moved in it.
    fn clock(&mut self) -> bool {
        let offers = !self.entries.is_empty() && self.random.below(8) > 0;
        self.pins.set("entry_valid", offers.into());
        self.pins.set("entry", self.entries.front().copied().unwrap_or(0x1ff).into());
        self.pins.set("byte_ready", self.is_ready.into());
        self.core.offers |= !self.core.answers.is_empty() && self.random.below(4) > 0;
        let beat = self.core.beat();
        let takes = self.core.answers.is_empty() && self.random.below(4) > 0;
        self.pins.set("command_ready", takes.into());
        self.pins.set("response_valid", beat.is_some().into());
        let (words, is_last) = beat.clone().unwrap_or_default();
        let data = words.iter().rev().fold(0, |data, word| data << 32 | u128::from(*word));
        self.pins.set("response_data", data);
        self.pins.set("response_both", (words.len() == 2).into());
        self.pins.set("response_last", is_last.into());
        self.pins.settle();
        let is_reset = self.pins.get("core_reset") == 1;
        let command = (takes && self.pins.get("command_valid") == 1).then(|| self.pins.get("command_data") as u32);
        let is_taken = beat.is_some() && self.pins.get("response_ready") == 1;
        let pops = offers && self.pins.get("entry_pop") == 1;
        let sends = self.watch_bytes();
        self.edge();
        if pops {
            self.entries.pop_front();
        }
        if is_reset {
            self.core.reset();
            return pops || sends;
        }
        if is_taken {
            self.core.take_beat(words.len());
        }
        command.into_iter().for_each(|word| self.core.command(word));
        pops || sends || is_taken || command.is_some()
    }

    /// Passes this many clocks.
    fn pass(&mut self, clocks: usize) {
        for _ in 0..clocks {
            self.clock();
        }
    }

    /// Takes the byte that goes out. The port is ready for a whole datagram, or for none.
    fn watch_bytes(&mut self) -> bool {
        self.busy_for = self.busy_for.saturating_sub(1);
        let was_ready = self.is_ready;
        self.is_ready |= self.busy_for == 0;
        if self.pins.get("byte_drops") == 1 {
            assert_eq!(self.pins.get("byte_valid"), 0, "a byte of a datagram that is dropped");
            self.dropped += usize::from(!self.coming.is_empty());
            self.coming.clear();
        }
        if self.pins.get("byte_valid") == 0 {
            return false;
        }
        assert!(was_ready, "a byte for which the port has no room");
        self.coming.push(self.pins.get("byte_data") as u8);
        if self.pins.get("byte_is_last") == 1 {
            self.sent.push(std::mem::take(&mut self.coming));
            self.busy_for = self.random.below(60);
            self.is_ready = self.busy_for == 0;
        }
        true
    }

    fn put(&mut self, sender: &[u8], datagram: &[u8], end: u16) {
        self.entries.extend(sender.iter().chain(datagram).map(|byte| u16::from(*byte)));
        self.entries.push_back(0x100 | end);
    }

    /// Runs until nothing moves any more, and returns what was sent.
    fn rest(&mut self) -> Vec<Vec<u8>> {
        let mut still = 0;
        while still < STILL {
            still = if self.clock() || !self.is_ready { 0 } else { still + 1 };
        }
        assert!(self.coming.is_empty(), "a datagram without an end");
        std::mem::take(&mut self.sent)
    }
}

fn host(last: u8) -> SocketAddrV4 {
    SocketAddrV4::new(Ipv4Addr::new(192, 168, 1, last), 50_000)
}

/// The addresses before a datagram.
fn addresses(host: SocketAddrV4) -> Vec<u8> {
    let [a, b, c, d] = host.ip().octets();
    let [high, low] = host.port().to_be_bytes();
    vec![2, 0x68, a ^ b, b, c, d, a, b, c, d, high, low]
}

/// A datagram without the fields that depend on the clock.
fn timeless(bytes: &[u8]) -> ToHost {
    let mut said = ToHost::from_bytes(bytes).expect("a sound datagram");
    said.header.free = 0;
    said.header.status &= !STATUS_BUSY;
    said
}

/// The link and its model, which get the same datagrams.
struct Both<P> {
    rig: Rig<P>,
    model: UdpModel<Instantly>,
    /// Number of the `Data` datagram that is awaited.
    expected: u32,
}

impl<P: Pins> Both<P> {
    fn new(pins: P, seed: u64) -> Self {
        let core = Instantly::of(SMALL).unwrap();
        let model = UdpModel::new(QUICK_UDP_LINK, core_identity(SMALL), core);
        Self { rig: Rig::new(pins, seed), model, expected: 0 }
    }

    /// Gives a datagram to both, and returns what both say.
    fn ask(&mut self, from: SocketAddrV4, end: u16, bytes: &[u8]) -> Vec<ToHost> {
        self.rig.put(&addresses(from), bytes, end);
        let said = self.rig.rest();
        if end & 1 == 1 {
            self.model.take(from, end & 2 != 0, bytes);
        }
        let mut expected = Vec::new();
        loop {
            self.model.work(5000);
            let Some((to, datagram)) = self.model.give() else { break };
            expected.push((addresses(to), timeless(&datagram)));
        }
        let said: Vec<_> = said.into_iter().map(|bytes| (bytes[..12].to_vec(), timeless(&bytes[12..]))).collect();
        for (place, (said, expected)) in said.iter().zip(&expected).enumerate() {
            assert_eq!(said, expected, "datagram {place} to {:x?} from {from}", &bytes[..bytes.len().min(40)]);
        }
        assert_eq!(said.len(), expected.len(), "datagrams to {:x?} from {from}", &bytes[..bytes.len().min(40)]);
        self.expected = said.last().map_or(self.expected, |(_, said)| said.header.expected);
        said.into_iter().map(|(_, said)| said).collect()
    }

    fn tell(&mut self, kind: HostDatagram, number: u32, words: &[u32]) -> Vec<DeviceDatagram> {
        let datagram = ToDevice { session: SESSION, kind, number, words: words.to_vec() };
        self.ask(host(2), 1, &datagram.to_bytes()).iter().map(ToHost::kind).collect()
    }

    /// A datagram at random: most belong to the session, some to others, some are damaged.
    fn any(&mut self) {
        let random = &mut self.rig.random;
        let kind = [HostDatagram::Hello, HostDatagram::Open, HostDatagram::Poll, HostDatagram::Close]
            .into_iter()
            .chain([HostDatagram::Data; 5])
            .nth(random.below(9) as usize)
            .expect("a kind");
        let words = match (kind, random.below(6)) {
            (HostDatagram::Hello, _) => vec![0; 14],
            (HostDatagram::Data, 0) => vec![command_word(Opcode::Hello)],
            (HostDatagram::Data, 1) => vec![command_word(Opcode::Triangles), 0, random.below(30) as u32],
            (HostDatagram::Data, 2) => vec![random.next_u64() as u32 & 0x0f00_0003; 1 + random.below(360) as usize],
            (HostDatagram::Data, _) => {
                let count = 3 + random.below(300) as u32;
                let points = (0..count).map(|_| random.next_u64() as u32 & 0x00ff_00ff);
                [clear_word(0), command_word(Opcode::Insert), count].into_iter().chain(points).collect()
            }
            _ => Vec::new(),
        };
        let near = [0, 0, 0, 0, 1, u32::MAX, 256][random.below(7) as usize];
        let number = if kind == HostDatagram::Data { self.expected.wrapping_add(near) } else { 0 };
        let session = [SESSION, SESSION, SESSION, SESSION, SESSION, 5, 0][random.below(7) as usize];
        let from = host([2, 2, 2, 2, 3][random.below(5) as usize]);
        let mut bytes = ToDevice { session, kind, number, words }.to_bytes();
        match random.below(12) {
            0 => {
                let place = random.below(bytes.len() as u64) as usize;
                bytes[place] ^= 1 << random.below(8);
            }
            1 => bytes.truncate(1 + random.below(bytes.len() as u64 - 1) as usize),
            _ => {}
        }
        let end = [1, 1, 1, 1, 1, 1, 3, 0][random.below(8) as usize];
        self.ask(from, end, &bytes);
    }
}

/// A session in which the host does everything in order.
fn a_job_goes_through(mut both: Both<impl Pins>, points: usize) {
    assert_eq!(both.tell(HostDatagram::Hello, 0, &[0; 14]), [DeviceDatagram::Hello]);
    assert_eq!(both.tell(HostDatagram::Open, 0, &[]), [DeviceDatagram::Opened]);
    let set: Vec<u32> = (0..points as u32).map(|j| (j * 7 % 350) | ((j * j % 1021) << 16)).collect();
    let insert = [&[clear_word(0), command_word(Opcode::Insert), points as u32][..], &set].concat();
    let said = both.tell(HostDatagram::Data, 0, &insert);
    assert_eq!(said, [DeviceDatagram::Ack, DeviceDatagram::AnswerEnd, DeviceDatagram::AnswerEnd]);
    let count = 2 * points as u32 - 2;
    let said = both.tell(HostDatagram::Data, 1, &[command_word(Opcode::Triangles), 0, count]);
    let parts = (2 + count as usize * 3 / 2).div_ceil(360);
    assert_eq!(said.len(), 1 + parts, "{said:?}");
    assert_eq!(both.tell(HostDatagram::Poll, 0, &[]), [DeviceDatagram::Ack]);
    assert_eq!(both.tell(HostDatagram::Close, 0, &[]), [DeviceDatagram::Closed]);
}

#[test]
fn both_forms_say_what_the_model_says() {
    let link = UdpLink::new(SMALL, QUICK_UDP_LINK).expect("a link");
    a_job_goes_through(Both::new(Stepper::new("udp_link", link, 1), 1), 12);
    let link = UdpLink::new(SMALL, QUICK_UDP_LINK).expect("a link");
    let mut both = Both::new(Stepper::new("udp_link", link, 2), 2);
    (0..12).for_each(|_| both.any());
}

#[test]
fn the_verilog_carries_long_answers() {
    for seed in 0..3 {
        a_job_goes_through(Both::new(Verilog::new("udp_link", seed), seed.into()), 350);
    }
}

#[test]
fn the_verilog_says_what_the_model_says_to_any_datagram() {
    let mut sessions = 0;
    for seed in 0..6 {
        let mut both = Both::new(Verilog::new("udp_link", seed), seed.into());
        for turn in 0..150 {
            both.any();
            if turn % 4 == 0 {
                // The session must not end by silence, which the model counts apart from the link.
                both.tell(HostDatagram::Poll, 0, &[]);
            }
            sessions += usize::from(both.model.session().is_some());
        }
    }
    assert!(sessions > 300, "{sessions} turns in a session");
}

#[test]
fn silence_ends_the_session_and_its_answers() {
    let silence = (QUICK_UDP_LINK.clock_hz / 1000 * QUICK_UDP_LINK.silence_ms) as usize;
    let mut both = Both::new(Verilog::new("udp_link", 9), 9);
    both.tell(HostDatagram::Open, 0, &[]);
    for _ in 0..3 {
        both.rig.pass(silence * 3 / 4);
        assert_eq!(both.tell(HostDatagram::Poll, 0, &[]), [DeviceDatagram::Ack]);
    }
    both.rig.pass(silence + 1000);
    both.model.age(silence as u64);
    assert_eq!(both.tell(HostDatagram::Poll, 0, &[]), [DeviceDatagram::NoSession]);
    assert_eq!(both.tell(HostDatagram::Open, 0, &[]), [DeviceDatagram::Opened]);
    assert_eq!(both.tell(HostDatagram::Data, 0, &[command_word(Opcode::Hello)]).len(), 2);
}

#[test]
fn what_finds_no_room_is_refused_and_the_place_holds_one_answer() {
    let mut rig = Rig::new(Verilog::new("udp_link", 4), 4);
    let datagram =
        |kind, number, words: &[u32]| ToDevice { session: SESSION, kind, number, words: words.to_vec() }.to_bytes();
    // Two questions at once: the second one finds the place taken, and nothing is done.
    rig.put(&addresses(host(3)), &datagram(HostDatagram::Hello, 0, &[0; 14]), 1);
    rig.put(&addresses(host(2)), &datagram(HostDatagram::Open, 0, &[]), 1);
    rig.is_ready = false;
    rig.busy_for = 400;
    let said = rig.rest();
    assert_eq!(said.iter().map(|bytes| bytes[12]).collect::<Vec<_>>(), [0x81]);
    rig.put(&addresses(host(2)), &datagram(HostDatagram::Open, 0, &[]), 1);
    assert_eq!(rig.rest().len(), 1);
    // The core answers a command, and no datagram goes out: words stay in the FIFO.
    (rig.is_ready, rig.busy_for) = (false, 8000);
    let hellos = vec![command_word(Opcode::Hello); 300];
    for number in 0..3 {
        rig.put(&addresses(host(2)), &datagram(HostDatagram::Data, number, &hellos), 1);
    }
    let said: Vec<ToHost> = rig.rest().iter().map(|bytes| timeless(&bytes[12..])).collect();
    assert_eq!((said[0].kind(), said[0].header.expected), (DeviceDatagram::Nak, 1), "{:?}", said[0]);
    assert_eq!(said.len(), 1 + 300);
    rig.put(&addresses(host(2)), &datagram(HostDatagram::Data, 1, &hellos), 1);
    assert_eq!(rig.rest().len(), 1 + 300);
}

#[test]
fn a_session_that_ends_drops_the_datagram_under_way() {
    let mut rig = Rig::new(Verilog::new("udp_link", 5), 5);
    let datagram =
        |kind, number, words: &[u32]| ToDevice { session: SESSION, kind, number, words: words.to_vec() }.to_bytes();
    for _ in 0..30 {
        rig.put(&addresses(host(2)), &datagram(HostDatagram::Open, 0, &[]), 1);
        assert_eq!(rig.rest().len(), 1);
        let hellos = vec![command_word(Opcode::Hello); 40];
        rig.put(&addresses(host(2)), &datagram(HostDatagram::Data, 0, &hellos), 1);
        rig.put(&addresses(host(2)), &datagram(HostDatagram::Close, 0, &[]), 1);
        let said = rig.rest();
        let kinds: Vec<u8> = said.iter().map(|bytes| timeless(&bytes[12..]).header.kind as u8).collect();
        assert_eq!(kinds.last(), Some(&0x88), "{kinds:x?}");
        assert!(kinds.len() < 40);
    }
    assert!(rig.dropped > 0, "no datagram was under way");
}

#[test]
fn wave_of_an_open_and_its_answer() {
    let link = UdpLink::new(SMALL, QUICK_UDP_LINK).expect("a link");
    let mut rig = Rig::new(Stepper::new("udp_link", link, 3), 3);
    let open = ToDevice { session: SESSION, kind: HostDatagram::Open, number: 0, words: Vec::new() };
    let sender: Vec<u8> = (20..32).collect();
    let entries = [&sender[..], &open.to_bytes()].concat();
    let mut wave = Wave::default();
    let (mut sent, mut behind) = (0, 0);
    for place in 0.. {
        // An entry is there in every clock until the datagram has ended.
        let entry = entries.get(place).map(|byte| u16::from(*byte)).or((place == entries.len()).then_some(0x101));
        rig.pins.set("entry_valid", entry.is_some());
        rig.pins.set("entry", entry.unwrap_or(0));
        rig.pins.set("byte_ready", true);
        rig.pins.settle();
        let comes = rig.pins.is("byte_valid");
        sent += usize::from(comes);
        // The copying of the session, and most bytes of the answer, are left out.
        let column = (place + 2).checked_sub(entries.len()).filter(|column| !(11..39).contains(column));
        if column.is_some() && !(4..32).contains(&sent) {
            wave.take(&[
                ("entry_valid", Cell::Bit(entry.is_some())),
                ("entry[8]", entry.map_or(Cell::Open, |entry| Cell::Bit(entry >> 8 == 1))),
                ("core_reset", Cell::Bit(rig.pins.is("core_reset"))),
                ("byte_valid", Cell::Bit(comes)),
                ("byte_data", if comes && sent < 4 { Cell::Number(rig.pins.get("byte_data")) } else { Cell::Open }),
                ("byte_is_last", if comes { Cell::Bit(rig.pins.is("byte_is_last")) } else { Cell::Open }),
            ]);
        }
        behind += usize::from(sent == 32);
        if behind > 2 {
            break;
        }
        rig.edge();
    }
    wave.assert_drawn_in("udp_link");
}
