//! Runs the whole stream link, with AXI on one side and a stand-in for the core on the other, at ratios of their clocks
//! from 1:4 to 4:1: Rust and Verilog must agree and keep the rules of the protocol's page.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_rig::{answer, command, Pins, Rig, StandIn, Verilog, PERIODS};
use incircle_hdl::stream::StreamLink;
use incircle_protocol::{
    StreamRegister, CONTROL_RESET, ERROR_ANSWER_STATUS, ERROR_PARTIAL_BEAT, MAGIC, SMALL, STREAM_FIFO_BEATS,
    STREAM_STATUS_BUSY, STREAM_STATUS_ERROR, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS,
};
use incircle_testkit::SplitMix64;

named_ports!([const W: usize, const K: usize, const E: usize] StreamLink<W, K, E>,
    [
        bus_clock, bus_reset_n, s_axis.tvalid, s_axis.tdata, s_axis.tkeep, m_axis.tready, s_axi.awvalid, s_axi.awaddr,
        s_axi.wvalid, s_axi.wdata, s_axi.wstrb, s_axi.bready, s_axi.arvalid, s_axi.araddr, s_axi.rready, core_clock,
        command.ready, response.valid, response.data, response.both, response.last, device_busy
    ],
    [
        s_axis.tready, m_axis.tvalid, m_axis.tdata, m_axis.tkeep, m_axis.tlast, s_axi.awready, s_axi.wready,
        s_axi.bvalid, s_axi.bresp, s_axi.arready, s_axi.rvalid, s_axi.rdata, s_axi.rresp, core_reset, command.valid,
        command.data, response.ready
    ]
);

fn rig(beat_bits: usize, periods: [u64; 2], seed: u64) -> Rig<Verilog> {
    let name = if beat_bits == 64 { "stream_link_64" } else { "stream_link_128" };
    let (pins, core) = (Verilog::new(name, seed as u32), StandIn::new(seed));
    // The shortest reset at power-up must be enough.
    let mut rig = Rig::after_reset(pins, beat_bits, Some(core), (periods, seed), 1 + seed % 3);
    rig.await_core();
    rig
}

/// Commands with their arguments; some answers have no payload, and some commands fail.
fn commands(number: usize, longest: u64, random: &mut SplitMix64) -> Vec<Vec<u32>> {
    let mut one = || {
        let arguments = random.below(4) as u32;
        let status = if random.below(8) == 0 { 1 + random.below(6) as u32 } else { 0 };
        let first = command(1 + random.below(9) as u32, status, arguments, random.below(longest) as u32);
        // Zeros among the arguments are not padding.
        let argument = |random: &mut SplitMix64| if random.below(2) == 0 { 0 } else { random.next_u64() as u32 };
        [first].into_iter().chain((0..arguments).map(|_| argument(random))).collect()
    };
    (0..number).map(|_| one()).collect()
}

/// Sends commands, some padded to the end of a beat and some not, and compares the answers.
fn exchange<P: Pins>(rig: &mut Rig<P>, number: usize, longest: u64, random: &mut SplitMix64) {
    let commands = commands(number, longest, random);
    let mut words = Vec::new();
    for command in &commands {
        words.extend(command);
        if random.below(3) == 0 {
            let to_whole = words.len().next_multiple_of(rig.bus.beat_bytes / 4);
            words.resize(to_whole + rig.bus.beat_bytes / 4 * random.below(2) as usize, 0);
        }
    }
    rig.bus.send(&words);
    for command in &commands {
        assert_eq!(rig.answer(60_000), answer(command));
    }
    assert!(rig.bus.came.is_empty());
}

fn in_both_forms<P: Pins>(pins: P, beat_bits: usize) {
    let mut random = SplitMix64::new(1);
    let mut rig = Rig::new(pins, beat_bits, Some(StandIn::new(1)), [8000, 7100], 1);
    rig.await_core();
    assert_eq!(rig.read(StreamRegister::Magic), MAGIC);
    assert_eq!(rig.read(StreamRegister::BeatBits), beat_bits as u32);
    exchange(&mut rig, 12, 20, &mut random);
    rig.write(StreamRegister::Control, CONTROL_RESET);
    rig.await_core();
    rig.bus.pace = 3;
    exchange(&mut rig, 6, 20, &mut random);
    assert_eq!(rig.read(StreamRegister::Answers), 18);
}

#[test]
fn the_link_passes_commands_and_answers_in_both_forms() {
    let narrow = StreamLink::<64, 8, 65>::new(SMALL).expect("a sound configuration");
    in_both_forms(Stepper::new("stream_link_64", narrow, 1), 64);
    let wide = StreamLink::<128, 16, 129>::new(SMALL).expect("a sound configuration");
    in_both_forms(Stepper::new("stream_link_128", wide, 1), 128);
}

