//! The header of an array: the type and the places of its numbers.
//!
//! `npyz` reads the text of the header. The length of the text and the depth of its brackets are checked first, so that
//! no file can exhaust memory or stack by its header.
//!
//! Source: the page "numpy.lib.format" of NumPy.

use std::io::Read;

use npyz::{DType, Field, NpyHeader, Order};

use super::cells::Item;
use crate::failure::{one_line, quoted, Failure};
use crate::input::unreadable;

/// The first bytes of every file.
const MAGIC: &[u8] = b"\x93NUMPY";
/// The number of bytes of the magic and the version.
const VERSION_END: usize = 8;
/// The most bytes that the text of a header may have. The text for an array of numbers has about 100.
const LONGEST_TEXT: u64 = 1 << 16;
/// The most brackets that may be open at a time in the text. A list of fields with shapes has four.
const DEEPEST: usize = 8;
/// The most bytes that a row may have.
pub const LONGEST_ROW: usize = 1 << 20;

/// The shapes and fields that an array must have.
pub struct Wanted {
    /// The name of the item that one row stands for, such as `point`, for messages.
    pub item: &'static str,
    /// The numbers of columns that an array may have.
    pub widths: &'static [u64],
    /// The shapes that an array may have, for messages.
    pub shapes: &'static str,
    /// The names of the columns in an array of records, and how many of them each record needs.
    pub fields: (&'static [&'static str], usize),
}

/// The numbers of one column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// The number of the column.
    pub axis: usize,
    /// The place of the number in its row, in bytes.
    pub offset: usize,
    /// The type of the numbers.
    pub item: Item,
}

/// Rows that follow one another in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The number of bytes of a row.
    pub stride: usize,
    /// The columns that the rows hold.
    pub columns: Vec<Column>,
}

/// The places of the numbers of an array. An array in C order is one pass with all columns, one in Fortran order a pass
/// for each column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The number of rows.
    pub rows: usize,
    /// The passes, in the order of the file.
    pub passes: Vec<Pass>,
    /// The number of bytes of all passes.
    pub bytes: u64,
    /// The shape, for messages.
    pub shape: String,
}

impl Layout {
    /// Reads a header. Returns the layout, and the number of bytes of the header.
    pub fn read(source: &mut dyn Read, wanted: &Wanted) -> Result<(Self, u64), Failure> {
        let text = read_text(source)?;
        let header = NpyHeader::from_reader(text.as_slice()).map_err(|error| unclear(&error.to_string()))?;
        Ok((Self::of(&header, wanted)?, text.len() as u64))
    }

    /// The columns of all passes.
    pub fn columns(&self) -> impl Iterator<Item = &Column> {
        self.passes.iter().flat_map(|pass| &pass.columns)
    }

    fn of(header: &NpyHeader, wanted: &Wanted) -> Result<Self, Failure> {
        let shape = shape_text(header.shape());
        if header.uses_pickled_array() {
            return Err(Failure::input(
                "the array holds Python objects, which are not read: save an array of numbers, such as \
                 array.astype('<f8')",
            ));
        }
        let (rows, passes) = match (header.dtype(), header.shape()) {
            (DType::Record(fields), &[rows]) => (rows, vec![pass_of_fields(&fields, wanted)?]),
            (dtype @ DType::Plain(_), &[rows, width]) if wanted.widths.contains(&width) => {
                let item = Item::of(&dtype).ok_or_else(|| wrong_type(&dtype))?;
                // The conversion loses nothing: `wanted` allows widths of 2 and 3 only.
                (rows, passes_of_items(item, width as usize, header.order()))
            }
            _ => {
                let Wanted { item, shapes, .. } = wanted;
                return Err(Failure::input(format!(
                    "the array has the shape {shape}, but {item}s have the shape {shapes}, a row for each {item}: \
                     transpose an array with a column for each {item}"
                )));
            }
        };
        let bytes = passes.iter().try_fold(0u64, |sum, pass| sum.checked_add(rows.checked_mul(pass.stride as u64)?));
        let (Some(bytes), Ok(rows)) = (bytes, usize::try_from(rows)) else {
            return Err(Failure::input(format!(
                "the header promises an array of shape {shape}, which no file can hold"
            )));
        };
        Ok(Self { rows, passes, bytes, shape })
    }
}

