//! Cells as GeoJSON and as JSON.

use std::io::{self, Write};

use incircle::voronoi::{Cell, Cells, ClippedCell, Corner, Piece, Side, Voronoi};

use super::frame::Frame;
use super::view::CellView;
use crate::number::Coordinate;

/// A place as a JSON list.
fn position([x, y]: [f64; 2]) -> String {
    format!("[{},{}]", Coordinate::Double(x), Coordinate::Double(y))
}

/// A list of numbers as JSON.
fn list(items: impl Iterator<Item = u32>) -> String {
    let texts: Vec<String> = items.map(|item| item.to_string()).collect();
    format!("[{}]", texts.join(","))
}

/// A ring as GeoJSON wants it: the first corner comes once more at the end.
fn ring(corners: impl Iterator<Item = (Corner, Side)>, frame: &Frame) -> String {
    let mut corners: Vec<String> = corners.map(|(corner, _)| position(frame.coordinates(corner))).collect();
    corners.extend(corners.first().cloned());
    format!("[{}]", corners.join(","))
}

/// The rings of a piece: its border, then its holes.
fn rings(piece: &Piece<'_>, frame: &Frame) -> String {
    let holes = piece.holes().map(|hole| ring(hole.corners(), frame));
    let all: Vec<String> = std::iter::once(ring(piece.corners(), frame)).chain(holes).collect();
    all.join(",")
}

/// The properties of a clipped cell: area, all neighbours, and those inside the clip.
fn properties(cell: &Cell<'_>, clipped: &ClippedCell<'_>, frame: &Frame) -> String {
    let mut inside: Vec<u32> = clipped.neighbors().collect();
    inside.sort_unstable();
    inside.dedup();
    let (area, step) = (clipped.area(), frame.step());
    format!(
        "\"point\":{},\"area\":{},\"neighbors\":{},\"inside\":{}",
        cell.point(),
        Coordinate::Double(area * step * step),
        list(cell.neighbors().iter().copied()),
        list(inside.into_iter())
    )
}

/// Writes a feature for each cell that has area in the clip.
pub fn write_geojson(view: CellView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
    let mut comma = "";
    each_clipped(view, |cell, clipped| {
        let rings: Vec<String> = clipped.pieces().map(|piece| format!("[{}]", rings(&piece, view.frame))).collect();
        let (kind, coordinates) = match &rings[..] {
            [] => return Ok(()),
            [only] => ("Polygon", only.clone()),
            several => ("MultiPolygon", format!("[{}]", several.join(","))),
        };
        write!(
            out,
            "{comma}\n{{\"type\":\"Feature\",\"id\":{},\"properties\":{{{}}},\
             \"geometry\":{{\"type\":\"{kind}\",\"coordinates\":{coordinates}}}}}",
            cell.point(),
            properties(cell, clipped, view.frame)
        )?;
        comma = ",";
        Ok(())
    })?;
    writeln!(out, "\n]}}")
}

/// Calls `take` with each cell and what the clip leaves of it. Without a clip nothing is called.
pub(super) fn each_clipped(
    view: CellView<'_>,
    mut take: impl FnMut(&Cell<'_>, &ClippedCell<'_>) -> io::Result<()>,
) -> io::Result<()> {
    let Some(clip) = view.clip else { return Ok(()) };
    let mut cells = Cells::new(view.voronoi, clip);
    for cell in view.voronoi.cells() {
        take(&cell, &cells.cell(cell.point()))?;
    }
    Ok(())
}

/// Writes one object: `cells` with the corners of each if there is a clip, else `vertices`, and `cells` by the numbers
/// of their vertices.
pub fn write_json(view: CellView<'_>, out: &mut dyn Write) -> io::Result<()> {
    if view.clip.is_none() {
        return write_unclipped(view, out);
    }
    write!(out, "{{\"cells\":[")?;
    let mut comma = "";
    each_clipped(view, |cell, clipped| {
        let rings: Vec<String> = clipped.pieces().map(|piece| rings(&piece, view.frame)).collect();
        write!(out, "{comma}\n{{{},\"rings\":[{}]}}", properties(cell, clipped, view.frame), rings.join(","))?;
        comma = ",";
        Ok(())
    })?;
    writeln!(out, "]}}")
}

fn write_unclipped(view: CellView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"vertices\":[")?;
    for vertex in 0..view.voronoi.vertex_count() as u32 {
        let comma = if vertex == 0 { "" } else { "," };
        write!(out, "{comma}\n{}", position(view.frame.coordinates(view.voronoi.vertex(vertex))))?;
    }
    write!(out, "],\n\"cells\":[")?;
    let mut comma = "";
    for cell in view.voronoi.cells() {
        let (vertices, neighbors) = (list(cell.vertices()), list(cell.neighbors().iter().copied()));
        let (point, rays) = (cell.point(), rays(view.voronoi, &cell));
        write!(
            out,
            "{comma}\n{{\"point\":{point},\"neighbors\":{neighbors},\"vertices\":{vertices},\"rays\":[{rays}]}}"
        )?;
        comma = ",";
    }
    writeln!(out, "]}}")
}

/// The directions in which an unbounded cell goes to infinity, in grid units: that of the edge that comes from there,
/// seen from its end, and that of the edge that goes there. A bounded cell has none; points on one line have an edge
/// without ends to each side, and both directions of each.
fn rays(voronoi: &Voronoi<'_>, cell: &Cell<'_>) -> String {
    let mut directions = Vec::new();
    for edge in cell.edges() {
        let [x, y] = voronoi.direction(cell.point(), edge.neighbor);
        directions.extend(edge.from.is_none().then_some([-x, -y]));
        directions.extend(edge.to.is_none().then_some([x, y]));
    }
    let texts: Vec<String> = directions.iter().map(|[x, y]| format!("[{x},{y}]")).collect();
    texts.join(",")
}
