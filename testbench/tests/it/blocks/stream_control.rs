//! Resets and registers of the stream link: Rust, Verilog and plain code agree clock by clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::stream::{RegisterBlock, RegisterPort, ResetReply, ResetRequest};
use incircle_protocol::{
    StreamRegister, CORE_COORD_BITS, CORE_VERSION, ERROR_ANSWER_STATUS, ERROR_PARTIAL_BEAT, MAGIC, PROTOCOL_VERSION,
    SMALL, STREAM_FIFO_BEATS, STREAM_STATUS_BUSY, STREAM_STATUS_ERROR, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS,
    STREAM_VERSION,
};

named_ports!([] ResetRequest, [reset, asks, reply, core_beat], [request, resets, core_runs], clock);
named_ports!([] ResetReply, [request], [resets, reply, beat], clock);
named_ports!([] RegisterPort,
    [reset, s_axi.awvalid, s_axi.awaddr, s_axi.wvalid, s_axi.wdata, s_axi.wstrb, s_axi.bready, s_axi.arvalid, s_axi.araddr, s_axi.rready, write_is_known, read_data, read_is_known], [s_axi.awready, s_axi.wready, s_axi.bvalid, s_axi.bresp, s_axi.arready, s_axi.rvalid, s_axi.rdata, s_axi.rresp, write_enable, write_address, write_data, write_bytes, read_enable, read_address], clock);
named_ports!([] RegisterBlock,
    [reset, s_axi.awvalid, s_axi.awaddr, s_axi.wvalid, s_axi.wdata, s_axi.wstrb, s_axi.bready, s_axi.arvalid, s_axi.araddr, s_axi.rready, resets, core_runs, is_busy, commands, answers], [s_axi.awready, s_axi.wready, s_axi.bvalid, s_axi.bresp, s_axi.arready, s_axi.rvalid, s_axi.rdata, s_axi.rresp, asks_reset], clock);

#[test]
fn a_reset_is_asked_for_until_it_is_answered() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("stream_reset_request", ResetRequest::default(), 1);
    // What is requested, for how many clocks, and whether the end of the reply is awaited.
    let (mut requested, mut resetting, mut for_clocks) = (true, true, 0);
    let (mut reply, mut beat, mut still, mut runs, mut seen) = (true, false, 0, false, false);
    let (mut resets, mut stops) = (0, 0);
    for clock in 0..60_000 {
        let reset = clock < 2 || random.below(4000) == 0;
        let asks = random.below(600) == 0;
        // A reply that stood there from before, and one that follows late or soon.
        if random.below([2, 30][clock / 3000 % 2]) == 0 {
            reply = requested;
        }
        let is_still = clock / 900 % 3 == 2;
        if !is_still && random.below(9) == 0 {
            beat = !beat;
        }
        for (port, bit) in [("reset", reset), ("asks", asks), ("reply", reply), ("core_beat", beat)] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 2 {
            block.expect("request", requested);
            block.expect("resets", resetting);
            block.expect("core_runs", runs);
        }
        block.edge();
        if resetting && !requested && !reply {
            resetting = false;
        }
        if requested {
            for_clocks += 1;
            if for_clocks >= ResetRequest::LEAST_CLOCKS && reply {
                requested = false;
            }
        }
        if reset || asks {
            resets += usize::from(!resetting);
            (requested, resetting, for_clocks) = (true, true, 0);
        }
        still += 1;
        if still > ResetRequest::MOST_STILL - 1 {
            stops += usize::from(runs);
            runs = false;
        }
        if beat != seen {
            (still, runs) = (0, true);
        }
        if reset {
            (still, runs) = (0, false);
        }
        seen = beat;
    }
    assert!(resets > 50 && stops > 10, "{resets} resets, {stops} stops");
}

#[test]
fn the_core_is_held_in_reset_and_says_so() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("stream_reset_reply", ResetReply::new(), 1);
    let mut requests = vec![true; 9];
    let mut request = true;
    let mut beats = Vec::new();
    for clock in 0..3000 {
        if clock > 20 && random.below(15) == 0 {
            request = !request;
        }
        block.set("request", request);
        block.settle();
        if clock > 10 {
            block.expect("reply", requests[ResetReply::LATENCY - 1]);
            block.expect("resets", requests[0] || requests[ResetReply::LATENCY]);
        }
        beats.push(block.get("beat"));
        block.edge();
        requests.insert(0, request);
    }
    let changes: Vec<usize> = (1..beats.len()).filter(|clock| beats[*clock] != beats[clock - 1]).collect();
    assert!(changes.len() > 300 && changes.windows(2).all(|pair| pair[1] - pair[0] == 8), "{changes:?}");
}

