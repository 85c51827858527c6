//! The ring of a polygon in GeoJSON (RFC 7946): one polygon without holes, bare, in a feature, or in a collection of
//! one feature.

use crate::failure::{counted, quoted, Failure};
use crate::formats::json_text;
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// Reads the corners of the only polygon of a file, in their order. The last corner repeats the first.
pub fn read(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    read_object(text::utf8(bytes)?, memory, 0)
}

fn refuse(why: impl std::fmt::Display) -> Failure {
    Failure::input(format!("{why}: give one GeoJSON polygon without holes"))
}

/// Reads a geometry, or the geometry of a feature, at a depth below the file.
fn read_object(object: &str, memory: Memory, depth: usize) -> Result<PointTable, Failure> {
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

fn read_polygon(rings: &str, memory: Memory) -> Result<PointTable, Failure> {
    if !json_text::is_list(rings) {
        return Err(refuse("the polygon has no list 'coordinates'"));
    }
    let ring = only(rings, "ring")?;
    let mut table = PointTable::of_items("corner").within(memory);
    json_text::each(&ring, |index, position| match json_text::numbers(position) {
        Some(([x, y, _], 2..)) => table.push([x.as_bytes(), y.as_bytes()], 0),
        _ => {
            let number = index + 1;
            Err(Failure::input(format!("corner {number} is {}, not two numbers", quoted(position.as_bytes()))))
        }
    })?;
    table.complete()
}
