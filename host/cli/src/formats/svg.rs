//! SVG: a picture of the mesh, which can only be written.
//!
//! The picture fits its canvas, and y points up. Triangles are grouped by size into classes. Each class is one path
//! with a colour of its own, dark for small triangles and light for large ones, and with lines that are thin if its
//! triangles are small. Coordinates are rounded to the canvas and written relative to the first corner of each
//! triangle, which keeps files short: about 25 bytes per triangle.

use std::io::{self, Write};

use crate::failure::counted;
use crate::formats::mesh_view::MeshView;

/// Canvas units along the longer side of the points' bounding box.
const CANVAS: f64 = 20_000.0;
/// Canvas units around the points.
const MARGIN: f64 = 500.0;
/// Width of the picture in pixels, unless the viewer chooses its own.
const PIXELS: f64 = 1000.0;
/// The number of size classes, which is odd so that the median lies in the middle of a class.
pub(crate) const CLASSES: usize = 25;
/// Sets of more points than this have no dots, which would cover the triangles.
pub(crate) const MOST_DOTS: usize = 2000;
/// Colours from the smallest to the largest triangles; classes lie between them.
const RAMP: [[u8; 3]; 6] = [
    [0x1d, 0x2b, 0x53],
    [0x23, 0x52, 0x7c],
    [0x2a, 0x8c, 0x98],
    [0x6f, 0xbf, 0xa0],
    [0xd3, 0xe0, 0xa5],
    [0xfb, 0xec, 0xc4],
];

/// The colour of points.
pub(crate) const POINT: &str = "#1d2b53";

/// Writes the picture of a mesh.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    let doubles = mesh.points.doubles();
    let canvas = Canvas::around(&doubles, doubles.iter().copied());
    let (points, triangles) = (counted(mesh.points.len(), "point"), counted(mesh.triangles.len(), "triangle"));
    write_head(&canvas, &format!("Delaunay triangulation: {points}, {triangles}"), out)?;
    let sides = mesh.triangles.iter().map(|&triangle| side(canvas.corners(triangle)));
    draw_triangles(mesh.triangles, &canvas, &Classes::of(sides.collect()), out)?;
    match mesh.planned {
        Some(planned) => draw_pieces(planned.made.pieces.edges(), &canvas, out)?,
        None => draw_hull(mesh.hull, !mesh.triangles.is_empty(), &canvas, out)?,
    }
    let count = mesh.points.len();
    if count <= MOST_DOTS {
        let width = (CANVAS * 0.15 / (count as f64).sqrt()).clamp(60.0, 280.0);
        draw_dots(doubles.iter().map(|&point| canvas.place(point)), width, POINT, out)?;
    }
    writeln!(out, "</svg>")
}

/// Writes the start of a picture: its size, its title and its ground.
pub(crate) fn write_head(canvas: &Canvas<'_>, title: &str, out: &mut dyn Write) -> io::Result<()> {
    let [width, height] = canvas.size;
    let shown = PIXELS * height / width;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         width=\"{PIXELS}\" height=\"{shown:.0}\">"
    )?;
    writeln!(out, "<title>{title}</title>")?;
    writeln!(out, "<rect width=\"100%\" height=\"100%\" fill=\"#fdfcf9\"/>")
}

/// The map from input coordinates to whole canvas units.
pub(crate) struct Canvas<'a> {
    points: &'a [[f64; 2]],
    low: [f64; 2],
    scale: f64,
    shrink: f64,
    /// Width and height, in canvas units.
    pub(crate) size: [f64; 2],
}

impl<'a> Canvas<'a> {
    /// The canvas of these points, which shows at least those that are `shown`.
    pub(crate) fn around(points: &'a [[f64; 2]], shown: impl Iterator<Item = [f64; 2]> + Clone) -> Self {
        let largest = shown.clone().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        // Differences of huge doubles would overflow.
        let shrink = if largest > 1e150 { 1e-200 } else { 1.0 };
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            let values = shown.clone().map(|point| point[axis] * shrink);
            values.reduce(pick).unwrap_or(0.0)
        };
        let low = [bound(0, f64::min), bound(1, f64::min)];
        let extent = [bound(0, f64::max) - low[0], bound(1, f64::max) - low[1]];
        let longer = extent[0].max(extent[1]);
        // If the points have no extent, or one that is too small for doubles, all are drawn in the middle.
        let scale = Some(CANVAS / longer).filter(|scale| scale.is_finite());
        let scale = scale.unwrap_or(0.0);
        let size = extent.map(|side| (side * scale).round() + 2.0 * MARGIN);
        Self { points, low, scale, shrink, size }
    }

    /// The place of a point on the canvas, with y downwards as in SVG.
    pub(crate) fn place(&self, point: [f64; 2]) -> [i64; 2] {
        let unit = |axis: usize| ((point[axis] * self.shrink - self.low[axis]) * self.scale).round();
        let x = MARGIN + unit(0);
        let y = self.size[1] - MARGIN - unit(1);
        [x as i64, y as i64]
    }

    /// Whether a point lies on the canvas.
    pub(crate) fn is_inside(&self, point: [f64; 2]) -> bool {
        let place = self.place(point);
        (0..2).all(|axis| (0..=self.size[axis] as i64).contains(&place[axis]))
    }

    /// The place of a vertex on the canvas.
    pub(crate) fn vertex(&self, vertex: u32) -> [i64; 2] {
        self.place(self.points.get(vertex as usize).copied().unwrap_or_default())
    }

    /// The places of the corners of a triangle on the canvas.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> [[i64; 2]; 3] {
        triangle.map(|vertex| self.vertex(vertex))
    }
}