/// What a master has under way on one channel: an offer stays until it is taken.
fn channel<T: Copy>(offered: &mut Option<T>, ready: bool, one_in: u64, random: &mut SplitMix64, new: T) {
    if ready {
        *offered = None;
    }
    if offered.is_none() && random.below(one_in) == 0 {
        *offered = Some(new);
    }
}

#[test]
fn the_port_follows_the_rules_of_axi() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("stream_register_port", RegisterPort::default(), 1);
    let (mut aw, mut w, mut ar): (Option<u64>, Option<(u64, u64)>, Option<u64>) = (None, None, None);
    // Taken and not written; written and not answered; the same for reads.
    let (mut addresses, mut words, mut reads): (Vec<u64>, Vec<(u64, u64)>, Vec<u64>) = Default::default();
    let (mut b, mut r): (Option<u64>, Option<(u64, u64)>) = (None, None);
    let (mut writes_done, mut reads_done) = (0, 0);
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(2500) == 0;
        let pace = [1, 6][clock / 1000 % 2];
        let (b_ready, r_ready) = (random.below(pace) == 0, random.below(pace) == 0);
        let (write_is_known, read_is_known, value) =
            (random.below(2) == 0, random.below(2) == 0, random.below(1 << 32));
        block.set("reset", reset);
        for (port, bit) in [
            ("s_axi_awvalid", aw.is_some()),
            ("s_axi_wvalid", w.is_some()),
            ("s_axi_arvalid", ar.is_some()),
            ("write_is_known", write_is_known),
            ("read_is_known", read_is_known),
        ] {
            block.set(port, bit);
        }
        let (data, bytes) = w.unwrap_or((5, 5));
        for (port, number) in [
            ("s_axi_awaddr", aw.unwrap_or(99)),
            ("s_axi_wdata", data),
            ("s_axi_wstrb", bytes),
            ("s_axi_araddr", ar.unwrap_or(77)),
            ("read_data", value),
        ] {
            block.set(port, number);
        }
        // No output follows a `ready` of the master within the clock.
        for (b_ready, r_ready) in [(!b_ready, !r_ready), (b_ready, r_ready)] {
            block.set("s_axi_bready", b_ready);
            block.set("s_axi_rready", r_ready);
            block.settle();
            if clock > 0 {
                block.expect("s_axi_bvalid", b.is_some());
                block.expect("s_axi_rvalid", r.is_some());
                block.expect("s_axi_awready", addresses.is_empty());
                block.expect("s_axi_wready", words.is_empty());
                block.expect("s_axi_arready", reads.is_empty());
            }
        }
        if clock == 0 {
            block.edge();
            continue;
        }
        if let Some(response) = b {
            block.expect("s_axi_bresp", response);
        }
        if let Some((data, response)) = r {
            block.expect("s_axi_rdata", data);
            block.expect("s_axi_rresp", response);
        }
        let writes = !addresses.is_empty() && !words.is_empty() && b.is_none();
        block.expect("write_enable", writes);
        if writes {
            block.expect("write_address", addresses[0]);
            block.expect("write_data", words[0].0);
            block.expect("write_bytes", words[0].1);
        }
        let reads_now = !reads.is_empty() && r.is_none();
        block.expect("read_enable", reads_now);
        if reads_now {
            block.expect("read_address", reads[0]);
        }
        block.edge();
        let taken = [addresses.is_empty(), words.is_empty(), reads.is_empty()];
        if b.is_some() && b_ready {
            b = None;
            writes_done += 1;
        }
        if r.is_some() && r_ready {
            r = None;
            reads_done += 1;
        }
        if writes {
            addresses.clear();
            words.clear();
            b = Some(if write_is_known { 0 } else { 2 });
        }
        if reads_now {
            reads.clear();
            r = Some((value, if read_is_known { 0 } else { 2 }));
        }
        if taken[0] {
            addresses.extend(aw);
        }
        if taken[1] {
            words.extend(w);
        }
        if taken[2] {
            reads.extend(ar);
        }
        let new = random.below(1 << 12);
        channel(&mut aw, taken[0], pace, &mut random, new);
        let new = (random.below(1 << 32), random.below(16));
        channel(&mut w, taken[1], pace, &mut random, new);
        let new = random.below(1 << 12);
        channel(&mut ar, taken[2], pace, &mut random, new);
        if reset {
            (addresses, words, reads, b, r) = Default::default();
        }
    }
    assert!(writes_done > 1500 && reads_done > 2000, "{writes_done} writes, {reads_done} reads");
}

