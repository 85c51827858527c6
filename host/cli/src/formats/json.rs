//! JSON: one object with `points`, `triangles`, `hull` and `duplicates`.
//!
//! `points` has the input points `[x, y]`, `triangles` triples of indices into `points`, `hull` indices, and
//! `duplicates` pairs `[index, lowest index at the same place]`. The key `numbers` with the value `doubles` says that
//! the decimals in `points` stand for the nearest doubles. A mesh with constraints also has `regions`, the region of
//! each triangle, and `pieces` with items `[a, b, [constraints]]`.

use std::io::{self, Write};

use crate::failure::{quoted, Failure};
use crate::formats::mesh_view::MeshView;
use crate::formats::plan::PlanTable;
use crate::formats::{geojson, json_text};
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// The value of the key `numbers` where the decimals stand for doubles.
const DOUBLES: &str = "doubles";

/// Reads the list `points`, which has pairs of finite numbers, and ignores everything else in the object. An object
/// without that list, or with the key `type` of GeoJSON, is read as GeoJSON.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let (list, numbers) = match json_text::fields(text::utf8(bytes)?, ["type", "points", "numbers"]) {
        Ok([None, Some(list), numbers]) if json_text::is_list(list) => (list, numbers),
        Err(error) if !error.is_data() => return Err(json_text::refuse(&error)),
        _ => return geojson::read_points(bytes, memory),
    };
    let mut table = PointTable::of_items("point").within(memory);
    if numbers.and_then(json_text::string).as_deref() == Some(DOUBLES) {
        table.take_doubles();
    }
    json_text::each(list, |index, item| match json_text::numbers(item) {
        Some(([x, y, _], 2)) => table.push([x.as_bytes(), y.as_bytes()], 0),
        _ => {
            let shown = quoted(item.as_bytes());
            Err(Failure::input(format!("points[{index}] is {shown}, not two numbers")))
        }
    })?;
    table.complete()
}

/// Reads the points of a list `points`, which has no constraints, or a plan of GeoJSON.
pub fn read_plan(bytes: &[u8], memory: Memory) -> Result<PlanTable, Failure> {
    match json_text::fields(text::utf8(bytes)?, ["type", "points"]) {
        Ok([None, Some(list)]) if json_text::is_list(list) => {
            read_points(bytes, memory).map(|table| PlanTable::of_points(table, true))
        }
        Err(error) if !error.is_data() => Err(json_text::refuse(&error)),
        _ => geojson::read_plan(bytes, memory),
    }
}

/// Reads the list `triangles` and ignores everything else in the object.
pub fn read_mesh(bytes: &[u8], memory: Memory) -> Result<Vec<[u32; 3]>, Failure> {
    let fields = json_text::fields(text::utf8(bytes)?, ["triangles"]);
    let [list] = fields.or_else(|error| if error.is_data() { Ok([None]) } else { Err(json_text::refuse(&error)) })?;
    let Some(list) = list.filter(|list| json_text::is_list(list)) else {
        return Err(Failure::input("the object has no list 'triangles'"));
    };
    let mut triangles = Vec::new();
    json_text::each(list, |index, item| {
        let triangle = serde_json::from_str(item).map_err(|_| {
            let shown = quoted(item.as_bytes());
            Failure::input(format!("triangles[{index}] is {shown}, not three point indices"))
        })?;
        memory.push(&mut triangles, triangle)
    })?;
    Ok(triangles)
}

/// Writes the object with one item per row.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{")?;
    if mesh.points.needs_mark() {
        writeln!(out, "\"numbers\":\"{DOUBLES}\",")?;
    }
    write!(out, "\"points\":")?;
    write_list(out, mesh.positions().map(|([x, y], _)| format!("[{x},{y}]")))?;
    write!(out, ",\n\"triangles\":")?;
    write_list(out, mesh.triangles.iter().map(|[a, b, c]| format!("[{a},{b},{c}]")))?;
    write!(out, ",\n\"hull\":")?;
    write_list(out, mesh.hull.iter().map(u32::to_string))?;
    write!(out, ",\n\"duplicates\":")?;
    write_list(out, mesh.duplicates.iter().map(|[i, of]| format!("[{i},{of}]")))?;
    if let Some(planned) = mesh.planned {
        write!(out, ",\n\"regions\":")?;
        write_list(out, planned.made.regions.iter().map(u32::to_string))?;
        write!(out, ",\n\"pieces\":")?;
        let piece = |([a, b], constraints): ([u32; 2], &[u32])| {
            let constraints: Vec<String> = constraints.iter().map(u32::to_string).collect();
            format!("[{a},{b},[{}]]", constraints.join(","))
        };
        write_list(out, planned.made.pieces.iter().map(piece))?;
    }
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
