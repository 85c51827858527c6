//! JSON: one object with `points`, `triangles`, `hull` and `duplicates`.
//!
//! `points` has the input points `[x, y]`, `triangles` triples of indices into `points`, `hull` indices, and
//! `duplicates` pairs `[index, lowest index at the same place]`.

use std::io::{self, Write};

use serde_json::Value;

use crate::failure::{quoted, Failure};
use crate::formats::geojson;
use crate::formats::mesh_view::MeshView;
use crate::points::PointTable;

/// Reads the list `points`, which has pairs of finite numbers, and ignores everything else in the object. An object
/// without that list, or with the key `type` of GeoJSON, is read as GeoJSON.
pub fn read_points(bytes: &[u8]) -> Result<PointTable, Failure> {
    let object: Result<Value, _> = serde_json::from_slice(crate::text::without_mark(bytes)?);
    let own = object.as_ref().ok().filter(|object| object.get("type").is_none());
    let Some(list) = own.and_then(|object| object.get("points")?.as_array()) else {
        let fault = object.err();
        return geojson::read_points(bytes).map_err(|failure| match fault {
            Some(error) if failure.message.starts_with(geojson::REFUSED) => {
                Failure::input(format!("not JSON: {error}"))
            }
            _ => failure,
        });
    };
    let mut table = PointTable::of_items("point");
    for (index, value) in list.iter().enumerate() {
        let Some([Value::Number(x), Value::Number(y)]) = value.as_array().map(Vec::as_slice) else {
            let shown = quoted(value.to_string().as_bytes());
            return Err(Failure::input(format!("points[{index}] is {shown}, not two numbers")));
        };
        // The parser keeps whole numbers of 64 bits, and makes doubles of other numbers. The shortest text of a double
        // is the decimal in the file, if that has up to 15 digits.
        table.push([x.to_string().as_bytes(), y.to_string().as_bytes()], 0)?;
    }
    table.complete()
}

/// Reads the list `triangles` and ignores everything else in the object.
pub fn read_mesh(bytes: &[u8]) -> Result<Vec<[u32; 3]>, Failure> {
    let bytes = crate::text::without_mark(bytes)?;
    let object: Value = serde_json::from_slice(bytes).map_err(|error| Failure::input(format!("not JSON: {error}")))?;
    let Some(list) = object.get("triangles").and_then(Value::as_array) else {
        return Err(Failure::input("the object has no list 'triangles'"));
    };
    let triangles = list.iter().enumerate().map(|(index, value)| read_triangle(value, index));
    triangles.collect()
}

fn read_triangle(value: &Value, index: usize) -> Result<[u32; 3], Failure> {
    let corners = value.as_array().map(Vec::as_slice).unwrap_or_default();
    let read = |corner: &Value| corner.as_u64().and_then(|number| u32::try_from(number).ok());
    match corners {
        [a, b, c] => read(a).zip(read(b)).zip(read(c)).map(|((a, b), c)| [a, b, c]),
        _ => None,
    }
    .ok_or_else(|| {
        let shown = quoted(value.to_string().as_bytes());
        Failure::input(format!("triangles[{index}] is {shown}, not three point indices"))
    })
}

/// Writes the object with one item per row.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"points\":")?;
    write_list(out, mesh.positions().map(|([x, y], _)| format!("[{x},{y}]")))?;
    write!(out, ",\n\"triangles\":")?;
    write_list(out, mesh.triangles.iter().map(|[a, b, c]| format!("[{a},{b},{c}]")))?;
    write!(out, ",\n\"hull\":")?;
    write_list(out, mesh.hull.iter().map(u32::to_string))?;
    write!(out, ",\n\"duplicates\":")?;
    write_list(out, mesh.duplicates.iter().map(|[i, of]| format!("[{i},{of}]")))?;
    writeln!(out, "}}")
}

fn write_list(out: &mut dyn Write, items: impl Iterator<Item = String>) -> io::Result<()> {
    write!(out, "[")?;
    for (index, item) in items.enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(out, "{comma}\n{item}")?;
    }
    write!(out, "]")
}
