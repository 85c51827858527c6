//! Draws terrain from points with heights: the triangles, shaded as if the sun stood in the north-west, and contour
//! lines on them.
//!
//! ```text
//! cargo run --release -p incircle --example terrain -- testbench/data/terrain.csv terrain.svg
//! cargo run --release -p incircle --example terrain -- testbench/data/terrain.csv all.svg 25 30000 32000
//! ```
//!
//! The numbers are the step between contour lines and the corner up to which points are taken. The file has a header
//! and rows `x,y,z` of whole numbers.

use std::error::Error;
use std::fmt::Write;
use std::io::Write as _;

use incircle::interpolate::Surface;

/// The factor by which the ground is drawn steeper than it is, so that shades differ.
const STEEPNESS: f64 = 3.0;
/// The direction to the sun: north-west, 45 degrees high.
const SUN: [f64; 3] = [-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2];
/// The side of the picture, in its own units.
const SIDE: f64 = 1000.0;

/// Points with heights.
struct Ground {
    points: Vec<[f64; 2]>,
    heights: Vec<f64>,
}

fn read(file: &str, corner: [f64; 2]) -> Result<Ground, Box<dyn Error>> {
    let mut ground = Ground { points: Vec::new(), heights: Vec::new() };
    for line in std::fs::read_to_string(file)?.lines().skip(1) {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let [x, y, z] = numbers[..] else { return Err(format!("'{line}' is no row x,y,z").into()) };
        if x <= corner[0] && y <= corner[1] {
            ground.points.push([x, y]);
            ground.heights.push(z);
        }
    }
    Ok(ground)
}

impl Ground {
    /// The brightness of a triangle, 0 to 1: the cosine of the angle between its normal and the sun.
    fn shade(&self, corners: [u32; 3]) -> f64 {
        let [a, b, c] = corners.map(|index| {
            let ([x, y], z) = (self.points[index as usize], self.heights[index as usize] * STEEPNESS);
            [x, y, z]
        });
        let (u, v) = ([0, 1, 2].map(|axis| b[axis] - a[axis]), [0, 1, 2].map(|axis| c[axis] - a[axis]));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let dot = |one: [f64; 3], other: [f64; 3]| (0..3).map(|axis| one[axis] * other[axis]).sum::<f64>();
        (dot(normal, SUN) / dot(normal, normal).sqrt()).max(0.0)
    }

    /// The colour of a triangle: green in the valleys, brown on the ridges, darker in the shade.
    fn colour(&self, corners: [u32; 3], [low, high]: [f64; 2]) -> String {
        let height = corners.iter().map(|&index| self.heights[index as usize]).sum::<f64>() / 3.0;
        let share = (height - low) / (high - low).max(1.0);
        let light = 0.25 + 0.75 * self.shade(corners);
        let mixed = |valley: f64, ridge: f64| ((valley + share * (ridge - valley)) * light) as u8;
        format!("#{:02x}{:02x}{:02x}", mixed(150.0, 245.0), mixed(190.0, 225.0), mixed(120.0, 190.0))
    }
}

/// The places as the data of a path in the picture, whose y grows downwards.
fn path(places: &[[f64; 2]], scale: f64, is_closed: bool) -> String {
    let mut data = String::new();
    for (place, [x, y]) in places.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(data, "{}{:.1} {:.1}", if place == 0 { 'M' } else { 'L' }, x * scale, SIDE - y * scale);
    }
    data + if is_closed { "Z" } else { "" }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, output, numbers @ ..] = &arguments[..] else {
        return Err("give a file of points and a name for the picture".into());
    };
    let number = |place: usize, usual: f64| numbers.get(place).map_or(Ok(usual), |text| text.parse());
    let (step, corner) = (number(0, 25.0)?, [number(1, 12_000.0)?, number(2, 12_000.0)?]);
    let ground = read(file, corner)?;
    let mesh = incircle::triangulate(&ground.points)?;
    let surface = Surface::new(&ground.points, &mesh.triangles, &ground.heights)?;
    let range = [ground.heights.iter().copied().fold(f64::INFINITY, f64::min), surface_top(&ground)];
    let scale = SIDE / corner[0].max(corner[1]);
    let mut svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"700\" viewBox=\"0 0 {SIDE} {SIDE}\">\n");
    for &corners in &mesh.triangles {
        let (colour, places) = (ground.colour(corners, range), corners.map(|index| ground.points[index as usize]));
        writeln!(svg, "<path d=\"{}\" fill=\"{colour}\" stroke=\"{colour}\"/>", path(&places, scale, true))?;
    }
    let (first, last) = ((range[0] / step).ceil() as i64, (range[1] / step).floor() as i64);
    let mut count = 0;
    for level in first..=last {
        // Every fourth line is broader.
        let width = if level % 4 == 0 { 2.2 } else { 0.9 };
        for line in surface.contours(level as f64 * step) {
            let places: Vec<[f64; 2]> = line.crossings.iter().map(|crossing| crossing.place(&ground.points)).collect();
            let data = path(&places, scale, line.is_closed);
            writeln!(svg, "<path d=\"{data}\" fill=\"none\" stroke=\"#5a3a1a\" stroke-width=\"{width}\"/>")?;
            count += 1;
        }
    }
    // The picture comes last, so that there is none if the line cannot be printed.
    let (points, triangles) = (ground.points.len(), mesh.triangles.len());
    writeln!(std::io::stdout(), "{points} points, {triangles} triangles, {count} contour lines")?;
    Ok(std::fs::write(output, svg + "</svg>\n")?)
}

/// The highest height.
fn surface_top(ground: &Ground) -> f64 {
    ground.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