#[test]
fn the_link_passes_commands_and_answers_at_any_ratio_and_pace() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        for beat_bits in [64, 128] {
            let mut random = SplitMix64::new(round as u64);
            let mut rig = rig(beat_bits, periods, round as u64);
            for (bus_pace, core_pace) in [(1, 1), (1, 5), (5, 1), (3, 3)] {
                rig.bus.pace = bus_pace;
                rig.core.as_mut().expect("a stand-in").pace = core_pace;
                exchange(&mut rig, 25, 60, &mut random);
            }
            exchange(&mut rig, 1, 4096, &mut random);
        }
    }
}

#[test]
fn counters_count_what_the_bus_saw() {
    for (beat_bits, periods) in [(64, PERIODS[2]), (128, PERIODS[3])] {
        let mut random = SplitMix64::new(7);
        let mut rig = rig(beat_bits, periods, 7);
        rig.bus.pace = 4;
        exchange(&mut rig, 60, 50, &mut random);
        rig.steps(200);
        let [commands, answers, ended, command_waits, answer_waits] = rig.bus.counted;
        assert!(commands > 20 && answers > 100 && ended == 60 && answer_waits > 50);
        assert_eq!(rig.read(StreamRegister::CommandBeats), commands);
        assert_eq!(rig.read(StreamRegister::AnswerBeats), answers);
        assert_eq!(rig.read(StreamRegister::Answers), ended);
        assert_eq!(rig.read(StreamRegister::CommandWaits), command_waits);
        assert_eq!(rig.read(StreamRegister::AnswerWaits), answer_waits);
        let clocks = rig.read(StreamRegister::ClocksLow);
        assert!(u64::from(clocks).abs_diff(rig.bus.clocks) < 200, "{clocks} and {}", rig.bus.clocks);
        assert_eq!(rig.read(StreamRegister::ClocksHigh), 0);
        rig.bus_reset(1);
        rig.await_core();
        assert_eq!(rig.read(StreamRegister::AnswerBeats), 0);
    }
}

#[test]
fn both_fifos_fill_and_nothing_is_lost() {
    for (beat_bits, periods) in [(64, PERIODS[0]), (128, PERIODS[6])] {
        let words_of_beat = beat_bits / 32;
        let mut rig = rig(beat_bits, periods, 3);
        // The core takes nothing, so the link holds the FIFO, its read port, and a beat that is being cut.
        rig.core.as_mut().expect("a stand-in").sleeps = true;
        let all = 1000 * words_of_beat;
        let commands: Vec<u32> = (0..all).map(|place| command(1 + place as u32 % 200, 0, 0, 1)).collect();
        rig.bus.send(&commands);
        rig.steps(8000);
        let held = 1000 - rig.bus.unsent() as u32;
        assert!((STREAM_FIFO_BEATS..=STREAM_FIFO_BEATS + 3).contains(&held), "{held} beats are held");
        assert_ne!(rig.read(StreamRegister::Status) & STREAM_STATUS_BUSY, 0);
        // Nobody takes an answer, so the other FIFO fills.
        rig.core.as_mut().expect("a stand-in").sleeps = false;
        rig.bus.is_deaf = true;
        rig.steps(20_000);
        let left = rig.bus.unsent();
        rig.steps(5000);
        assert!(left > 0 && rig.bus.unsent() == left && rig.bus.came.is_empty());
        // An answer is on offer though nobody was ever ready for one.
        assert_eq!(rig.pins.get("m_axis_tvalid"), 1);
        rig.bus.is_deaf = false;
        for command in &commands {
            assert_eq!(rig.answer(60_000), answer(&[*command]));
        }
    }
}

#[test]
fn a_beat_without_all_its_bytes_is_dropped_and_a_failed_answer_is_kept() {
    let mut rig = rig(64, PERIODS[4], 5);
    assert_eq!(rig.read(StreamRegister::Errors), 0);
    let sound = command(3, 0, 1, 2);
    rig.bus.send(&[sound, 77]);
    rig.bus.send_partial(0x7f);
    rig.bus.send_partial(0);
    rig.bus.send(&[command(4, 5, 0, 1), 0]);
    assert_eq!(rig.answer(5000), answer(&[sound, 77]));
    assert_eq!(rig.answer(5000), answer(&[command(4, 5, 0, 1)]));
    rig.steps(20);
    assert_eq!(rig.read(StreamRegister::Errors), ERROR_PARTIAL_BEAT | ERROR_ANSWER_STATUS);
    assert_eq!(rig.read(StreamRegister::Fault), 0x0405_0000);
    assert_eq!(rig.read(StreamRegister::Status) & !STREAM_STATUS_BUSY, STREAM_STATUS_RUNS | STREAM_STATUS_ERROR);
    assert_eq!(rig.read(StreamRegister::CommandBeats), 4);
    rig.write(StreamRegister::Errors, ERROR_PARTIAL_BEAT);
    assert_eq!(rig.read(StreamRegister::Errors), ERROR_ANSWER_STATUS);
    // A reset by the control register keeps the errors and the fault; a reset of the bus clears them.
    rig.write(StreamRegister::Control, CONTROL_RESET);
    rig.await_core();
    assert_eq!((rig.read(StreamRegister::Errors), rig.read(StreamRegister::Fault)), (ERROR_ANSWER_STATUS, 0x0405_0000));
    rig.bus_reset(1);
    rig.await_core();
    assert_eq!((rig.read(StreamRegister::Errors), rig.read(StreamRegister::Fault)), (0, 0));
}