/// The side of a square that is as large as the triangle, at least one unit.
pub(crate) fn side([a, b, c]: [[i64; 2]; 3]) -> f64 {
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    (twice.abs() as f64 / 2.0).sqrt().max(1.0)
}

/// The scale from triangle sides to size classes.
pub(crate) struct Classes {
    middle: f64,
    spread: f64,
}

impl Classes {
    /// Makes the scale, centred on the median size. The scale spans all sizes but the outer fiftieths, and at least a
    /// factor of 8 to both sides, so that even triangles have similar colours.
    pub(crate) fn of(mut sides: Vec<f64>) -> Self {
        sides.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| {
            let index = (sides.len().saturating_sub(1) as f64 * share) as usize;
            sides.get(index).copied().unwrap_or(1.0).log2()
        };
        let middle = at(0.5);
        let spread = (middle - at(0.02)).max(at(0.98) - middle).max(3.0);
        Self { middle, spread }
    }

    /// The class of a triangle or cell of this side.
    pub(crate) fn class(&self, side: f64) -> usize {
        let along = (side.log2() - self.middle) / (2.0 * self.spread) + 0.5;
        let last = (CLASSES - 1) as f64;
        (along * last).round().clamp(0.0, last) as usize
    }

    /// The triangle side in the middle of a class.
    pub(crate) fn side(&self, class: usize) -> f64 {
        let along = class as f64 / (CLASSES - 1) as f64;
        (self.middle + (along - 0.5) * 2.0 * self.spread).exp2()
    }
}

/// Draws triangles, the large ones first, so that the thin lines of small triangles stay above the thick ones.
pub(crate) fn draw_triangles(
    all: &[[u32; 3]],
    canvas: &Canvas<'_>,
    classes: &Classes,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut members = vec![Vec::new(); CLASSES];
    for &triangle in all {
        let corners = canvas.corners(triangle);
        members[classes.class(side(corners))].push(corners);
    }
    writeln!(out, "<g stroke=\"#12304a\" stroke-opacity=\".45\" stroke-linejoin=\"round\">")?;
    for (class, triangles) in members.iter().enumerate().rev() {
        if triangles.is_empty() {
            continue;
        }
        let width = (classes.side(class) * 0.05).clamp(1.0, 30.0);
        write!(out, "<path fill=\"{}\" stroke-width=\"{width:.1}\" d=\"", colour(class))?;
        for [a, b, c] in triangles {
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
            write!(out, "M{} {}l{} {} {} {}z", a[0], a[1], u[0], u[1], v[0], v[1])?;
        }
        writeln!(out, "\"/>")?;
    }
    writeln!(out, "</g>")
}

/// The colour of a class.
pub(crate) fn colour(class: usize) -> String {
    let along = class as f64 / (CLASSES - 1) as f64 * (RAMP.len() - 1) as f64;
    let below = (along as usize).min(RAMP.len() - 2);
    let share = along - below as f64;
    let mix = |channel: usize| {
        let (from, to) = (f64::from(RAMP[below][channel]), f64::from(RAMP[below + 1][channel]));
        (from + (to - from) * share).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

/// Draws the hull as a closed line, or without triangles the line through the points.
pub(crate) fn draw_hull(hull: &[u32], is_closed: bool, canvas: &Canvas<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut d = String::new();
    for (index, &vertex) in hull.iter().enumerate() {
        let [x, y] = canvas.vertex(vertex);
        let command = if index == 0 { "M" } else { "L" };
        d.push_str(&format!("{command}{x} {y}"));
    }
    if is_closed {
        d.push('z');
    }
    writeln!(
        out,
        "<path fill=\"none\" stroke=\"#e4572e\" stroke-width=\"45\" stroke-linejoin=\"round\" \
         stroke-linecap=\"round\" d=\"{d}\"/>"
    )
}

/// Draws the edges that constraints fix.
fn draw_pieces(pieces: &[[u32; 2]], canvas: &Canvas<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "<path fill=\"none\" stroke=\"#e4572e\" stroke-width=\"45\" stroke-linecap=\"round\" d=\"")?;
    for piece in pieces {
        let [[x, y], [u, v]] = piece.map(|vertex| canvas.vertex(vertex));
        write!(out, "M{x} {y}L{u} {v}")?;
    }
    writeln!(out, "\"/>")
}

/// Draws a dot at each place of the canvas, as a subpath of no length with round ends. Without places nothing is drawn.
pub(crate) fn draw_dots(
    places: impl Iterator<Item = [i64; 2]>,
    width: f64,
    colour: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut places = places.peekable();
    if places.peek().is_none() {
        return Ok(());
    }
    write!(out, "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.0}\" stroke-linecap=\"round\" d=\"")?;
    for [x, y] in places {
        write!(out, "M{x} {y}h0")?;
    }
    writeln!(out, "\"/>")
}
