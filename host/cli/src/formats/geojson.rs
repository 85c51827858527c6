//! GeoJSON (RFC 7946). Points are read; meshes are written with a polygon for each triangle.
//!
//! Points come from `Point` and `MultiPoint` geometries, bare or in features and collections, in the order of the file;
//! heights are kept as z. In a plan, every position of a line or polygon is a point, too, and the lines and rings are
//! constraints. Where only points are wanted, any other geometry is refused, because its corners would be lost
//! silently.

use std::fmt;
use std::io::{self, Write};

use crate::failure::{counted, one_line, quoted, Failure};
use crate::formats::json_text;
use crate::formats::mesh_view::MeshView;
use crate::formats::plan::PlanTable;
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// The most collections that may be in one another. RFC 7946 advises against any collection in a collection.
const DEEPEST: usize = 32;
/// The names of all types of geometry that have constraints.
const OTHERS: [&str; 4] = ["LineString", "MultiLineString", "Polygon", "MultiPolygon"];

/// Reads the points of a file.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    read(bytes, PlanTable::new(memory, true)).map(|plan| plan.table)
}

/// Reads the points and the constraints of a file.
pub fn read_plan(bytes: &[u8], memory: Memory) -> Result<PlanTable, Failure> {
    read(bytes, PlanTable::new(memory, false))
}

fn read(bytes: &[u8], mut plan: PlanTable) -> Result<PlanTable, Failure> {
    let text = text::utf8(bytes)?;
    if text.trim_ascii().is_empty() {
        return Err(Failure::input("the file is empty: GeoJSON is an object such as a FeatureCollection"));
    }
    let object = Object::of(text, Place::default())?;
    match (object.kind.as_str(), object.features) {
        ("FeatureCollection", Some(list)) if json_text::is_list(list) => json_text::each(list, |index, feature| {
            let place = Place { feature: Some(index + 1), position: None };
            let feature = Object::of(feature, place)?;
            if feature.kind != "Feature" {
                return Err(refuse(format!("{place} has the type {}", quoted(feature.kind.as_bytes()))));
            }
            add_feature(&feature, &mut plan, place)
        })?,
        ("FeatureCollection", _) => return Err(refuse("the collection has no list 'features'")),
        ("Feature", _) => add_feature(&object, &mut plan, Place { feature: Some(1), position: None })?,
        _ => add_geometry(&object, &mut plan, Place::default(), 0)?,
    }
    plan.complete()
}

/// The failure of a text that is no GeoJSON.
fn refuse(why: impl fmt::Display) -> Failure {
    Failure::input(format!("not GeoJSON: {why}"))
}

/// A place in the file, for messages.
#[derive(Clone, Copy, Default)]
struct Place {
    /// The number of the feature, counted from 1; `None` if the file is a geometry.
    feature: Option<usize>,
    /// The number of the position in a `MultiPoint`, counted from 1.
    position: Option<usize>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.feature {
            Some(number) => write!(f, "feature {number}")?,
            None => write!(f, "the geometry")?,
        }
        self.position.map_or(Ok(()), |number| write!(f, ", position {number},"))
    }
}

/// The parts of an object of GeoJSON that are read, as texts.
struct Object<'a> {
    kind: String,
    geometry: Option<&'a str>,
    features: Option<&'a str>,
    coordinates: Option<&'a str>,
    geometries: Option<&'a str>,
}

impl<'a> Object<'a> {
    fn of(text: &'a str, place: Place) -> Result<Self, Failure> {
        let names = ["type", "geometry", "features", "coordinates", "geometries"];
        let fields = json_text::fields(text, names).map_err(|error| match place.feature {
            None => refuse(one_line(&error.to_string())),
            // The file as a whole is JSON, so the value is no object.
            Some(_) => refuse(format!("{place} is {}", quoted(text.as_bytes()))),
        })?;
        let [kind, geometry, features, coordinates, geometries] = fields;
        let kind = kind.and_then(json_text::string).ok_or_else(|| match place.feature {
            None => refuse("the object has no 'type'"),
            Some(_) => refuse(format!("{place} has no 'type'")),
        })?;
        Ok(Self { kind, geometry, features, coordinates, geometries })
    }
}

