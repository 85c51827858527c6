//! Runs `WritePort` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::bundles::{column_write, pack, random_fields, WRITE};
use crate::rig::stepper::{named_ports, Expected, Stepper};
use incircle_hdl::engine::WritePort;
use incircle_testkit::SplitMix64;

named_ports!([] WritePort, [reset, commit, solo, seed], [write, enables], clock);

const CYCLES: usize = 6_000;

#[test]
fn write_port_takes_the_request_there_is() {
    let mut numbers = SplitMix64::new(23);
    let stimuli: Vec<Vec<u128>> = (0..CYCLES)
        .map(|cycle| {
            let mut requests = [(); 3].map(|()| random_fields(WRITE, &mut numbers));
            let valid = numbers.below(5);
            for (writer, request) in requests.iter_mut().enumerate() {
                request[0] = u64::from(writer as u64 == valid);
            }
            let reset = cycle == 0 || numbers.once_in(20);
            let requests = requests.map(|request| pack(WRITE, request));
            [&[u128::from(reset)], &requests[..]].concat()
        })
        .collect();
    let (mut port, mut copies): (Expected, Expected) = (None, None);
    Stepper::new("write_port", WritePort::default(), 1).run(
        &["reset", "commit", "solo", "seed"],
        &["write", "enables"],
        stimuli,
        |values| {
            let (seen, seen_copies) = (port, copies);
            let request = values[1..].iter().find(|request| **request & 1 == 1);
            port = if values[0] == 1 {
                copies = Some(0x7fff << 4 | 0x5555 << 19);
                Some(0)
            } else {
                copies = request.map(|write| (write >> 1 & 0x7fff) << 4 | (write >> 1 & 0x7fff) << 19).or(copies);
                // Without a request the data stay, and the write is over.
                request.copied().or(port.map(|write| write & !1))
            };
            // The columns of the write that are written.
            let enables = seen.map(|write| if write & 1 == 1 { write >> 16 & 0b1111 } else { 0 });
            vec![seen, enables.zip(seen_copies).map(|(enables, copies)| enables | copies)]
        },
    );
}

#[test]
fn write_port_shows_the_wave_of_its_header() {
    let stimuli = [
        (1, "commit", column_write(5, 15, 1, 1)),
        (2, "commit", column_write(6, 15, 1, 1)),
        (4, "solo", column_write(7, 15, 1, 1)),
    ];
    let lanes = [
        ("commit.valid", "commit", 0, 1, When::Always),
        ("commit.id", "commit", 1, 15, When::If("commit")),
        ("solo.valid", "solo", 0, 1, When::Always),
        ("solo.id", "solo", 1, 15, When::If("solo")),
        ("write.valid", "write", 0, 1, When::Always),
        ("write.id", "write", 1, 15, When::If("write")),
        ("enables.link1", "enables", 2, 1, When::Always),
    ];
    draw("write_port", WritePort::default(), &stimuli, 7, &lanes).assert_drawn_in("write_port");
}
