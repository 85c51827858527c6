//! How identities, points, records and reports are laid out in words.

/// Words of an [`Identity`].
pub const IDENTITY_WORDS: usize = 7;

/// What an implementation says of itself, in the order of its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// [`MAGIC`](crate::MAGIC).
    pub magic: u32,
    /// [`PROTOCOL_VERSION`](crate::PROTOCOL_VERSION).
    pub protocol_version: u32,
    /// Version of the implementation, `major << 16 | minor << 8 | patch`.
    pub core_version: u32,
    /// Bits of a coordinate, 1 to 31.
    pub coord_bits: u32,
    /// Points it holds.
    pub capacity: u32,
    /// Insertions it works on at once.
    pub contexts: u32,
    /// Boundary edges of a cavity it keeps; larger cavities are done by flips.
    pub ring_capacity: u32,
}

impl Identity {
    /// As words on the link.
    pub const fn to_words(self) -> [u32; IDENTITY_WORDS] {
        [
            self.magic,
            self.protocol_version,
            self.core_version,
            self.coord_bits,
            self.capacity,
            self.contexts,
            self.ring_capacity,
        ]
    }

    /// From words on the link; nothing is checked.
    pub const fn from_words(words: [u32; IDENTITY_WORDS]) -> Self {
        Self {
            magic: words[0],
            protocol_version: words[1],
            core_version: words[2],
            coord_bits: words[3],
            capacity: words[4],
            contexts: words[5],
            ring_capacity: words[6],
        }
    }
}

/// Words of an [`InsertReport`].
pub const INSERT_REPORT_WORDS: usize = 5;

/// The payload of an `Insert` answer: totals since the last `Clear`.
///
/// A point's vertex id is its arrival number since the last `Clear`, duplicates counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InsertReport {
    /// Points that arrived and were given a vertex id.
    pub arrived: u32,
    /// Points that are vertices of the mesh.
    pub inserted: u32,
    /// Points that fell onto an earlier one.
    pub duplicates: u32,
    /// Points refused.
    pub refused: u32,
    /// Triangle records, ghosts included: `2 * inserted - 2`, or 0 with fewer than three points.
    pub records: u32,
}

impl InsertReport {
    /// As words on the link.
    pub const fn to_words(self) -> [u32; INSERT_REPORT_WORDS] {
        [self.arrived, self.inserted, self.duplicates, self.refused, self.records]
    }

    /// From words on the link; nothing is checked.
    pub const fn from_words(words: [u32; INSERT_REPORT_WORDS]) -> Self {
        Self { arrived: words[0], inserted: words[1], duplicates: words[2], refused: words[3], records: words[4] }
    }
}

/// Word layout of points and records, which follows from the identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Words of a point. 1: `x | y << 16` (coordinates up to 16 bits). 2: `x`, `y`.
    pub point_words: usize,
    /// Words of a triangle record. 3: word `k` is `v[k] | n[k] << 15`, bit 31 of word 0 is the lock bit
    /// (ids up to 15 bits, bit 30 unused). 6: `v[0]`, `v[1]`, `v[2]`, `n[0]`, `n[1]`, `n[2]`.
    pub record_words: usize,
}

/// Bits of an id in a three-word record.
pub const NARROW_ID_BITS: u32 = 15;

impl Layout {
    /// The layout of an implementation with these coordinate bits and this capacity.
    pub const fn of(coord_bits: u32, capacity: u32) -> Self {
        let narrow =
            crate::triangle_id_bits(capacity) <= NARROW_ID_BITS && crate::vertex_id_bits(capacity) <= NARROW_ID_BITS;
        Self { point_words: if coord_bits <= 16 { 1 } else { 2 }, record_words: if narrow { 3 } else { 6 } }
    }

    /// A point as words; the second counts only where `point_words` is 2.
    pub const fn point_to_words(self, x: u32, y: u32) -> [u32; 2] {
        if self.point_words == 1 {
            [x | y << 16, 0]
        } else {
            [x, y]
        }
    }

    /// A record (`v`, `n`) from `record_words` words.
    #[inline]
    pub fn record_from_words(self, words: &[u32]) -> ([u32; 3], [u32; 3]) {
        if self.record_words == 3 {
            let mask = (1 << NARROW_ID_BITS) - 1;
            let column = |shift: u32| [words[0] >> shift & mask, words[1] >> shift & mask, words[2] >> shift & mask];
            (column(0), column(NARROW_ID_BITS))
        } else {
            ([words[0], words[1], words[2]], [words[3], words[4], words[5]])
        }
    }

    /// Words of the payload of a `Triangles` answer for this many records, if 32 bits can say it. Narrow: ids of 16 bits without gaps, the
    /// low half of a word first; an odd last half is zero. Wide: a word an id.
    pub const fn triangles_words(self, records: u32) -> Option<u32> {
        let words = self.packed_words(records);
        if words <= u32::MAX as u64 {
            Some(words as u32)
        } else {
            None
        }
    }

    /// The same, also where 32 bits cannot say it.
    pub(crate) const fn packed_words(self, records: u32) -> u64 {
        let ids = 3 * records as u64;
        if self.record_words == 3 {
            ids.div_ceil(2)
        } else {
            ids
        }
    }

    /// The vertices of a record of such a payload.
    #[inline]
    pub fn vertices_from_words(self, words: &[u32], record: usize) -> [u32; 3] {
        let place = 3 * record;
        if self.record_words == 3 {
            let id = |half: usize| words[half / 2] >> (16 * (half % 2)) & 0xffff;
            [id(place), id(place + 1), id(place + 2)]
        } else {
            [words[place], words[place + 1], words[place + 2]]
        }
    }

    /// Puts the vertices of a record into such a payload, which was zero there.
    #[inline]
    pub fn vertices_to_words(self, v: [u32; 3], words: &mut [u32], record: usize) {
        for (place, id) in (3 * record..).zip(v) {
            if self.record_words == 3 {
                words[place / 2] |= id << (16 * (place % 2));
            } else {
                words[place] = id;
            }
        }
    }

    /// The first three or all six words of a record on the link; `locked` has a place in the narrow form only.
    pub const fn record_to_words(self, v: [u32; 3], n: [u32; 3], locked: bool) -> [u32; 6] {
        if self.record_words == 3 {
            let mut words = [0; 6];
            let mut k = 0;
            while k < 3 {
                words[k] = v[k] | n[k] << NARROW_ID_BITS;
                k += 1;
            }
            words[0] |= (locked as u32) << 31;
            words
        } else {
            [v[0], v[1], v[2], n[0], n[1], n[2]]
        }
    }
}
