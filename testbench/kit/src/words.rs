//! Point sets as words: x in the lower 16 bits, y in the upper 16.

use crate::random32::Random32;

/// Puts three points that span a triangle in front of the points.
pub fn started(points: Vec<u32>) -> Vec<u32> {
    [vec![0, 1, 0x1_0000], points].concat()
}

/// Random points of a box; in a small box most of them fall together.
pub fn boxed(random: &mut Random32, count: u32, side: u32) -> Vec<u32> {
    (0..count).map(|_| random.below(side) | random.below(side) << 16).collect()
}

/// Random points of a box where every other point is one of the eight before it: duplicates of points that
/// are still being inserted.
pub fn stuttering(random: &mut Random32, count: u32, side: u32) -> Vec<u32> {
    let mut points: Vec<u32> = Vec::new();
    for _ in 0..count {
        let back = random.below(16) as usize;
        let point = match back {
            1..=8 if back <= points.len() => points[points.len() - back],
            _ => random.below(side) | random.below(side) << 16,
        };
        points.push(point);
    }
    points
}

/// Points of a parabola: all lie on the hull, and a point above it has a large cavity.
pub fn parabola(random: &mut Random32, count: u32) -> Vec<u32> {
    let mut points: Vec<u32> = (0..count).map(|x| x | ((x * x) & 0xffff) << 16).collect();
    random.shuffle(&mut points);
    points
}

/// Many points on one circle, which all see each other, and a few inside, in any order.
pub fn wheel(random: &mut Random32, count: u32) -> Vec<u32> {
    let mut points = rim(random);
    points.truncate(count as usize);
    let inside = count - points.len() as u32;
    points.extend(hub(random, inside));
    random.shuffle(&mut points);
    points
}

/// The points of a wheel with the circle first: the first point inside removes nearly all triangles.
pub fn wheel_from_outside(random: &mut Random32, inside: u32) -> Vec<u32> {
    let mut points = rim(random);
    points.extend(hub(random, inside));
    points
}

/// Points on one circle.
fn rim(random: &mut Random32) -> Vec<u32> {
    // 1105 = 5 * 13 * 17 is the hypotenuse of many right triangles with whole sides.
    const RADIUS: i64 = 1105;
    let mut points = Vec::new();
    for x in -RADIUS..=RADIUS {
        let y = (RADIUS * RADIUS - x * x).isqrt();
        if y * y + x * x == RADIUS * RADIUS {
            points.extend([y, -y].map(|y| (x + RADIUS) as u32 | ((y + RADIUS) as u32) << 16));
        }
    }
    random.shuffle(&mut points);
    points
}

/// Points around the centre of the circle.
fn hub(random: &mut Random32, count: u32) -> Vec<u32> {
    boxed(random, count, 400).into_iter().map(|point| point + 900 * 0x1_0001).collect()
}
