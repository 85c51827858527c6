//! The rings of a polygon in GeoJSON (RFC 7946): one polygon, perhaps with holes, bare, in a feature, or in a
//! collection of one feature.

use crate::failure::{counted, quoted, Failure};
use crate::formats::json_text;
use crate::formats::plan::check_ring;
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// The corners of a polygon.
pub struct Rings {
    /// The corners of the outer ring, then those of each hole. The last corner of a ring repeats its first.
    pub corners: PointTable,
    /// The number of corners of each ring.
    pub counts: Vec<usize>,
}

/// Reads the only polygon of a file.
pub fn read(bytes: &[u8], memory: Memory) -> Result<Rings, Failure> {
    read_object(text::utf8(bytes)?, memory, 0)
}

fn refuse(why: impl std::fmt::Display) -> Failure {
    Failure::input(format!("{why}: give one GeoJSON polygon"))
}

/// Reads a geometry, or the geometry of a feature, at a depth below the file.
fn read_object(object: &str, memory: Memory, depth: usize) -> Result<Rings, Failure> {
    let fields = json_text::fields(object, ["type", "coordinates", "geometry", "features"]);
    let [kind, coordinates, geometry, features] = fields.map_err(|error| json_text::refuse(&error))?;
    let kind = kind.and_then(json_text::string).unwrap_or_default();
    let list_of = |list: Option<&str>| list.filter(|text| json_text::is_list(text)).map(str::to_owned);
    match (kind.as_str(), depth) {
        ("Polygon", _) => read_polygon(&list_of(coordinates).unwrap_or_default(), memory),
        ("Feature", 0 | 1) => read_object(geometry.unwrap_or("null"), memory, 2),
        ("FeatureCollection", 0) => {
            let list = list_of(features).ok_or_else(|| refuse("the collection has no list 'features'"))?;
            let only = only(&list, "feature")?;
            read_object(&only, memory, 1)
        }
        (other, _) => Err(refuse(format!("the type is {}", quoted(other.as_bytes())))),
    }
}

/// The only item of a list.
fn only(list: &str, what: &str) -> Result<String, Failure> {
    let mut items = Vec::new();
    json_text::each(list, |_, item| {
        items.push(item.to_owned());
        Ok(())
    })?;
    match items.len() {
        1 => Ok(items.swap_remove(0)),
        count => Err(refuse(format!("there are {}", counted(count, what)))),
    }
}

fn read_polygon(rings: &str, memory: Memory) -> Result<Rings, Failure> {
    if !json_text::is_list(rings) {
        return Err(refuse("the polygon has no list 'coordinates'"));
    }
    let mut corners = PointTable::of_items("corner").within(memory);
    let mut counts = Vec::new();
    json_text::each(rings, |_, ring| {
        if !json_text::is_list(ring) {
            return Err(refuse(format!("ring {} is {}, not a list", counts.len() + 1, quoted(ring.as_bytes()))));
        }
        let before = corners.len();
        json_text::each(ring, |index, position| match json_text::numbers(position) {
            Some(([x, y, _], 2..)) => corners.push([x.as_bytes(), y.as_bytes()], 0),
            _ => {
                let (number, ring) = (index + 1, counts.len() + 1);
                let shown = quoted(position.as_bytes());
                Err(Failure::input(format!("corner {number} of ring {ring} is {shown}, not two numbers")))
            }
        })?;
        check_ring(&corners, before, || "the polygon".to_owned())?;
        counts.push(corners.len() - before);
        Ok(())
    })?;
    if counts.is_empty() {
        return Err(refuse("the polygon has no ring"));
    }
    Ok(Rings { corners: corners.complete()?, counts })
}
