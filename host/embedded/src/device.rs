//! The device behind a serial port: greeting, session and job.

use embedded_io::{Read, ReadReady, Write};
use incircle_protocol::{
    rate_step, Clear, Command, DeviceFrame, Greeting, HostFrame, Identity, InsertReport, Layout, RecordRange,
    FIRST_RATE, GREETING_WORDS, INSERT_REPORT_WORDS, MAX_SILENCE_MS,
};

use crate::clock::{has_come, Clock};
use crate::error::{Error, Fault};
use crate::frame::word_at;
use crate::greeting::check;
use crate::line::Line;
use crate::load::{Load, Request};
use crate::mesh::{Assembly, Mesh};
use crate::order::{prepare, Order};
use crate::rate::{Rate, MOST_FAILURES, SILENCE_SLACK};
use crate::session::{Limit, Session, GROW_AFTER, MAX_ANSWER_WORDS};
use crate::{records_needed, Point};

/// Milliseconds for which the host greets. A device that another host left at a high rate first needs its silence,
/// after which it is back at the first rate.
const GREET_FOR: u32 = MAX_SILENCE_MS + 1000;
/// Milliseconds from one greeting or `Open` to the next.
const GREET_EVERY: u32 = 200;
/// Fewest records to which noise makes a range shrink.
const LEAST_RANGE: usize = 8;
/// Most points that indices of 16 bits can number.
const MOST_POINTS: usize = 1 << 16;

/// The buffers that the caller lends for a job. What they hold before does not matter.
#[derive(Debug)]
pub struct Buffers<'b> {
    /// Indices of the points in the order of insertion: an entry for each point.
    pub order: &'b mut [u16],
    /// Records of the mesh: [`records_needed`] entries. The triangles of the mesh are the first of them.
    pub records: &'b mut [[u16; 3]],
}

/// A device behind a serial port.
///
/// The value takes 1.2 kB of memory, most of it for the longest frame, and [`Device::new`] can make it in a `static`.
pub struct Device<P, C> {
    line: Line<P, C>,
    greeting: Option<Greeting>,
    /// Number of the last session.
    session: u8,
    /// The rate that the caller wants.
    rate: Option<Rate<P>>,
}

impl<P: Read + ReadReady + Write, C: Clock> Device<P, C> {
    /// A device at this port. Nothing is sent yet.
    pub const fn new(port: P, clock: C) -> Self {
        Self { line: Line::new(port, clock), greeting: None, session: 0, rate: None }
    }

    /// The same device, whose jobs run at this rate in bits per second, if it works. `set` sets the port to a rate, and
    /// is called when all bytes of the host have left it. Between jobs the port is at 115,200 bits per second.
    ///
    /// A rate that the device cannot reach is not asked for. A rate at which the device does not answer costs 3
    /// seconds, and the job runs at 115,200 bits per second; after two failures it is not tried again.
    pub fn with_rate(mut self, bits_per_second: u32, set: fn(&mut P, u32)) -> Self {
        self.rate = Some(Rate { bits_per_second, set, failures: 0 });
        self
    }

    /// Greets the device, for 3 seconds at most, and returns the properties of its core. No session is opened. A job
    /// greets a device that has not been greeted. Greet again where another board may be at the port.
    ///
    /// # Errors
    /// [`Error::Silent`] or [`Error::Noise`] if no device answers, [`Error::Device`] if its greeting is not one of a
    /// device that this driver serves, and errors of the port.
    pub fn greet(&mut self) -> Result<Identity, Error<P::Error>> {
        let line = &mut self.line;
        let since = line.now();
        // Any number from 1 to 255 will do, so long as it is not that of the last session.
        self.session = self.session.max(since as u8);
        loop {
            line.say(self.session.max(1), HostFrame::Hello)?;
            let until = line.now().wrapping_add(GREET_EVERY);
            while let Some(header) = line.hear(until)? {
                if header.kind == DeviceFrame::Hello {
                    let greeting = greeting(line.body())?;
                    self.greeting = Some(greeting);
                    return Ok(greeting.identity);
                }
                // A device may say other frames without an end.
                if has_come(until, line.now()) {
                    break;
                }
            }
            if has_come(since.wrapping_add(GREET_FOR), line.now()) {
                return Err(match line.received() {
                    0 => Error::Silent,
                    bytes => Error::Noise { bytes },
                });
            }
        }
    }

    /// The greeting of the device, which is greeted if need be.
    fn greeting(&mut self) -> Result<Greeting, Error<P::Error>> {
        if self.greeting.is_none() {
            self.greet()?;
        }
        self.greeting.ok_or(Error::Silent)
    }