/// Reads the whole header, as its own length says.
fn read_text(source: &mut dyn Read) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    read_more(source, VERSION_END as u64, &mut bytes)?;
    if !bytes.starts_with(MAGIC) {
        return Err(Failure::input("not an array of NumPy: the first bytes are not those of a .npy file"));
    }
    let length_bytes = if bytes.get(MAGIC.len()) == Some(&1) { 2 } else { 4 };
    read_more(source, length_bytes, &mut bytes)?;
    let length = bytes.iter().skip(VERSION_END).rev().fold(0u64, |length, &byte| length << 8 | u64::from(byte));
    if length > LONGEST_TEXT {
        return Err(unclear(&format!("it promises {length} bytes of text, and at most {LONGEST_TEXT} are read")));
    }
    let promised = bytes.len() as u64 + length;
    read_more(source, length, &mut bytes)?;
    if (bytes.len() as u64) < promised.max(VERSION_END as u64 + length_bytes) {
        return Err(unclear("the file ends within it"));
    }
    let mut depth = 0usize;
    for byte in &bytes[VERSION_END..] {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(unclear("its brackets are nested too deeply"));
        }
    }
    Ok(bytes)
}

/// Adds up to `count` bytes; fewer only at the end of the file.
fn read_more(source: &mut dyn Read, count: u64, bytes: &mut Vec<u8>) -> Result<(), Failure> {
    source.take(count).read_to_end(bytes).map(|_| ()).map_err(|error| unreadable(&error))
}

/// The failure of a header that cannot be understood.
fn unclear(why: &str) -> Failure {
    Failure::input(format!("the header of the array cannot be read: {}", one_line(why)))
}

fn wrong_type(dtype: &DType) -> Failure {
    Failure::input(format!(
        "the array holds values of type {}, but integers of up to 64 bits, f4 or f8 are read: convert the array, as \
         with array.astype('<f8')",
        one_line(&dtype.descr())
    ))
}

/// The shape as Python writes it.
fn shape_text(shape: &[u64]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => {
            let lengths: Vec<_> = shape.iter().map(u64::to_string).collect();
            one_line(&format!("({})", lengths.join(", ")))
        }
    }
}

/// The passes of an array of `width` columns of one type.
fn passes_of_items(item: Item, width: usize, order: Order) -> Vec<Pass> {
    match order {
        Order::C => {
            let column = |axis| Column { axis, offset: axis * item.size, item };
            vec![Pass { stride: width * item.size, columns: (0..width).map(column).collect() }]
        }
        Order::Fortran => {
            let pass = |axis| Pass { stride: item.size, columns: vec![Column { axis, offset: 0, item }] };
            (0..width).map(pass).collect()
        }
    }
}

/// The pass of an array of records. Fields with other names are left out.
fn pass_of_fields(fields: &[Field], wanted: &Wanted) -> Result<Pass, Failure> {
    let (names, needed) = wanted.fields;
    let mut columns = vec![None; names.len()];
    let mut stride = 0usize;
    for field in fields {
        let size = field.dtype.num_bytes().and_then(|size| stride.checked_add(size));
        let end = size.filter(|&end| end <= LONGEST_ROW);
        let end = end.ok_or_else(|| Failure::input(format!("a row of the array has more than {LONGEST_ROW} bytes")))?;
        if let Some(axis) = names.iter().position(|name| *name == field.name) {
            let item = Item::of(&field.dtype).ok_or_else(|| wrong_type(&field.dtype))?;
            columns[axis] = Some(Column { axis, offset: stride, item });
        }
        stride = end;
    }
    if needed == 0 || columns[..needed].contains(&None) {
        let found: Vec<_> = fields.iter().take(8).map(|field| quoted(field.name.as_bytes())).collect();
        let (found, item, shapes) = (one_line(&found.join(", ")), wanted.item, wanted.shapes);
        let fields = if needed > 0 { " or the fields x and y" } else { "" };
        return Err(Failure::input(format!(
            "the array holds records with the fields {found}, but {item}s have the shape {shapes}{fields}"
        )));
    }
    Ok(Pass { stride, columns: columns.into_iter().flatten().collect() })
}
