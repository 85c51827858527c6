//! Proves that the crossings between the clock of the bus and that of the core are those in `protocol/STREAM.md`, and
//! that a crossing of any other kind is found.

use incircle_hdl::export;
use incircle_protocol::TINY;
use incircle_testbench::crossings::{crossings, stream_port_clock, Crossing, Way};

const NAME: &str = "stream_link";

fn found(verilog: &str) -> Vec<Crossing> {
    crossings(verilog, NAME, stream_port_clock).unwrap_or_else(|error| panic!("{error}"))
}

fn link(beat_bits: u32) -> String {
    export::stream_link(TINY, beat_bits, NAME).unwrap()
}

/// Every crossing of a link with beats of this width: from, to, way, receiver, bits.
fn expected(beat_bits: usize) -> Vec<(&'static str, &'static str, Way, &'static str, usize)> {
    let (bus, core) = ("bus_clock", "core_clock");
    vec![
        (bus, core, Way::Synchroniser, "answers.read_seen.first", 10),
        (bus, core, Way::Synchroniser, "commands.write_seen.first", 10),
        (bus, core, Way::Synchroniser, "core.request_seen.first", 1),
        (bus, core, Way::Memory, "commands.memory.word", beat_bits),
        (core, bus, Way::Synchroniser, "answers.write_seen.first", 10),
        (core, bus, Way::Synchroniser, "bus.beat_seen.first", 1),
        (core, bus, Way::Synchroniser, "bus.busy_seen.first", 1),
        (core, bus, Way::Synchroniser, "bus.reply_seen.first", 1),
        (core, bus, Way::Synchroniser, "commands.read_seen.first", 10),
        (core, bus, Way::Memory, "answers.memory.word", beat_bits + 1),
    ]
}

#[test]
fn nothing_crosses_but_what_the_page_says() {
    for beat_bits in [64, 128] {
        let found = found(&link(beat_bits));
        let seen: Vec<_> = found
            .iter()
            .map(|one| (one.from.as_str(), one.to.as_str(), one.way, one.receiver.as_str(), one.bits))
            .collect();
        let mut expected = expected(beat_bits as usize);
        expected.sort();
        assert_eq!(seen, expected, "{beat_bits} bits");
    }
}

#[test]
fn other_crossings_are_found() {
    let sound = link(64);
    for (old, new) in [
        // A flag that bypasses its synchroniser.
        ("resetting$reply = reply_seen$received;", "resetting$reply = reply;"),
        // Logic in front of a synchroniser.
        ("busy_seen$sent = core_busy;", "busy_seen$sent = core_busy & core_beat;"),
        // A reset by the other side.
        ("answers$write_reset = core$core_reset;", "answers$write_reset = bus$resets;"),
        // A whole word between the clocks.
        ("watch$m_axis_tdata = ((entry)", "watch$m_axis_tdata = ((entry ^ core_beat)"),
    ] {
        let places = sound.matches(old).count();
        if places == 0 {
            let hint: Vec<_> =
                sound.lines().filter(|line| line.contains(old.split(' ').next().unwrap_or(old))).collect();
            panic!("{old:?} is not in the Verilog, but {hint:?}");
        }
        let found = found(&sound.replace(old, new));
        assert!(found.iter().any(|one| one.way == Way::Fault), "{new}: {found:?}");
    }
}
