//! The numbers of an array, from their bytes.

use npyz::{DType, Endianness, TypeChar};

/// The kinds of numbers that bytes may stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Signed,
    Unsigned,
    Float,
}

/// The type of the numbers of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    kind: Kind,
    /// The number of bytes of a number: 1, 2, 4 or 8.
    pub size: usize,
    /// Whether the first byte is the most significant one.
    is_big_endian: bool,
}

impl Item {
    /// The type with this description; `None` if the type is neither an integer of up to 64 bits nor `f4` nor `f8`.
    pub fn of(dtype: &DType) -> Option<Self> {
        let DType::Plain(named) = dtype else {
            return None;
        };
        let kind = match (named.type_char(), named.size_field()) {
            (TypeChar::Int, 1 | 2 | 4 | 8) => Kind::Signed,
            (TypeChar::Uint, 1 | 2 | 4 | 8) => Kind::Unsigned,
            (TypeChar::Float, 4 | 8) => Kind::Float,
            _ => return None,
        };
        let is_big_endian = named.endianness() == Endianness::Big;
        Some(Self { kind, size: named.num_bytes()?, is_big_endian })
    }

    /// Whether the numbers are whole by their type.
    pub fn is_integer(self) -> bool {
        self.kind != Kind::Float
    }
}

/// The numbers of one column in a piece of an array.
#[derive(Clone, Copy, Debug)]
pub struct Cells<'a> {
    /// The bytes of whole rows.
    pub bytes: &'a [u8],
    /// The number of bytes of a row.
    pub stride: usize,
    /// The place of the number in its row, in bytes.
    pub offset: usize,
    /// The type of the numbers.
    pub item: Item,
    /// The number of the column.
    pub axis: usize,
    /// The index of the first row in the array.
    pub first: usize,
    /// The index in the array of the first row of the list that is filled.
    pub list: usize,
}

impl Cells<'_> {
    /// The place in the list of the first row.
    pub fn start(&self) -> usize {
        self.first - self.list
    }

    /// The place in the list after the last row.
    pub fn end(&self) -> usize {
        self.start() + self.bytes.len() / self.stride.max(1)
    }

    /// Calls `put` with all numbers of a column of integers. An integer of 2^63 or more comes as a negative one;
    /// [`Cells::beyond`] tells it.
    pub fn integers(&self, mut put: impl FnMut(i64)) {
        match (self.item.kind, self.item.size) {
            (Kind::Signed, 1) => self.each(|cell| put(i8::from_le_bytes(cell).into())),
            (Kind::Signed, 2) => self.each(|cell| put(i16::from_le_bytes(cell).into())),
            (Kind::Signed, 4) => self.each(|cell| put(i32::from_le_bytes(cell).into())),
            (Kind::Unsigned, 1) => self.each(|cell| put(u8::from_le_bytes(cell).into())),
            (Kind::Unsigned, 2) => self.each(|cell| put(u16::from_le_bytes(cell).into())),
            (Kind::Unsigned, 4) => self.each(|cell| put(u32::from_le_bytes(cell).into())),
            _ => self.each(|cell| put(i64::from_le_bytes(cell))),
        }
    }

    /// The number that an integer of [`Cells::integers`] stands for, if that is 2^63 or more.
    pub fn beyond(&self, integer: i64) -> Option<u64> {
        let is_beyond = self.item.kind == Kind::Unsigned && integer < 0;
        is_beyond.then_some(integer.cast_unsigned())
    }

    /// Calls `put` with all numbers of a column, as the nearest doubles.
    pub fn doubles(&self, mut put: impl FnMut(f64)) {
        match (self.item.kind, self.item.size) {
            (Kind::Float, 4) => self.each(|cell| put(f32::from_le_bytes(cell).into())),
            (Kind::Float, _) => self.each(|cell| put(f64::from_le_bytes(cell))),
            (Kind::Unsigned, 8) => self.each(|cell| put(u64::from_le_bytes(cell) as f64)),
            _ => self.integers(|integer| put(integer as f64)),
        }
    }

    /// Calls `take` with the bytes of all numbers, the least significant byte first.
    fn each<const N: usize>(&self, mut take: impl FnMut([u8; N])) {
        if self.item.is_big_endian {
            self.stored(|mut cell| {
                cell.reverse();
                take(cell);
            });
        } else {
            self.stored(take);
        }
    }

    fn stored<const N: usize>(&self, mut take: impl FnMut([u8; N])) {
        for row in self.bytes.chunks_exact(self.stride) {
            if let Some(cell) = row.get(self.offset..).and_then(<[u8]>::first_chunk) {
                take(*cell);
            }
        }
    }
}