    /// The port and the clock.
    pub fn into_parts(self) -> (P, C) {
        self.line.into_parts()
    }

    /// Triangulates the points, and leaves the canonical mesh in the buffers.
    ///
    /// The order of insertion and the sorting of triangles cost O(n log n). The line carries 16 bytes and some more for
    /// each point, which takes 1.5 ms at 115,200 bits per second. Points on one line need no session.
    ///
    /// # Errors
    /// [`Error::Buffer`], [`Error::TooManyPoints`], [`Error::Capacity`] and [`Error::Coordinate`] before a session
    /// opens; the errors of [`Device::greet`]; [`Error::Timeout`] after `timeout_ms` milliseconds; errors of the line
    /// and of the port; [`Error::Device`] if the device says what no sound device says.
    pub fn triangulate<'b>(
        &mut self,
        points: &'b [Point],
        buffers: Buffers<'b>,
        timeout_ms: u32,
    ) -> Result<Mesh<'b>, Error<P::Error>> {
        let limit = Limit { since: self.line.now(), milliseconds: timeout_ms };
        let order = part("order", buffers.order, points.len())?;
        let greeting = self.greeting()?;
        let Identity { capacity, coord_bits, contexts, .. } = greeting.identity;
        check_points(points, coord_bits)?;
        let Order { distinct, is_collinear } = prepare(points, order);
        let order: &'b [u16] = order;
        let (order, duplicates) = order.split_at(distinct);
        if is_collinear {
            return Ok(Mesh::on_a_line(points, order, duplicates));
        }
        if distinct > capacity as usize {
            return Err(Error::Capacity { given: distinct, capacity });
        }
        let records = part("records", buffers.records, records_needed(distinct))?;
        let layout = Layout::of(coord_bits, capacity);
        let load = Load { points, order, contexts: contexts as usize, layout };
        let mut assembly = Assembly::new(load, capacity, records);
        self.insert_and_read(&load, &mut assembly, &greeting, limit)?;
        Ok(assembly.finish(duplicates)?)
    }

    /// Does a job in a session of its own, and leaves the port at the first rate.
    fn insert_and_read(
        &mut self,
        load: &Load<'_>,
        assembly: &mut Assembly<'_>,
        greeting: &Greeting,
        limit: Limit,
    ) -> Result<(), Error<P::Error>> {
        let done = self.job(load, assembly, greeting, limit);
        if let Some(Rate { set, .. }) = self.rate {
            self.line.set_rate(set, FIRST_RATE);
        }
        done
    }

    fn job(
        &mut self,
        load: &Load<'_>,
        assembly: &mut Assembly<'_>,
        greeting: &Greeting,
        limit: Limit,
    ) -> Result<(), Error<P::Error>> {
        let distinct = load.order.len();
        let layout = load.layout;
        let mut free = self.open(limit)?;
        if !self.raise_rate(greeting, limit, free)? {
            free = self.open(limit)?;
        }
        let mut session = Session::new(&mut self.line, self.session, greeting, limit, free);
        session.ask(Request::bare(Command::Clear(Clear::one_mesh(0))))?;
        check_report(session.ask(Request::insert(load))?, distinct)?;
        let records = records_needed(distinct);
        let mut range = Range::new(layout);
        let mut first = 0;
        while first < records {
            let count = range.records.min(records - first);
            let asked = RecordRange { first: first as u32, count: count as u32 };
            let has_come = session.ask_once(Request::bare(Command::Triangles(asked)))?;
            range.learn(has_come);
            if has_come {
                (0..count).try_for_each(|record| assembly.take(vertices(layout, session.payload(), record)))?;
                first += count;
            }
        }
        session.close()
    }

    /// Brings an open session to the rate that the caller wants, if there is one and the device can reach it. Returns
    /// false if that failed: the device is then back at the first rate, without a session.
    fn raise_rate(&mut self, greeting: &Greeting, limit: Limit, free: u16) -> Result<bool, Error<P::Error>> {
        let Some(Rate { bits_per_second, set, failures: 0..MOST_FAILURES }) = self.rate else { return Ok(true) };
        let Some(step) = rate_step(bits_per_second, greeting.clock_hz) else { return Ok(true) };
        let session = Session::new(&mut self.line, self.session, greeting, limit, free);
        if session.raise(bits_per_second, step, set)? {
            return Ok(true);
        }
        if let Some(rate) = &mut self.rate {
            rate.failures += 1;
        }
        self.line.set_rate(set, FIRST_RATE);
        let until = self.line.now().wrapping_add(greeting.silence_ms + SILENCE_SLACK);
        while !has_come(until, self.line.now()) {
            self.line.hear(until)?;
        }
        Ok(false)
    }

    /// Opens a session, which resets the core. Returns the free bytes of the device's FIFO.
    fn open(&mut self, limit: Limit) -> Result<u16, Error<P::Error>> {
        self.session = self.session % u8::MAX + 1;
        let number = self.session;
        let since = self.line.now();
        loop {
            self.line.say(number, HostFrame::Open)?;
            let until = self.line.now().wrapping_add(GREET_EVERY);
            while let Some(header) = self.line.hear(until)? {
                limit.check(self.line.now())?;
                if header.kind == DeviceFrame::Opened && header.session == number {
                    return Ok(header.free);
                }
            }
            let now = self.line.now();
            limit.check(now)?;
            if has_come(since.wrapping_add(GREET_FOR), now) {
                return Err(Error::Lost { milliseconds: now.wrapping_sub(since) });
            }
        }
    }
}

