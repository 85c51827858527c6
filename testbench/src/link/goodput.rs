//! Measures which share of a line's payload limit the serial link reaches.

use std::error::Error;
use std::fmt::Write;
use std::time::Duration;

use incircle_protocol::{answer_status, Clear, Command, Config, RecordRange, Status, FULL};
use incircle_sim::faults::FaultSpec;

use super::virtual_line::VirtualLine;
use super::Detail;

/// Rates of the table, in bits per second.
pub const RATES: [u32; 2] = [3_000_000, 12_000_000];
/// Least share of the payload limit that the link has to reach.
pub const TARGET: f64 = 0.9;
/// Round trip of the line, besides the time of the bits.
const TRIP: Duration = Duration::from_millis(1);
/// Time limit of a command.
const LIMIT: Duration = Duration::from_secs(30);
/// Configuration of the core: with one this large, an answer is many windows long.
const CORE: Config = FULL;

/// Direction of the payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Points to the device.
    Points,
    /// Records to the host.
    Records,
}

/// Measurement of one direction at one rate.
#[derive(Clone, Copy, Debug)]
pub struct Goodput {
    /// Rate of the line in bits per second.
    pub rate: u32,
    /// Direction of the payload.
    pub way: Way,
    /// Bytes of payload words: the command with its points, or the answer with its records.
    pub bytes: usize,
    /// Time from the call with the command until its answer is complete.
    pub time: Duration,
}

impl Goodput {
    /// Payload bytes per second.
    pub fn per_second(&self) -> f64 {
        self.bytes as f64 / self.time.as_secs_f64()
    }

    /// Share of the limit, which is the rate over ten: a byte takes ten bits, and all bytes would be payload.
    pub fn share(&self) -> f64 {
        self.per_second() * 10.0 / f64::from(self.rate)
    }
}

/// Measures both directions at a rate, with `points` points, of which the core keeps as many as it holds.
///
/// # Errors
/// The board is not part of this build, or the link failed.
pub fn measure(detail: Detail, rate: u32, points: usize) -> Result<[Goodput; 2], Box<dyn Error>> {
    let mut line = VirtualLine::new(detail.board(CORE)?, rate, TRIP, &FaultSpec::default());
    line.open(LIMIT)?;
    if line.rate() != rate {
        return Err(format!("the link runs at {} bits per second, not {rate}", line.rate()).into());
    }
    line.ask(&Command::<[u32; 0]>::Clear(Clear::one_mesh(0)), LIMIT)?;
    let words: Vec<u32> = super::jobs::random_points(points, 1).iter().map(|point| point.x | (point.y << 16)).collect();
    let insert = Command::Insert { count: u32::try_from(points)?, points: words };
    let begun = line.now();
    let report = line.ask(&insert, LIMIT)?;
    let status = report.first().map(|&header| answer_status(header));
    if status != Some(Status::Ok as u8) && status != Some(Status::Full as u8) {
        return Err(format!("the core answers with status {status:?}").into());
    }
    let to_device = Goodput { rate, way: Way::Points, bytes: 4 * insert.words(), time: line.now() - begun };
    let records = report.get(6).copied().unwrap_or(0);
    let begun = line.now();
    let answer = line.ask(&Command::<[u32; 0]>::Read(RecordRange { first: 0, count: records }), LIMIT)?;
    let to_host = Goodput { rate, way: Way::Records, bytes: 4 * answer.len(), time: line.now() - begun };
    line.close();
    Ok([to_device, to_host])
}

/// Returns the text of `goodput.md`.
///
/// # Errors
/// The errors of [`measure`].
pub fn document() -> Result<String, Box<dyn Error>> {
    let mut text = String::from(
        "# Goodput of the serial link\n\n\
         For readers who want to know how much of a serial line is left for their points and triangles.\n\
         Made by `cargo run --release -p incircle-testbench --bin goodput`: the driver's protocol runs before the\n\
         Verilated `incircle_serial_top`, whose pins are driven and sampled bit by bit. Time is virtual, with 1 ms of\n\
         round trip besides the bits, so the figures are the same on every machine. The core is `full`, and its link\n\
         has a FIFO of 16,384 bytes.\n\n\
         Payload is what the core and its user see: the words of one `Insert` with its points, or the words of one\n\
         answer to `Read` with its records. The time is that of the whole command, from the call of the driver to the\n\
         last word of the answer, so the round trip, frame headers, check sums, encoding, acknowledgements and the\n\
         work of the core all count as losses. The limit is the rate over ten, because 8N1 sends ten bits a byte: the\n\
         line would carry that much if it carried payload alone.\n\n\
         | bits per second | way | payload bytes | time | bytes per second | of the limit |\n\
         |---|---|---|---|---|---|\n",
    );
    for rate in RATES {
        for goodput in measure(Detail::Pins, rate, 8192)? {
            let way = match goodput.way {
                Way::Points => "points to the device",
                Way::Records => "records to the host",
            };
            writeln!(
                text,
                "| {} | {way} | {} | {:.1} ms | {:.0} | {:.1} % |",
                rate,
                goodput.bytes,
                goodput.time.as_secs_f64() * 1e3,
                goodput.per_second(),
                100.0 * goodput.share()
            )?;
        }
    }
    Ok(text)
}
