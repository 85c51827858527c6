//! Voronoi cells by their definition: a clip, cut by the border with every other point. For small sets of small
//! numbers, and for nothing but comparison.

use num_bigint::BigInt;

/// A place `(x / d, y / d)` in lowest terms with a positive `d`, in this order.
pub type Fraction = [i128; 3];

fn common_factor(one: i128, other: i128) -> i128 {
    if other == 0 {
        one.abs()
    } else {
        common_factor(other, one % other)
    }
}

/// The place in lowest terms.
fn lowest([x, y, d]: Fraction) -> Fraction {
    let factor = common_factor(common_factor(x, y), d) * d.signum();
    [x / factor, y / factor, d / factor]
}

/// The half plane of the places that are at least as near to `p` as to `q`: coefficients of x, y and 1, such that
/// their sum is not negative there.
fn nearer(p: [i128; 2], q: [i128; 2]) -> [i128; 3] {
    let square = |point: [i128; 2]| point[0] * point[0] + point[1] * point[1];
    [2 * (p[0] - q[0]), 2 * (p[1] - q[1]), square(q) - square(p)]
}

fn value(half_plane: [i128; 3], place: Fraction) -> i128 {
    (0..3).map(|k| half_plane[k] * place[k]).sum()
}

/// The part of a convex polygon in a half plane; nothing if that has no area.
fn cut(polygon: &[Fraction], half_plane: [i128; 3]) -> Vec<Fraction> {
    let mut kept = Vec::new();
    for (k, &from) in polygon.iter().enumerate() {
        let to = polygon[(k + 1) % polygon.len()];
        let (one, other) = (value(half_plane, from), value(half_plane, to));
        if one >= 0 {
            kept.push(from);
        }
        if (one < 0 && other > 0) || (one > 0 && other < 0) {
            kept.push(lowest([0, 1, 2].map(|k| from[k] * other - to[k] * one)));
        }
    }
    if kept.iter().all(|&place| value(half_plane, place) == 0) {
        kept.clear();
    }
    kept
}

/// The cell of a point inside a convex clip, both with their corners counter-clockwise. Points at the place of the
/// point itself are left out. The result has no corner if the cell has no area in the clip.
pub fn clipped_cell(points: &[[i64; 2]], index: usize, clip: &[[i64; 2]]) -> Vec<Fraction> {
    let wide = |point: [i64; 2]| point.map(i128::from);
    let whole: Vec<Fraction> = clip.iter().map(|&corner| [corner[0].into(), corner[1].into(), 1]).collect();
    let others = points.iter().filter(|&&other| other != points[index]);
    others.fold(whole, |cell, &other| cut(&cell, nearer(wide(points[index]), wide(other))))
}

/// The distinct points behind the edges of a clipped cell, except for edges that run along the border of the clip, in
/// the order of the points.
pub fn cell_neighbors(points: &[[i64; 2]], index: usize, clip: &[[i64; 2]]) -> Vec<u32> {
    let cell = clipped_cell(points, index, clip);
    let wide = |point: [i64; 2]| point.map(i128::from);
    let on_clip = |place: Fraction, edge: usize| {
        let (a, b) = (wide(clip[edge]), wide(clip[(edge + 1) % clip.len()]));
        let [x, y] = [0, 1].map(|axis| place[axis] - a[axis] * place[2]);
        x * (b[1] - a[1]) == y * (b[0] - a[0])
    };
    let is_neighbor = |other: usize| {
        let half_plane = nearer(wide(points[index]), wide(points[other]));
        let ends: Vec<Fraction> = cell.iter().copied().filter(|&place| value(half_plane, place) == 0).collect();
        let is_first = points[..other].iter().all(|point| *point != points[other]);
        let runs_along = |edge: usize| ends.iter().all(|&place| on_clip(place, edge));
        is_first && points[other] != points[index] && ends.len() == 2 && !(0..clip.len()).any(runs_along)
    };
    (0..points.len()).filter(|&other| is_neighbor(other)).map(|other| other as u32).collect()
}

/// A sum of areas, as a numerator and a positive denominator of any size.
#[derive(Clone, Debug)]
pub struct Area {
    numerator: BigInt,
    denominator: BigInt,
}

impl Default for Area {
    fn default() -> Self {
        Self { numerator: BigInt::ZERO, denominator: 1.into() }
    }
}

impl Area {
    /// Adds twice the signed area of a polygon, times `factor`.
    pub fn add_twice(&mut self, polygon: &[Fraction], factor: i64) {
        for (k, from) in polygon.iter().enumerate() {
            let to = polygon[(k + 1) % polygon.len()];
            let cross = BigInt::from(from[0]) * to[1] - BigInt::from(from[1]) * to[0];
            let denominator = BigInt::from(from[2]) * to[2];
            self.numerator = &self.numerator * &denominator + cross * &self.denominator * factor;
            self.denominator *= denominator;
        }
    }
}

impl Area {
    /// The difference of two areas.
    pub fn minus(&self, other: &Self) -> Self {
        Self {
            numerator: &self.numerator * &other.denominator - &other.numerator * &self.denominator,
            denominator: &self.denominator * &other.denominator,
        }
    }

    /// The quotient of two areas, rounded to a multiple of 2^-80. The other must not be zero.
    pub fn over(&self, other: &Self) -> f64 {
        let quotient = ((&self.numerator * &other.denominator) << 80u32) / (&other.numerator * &self.denominator);
        i128::try_from(quotient).map_or(f64::NAN, |quotient| quotient as f64 / 2f64.powi(80))
    }
}

impl PartialEq for Area {
    fn eq(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator == &other.numerator * &self.denominator
    }
}

/// Twice the area of a cell inside a simple polygon: the signed sum over the triangles that the origin spans with the
/// edges.
pub fn twice_area_inside(points: &[[i64; 2]], index: usize, polygon: &[[i64; 2]]) -> Area {
    let mut area = Area::default();
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        match (a[0] * b[1] - a[1] * b[0]).signum() {
            1 => area.add_twice(&clipped_cell(points, index, &[[0, 0], a, b]), 1),
            -1 => area.add_twice(&clipped_cell(points, index, &[[0, 0], b, a]), -1),
            _ => {}
        }
    }
    area
}
