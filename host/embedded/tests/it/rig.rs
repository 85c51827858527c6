//! A simulated board behind a line that carries a byte in each direction at a time, in virtual time.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::rc::Rc;

use embedded_io::{ErrorType, Read, ReadReady, Write};
use incircle_embedded::{records_needed, Buffers, Clock, Device, Error, Point};
use incircle_model::serial::{Instantly, SerialModel, WordDevice};
use incircle_protocol::{Identity, LinkConfig, FIRST_RATE, PHASE_BITS, SMALL};

/// The link of the simulated boards. The clock is slow, so that a model by clock keeps up.
pub const LINK: LinkConfig = LinkConfig { clock_hz: 1_000_000, fifo_bytes: 4096, silence_ms: 2000 };
/// The same at the clock of a board.
pub const FAST_LINK: LinkConfig = LinkConfig { clock_hz: 125_000_000, fifo_bytes: 4096, silence_ms: 2000 };
/// Bytes that the port of the microcontroller keeps, as many serial ports do in hardware. Later ones are lost.
const PORT_BYTES: usize = 16;
/// Milliseconds that a job may take.
pub const PATIENCE: u32 = 120_000;

/// The fate of a byte on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    Passes,
    Lost,
    Twice,
    /// Bits of the byte are changed.
    Flipped(u8),
}

/// Chooses the fate of a byte by its direction, which is true towards the host, and its number in that direction.
pub type Faults = Box<dyn FnMut(bool, u64) -> Fate>;

/// The board and the line.
pub struct Board<D> {
    pub model: SerialModel<D>,
    pub faults: Faults,
    pub nanoseconds: u64,
    /// Bytes so far, towards the device and towards the host.
    pub bytes: [u64; 2],
    /// Bytes that the port did not keep.
    pub overflows: u64,
    /// Bits per second at which the host's port runs.
    pub rate: u32,
    /// Highest rate that the line carries.
    pub usable: u32,
    link: LinkConfig,
    received: VecDeque<u8>,
    clocks_left: u64,
}

impl<D: WordDevice> Board<D> {
    pub fn new(identity: Identity, core: D) -> Rc<RefCell<Self>> {
        Self::with_link(LINK, identity, core)
    }

    pub fn with_link(link: LinkConfig, identity: Identity, core: D) -> Rc<RefCell<Self>> {
        Rc::new(RefCell::new(Self {
            model: SerialModel::new(link, identity, core),
            rate: FIRST_RATE,
            usable: u32::MAX,
            link,
            faults: Box::new(|_, _| Fate::Passes),
            nanoseconds: 5_000_000_000,
            bytes: [0; 2],
            overflows: 0,
            received: VecDeque::new(),
            clocks_left: 0,
        }))
    }

    /// The bytes that arrive in place of this one.
    fn carry(&mut self, to_host: bool, byte: u8, is_readable: bool) -> Vec<u8> {
        let count = &mut self.bytes[usize::from(to_host)];
        *count += 1;
        match (self.faults)(to_host, *count - 1) {
            Fate::Passes if !is_readable => vec![byte ^ 0x5a],
            Fate::Passes => vec![byte],
            Fate::Lost => vec![],
            Fate::Twice => vec![byte; 2],
            Fate::Flipped(bits) => vec![byte ^ bits],
        }
    }

    /// Whether both sides have the same rate, and the line carries it. Otherwise bits come out wrong.
    fn is_readable(&self) -> bool {
        let device = (u64::from(self.model.rate_step()) * u64::from(self.link.clock_hz)) >> PHASE_BITS;
        device.abs_diff(self.rate.into()) < u64::from(self.rate) / 50 && self.rate <= self.usable
    }

    /// Lets the time of a byte pass, in which the host may send one.
    fn pass(&mut self, sent: Option<u8>) {
        let byte_ns = 10 * 1_000_000_000 / u64::from(self.rate);
        self.nanoseconds += byte_ns;
        let is_readable = self.is_readable();
        for byte in sent.map_or(vec![], |byte| self.carry(false, byte, is_readable)) {
            self.model.take(byte);
        }
        self.clocks_left += byte_ns * u64::from(self.link.clock_hz);
        self.model.pass(self.clocks_left / 1_000_000_000);
        self.clocks_left %= 1_000_000_000;
        // The last byte before the device changes its rate still has the old one.
        let is_readable = self.is_readable();
        if let Some(byte) = self.model.give() {
            for byte in self.carry(true, byte, is_readable) {
                if self.received.len() < PORT_BYTES {
                    self.received.push_back(byte);
                } else {
                    self.overflows += 1;
                }
            }
        }
    }
}

