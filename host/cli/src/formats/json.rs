//! JSON: one object with `points`, `triangles`, `hull` and `duplicates`.
//!
//! `points` are the input points `[x, y]`, `triangles` triples of indices into them, `hull` a list of indices, `duplicates`
//! pairs `[index, lowest index with the same place]`.

use std::io::{self, Write};

use serde_json::Value;

use crate::failure::Failure;
use crate::formats::MeshView;

/// Reads `triangles`; all else in the object is left out.
pub fn read_mesh(bytes: &[u8]) -> Result<Vec<[u32; 3]>, Failure> {
    let bytes = crate::text::without_mark(bytes)?;
    let object: Value = serde_json::from_slice(bytes)
        .map_err(|error| Failure::input(format!("not JSON: {error}")))?;
    let Some(list) = object.get("triangles").and_then(Value::as_array) else {
        return Err(Failure::input("the object has no list 'triangles'"));
    };
    let triangles = list
        .iter()
        .enumerate()
        .map(|(index, value)| read_triangle(value, index));
    triangles.collect()
}

fn read_triangle(value: &Value, index: usize) -> Result<[u32; 3], Failure> {
    let corners = value.as_array().map(Vec::as_slice).unwrap_or_default();
    let read = |corner: &Value| {
        corner
            .as_u64()
            .and_then(|number| u32::try_from(number).ok())
    };
    match corners {
        [a, b, c] => read(a)
            .zip(read(b))
            .zip(read(c))
            .map(|((a, b), c)| [a, b, c]),
        _ => None,
    }
    .ok_or_else(|| {
        let shown = crate::failure::quoted(value.to_string().as_bytes());
        Failure::input(format!(
            "triangles[{index}] is {shown}, not three point indices"
        ))
    })
}

/// Writes the object, an item per row.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"points\":")?;
    write_list(out, mesh.points.iter().map(|[x, y]| format!("[{x},{y}]")))?;
    write!(out, ",\n\"triangles\":")?;
    write_list(
        out,
        mesh.triangles
            .iter()
            .map(|[a, b, c]| format!("[{a},{b},{c}]")),
    )?;
    write!(out, ",\n\"hull\":")?;
    write_list(out, mesh.hull.iter().map(u32::to_string))?;
    write!(out, ",\n\"duplicates\":")?;
    write_list(
        out,
        mesh.duplicates.iter().map(|[i, of]| format!("[{i},{of}]")),
    )?;
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
