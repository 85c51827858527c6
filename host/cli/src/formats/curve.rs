//! SVG drawings of an order of insertion: a line from each point to the next.
//!
//! The colour of the line runs from blue to red, so that the beginning can be seen.

use std::io::{self, Write};

/// Canvas units along the longer side of the points' bounding box.
const CANVAS: f64 = 10_000.0;
/// Canvas units around the points.
const MARGIN: f64 = 250.0;
/// The number of pieces of the line, each of one colour.
const PIECES: usize = 64;

/// Writes the drawing of points in their order.
pub fn write(points: &[[u32; 2]], title: &str, out: &mut dyn Write) -> io::Result<()> {
    let low = [0, 1].map(|axis| points.iter().map(|point| point[axis]).min().unwrap_or(0));
    let size = [0, 1].map(|axis| points.iter().map(|point| point[axis] - low[axis]).max().unwrap_or(0));
    let scale = CANVAS / f64::from(size[0].max(size[1]).max(1));
    let [width, height] = size.map(|side| f64::from(side) * scale + 2.0 * MARGIN);
    let place = |point: [u32; 2]| {
        let [x, y] = [0, 1].map(|axis| f64::from(point[axis] - low[axis]) * scale + MARGIN);
        format!("{x:.0},{:.0}", height - y)
    };
    // The line is as thick as a quarter of the usual distance of neighbours.
    let thick = (CANVAS / (points.len().max(1) as f64).sqrt() / 4.0).clamp(2.0, 60.0);
    writeln!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"1000\">")?;
    writeln!(out, "<title>{title}</title>")?;
    writeln!(out, "<rect width=\"100%\" height=\"100%\" fill=\"#fdfcf9\"/>")?;
    writeln!(out, "<g fill=\"none\" stroke-width=\"{thick:.0}\" stroke-linejoin=\"round\">")?;
    let length = points.len().div_ceil(PIECES).max(1);
    for (piece, start) in (0..points.len()).step_by(length).enumerate() {
        // A piece begins with the last point of the previous piece, so that the line has no gaps.
        let line = &points[start.saturating_sub(1)..(start + length).min(points.len())];
        let line: Vec<String> = line.iter().map(|&point| place(point)).collect();
        let hue = 240 - 240 * piece / PIECES;
        writeln!(out, "<polyline stroke=\"hsl({hue} 80% 45%)\" points=\"{}\"/>", line.join(" "))?;
    }
    writeln!(out, "</g>\n</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_drawn() {
        for count in [0, 1, 2, 63, 64, 65, 1000u32] {
            let points: Vec<[u32; 2]> = (0..count).map(|k| [k * 37 % 101, k * 53 % 89]).collect();
            let mut bytes = Vec::new();
            write(&points, "a title", &mut bytes).expect("memory takes all");
            let text = String::from_utf8(bytes).expect("text");
            let lines: Vec<&str> = text.lines().filter(|line| line.starts_with("<polyline")).collect();
            let drawn: usize = lines.iter().map(|line| line.matches(',').count()).sum();
            assert_eq!(drawn, count as usize + lines.len().saturating_sub(1), "{count}");
            assert!(text.ends_with("</svg>\n"));
        }
    }
}
