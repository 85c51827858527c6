//! Reading PLY, the Stanford polygon format: ascii and both binary forms.
//!
//! A comment with the mark of doubles says that the decimals of an ascii file stand for the nearest doubles.
//!
//! Points are `x`, `y` and `z` of the element `vertex`, triangles the list `vertex_indices` or `vertex_index` of
//! `face`; everything else is ignored. `ply-rs-bw` decodes headers and binary elements, one element at a time, so the
//! claims of a header alone allocate nothing.

use std::io;

use incircle::Shown;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType};

use crate::failure::{counted, one_line, quoted, Failure};
use crate::memory::Memory;
use crate::points::{PointTable, DOUBLES};
use crate::text;

/// Reads the vertices of a file as points.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let mut table = PointTable::of_items("vertex").within(memory);
    let mut header = text::rows(bytes).map(|(_, row)| row).take_while(|&row| row != b"end_header");
    if header.any(|row| row == format!("comment {DOUBLES}").as_bytes()) {
        table.take_doubles();
    }
    read_element(bytes, "vertex", |item, _| {
        let [x, y, z] = item.position;
        match [x, y] {
            [Some(Value::Double(x)), Some(Value::Double(y))] => table.push_doubles([x, y], 0)?,
            texts => {
                let texts = texts.map(|value| value.map(Value::into_text).unwrap_or_default());
                table.push([&texts[0], &texts[1]], 0)?;
            }
        }
        table.push_height(z.map(Value::into_text).as_deref(), 0)
    })?;
    table.complete()
}

/// Reads the faces, which must be triangles.
pub fn read_mesh(bytes: &[u8], memory: Memory) -> Result<Vec<[u32; 3]>, Failure> {
    let mut triangles = Vec::new();
    read_element(bytes, "face", |item, index| {
        let number = index + 1;
        let (corners, count) = item.corners;
        if count != 3 {
            return Err(Failure::input(format!("face {number} has {}, not 3", counted(count, "corner"))));
        }
        let mut triangle = [0; 3];
        for (vertex, corner) in triangle.iter_mut().zip(corners) {
            if !(corner >= 0.0 && corner <= f64::from(u32::MAX) && corner.fract() == 0.0) {
                return Err(Failure::input(format!("face {number}: {} is not a point index", Shown(corner))));
            }
            *vertex = corner as u32;
        }
        memory.push(&mut triangles, triangle)
    })?;
    Ok(triangles)
}

/// A coordinate of a vertex.
enum Value {
    /// A number of a binary file.
    Double(f64),
    /// A number of an ascii file, as written.
    Text(Vec<u8>),
}

impl Value {
    /// The number as a text from which it can be read again.
    fn into_text(self) -> Vec<u8> {
        match self {
            Self::Double(value) => format!("{value:e}").into_bytes(),
            Self::Text(text) => text,
        }
    }
}

/// The properties that are taken from an element.
struct Item {
    /// The properties `x`, `y` and `z`.
    position: [Option<Value>; 3],
    corners: Corners,
}

/// The first three numbers of a list, and how many it has. A list of any length takes no memory so.
type Corners = ([f64; 3], usize);

impl Item {
    /// The place for a coordinate of this name, if there is one.
    fn coordinate(&mut self, name: &str) -> Option<&mut Option<Value>> {
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name)?;
        Some(&mut self.position[axis])
    }

    /// Keeps the numbers of a property if they are the corners of a face.
    fn keep_corners(&mut self, name: &str, values: Corners) {
        if matches!(name, "vertex_indices" | "vertex_index") {
            self.corners = values;
        }
    }
}

impl PropertyAccess for Item {
    fn new() -> Self {
        Self { position: [None, None, None], corners: ([0.0; 3], 0) }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let values = numbers(property);
        match self.coordinate(name) {
            Some(coordinate) => *coordinate = (values.1 > 0).then_some(Value::Double(values.0[0])),
            None => self.keep_corners(name, values),
        }
        PropertyAccessResult::Set
    }
}

/// The numbers of a property. Doubles hold each of its types exactly.
fn numbers(property: Property) -> Corners {
    fn all<T: Into<f64> + Copy>(list: Vec<T>) -> Corners {
        let mut first = [0.0; 3];
        first.iter_mut().zip(&list).for_each(|(number, &value)| *number = value.into());
        (first, list.len())
    }
    let one = |value: f64| ([value, 0.0, 0.0], 1);
    match property {
        Property::Char(value) => one(value.into()),
        Property::UChar(value) => one(value.into()),
        Property::Short(value) => one(value.into()),
        Property::UShort(value) => one(value.into()),
        Property::Int(value) => one(value.into()),
        Property::UInt(value) => one(value.into()),
        Property::Float(value) => one(value.into()),
        Property::Double(value) => one(value),
        Property::ListChar(list) => all(list),
        Property::ListUChar(list) => all(list),
        Property::ListShort(list) => all(list),
        Property::ListUShort(list) => all(list),
        Property::ListInt(list) => all(list),
        Property::ListUInt(list) => all(list),
        Property::ListFloat(list) => all(list),
        Property::ListDouble(list) => all(list),
    }
}

type Take<'a> = &'a mut dyn FnMut(Item, usize) -> Result<(), Failure>;