#[test]
fn busy_is_told_without_a_gap() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        let mut random = SplitMix64::new(round as u64);
        let mut rig = rig(64, periods, round as u64);
        for turn in 0..60 {
            // Padding alone, or a command that lacks an argument.
            let first = command(2, 0, 1, random.below(12) as u32);
            // A slow core would leave the padding of the turn before in the link.
            rig.core.as_mut().expect("a stand-in").pace = 1;
            rig.steps(60);
            assert_eq!(rig.read(StreamRegister::Status), STREAM_STATUS_RUNS, "idle at {periods:?}, turn {turn}");
            rig.core.as_mut().expect("a stand-in").pace = 1 + random.below(6);
            rig.bus.send(&[0, first]);
            let is_at_rest = random.below(3) == 0;
            if is_at_rest {
                rig.steps(400);
            }
            while rig.bus.unsent() > 0 {
                rig.step();
            }
            rig.bus.send(&[9, 0]);
            let mut reads = 0;
            while !rig.bus.came.iter().any(|(_, is_last)| *is_last) {
                // A status read before the answer ended must say busy.
                let status = rig.read(StreamRegister::Status);
                if !rig.bus.came.iter().any(|(_, is_last)| *is_last) {
                    assert_eq!(status, STREAM_STATUS_RUNS | STREAM_STATUS_BUSY, "{reads} at {periods:?}");
                    reads += 1;
                }
                rig.steps(random.below(3) as usize);
            }
            assert_eq!(rig.answer(1), answer(&[first, 9]));
        }
    }
}

#[test]
fn resets_in_the_middle_leave_nothing_behind() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        for beat_bits in [64, 128] {
            let mut random = SplitMix64::new(round as u64);
            let mut rig = rig(beat_bits, periods, 20 + round as u64);
            for attempt in 0..24 {
                let words: Vec<u32> = commands(40, 30, &mut random).concat();
                rig.core.as_mut().expect("a stand-in").pace = 1 + random.below(3);
                rig.bus.is_deaf = random.below(3) == 0;
                rig.bus.send(&words);
                let steps = random.below(1500) as usize;
                rig.steps(steps);
                // The host ends its transfers, then resets.
                rig.bus.drop_unsent();
                while rig.bus.unsent() > 0 {
                    rig.step();
                }
                rig.bus.is_deaf = true;
                rig.steps(3);
                let resets = rig.core.as_ref().expect("a stand-in").resets;
                if attempt % 3 == 2 {
                    rig.bus_reset(1 + random.below(3));
                } else {
                    rig.write(StreamRegister::Control, CONTROL_RESET);
                    let (control, status) = (rig.read(StreamRegister::Control), rig.read(StreamRegister::Status));
                    assert!(control == CONTROL_RESET && status & STREAM_STATUS_RESETTING != 0 || periods[1] < 9200);
                }
                if random.below(3) == 0 {
                    rig.write(StreamRegister::Control, CONTROL_RESET);
                }
                rig.await_core();
                assert_eq!(rig.read(StreamRegister::Control), 0);
                rig.bus.came.clear();
                rig.bus.is_deaf = false;
                assert!(rig.core.as_ref().expect("a stand-in").resets >= resets + 8);
                rig.core.as_mut().expect("a stand-in").pace = 1;
                exchange(&mut rig, 3, 20, &mut random);
            }
        }
    }
}

#[test]
fn a_core_without_a_clock_is_told_and_its_reset_does_not_end() {
    let mut rig = rig(64, PERIODS[1], 9);
    rig.core_stands = true;
    rig.steps(1200);
    assert_eq!(rig.read(StreamRegister::Status) & STREAM_STATUS_RUNS, 0);
    rig.write(StreamRegister::Control, CONTROL_RESET);
    rig.steps(3000);
    assert_eq!(rig.read(StreamRegister::Status), STREAM_STATUS_RESETTING);
    assert_eq!(rig.read(StreamRegister::Control), CONTROL_RESET);
    rig.core_stands = false;
    rig.await_core();
    exchange(&mut rig, 5, 30, &mut SplitMix64::new(1));
}
