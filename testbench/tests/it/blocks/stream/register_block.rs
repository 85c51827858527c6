//! Runs `RegisterBlock` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::stream::RegisterBlock;
use incircle_protocol::{
    StreamRegister, CORE_COORD_BITS, CORE_VERSION, ERROR_ANSWER_STATUS, ERROR_PARTIAL_BEAT, MAGIC, PROTOCOL_VERSION,
    SMALL, STREAM_FIFO_BEATS, STREAM_STATUS_BUSY, STREAM_STATUS_ERROR, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS,
    STREAM_VERSION,
};
use incircle_testkit::SplitMix64;

named_ports!([] RegisterBlock,
    [
        reset, s_axi.awvalid, s_axi.awaddr, s_axi.wvalid, s_axi.wdata, s_axi.wstrb, s_axi.bready, s_axi.arvalid,
        s_axi.araddr, s_axi.rready, resets, core_runs, is_busy, commands, answers
    ],
    [
        s_axi.awready, s_axi.wready, s_axi.bvalid, s_axi.bresp, s_axi.arready, s_axi.rvalid, s_axi.rdata, s_axi.rresp,
        asks_reset
    ],
    clock
);

/// Events of a clock, by port.
const EVENTS: [&str; 7] =
    ["commands_took", "commands_waited", "dropped", "answers_took", "answers_waited", "answers_ended", "failed"];

/// The register block with a master, and the expected content of its registers.
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

    /// Runs one clock with random events.
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

    /// Runs a clock without events, for registers that would change.
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
            Contexts => 1 << 8 | SMALL.contexts,
            Ring => 2 << 16 | SMALL.ring,
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
            // Any address within a word reads its register.
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
