//! Computes the result of a visit from the geometry alone, without a formula of the hardware: orientation
//! is a sum over the corners, incircle the 3 x 3 determinant of the lifted points, the walk a minimum, the
//! tie a minimum of four points.

use crate::rig::stepper::bundles::{turned, Finding, LockFinding};

/// Parts of a verdict at the ports: the conflict, the bits that hold however the record is turned, and the bits that
/// hold only if it is not turned.
pub const VERDICT_PARTS: [&str; 3] = ["verdict[0+:1]", "verdict[1+:2]", "verdict[3+:17]"];

/// The parts of a verdict about `p`; `None` where a part is arbitrary: a tie unless the corners turn left and `p` is
/// none of them, or bits for which no turned record is visited.
pub fn verdict_parts(verdict: u128, slot: usize, r: [Point; 3], p: Point) -> [Option<u128>; 3] {
    let counts = incircle(r, p) != 0 || orientation(r[0], r[1], r[2]) > 0 && !r.contains(&p);
    [counts.then_some(verdict & 1), Some(verdict >> 1 & 3), (slot == 0).then_some(verdict >> 3)]
}

/// A point; points compare by `x`, then by `y`.
pub type Point = (i64, i64);

/// A point as the ports take it.
pub fn word(point: Point) -> u64 {
    (point.0 | point.1 << 16) as u64
}

pub fn point(word: u64) -> Point {
    ((word & 0xffff) as i64, (word >> 16) as i64)
}

/// Twice the signed area of a triangle, by the shoelace formula.
pub fn orientation(a: Point, b: Point, c: Point) -> i64 {
    let corner = |u: Point, v: Point| u.0 * v.1 - v.0 * u.1;
    corner(a, b) + corner(b, c) + corner(c, a)
}

/// Determinant of the points lifted to a paraboloid, relative to `p`: positive if `p` lies inside
/// the circle of a counter-clockwise triangle.
pub fn incircle(triangle: [Point; 3], p: Point) -> i128 {
    let [a, b, c] = triangle.map(|vertex| {
        let (x, y) = (i128::from(vertex.0 - p.0), i128::from(vertex.1 - p.1));
        [x, y, x * x + y * y]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The locks with their holders, as plain code.
#[derive(Clone, Debug)]
pub struct Locks(Vec<Option<u64>>);

impl Locks {
    pub fn new(locks: usize) -> Self {
        Self(vec![None; locks])
    }

    /// Holder of a lock, if there is one.
    pub fn holder(&self, id: usize) -> Option<u64> {
        self.0[id]
    }

    /// A visit of this context wants the lock, which may be cleared at the same edge. Returns whether the visit took
    /// the lock, and whether the lock is foreign.
    pub fn take(&mut self, id: usize, context: u64, is_cleared: bool) -> (bool, bool) {
        match self.0[id] {
            _ if is_cleared => (false, true),
            Some(holder) => (false, holder != context),
            None => {
                self.0[id] = Some(context);
                (true, false)
            }
        }
    }

    pub fn clear(&mut self, id: usize) {
        self.0[id] = None;
    }
}

/// A record, stored or turned.
#[derive(Clone, Copy, Debug, Default)]
pub struct Record {
    pub v: [u64; 3],
    pub n: [u64; 3],
}

impl Record {
    /// Slot that comes first when a visit from `cavity_record` turns the record.
    pub fn slot(&self, rotates: bool, cavity_record: u64) -> usize {
        self.n.iter().position(|link| rotates && *link == cavity_record).unwrap_or(0)
    }

    pub fn turned(&self, slot: usize) -> Self {
        let mut turned = *self;
        turned.v.rotate_left(slot);
        turned.n.rotate_left(slot);
        turned
    }

    /// Packs this record, already turned, as a `Turned`; `lock` is took, foreign and again.
    pub fn pack_turned(&self, slot: usize, lock: [bool; 3], infinite: u64) -> u128 {
        let [took, foreign, again] = lock;
        let lock = LockFinding { took, foreign, again };
        turned(self.v, self.n, slot as u64, lock, self.v.map(|vertex| vertex == infinite))
    }

    /// Verdict about `p` of a visit that turns this stored record by `slot`. `r` has the corners of the record, with
    /// any point for the infinite vertex.
    pub fn verdict(&self, slot: usize, mut r: [Point; 3], p: Point, infinite: u64) -> u128 {
        r.rotate_left(slot);
        self.turned(slot).verdict_turned(r, p, infinite)
    }

    fn verdict_turned(&self, r: [Point; 3], p: Point, infinite: u64) -> u128 {
        let side = [0, 1, 2].map(|k| orientation(r[(k + 1) % 3], r[(k + 2) % 3], p));
        let (conflict, located, falls_onto_corner, next);
        if let Some(k) = self.v.iter().position(|vertex| *vertex == infinite) {
            let (a, b) = (r[(k + 1) % 3], r[(k + 2) % 3]);
            let is_between = a.min(b) < p && p < a.max(b);
            conflict = side[k] > 0 || (side[k] == 0 && is_between);
            located = side[k] > 0;
            falls_onto_corner = false;
            next = k;
        } else {
            let inside = incircle(r, p);
            let lowest = side.iter().min();
            next = side.iter().position(|side| Some(side) == lowest).unwrap_or(0);
            // A point on the circle lies beyond one side at most.
            let takes_tie = p.min(r[next]) < r[(next + 1) % 3].min(r[(next + 2) % 3]);
            conflict = inside > 0 || (inside == 0 && takes_tie);
            located = side.iter().all(|side| *side >= 0);
            falls_onto_corner = r.contains(&p);
        }
        let (is_left, is_straight, walk_next) = (side[2] > 0, side[2] == 0, self.n[next]);
        Finding { conflict, located, falls_onto_corner, is_left, is_straight, walk_next }.verdict()
    }
}
