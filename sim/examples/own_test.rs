//! A test of your own: the Verilated core through the calls that a board takes, and a waveform of one of its jobs.
//! `docs/simulation.md` explains it.
//!
//!     cargo run --release -p incircle-sim --example own_test -- second.vcd

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use incircle::{Device, Options, Point};
use incircle_protocol::TINY;
use incircle_sim::{waves, SimDevice, SimTransport};

/// What your program does with a device. With `Device::open("serial:/dev/ttyUSB0")` it runs on a board.
fn my_program(device: &mut Device, points: &[Point], out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let solution = device.session()?.triangulate_with(points, &Options::default())?;
    assert_eq!(solution.mesh, incircle::triangulate(points)?, "the core gives the one right mesh");
    writeln!(out, "{}: {} points, triangles {:?}", solution.report.backend, points.len(), solution.mesh.triangles)?;
    Ok(())
}

/// Runs three jobs on a core, then again with a waveform of the second one, which goes to this file.
pub fn run(waveform: &Path, out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let square = [(0, 0), (8, 0), (8, 8), (0, 8), (4, 3)].map(Point::from);
    let jobs: [&[Point]; 3] = [&square[..3], &square, &square[1..]];

    // A core without waveforms is the quick one.
    let mut core = incircle_sim::open(TINY)?;
    for job in jobs {
        my_program(&mut core, job, out)?;
    }

    let mut traced = SimDevice::traced(TINY)?;
    traced.trace_job(waveform, 2)?;
    let mut core = Device::from_transport(Box::new(SimTransport::new(traced, "tiny")));
    for job in jobs {
        my_program(&mut core, job, out)?;
    }
    drop(core);
    for file in waves::write_layout(waveform)? {
        writeln!(out, "wrote {}", file.file_name().unwrap_or_default().display())?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let waveform = std::env::args_os().nth(1).map_or("second.vcd".into(), PathBuf::from);
    run(&waveform, &mut std::io::stdout())
}