fn add_feature(feature: &Object<'_>, plan: &mut PlanTable, place: Place) -> Result<(), Failure> {
    match feature.geometry {
        None | Some("null") => Err(Failure::input(format!("{place} has no geometry, so no point"))),
        Some(geometry) => add_geometry(&Object::of(geometry, place)?, plan, place, 0),
    }
}

fn add_geometry(geometry: &Object<'_>, plan: &mut PlanTable, place: Place, depth: usize) -> Result<(), Failure> {
    let list_of = |text: Option<&'_ str>| text.filter(|text| json_text::is_list(text)).is_some();
    match geometry.kind.as_str() {
        "Point" => add_position(geometry.coordinates.unwrap_or("null"), plan, place),
        "MultiPoint" if list_of(geometry.coordinates) => {
            add_positions(geometry.coordinates.unwrap_or_default(), plan, place)
        }
        "GeometryCollection" if depth == DEEPEST => {
            Err(refuse(format!("{place} has more than {DEEPEST} collections in one another")))
        }
        "GeometryCollection" if list_of(geometry.geometries) => {
            json_text::each(geometry.geometries.unwrap_or_default(), |_, inner| {
                add_geometry(&Object::of(inner, place)?, plan, place, depth + 1)
            })
        }
        "MultiPoint" => Err(refuse(format!("{place} has no list 'coordinates'"))),
        "GeometryCollection" => Err(refuse(format!("{place} has no list 'geometries'"))),
        other if OTHERS.contains(&other) && plan.takes_only_points() => {
            Err(Failure::input(format!("{place} is a {other}: only Point and MultiPoint are read")))
        }
        other if OTHERS.contains(&other) => add_lines(other, geometry.coordinates.unwrap_or("null"), plan, place),
        other => Err(refuse(format!("{place} has the type {}", quoted(other.as_bytes())))),
    }
}

/// Adds the lines or rings of a geometry of this kind.
fn add_lines(kind: &str, coordinates: &str, plan: &mut PlanTable, place: Place) -> Result<(), Failure> {
    match kind {
        "LineString" => {
            let first = plan.table.len();
            add_positions(coordinates, plan, place)?;
            plan.add_line(first, || place.to_string())
        }
        "MultiLineString" => each_of(coordinates, place, |line| add_lines("LineString", line, plan, place)),
        "Polygon" => {
            plan.begin_polygon();
            each_of(coordinates, place, |ring| {
                let first = plan.table.len();
                add_positions(ring, plan, place)?;
                plan.add_ring(first, || place.to_string())
            })
        }
        _ => each_of(coordinates, place, |polygon| add_lines("Polygon", polygon, plan, place)),
    }
}

/// Calls `take` with each item of a value that must be a list.
fn each_of(text: &str, place: Place, mut take: impl FnMut(&str) -> Result<(), Failure>) -> Result<(), Failure> {
    if !json_text::is_list(text) {
        let shown = quoted(text.as_bytes());
        return Err(refuse(format!("{place} has {shown} where a list of lists belongs")));
    }
    json_text::each(text, |_, item| take(item))
}

/// Adds the points of a list of positions.
fn add_positions(list: &str, plan: &mut PlanTable, place: Place) -> Result<(), Failure> {
    if !json_text::is_list(list) {
        let shown = quoted(list.as_bytes());
        return Err(refuse(format!("{place} has {shown} where a list of positions belongs")));
    }
    json_text::each(list, |index, position| add_position(position, plan, Place { position: Some(index + 1), ..place }))
}

/// Adds a point with its numbers as they are written. The third number is z.
fn add_position(text: &str, plan: &mut PlanTable, place: Place) -> Result<(), Failure> {
    let table = &mut plan.table;
    let Some((numbers, count)) = json_text::numbers(text) else {
        let shown = quoted(text.as_bytes());
        return Err(Failure::input(format!("{place} has the coordinates {shown}: a point needs a list of numbers")));
    };
    if count < 2 {
        let coordinates = counted(count, "coordinate");
        return Err(Failure::input(format!("{place} has {coordinates}: a point needs two finite numbers")));
    }
    let [x, y, z] = numbers.map(str::as_bytes);
    table.push([x, y], 0)?;
    table.push_height((count > 2).then_some(z), 0)
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