/// The port or the clock of the microcontroller.
pub struct End<D>(pub Rc<RefCell<Board<D>>>);

impl<D> End<D> {
    /// Sets the port to a rate.
    pub fn set_rate(&mut self, rate: u32) {
        self.0.borrow_mut().rate = rate;
    }
}

impl<D> ErrorType for End<D> {
    type Error = Infallible;
}

impl<D: WordDevice> Read for End<D> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        let mut board = self.0.borrow_mut();
        let count = buffer.len().min(board.received.len());
        assert!(count > 0, "a read would block");
        board.received.drain(..count).zip(buffer).for_each(|(byte, place)| *place = byte);
        Ok(count)
    }
}

impl<D: WordDevice> ReadReady for End<D> {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.0.borrow().received.is_empty())
    }
}

impl<D: WordDevice> Write for End<D> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let sent = bytes.first().copied();
        self.0.borrow_mut().pass(sent);
        Ok(sent.map_or(0, |_| 1))
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl<D: WordDevice> Clock for End<D> {
    fn milliseconds(&mut self) -> u32 {
        (self.0.borrow().nanoseconds / 1_000_000) as u32
    }

    fn idle(&mut self) {
        self.0.borrow_mut().pass(None);
    }
}

/// A board with the core `small`, whose answers come at once.
pub fn small() -> Rc<RefCell<Board<Instantly>>> {
    let core = Instantly::of(SMALL).unwrap();
    Board::new(core.identity(), core)
}

/// A board with the core `small` at the clock of a real one.
pub fn fast() -> Rc<RefCell<Board<Instantly>>> {
    let core = Instantly::of(SMALL).unwrap();
    Board::with_link(FAST_LINK, core.identity(), core)
}

/// A mesh with lists of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    pub triangles: Vec<[u16; 3]>,
    pub hull: Vec<u16>,
    pub duplicates: Vec<(u16, u16)>,
}

/// Does a job on the board of this device, within this many milliseconds.
pub fn ask<D: WordDevice>(
    device: &mut Device<End<D>, End<D>>,
    points: &[Point],
    patience: u32,
) -> Result<Lists, Error<Infallible>> {
    let (mut order, mut records) = (vec![0; points.len()], vec![[7; 3]; records_needed(points.len())]);
    let buffers = Buffers { order: &mut order, records: &mut records };
    let mesh = device.triangulate(points, buffers, patience)?;
    Ok(Lists {
        triangles: mesh.triangles().to_vec(),
        hull: mesh.hull().collect(),
        duplicates: mesh.duplicates().collect(),
    })
}

/// Greets the board and does a job.
pub fn run<D: WordDevice>(board: &Rc<RefCell<Board<D>>>, points: &[Point]) -> Result<Lists, Error<Infallible>> {
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    ask(&mut device, points, PATIENCE)
}

/// The mesh by the CPU triangulator.
pub fn by_cpu(points: &[Point]) -> Lists {
    let wide: Vec<(u32, u32)> = points.iter().map(|&[x, y]| (x.into(), y.into())).collect();
    let mesh = incircle::triangulate(&wide).unwrap();
    mesh.verify().unwrap();
    let narrow = |index: u32| u16::try_from(index).unwrap();
    Lists {
        triangles: mesh.triangles.iter().map(|triangle| triangle.map(narrow)).collect(),
        hull: mesh.hull.iter().copied().map(narrow).collect(),
        duplicates: mesh.duplicates.iter().map(|found| (narrow(found.index), narrow(found.of))).collect(),
    }
}

/// Random points on a square of this side.
pub fn random_points(count: usize, side: u32, seed: u64) -> Vec<Point> {
    let mut random = incircle_testkit::SplitMix64::new(seed);
    (0..count).map(|_| [random.below_u32(side) as u16, random.below_u32(side) as u16]).collect()
}
