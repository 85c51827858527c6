//! Measures how many points a second a core behind the UDP link does, seen from a socket of the host: clocks are
//! counted at the pins of the PHY, and the cable neither delays nor loses a datagram.

use std::cell::RefCell;
use std::error::Error;
use std::fmt::Write;
use std::rc::Rc;
use std::time::Duration;

use incircle::{Device, Options, Point};
use incircle_protocol::{Config, DUAL, FULL, SMALL};
use incircle_sim::network::NetworkBoard;
use incircle_testkit::{NetworkFaults, SplitMix64};

use super::virtual_ether::{EtherTransport, VirtualEther};

/// Limit for an answer, in virtual time.
const LIMIT: Duration = Duration::from_secs(2);
/// More microseconds than the core takes for a job, or for the jobs that share its memory.
const LONGEST_JOB_US: u32 = 3000;
/// Points that the batches of the page have together, about.
const POINTS: usize = 100_000;
/// The largest coordinate of the points, plus 1.
const SIDE: u32 = 1 << 16;

/// A measurement of the page.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// The core, and its clock in MHz.
    pub config: Config,
    pub clock_mhz: u32,
    /// Jobs of the batch, and points of a job.
    pub jobs: usize,
    pub points: usize,
    /// Million points a second that were aimed at, if there is an aim.
    pub target: Option<f64>,
}

const fn load(config: Config, clock_mhz: u32, points: usize, target: Option<f64>) -> Load {
    Load { config, clock_mhz, jobs: POINTS / points, points, target }
}

/// The rows of the page.
const LOADS: [Load; 13] = [
    load(FULL, 120, 200, Some(7.0)),
    load(FULL, 120, 1000, Some(7.0)),
    load(FULL, 120, 4000, Some(7.0)),
    load(SMALL, 120, 200, Some(5.0)),
    load(SMALL, 120, 1000, None),
    load(SMALL, 105, 200, Some(5.0)),
    load(SMALL, 105, 1000, None),
    load(FULL, 150, 200, Some(8.8)),
    load(FULL, 150, 1000, Some(8.8)),
    load(FULL, 150, 4000, Some(8.8)),
    load(DUAL, 150, 200, Some(11.0)),
    load(DUAL, 150, 1000, Some(11.0)),
    load(DUAL, 150, 4000, Some(11.0)),
];

/// The frame whose time the page tells, and the milliseconds that were aimed at.
const FRAME: Load = Load { config: FULL, clock_mhz: 120, jobs: 1, points: 4000, target: None };
const FRAME_TARGET_MS: f64 = 1.2;

impl Load {
    /// Does the batch, compares every mesh with that of the CPU triangulator, and returns the time from the call of the
    /// library to the last mesh. The session is open before, and the time that the host itself needs is none of it.
    ///
    /// # Errors
    /// The board is not part of this build, the link failed, or a mesh is wrong.
    pub fn measure(self) -> Result<Duration, Box<dyn Error>> {
        let board = NetworkBoard::at_clock(self.config, self.clock_mhz * 1_000_000)?;
        let ether = Rc::new(RefCell::new(VirtualEther::new(board, Duration::ZERO, &NetworkFaults::default())));
        ether.borrow_mut().set_longest_job(LONGEST_JOB_US);
        let mut device = Device::from_transport(Box::new(EtherTransport::new(Rc::clone(&ether), LIMIT)));
        let mut session = device.session()?;
        let mut random = SplitMix64::new(1);
        let sets: Vec<Vec<Point>> = (0..self.jobs).map(|_| random.points(self.points, SIDE)).collect();
        let begun = ether.borrow().now();
        let solved = session.triangulate_batch(&sets, &Options::default())?;
        let time = ether.borrow().now() - begun;
        let mut cpu = Device::cpu(None);
        for (job, (points, solution)) in sets.iter().zip(solved).enumerate() {
            if solution.mesh != cpu.session()?.triangulate(points)?.mesh {
                return Err(format!("the mesh of job {job} is wrong").into());
            }
        }
        Ok(time)
    }

    /// Million points a second of a batch that took this long.
    pub fn millions(self, time: Duration) -> f64 {
        (self.jobs * self.points) as f64 / time.as_secs_f64() / 1e6
    }

    fn row(self) -> Result<String, Box<dyn Error>> {
        let millions = self.millions(self.measure()?);
        let aim = self.target.map_or_else(
            || "-".to_owned(),
            |target| format!("{target:.1}, {}", if millions >= target { "met" } else { "missed" }),
        );
        let Self { config, clock_mhz, jobs, points, .. } = self;
        Ok(format!("| {} | {clock_mhz} | {jobs} x {points} | {millions:.2} | {aim} |\n", config.name))
    }
}

/// Measures the rows of the core of this name, and tells each to `say`.
///
/// # Errors
/// The errors of [`Load::measure`], and a name that no row has.
pub fn throughput_rows(core: &str, say: &dyn Fn(&str)) -> Result<(), Box<dyn Error>> {
    let mut loads = LOADS.into_iter().filter(|load| load.config.name == core).peekable();
    if loads.peek().is_none() {
        return Err(format!("the page has no row of a core '{core}'").into());
    }
    loads.try_for_each(|load| {
        say(load.row()?.trim_end());
        Ok(())
    })
}

/// Returns the text of `throughput-udp.md`, and tells `say` each row as soon as it is known.
///
/// # Errors
/// The errors of [`Load::measure`].
pub fn throughput_document(say: &dyn Fn(&str)) -> Result<String, Box<dyn Error>> {
    let mut text = String::from(
        "# Speed through the UDP link\n\n\
         For readers who want to know how many points a second a program with a network socket gets from a core behind\n\
         gigabit Ethernet. Made by `cargo run --release -p incircle-testbench --bin throughput-udp`: the library's\n\
         protocol runs before the Verilated `incircle_udp_top`, whose GMII pins are driven and sampled byte by byte. Time\n\
         is counted in clocks, so the figures are the same on every machine. The cable delays and loses nothing, the host\n\
         takes no time of its own, and at most 64 kB of answers are asked for at a time. Every mesh is compared with that\n\
         of the CPU triangulator. No board was measured.\n\n\
         | core | MHz | jobs x points | million points a second | aim |\n\
         |---|---:|---:|---:|---|\n",
    );
    for load in LOADS {
        let row = load.row()?;
        say(row.trim_end());
        text += &row;
    }
    let frame = FRAME.measure()?.as_secs_f64() * 1e3;
    let verdict = if frame <= FRAME_TARGET_MS { "met" } else { "missed" };
    write!(
        text,
        "\nMeshes are read with short ids of 12 bits, so the jobs that share a memory have at most 4095 points together.\n\
         The answer to a point then takes 9 bytes, so a gigabit carries 12.7 million points a second at most; with ids of 16\n\
         bits it would carry 9.7 million.\n\n\
         Fewer jobs of 1000 points and more share the memory of a core than on a PCIe card: their ids must be short, and their\n\
         meshes must fit the FIFO of the device, or the core would wait for the cable.\n\n\
         One frame of {} points on `{}` at {} MHz takes {frame:.2} ms from the call to the mesh; the aim was\n\
         {FRAME_TARGET_MS} ms, {verdict}.\n",
        FRAME.points, FRAME.config.name, FRAME.clock_mhz
    )?;
    Ok(text)
}