/// Calls `take` with every item of the element `wanted` and the index of the item.
fn read_element(
    bytes: &[u8],
    wanted: &str,
    mut take: impl FnMut(Item, usize) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Item>::new().read_header(&mut reader);
    let header = header.map_err(|error| Failure::input(format!("not a PLY header: {}", header_fault(&error))))?;
    if !header.elements.contains_key(wanted) {
        return Err(Failure::input(format!("the header has no element '{wanted}'")));
    }
    let mut rest: &[u8] = reader.into_inner();
    for (name, element) in &header.elements {
        refuse_false_count(element, &header, rest)?;
        if name == wanted {
            read_items(element, &header, &mut rest, &mut take)?;
        } else {
            read_items(element, &header, &mut rest, &mut |_, _| Ok(()))?;
        }
    }
    refuse_remainder(&header, rest)
}

/// The message of a header that cannot be read, without the parser's dump of its own state.
fn header_fault(error: &ply_rs_bw::parser::ParseError) -> String {
    let message = error.to_string();
    one_line(message.split("Error: ParseError").next().unwrap_or_default())
}

/// Refuses data after the last element, which a count that is too small would lose silently.
fn refuse_remainder(header: &Header, rest: &[u8]) -> Result<(), Failure> {
    let (left, unit) = match header.encoding {
        Encoding::Ascii => {
            let rows = text::rows(rest).filter(|(_, row)| text::words(row).next().is_some());
            (rows.count(), "row")
        }
        Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => (rest.len(), "byte"),
    };
    if left > 0 {
        let left = counted(left, unit);
        return Err(Failure::input(format!(
            "the file holds more than its header promises: {left} after the last element"
        )));
    }
    Ok(())
}

/// Refuses a count that the remaining bytes cannot hold. Every value takes at least one byte.
fn refuse_false_count(element: &ElementDef, header: &Header, rest: &[u8]) -> Result<(), Failure> {
    let name = &element.name;
    if element.properties.is_empty() {
        return Err(Failure::input(format!("element '{name}' has no properties")));
    }
    let room = match header.encoding {
        Encoding::Ascii => text::rows(rest).count(),
        Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => rest.len() / element.properties.len(),
    };
    if element.count > room {
        return Err(Failure::input(format!(
            "the header promises {} of element '{name}', but the file ends after {room} at most",
            element.count
        )));
    }
    Ok(())
}

fn read_items(element: &ElementDef, header: &Header, rest: &mut &[u8], take: Take<'_>) -> Result<(), Failure> {
    let parser = Parser::<Item>::new();
    for index in 0..element.count {
        let item = match header.encoding {
            Encoding::Ascii => read_row(element, rest, index)?,
            Encoding::BinaryBigEndian => binary(parser.read_big_endian_element(rest, element), element, index)?,
            Encoding::BinaryLittleEndian => binary(parser.read_little_endian_element(rest, element), element, index)?,
        };
        take(item, index)?;
    }
    Ok(())
}

fn binary(
    item: Result<Item, ply_rs_bw::parser::ParseError>,
    element: &ElementDef,
    index: usize,
) -> Result<Item, Failure> {
    item.map_err(|error| match error.kind() {
        io::ErrorKind::UnexpectedEof => Failure::input(format!(
            "the header promises {} of element '{}', but the file ends in number {}",
            element.count,
            element.name,
            index + 1
        )),
        _ => Failure::input(format!("{} {}: {}", element.name, index + 1, one_line(&error.to_string()))),
    })
}

/// Takes the next text row from `rest` and reads it as an item.
fn read_row(element: &ElementDef, rest: &mut &[u8], index: usize) -> Result<Item, Failure> {
    let end = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
    let (row, after) = rest.split_at(end);
    *rest = after.strip_prefix(b"\n").unwrap_or(after);
    let mut words = text::words(row);
    let place = |name: &str| format!("{} {}, {name}", element.name, index + 1);
    let number = |word: Option<&[u8]>, name: &str| -> Result<f64, Failure> {
        let word = word.ok_or_else(|| Failure::input(format!("{}: the value is missing", place(name))))?;
        let parsed = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f64>().ok());
        parsed.ok_or_else(|| Failure::input(format!("{}: {} is not a number", place(name), quoted(word))))
    };
    let mut item = Item::new();
    for (name, property) in &element.properties {
        if let (PropertyType::Scalar(_), Some(coordinate)) = (&property.data_type, item.coordinate(name)) {
            let word = words.next().ok_or_else(|| Failure::input(format!("{}: the value is missing", place(name))))?;
            *coordinate = Some(Value::Text(word.to_vec()));
            continue;
        }
        let count = match property.data_type {
            PropertyType::Scalar(_) => 1,
            // A count that is not a whole number turns into zero, or into one that the row cannot hold.
            PropertyType::List(..) => number(words.next(), name)? as usize,
        };
        let mut first = [0.0; 3];
        for index in 0..count {
            let value = number(words.next(), name)?;
            if let Some(place) = first.get_mut(index) {
                *place = value;
            }
        }
        item.keep_corners(name, (first, count));
    }
    if words.next().is_some() {
        return Err(Failure::input(format!("{} {} has more values than the header promises", element.name, index + 1)));
    }
    Ok(item)
}
