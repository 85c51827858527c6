//! GeoJSON (RFC 7946). Points are read; meshes are written with a polygon for each triangle.
//!
//! Points come from `Point` and `MultiPoint` geometries, bare or in features and collections, in the order of the file;
//! heights are kept as z. Any other geometry is refused, because its corners would be lost silently.

use std::io::{self, Write};

use geojson::{Feature, GeoJson, Geometry, GeometryValue, Position};

use crate::failure::{one_line, Failure};
use crate::formats::mesh_view::MeshView;
use crate::points::PointTable;

/// The beginning of the message about a text that is no GeoJSON.
pub const REFUSED: &str = "not GeoJSON: ";

/// Reads the points of a file.
pub fn read_points(bytes: &[u8]) -> Result<PointTable, Failure> {
    let bytes = crate::text::without_mark(bytes)?;
    if bytes.trim_ascii().is_empty() {
        return Err(Failure::input("the file is empty: GeoJSON is an object such as a FeatureCollection"));
    }
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Err(Failure::input("the file is not UTF-8 text"));
    };
    let document: GeoJson = text.parse().map_err(|error: geojson::Error| {
        let message = error.to_string();
        let message = message.strip_prefix("Error while deserializing GeoJSON: ").unwrap_or(&message);
        Failure::input(format!("{REFUSED}{}", one_line(message)))
    })?;
    let mut table = PointTable::of_items("point");
    match &document {
        GeoJson::Geometry(geometry) => add_geometry(geometry, &mut table, "the geometry")?,
        GeoJson::Feature(feature) => add_feature(feature, &mut table, 1)?,
        GeoJson::FeatureCollection(collection) => {
            for (index, feature) in collection.features.iter().enumerate() {
                add_feature(feature, &mut table, index + 1)?;
            }
        }
    }
    table.complete()
}

fn add_feature(feature: &Feature, table: &mut PointTable, number: usize) -> Result<(), Failure> {
    match &feature.geometry {
        Some(geometry) => add_geometry(geometry, table, &format!("feature {number}")),
        None => Err(Failure::input(format!("feature {number} has no geometry, so no point"))),
    }
}

fn add_geometry(geometry: &Geometry, table: &mut PointTable, place: &str) -> Result<(), Failure> {
    match &geometry.value {
        GeometryValue::Point { coordinates } => add_position(coordinates, table, place),
        GeometryValue::MultiPoint { coordinates } => {
            coordinates.iter().try_for_each(|position| add_position(position, table, place))
        }
        // The recursion is bounded, because the JSON parser limits how deep collections nest.
        GeometryValue::GeometryCollection { geometries } => {
            geometries.iter().try_for_each(|inner| add_geometry(inner, table, place))
        }
        other => Err(Failure::input(format!("{place} is a {}: only Point and MultiPoint are read", other.type_name()))),
    }
}

fn add_position(position: &Position, table: &mut PointTable, place: &str) -> Result<(), Failure> {
    match position.as_slice() {
        // All numbers are finite: JSON has no NaN or infinity, and its parser refuses numbers too large for a double.
        [x, y, rest @ ..] if x.is_finite() && y.is_finite() => {
            push(table, [*x, *y])?;
            table.push_height(rest.first().copied());
            Ok(())
        }
        other => {
            Err(Failure::input(format!("{place} has {} coordinates: a point needs two finite numbers", other.len())))
        }
    }
}

/// A whole double of this magnitude or more may differ from the number in the file.
const LAST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Adds a point. The parser of GeoJSON makes doubles of all numbers. The shortest text of a double is the decimal in
/// the file, if that has up to 15 digits.
fn push(table: &mut PointTable, point: [f64; 2]) -> Result<(), Failure> {
    if point.iter().any(|value| value.abs() >= LAST_EXACT) {
        return table.push_doubles(point, 0);
    }
    let texts = point.map(|value| format!("{value:e}"));
    table.push([texts[0].as_bytes(), texts[1].as_bytes()], 0)
}

/// Writes a feature for each triangle, with its number as `id` and its corners as the property `vertices`.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
    for (id, &triangle) in mesh.triangles.iter().enumerate() {
        let comma = if id == 0 { "" } else { "," };
        let [a, b, c] = triangle;
        let corner = |vertex| {
            let [x, y] = mesh.position(vertex);
            format!("[{x},{y}]")
        };
        write!(
            out,
            "{comma}\n{{\"type\":\"Feature\",\"id\":{id},\"properties\":{{\"vertices\":[{a},{b},{c}]}},\
             \"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[{},{},{},{}]]}}}}",
            corner(a),
            corner(b),
            corner(c),
            corner(a)
        )?;
    }
    writeln!(out, "\n]}}")
}
