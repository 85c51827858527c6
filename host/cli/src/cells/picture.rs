//! A picture of cells: coloured by size, with their points.

use std::io::{self, Write};

use super::text::each_clipped;
use super::view::CellView;
use crate::failure::counted;
use crate::formats::svg::{colour, draw_dots, write_head, Canvas, Classes, CLASSES, MOST_DOTS, POINT};

/// A piece of a cell on the canvas.
struct Drawn {
    /// The border, then the holes, which turn the other way and so stay empty.
    rings: Vec<Vec<[i64; 2]>>,
    /// The side of a square as large as the piece.
    side: f64,
}

/// Writes the picture of clipped cells. `points` are the points in the numbers of the file.
pub fn write_picture(view: CellView<'_>, points: &[[f64; 2]], out: &mut dyn Write) -> io::Result<()> {
    let corners = view.clip.map_or(&[][..], |clip| clip.corners());
    let place = |corner| view.frame.coordinates(incircle::voronoi::Corner::of_point(corner));
    let shown: Vec<[f64; 2]> = corners.iter().copied().map(place).collect();
    let canvas = Canvas::around(points, shown.iter().copied());
    let drawn = draw(view, &canvas)?;
    write_head(&canvas, &format!("Voronoi cells: {}", counted(view.voronoi.cells().count(), "cell")), out)?;
    let classes = Classes::of(drawn.iter().map(|piece| piece.side).collect());
    let mut members = vec![Vec::new(); CLASSES];
    for piece in &drawn {
        members[classes.class(piece.side)].extend(&piece.rings);
    }
    writeln!(out, "<g stroke=\"#fdfcf9\" stroke-linejoin=\"round\">")?;
    for (class, pieces) in members.iter().enumerate().filter(|(_, pieces)| !pieces.is_empty()).rev() {
        let width = (classes.side(class) * 0.04).clamp(2.0, 40.0);
        write!(out, "<path fill=\"{}\" stroke-width=\"{width:.1}\" d=\"", colour(class))?;
        pieces.iter().try_for_each(|corners| write_outline(corners, out))?;
        writeln!(out, "\"/>")?;
    }
    writeln!(out, "</g>")?;
    let inside = points.iter().filter(|&&point| canvas.is_inside(point));
    if points.len() <= MOST_DOTS {
        let width = (3000.0 / (points.len().max(1) as f64).sqrt()).clamp(50.0, 200.0);
        draw_dots(inside.map(|&point| canvas.place(point)), width, POINT, out)?;
    }
    writeln!(out, "</svg>")
}

/// The pieces of all cells on the canvas.
fn draw(view: CellView<'_>, canvas: &Canvas<'_>) -> io::Result<Vec<Drawn>> {
    let mut drawn = Vec::new();
    each_clipped(view, |_, clipped| {
        for piece in clipped.pieces() {
            let place = |(corner, _)| canvas.place(view.frame.coordinates(corner));
            let holes = piece.holes().map(|hole| hole.corners().map(place).collect());
            let rings: Vec<Vec<[i64; 2]>> =
                std::iter::once(piece.corners().map(place).collect()).chain(holes).collect();
            let twice: i64 = rings.iter().map(|ring| twice_area(ring)).sum();
            drawn.push(Drawn { rings, side: (twice.abs() as f64 / 2.0).sqrt().max(1.0) });
        }
        Ok(())
    })?;
    Ok(drawn)
}

/// Twice the area of a ring on the canvas; its sign tells how the ring turns.
fn twice_area(ring: &[[i64; 2]]) -> i64 {
    let term = |k: usize| {
        let ([x, y], [u, v]) = (ring[k], ring[(k + 1) % ring.len()]);
        x * v - y * u
    };
    (0..ring.len()).map(term).sum()
}

/// Writes a closed path, relative to its first corner.
fn write_outline(corners: &[[i64; 2]], out: &mut dyn Write) -> io::Result<()> {
    let mut from: Option<[i64; 2]> = None;
    for &[x, y] in corners {
        match from {
            None => write!(out, "M{x} {y}l")?,
            Some([u, v]) => write!(out, "{} {} ", x - u, y - v)?,
        }
        from = Some([x, y]);
    }
    write!(out, "z")
}