#[test]
fn the_port_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("stream_register_port", RegisterPort::default(), 1);
    for (port, bit) in [("reset", true), ("write_is_known", true), ("read_is_known", true), ("s_axi_rready", true)] {
        block.set(port, bit);
    }
    block.set("read_data", 5u32);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    for clock in 0..9 {
        for (port, at) in [("s_axi_wvalid", 1), ("s_axi_awvalid", 2), ("s_axi_arvalid", 2), ("s_axi_bready", 5)] {
            block.set(port, clock == at);
        }
        block.settle();
        let bit = |port: &str| Cell::Bit(block.is(port));
        wave.take(&[
            ("awvalid", Cell::Bit(clock == 2)),
            ("awready", bit("s_axi_awready")),
            ("wvalid", Cell::Bit(clock == 1)),
            ("wready", bit("s_axi_wready")),
            ("write", bit("write_enable")),
            ("bvalid", bit("s_axi_bvalid")),
            ("bready", Cell::Bit(clock == 5)),
            ("arvalid", Cell::Bit(clock == 2)),
            ("read", bit("read_enable")),
            ("rvalid", bit("s_axi_rvalid")),
            ("rdata", if block.is("s_axi_rvalid") { Cell::Number(block.get("s_axi_rdata")) } else { Cell::Open }),
        ]);
        block.edge();
    }
    wave.assert_drawn_in("register_port");
}

/// Events of a clock, by port.
const EVENTS: [&str; 7] =
    ["commands_took", "commands_waited", "dropped", "answers_took", "answers_waited", "answers_ended", "failed"];

/// The register block with a master, and what its registers must hold.
struct Block {
    stepper: Stepper<RegisterBlock>,
    random: SplitMix64,
    clocks: u64,
    counted: [u32; 7],
    errors: u32,
    fault: u32,
    status: [bool; 3],
    asked: usize,
}

impl Block {
    fn new() -> Self {
        let mut stepper = Stepper::new("stream_register_block", RegisterBlock::new(SMALL, 64), 1);
        stepper.set("reset", true);
        stepper.settle();
        stepper.edge();
        stepper.set("reset", false);
        stepper.set("s_axi_bready", true);
        stepper.set("s_axi_rready", true);
        Self {
            stepper,
            random: SplitMix64::new(4),
            clocks: 0,
            counted: [0; 7],
            errors: 0,
            fault: 0,
            status: [false; 3],
            asked: 0,
        }
    }

    /// One clock with random events.
    fn clock(&mut self) {
        let header = self.random.below(1 << 32) as u32;
        self.stepper.set("header", header);
        for (place, event) in EVENTS.into_iter().enumerate() {
            let happens = self.random.below(5) == 0;
            self.stepper.set(event, happens);
            self.counted[place] += u32::from(happens);
            if happens && event == "dropped" {
                self.errors |= ERROR_PARTIAL_BEAT;
            }
            if happens && event == "failed" {
                self.errors |= ERROR_ANSWER_STATUS;
                self.fault = header;
            }
        }
        self.show_status();
        self.stepper.settle();
        self.asked += usize::from(self.stepper.is("asks_reset"));
        self.stepper.edge();
        self.clocks += 1;
    }

    fn show_status(&mut self) {
        for (port, bit) in ["resets", "core_runs", "is_busy"].into_iter().zip(self.status) {
            self.stepper.set(port, bit);
        }
    }

    /// Nothing happens for a clock, for registers that would move.
    fn rest(&mut self) {
        EVENTS.into_iter().for_each(|event| self.stepper.set(event, false));
        self.show_status();
        self.stepper.settle();
        self.asked += usize::from(self.stepper.is("asks_reset"));
        self.stepper.edge();
        self.clocks += 1;
    }

    fn read(&mut self, offset: u32) -> (u32, u32) {
        self.stepper.set("s_axi_araddr", offset);
        self.stepper.set("s_axi_arvalid", true);
        self.rest();
        self.stepper.set("s_axi_arvalid", false);
        self.rest();
        self.stepper.settle();
        assert!(self.stepper.is("s_axi_rvalid"));
        let (value, response) = (self.stepper.get("s_axi_rdata") as u32, self.stepper.get("s_axi_rresp") as u32);
        self.rest();
        (value, response)
    }

