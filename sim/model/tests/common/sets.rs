//! Point sets as words.

use super::Random;

/// Points of a box: in a small one most fall together.
pub fn boxed(random: &mut Random, count: u32, side: u32) -> Vec<u32> {
    (0..count).map(|_| random.below(side) | random.below(side) << 16).collect()
}

/// As `boxed`, but every other point is one of the eight before it: duplicates of points that are still in flight.
pub fn stuttering(random: &mut Random, count: u32, side: u32) -> Vec<u32> {
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

/// Points of a parabola: all on the hull, and the cavities of a point above it are large.
pub fn parabola(random: &mut Random, count: u32) -> Vec<u32> {
    let mut points: Vec<u32> = (0..count).map(|x| x | (x * x & 0xffff) << 16).collect();
    random.shuffle(&mut points);
    points
}

/// Many points of one circle, which all see each other, and a few inside.
pub fn wheel(random: &mut Random, count: u32) -> Vec<u32> {
    // 5^2 13^2 17^2 leaves many points with whole coordinates on the circle of radius 1105.
    const RADIUS: i64 = 1105;
    let mut points: Vec<u32> = Vec::new();
    for x in -RADIUS..=RADIUS {
        let y = (RADIUS * RADIUS - x * x).isqrt();
        if y * y + x * x == RADIUS * RADIUS {
            points.extend([y, -y].map(|y| (x + RADIUS) as u32 | ((y + RADIUS) as u32) << 16));
        }
    }
    random.shuffle(&mut points);
    points.truncate(count as usize);
    let inside = count - points.len() as u32;
    points.extend((0..inside).map(|_| 900 + random.below(400) | 900 + random.below(400) << 16));
    random.shuffle(&mut points);
    points
}