/// Refuses points that this driver cannot number, or that are not on the grid of the device.
fn check_points<E>(points: &[Point], bits: u32) -> Result<(), Error<E>> {
    if points.len() > MOST_POINTS {
        return Err(Error::TooManyPoints { given: points.len(), most: MOST_POINTS });
    }
    let is_beyond = |&[x, y]: &Point| u32::from(x | y).checked_shr(bits).is_some_and(|rest| rest != 0);
    match points.iter().enumerate().find(|(_, point)| is_beyond(point)) {
        Some((index, &[x, y])) => Err(Error::Coordinate { index, x, y, bits }),
        None => Ok(()),
    }
}

/// The number of records that are asked for at a time: even, so that packed records end with a whole word, and few
/// enough for a frame. Noise makes it smaller.
struct Range {
    records: usize,
    most: usize,
    /// Answers in a row that came.
    clean: u32,
}

impl Range {
    fn new(layout: Layout) -> Self {
        let ids = if layout.record_words == 3 { 2 * MAX_ANSWER_WORDS } else { MAX_ANSWER_WORDS };
        let most = (ids / 3) & !1;
        Self { records: most, most, clean: 0 }
    }

    fn learn(&mut self, has_come: bool) {
        self.clean = if has_come { self.clean + 1 } else { 0 };
        if !has_come {
            self.records = ((self.records / 2) & !1).max(LEAST_RANGE);
        } else if self.clean >= GROW_AFTER {
            (self.records, self.clean) = ((2 * self.records).min(self.most), 0);
        }
    }
}

/// The first entries of a buffer.
fn part<'b, T, E>(name: &'static str, buffer: &'b mut [T], needed: usize) -> Result<&'b mut [T], Error<E>> {
    let given = buffer.len();
    buffer.get_mut(..needed).ok_or(Error::Buffer { name, given, needed })
}

/// The greeting in the body of a `Hello`, checked.
fn greeting(body: &[u8]) -> Result<Greeting, Fault> {
    let mut words = [0; GREETING_WORDS];
    for (word, place) in words.iter_mut().zip(0..) {
        *word = word_at(body, place).unwrap_or(0);
    }
    let greeting = Greeting::from_words(words);
    check(&greeting)?;
    Ok(greeting)
}

/// Checks the report of the insertion of all points.
fn check_report(payload: &[u8], distinct: usize) -> Result<(), Fault> {
    let mut words = [0; INSERT_REPORT_WORDS];
    for (word, place) in words.iter_mut().zip(0..) {
        *word = word_at(payload, place).unwrap_or(0);
    }
    let report = InsertReport::from_words(words);
    let count = distinct as u32;
    for (what, found, expected) in [
        ("points that arrived", report.arrived, count),
        ("vertices", report.inserted, count),
        ("duplicates", report.duplicates, 0),
        ("refused points", report.refused, 0),
        ("records", report.records, records_needed(distinct) as u32),
    ] {
        if found != expected {
            return Err(Fault::Report { what, found, expected });
        }
    }
    Ok(())
}

/// The vertices of a record in the payload of a `Triangles` answer.
fn vertices(layout: Layout, payload: &[u8], record: usize) -> [u32; 3] {
    let id = |place: usize| {
        if layout.record_words != 3 {
            return word_at(payload, place).unwrap_or(u32::MAX);
        }
        let half = payload.get(2 * place..).and_then(|rest| rest.first_chunk());
        half.map_or(u32::MAX, |&half| u16::from_le_bytes(half).into())
    };
    [id(3 * record), id(3 * record + 1), id(3 * record + 2)]
}
