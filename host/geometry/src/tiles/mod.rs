//! Stub until the module of tiles is there.

use crate::point::Point;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    pub west: Option<i64>,
    pub east: Option<i64>,
    pub south: Option<i64>,
    pub north: Option<i64>,
}

impl Region {
    pub const WHOLE: Self = Self { west: None, east: None, south: None, north: None };
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    Within,
    Beyond,
    Unknown,
}

pub fn reach(region: &Region, [a, b, c]: [Point; 3]) -> Reach {
    let d = |p: Point| [i128::from(p.x) - i128::from(a.x), i128::from(p.y) - i128::from(a.y)];
    let (b, c) = (d(b), d(c));
    let cross = b[0] * c[1] - b[1] * c[0];
    let (lb, lc) = (b[0] * b[0] + b[1] * b[1], c[0] * c[0] + c[1] * c[1]);
    // The centre is u / (2 cross) from a.
    let u = [lb * c[1] - lc * b[1], lc * b[0] - lb * c[0]];
    let ok = |x: i128, ux: i128, uy: i128| -> Option<bool> {
        // disc strictly inside x' < x: sqrt(ux²+uy²) < 2 cross x - ux
        let k = 2 * cross * x;
        if k <= 0 {
            return Some(false);
        }
        // Wide values are rounded away by the checks.
        let left = k.checked_mul(k.checked_sub(2 * ux)?)?;
        Some(left > uy.checked_mul(uy)?)
    };
    let (ax, ay) = (i128::from(a.x), i128::from(a.y));
    let tests = [
        region.east.map(|x| ok(i128::from(x) - ax, u[0], u[1])),
        region.west.map(|x| ok(ax - (i128::from(x) - 1), -u[0], u[1])),
        region.north.map(|y| ok(i128::from(y) - ay, u[1], u[0])),
        region.south.map(|y| ok(ay - (i128::from(y) - 1), -u[1], u[0])),
    ];
    if tests.iter().flatten().any(Option::is_none) {
        return Reach::Unknown;
    }
    if tests.iter().flatten().all(|t| *t == Some(true)) {
        Reach::Within
    } else {
        Reach::Beyond
    }
}