    fn write(&mut self, offset: u32, value: u32, bytes: u32) -> u32 {
        self.stepper.set("s_axi_awaddr", offset);
        self.stepper.set("s_axi_wdata", value);
        self.stepper.set("s_axi_wstrb", bytes);
        self.stepper.set("s_axi_awvalid", true);
        self.stepper.set("s_axi_wvalid", true);
        self.rest();
        self.stepper.set("s_axi_awvalid", false);
        self.stepper.set("s_axi_wvalid", false);
        self.rest();
        self.stepper.settle();
        assert!(self.stepper.is("s_axi_bvalid"));
        let response = self.stepper.get("s_axi_bresp") as u32;
        self.rest();
        response
    }

    fn status(&self) -> u32 {
        let [resets, runs, busy] = self.status;
        let bit = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        bit(runs && !resets, STREAM_STATUS_RUNS)
            | bit(busy, STREAM_STATUS_BUSY)
            | bit(resets, STREAM_STATUS_RESETTING)
            | bit(self.errors != 0, STREAM_STATUS_ERROR)
    }

    fn expected(&self, register: StreamRegister) -> Option<u32> {
        use StreamRegister::*;
        let [took, waited, _, answered, answer_waited, ended, _] = self.counted;
        Some(match register {
            Magic => MAGIC,
            StreamVersion => STREAM_VERSION,
            ProtocolVersion => PROTOCOL_VERSION,
            CoreVersion => CORE_VERSION,
            CoordBits => CORE_COORD_BITS,
            Capacity => SMALL.points,
            Contexts => SMALL.contexts,
            Ring => SMALL.ring,
            BeatBits => 64,
            FifoBeats => STREAM_FIFO_BEATS,
            Control => u32::from(self.status[0]),
            Status => self.status(),
            Errors => self.errors,
            Fault => self.fault,
            ClocksLow => return None,
            ClocksHigh => 0,
            CommandBeats => took,
            AnswerBeats => answered,
            Answers => ended,
            CommandWaits => waited,
            AnswerWaits => answer_waited,
        })
    }
}

#[test]
fn registers_hold_what_the_page_says() {
    let mut block = Block::new();
    for round in 0..40 {
        let clocks = block.random.below(60);
        (0..clocks).for_each(|_| block.clock());
        block.status = [1, 2, 4].map(|bit| round & bit != 0);
        for register in StreamRegister::ALL {
            // Any address within a word is its register.
            let offset = register.offset() + block.random.below(4) as u32;
            let (value, response) = block.read(offset);
            assert_eq!(response, 0, "{register:?}");
            if let Some(expected) = block.expected(register) {
                assert_eq!(value, expected, "{register:?}");
            }
        }
        let before = block.clocks;
        let (value, _) = block.read(StreamRegister::ClocksLow.offset());
        assert_eq!(u64::from(value), before + 1);
        let errors = block.errors;
        let (clears, bytes) = (block.random.below(4) as u32, block.random.below(16) as u32);
        assert_eq!(block.write(StreamRegister::Errors.offset(), clears, bytes), 0);
        if bytes & 1 == 1 {
            block.errors = errors & !clears;
        }
        assert_eq!(block.read(StreamRegister::Errors.offset()), (block.errors, 0));
        assert_eq!(block.read(StreamRegister::Status.offset()), (block.status(), 0));
    }
}

#[test]
fn only_known_registers_can_be_written_and_only_bit_0_of_control_resets() {
    let mut block = Block::new();
    let mut asked = 0;
    for offset in (0..4096).step_by(4) {
        let register = StreamRegister::ALL.into_iter().find(|register| register.offset() == offset);
        let can_be_written = matches!(register, Some(StreamRegister::Control | StreamRegister::Errors));
        assert_eq!(block.write(offset, 1, 15), if can_be_written { 0 } else { 2 }, "{offset:#x}");
        asked += usize::from(register == Some(StreamRegister::Control));
        assert_eq!(block.asked, asked, "{offset:#x}");
        let (value, response) = block.read(offset);
        assert_eq!(response, if register.is_some() { 0 } else { 2 }, "{offset:#x}");
        assert!(register.is_some() || value == 0);
    }
    for (value, bytes, resets) in [(0, 15, 0), (0xffff_fffe, 15, 0), (1, 14, 0), (1, 1, 1), (0xffff_ffff, 15, 1)] {
        let before = block.asked;
        assert_eq!(block.write(StreamRegister::Control.offset(), value, bytes), 0);
        assert_eq!(block.asked - before, resets, "{value:#x} {bytes:#x}");
    }
}
