//! The sieve takes the selected points out of the records of a LAS file.

use std::cmp::Ordering;
use std::mem;

use crate::failure::Failure;
use crate::formats::pieces::Take;
use crate::formats::selection::{Bounds, Selection};
use crate::memory::Memory;
use crate::number;
use crate::points::{Coordinates, PointTable};

use super::header::{refuse, Header};
use super::scale::{Plane, Scale};

/// The number of points from which on they are a piece.
const PIECE: usize = 1 << 16;

/// The selection, and the points taken so far.
pub struct Sieve<'a> {
    scale: Scale,
    record_bytes: usize,
    /// The byte of a record that has the class, and a mask for the bits of the class in that byte.
    class: (usize, u8),
    classes: Option<Box<[bool; 256]>>,
    /// The least and the greatest integer within the bounds, for x and for y.
    within: [(i64, i64); 2],
    points: Points,
    heights: Vec<f64>,
    /// The number of records seen so far.
    seen: u64,
    /// The most points for which there is memory.
    most: u64,
    /// Takes the points whenever there are enough for a piece.
    outlet: Option<Take<'a>>,
}

/// The coordinates of points.
enum Points {
    Steps(Plane, Vec<[i64; 2]>),
    Doubles(Vec<[f64; 2]>),
}

impl Points {
    /// Takes all points out.
    fn take(&mut self) -> Coordinates {
        match self {
            Self::Steps(plane, steps) => Coordinates::Steps { steps: mem::take(steps), unit: plane.unit },
            Self::Doubles(doubles) => Coordinates::Doubles(mem::take(doubles)),
        }
    }
}

impl<'a> Sieve<'a> {
    /// Makes the sieve of a file. Its points must fit the memory.
    pub fn new(header: &Header, selection: &Selection, memory: Memory) -> Self {
        let scale = Scale::of(header);
        let within = match &selection.bounds {
            Some(bounds) => [0, 1].map(|axis| within(&scale, bounds, axis)),
            None => [(i64::MIN, i64::MAX); 2],
        };
        let classes = (!selection.classes.is_empty()).then(|| {
            let mut taken = Box::new([false; 256]);
            selection.classes.iter().for_each(|&class| taken[usize::from(class)] = true);
            taken
        });
        let points = scale.plane().map_or(Points::Doubles(Vec::new()), |plane| Points::Steps(plane, Vec::new()));
        Self {
            scale,
            record_bytes: header.record_bytes,
            // The formats before LAS 1.4 have the class in five bits, beside three flags.
            class: if header.is_extended() { (16, 0xff) } else { (15, 0x1f) },
            classes,
            within,
            points,
            heights: Vec::new(),
            seen: 0,
            most: memory.most_points(),
            outlet: None,
        }
    }

    /// Makes the sieve of a file whose points are taken in pieces. There may be any number of them.
    pub fn of_pieces(header: &Header, selection: &Selection, take: Take<'a>) -> Self {
        Self { outlet: Some(take), ..Self::new(header, selection, Memory::ENDLESS) }
    }

    /// Whether points are selected by class.
    pub fn wants_class(&self) -> bool {
        self.classes.is_some()
    }

    /// Takes the selected points out of whole records, which follow those of the last call.
    pub fn take(&mut self, records: &[u8]) -> Result<(), Failure> {
        for record in records.chunks_exact(self.record_bytes) {
            self.seen += 1;
            let integer = |place: usize| i32::from_le_bytes([0, 1, 2, 3].map(|byte| record[place + byte]));
            let [x, y] = [integer(0), integer(4)];
            let class = usize::from(record[self.class.0] & self.class.1);
            let is_within = |integer: i32, axis: usize| {
                let (low, high) = self.within[axis];
                low <= i64::from(integer) && i64::from(integer) <= high
            };
            let is_taken = self.classes.as_ref().is_none_or(|classes| classes[class]);
            if !(is_taken && is_within(x, 0) && is_within(y, 1)) {
                continue;
            }
            match &mut self.points {
                Points::Steps(plane, steps) => steps.push([plane.steps(x, 0), plane.steps(y, 1)]),
                Points::Doubles(doubles) => doubles.push(finite(&self.scale, [x, y], self.seen)?),
            }
            let height = self.scale.height(integer(8));
            if !height.is_finite() {
                return Err(beyond_doubles(self.seen));
            }
            self.heights.push(height);
        }
        if self.heights.len() as u64 > self.most {
            let most = self.most;
            return Err(refuse(format!(
                "the file has more than {most} points, which is what the free memory holds: select some with --class \
                 or --bounds, or use a machine with more memory"
            )));
        }
        match self.outlet.is_some() && self.heights.len() >= PIECE {
            true => self.finish(),
            false => Ok(()),
        }
    }

    /// Gives the points that were not taken yet as a piece.
    pub fn finish(&mut self) -> Result<(), Failure> {
        self.heights.clear();
        let Some(take) = &mut self.outlet else { return Ok(()) };
        take(&self.points.take())
    }

    /// The points that were taken.
    pub fn into_table(mut self) -> PointTable {
        PointTable::of_coordinates("point", self.points.take()).with_heights(self.heights)
    }
}

/// The coordinates of a point as doubles. A scale or an offset near the largest double can make a coordinate infinite,
/// which is refused.
fn finite(scale: &Scale, integers: [i32; 2], number: u64) -> Result<[f64; 2], Failure> {
    let point = [scale.double(integers[0], 0), scale.double(integers[1], 1)];
    if point.iter().all(|value| value.is_finite()) {
        return Ok(point);
    }
    Err(beyond_doubles(number))
}

/// The failure of a point with an infinite coordinate.
fn beyond_doubles(number: u64) -> Failure {
    refuse(format!("point {number} is beyond the largest double: the scale or the offset in the header is too large"))
}

/// The lowest and the highest integer of an axis whose coordinates are within the bounds.
fn within(scale: &Scale, bounds: &Bounds, axis: usize) -> (i64, i64) {
    let compare = |integer: i32, bound| number::compare(scale.coordinate(integer, axis), bound);
    let low = first(|integer| compare(integer, bounds.low[axis]) != Ordering::Less);
    let beyond = first(|integer| compare(integer, bounds.high[axis]) == Ordering::Greater);
    (low, beyond - 1)
}

/// The lowest 32-bit integer for which `holds` is true; 2^31 if there is none. `holds` must be true for all higher
/// integers, too.
fn first(holds: impl Fn(i32) -> bool) -> i64 {
    let (mut low, mut high) = (i64::from(i32::MIN), i64::from(i32::MAX) + 1);
    while low < high {
        let middle = (low + high).div_euclid(2);
        // The middle lies below 2^31, so it has 32 bits.
        if holds(middle as i32) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}
