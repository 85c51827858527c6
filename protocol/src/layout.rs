//! The layout of identities, points, records and reports in 32-bit words.

/// Number of words of an [`Identity`].
pub const IDENTITY_WORDS: usize = 7;

/// Lowest bit of the number of engines in the sixth word of an identity.
pub const ENGINES_SHIFT: u32 = 8;

/// Lowest bit of the features in the seventh word of an identity.
pub const FEATURES_SHIFT: u32 = 16;

/// The properties that a device reports, in the order of their words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The letters `inCi`, [`MAGIC`](crate::MAGIC).
    pub magic: u32,
    /// Version of the protocol, as [`PROTOCOL_VERSION`](crate::PROTOCOL_VERSION) packs it.
    pub protocol_version: u32,
    /// Version of the core or model, `major << 16 | minor << 8 | patch`.
    pub core_version: u32,
    /// Bits of one coordinate, 1 to 31.
    pub coord_bits: u32,
    /// Number of points that the memory of an engine holds.
    pub capacity: u32,
    /// Number of contexts of an engine, which is the number of its insertions in progress at a time.
    pub contexts: u32,
    /// Number of engines. Each has a memory of this capacity and takes whole jobs.
    pub engines: u32,
    /// Number of boundary edges that a context's list holds. A point with a longer boundary becomes a solo insertion,
    /// by flips.
    pub ring_capacity: u32,
    /// The features that the device has beyond the commands of every device, a bit each:
    /// [`FEATURE_RUNS`](crate::FEATURE_RUNS), [`FEATURE_SHORT_IDS`](crate::FEATURE_SHORT_IDS), and one for each
    /// [kind of runs](crate::RunKind::feature). All other bits are 0, and a host does not look at them.
    pub features: u32,
}

impl Identity {
    /// The identity as words, in the order of the fields. Contexts and engines share a word, and so do boundary edges
    /// and features.
    pub const fn to_words(self) -> [u32; IDENTITY_WORDS] {
        [
            self.magic,
            self.protocol_version,
            self.core_version,
            self.coord_bits,
            self.capacity,
            self.contexts_word(),
            self.features << FEATURES_SHIFT | self.ring_capacity,
        ]
    }

    /// The word with the number of contexts in the low byte and that of engines above it.
    pub const fn contexts_word(self) -> u32 {
        self.engines << ENGINES_SHIFT | self.contexts
    }

    /// The identity from words in the order of the fields. No value is checked. A device of version 1.2 says 0 in place
    /// of the number of engines, and has one; it has no features.
    pub const fn from_words(words: [u32; IDENTITY_WORDS]) -> Self {
        let engines = words[5] >> ENGINES_SHIFT;
        Self {
            magic: words[0],
            protocol_version: words[1],
            core_version: words[2],
            coord_bits: words[3],
            capacity: words[4],
            contexts: words[5] & ((1 << ENGINES_SHIFT) - 1),
            engines: if engines == 0 { 1 } else { engines },
            ring_capacity: words[6] & ((1 << FEATURES_SHIFT) - 1),
            features: words[6] >> FEATURES_SHIFT,
        }
    }
}

/// Number of words of an [`InsertReport`].
pub const INSERT_REPORT_WORDS: usize = 5;

/// The payload of the answer to `Insert`: totals since the last `Clear`.
///
/// The vertex id of a point is its number in the order of arrival since the last `Clear`; duplicates count as well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InsertReport {
    /// Points that arrived and got a vertex id.
    pub arrived: u32,
    /// Points that are vertices of the mesh.
    pub inserted: u32,
    /// Points equal to an earlier one.
    pub duplicates: u32,
    /// Points that the device refused: beyond its capacity, or after a collinear start.
    pub refused: u32,
    /// Triangle records, ghost triangles included: `2 * inserted - 2`, or 0 with fewer than three points.
    pub records: u32,
}

impl InsertReport {
    /// The report as words, in the order of the fields.
    pub const fn to_words(self) -> [u32; INSERT_REPORT_WORDS] {
        [self.arrived, self.inserted, self.duplicates, self.refused, self.records]
    }

    /// The report from words in the order of the fields. No value is checked.
    pub const fn from_words(words: [u32; INSERT_REPORT_WORDS]) -> Self {
        Self { arrived: words[0], inserted: words[1], duplicates: words[2], refused: words[3], records: words[4] }
    }
}

/// Layout of points and records in words, which follows from the identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Words of a point. 1: `x | y << 16`, for coordinates of up to 16 bits. 2: `x`, `y`.
    pub point_words: usize,
    /// Words of a record. 3: word `k` is `v[k] | n[k] << 15`, for ids of up to 15 bits; bit 31 of word 0 is the lock
    /// bit, and bit 30 is unused. 6: `v[0]`, `v[1]`, `v[2]`, `n[0]`, `n[1]`, `n[2]`.
    pub record_words: usize,
}

/// Bits of an id in a record of three words.
pub const NARROW_ID_BITS: u32 = 15;

impl Layout {
    /// The layout of a device with these coordinate bits and this capacity.
    pub const fn of(coord_bits: u32, capacity: u32) -> Self {
        let narrow =
            crate::triangle_id_bits(capacity) <= NARROW_ID_BITS && crate::vertex_id_bits(capacity) <= NARROW_ID_BITS;
        Self { point_words: if coord_bits <= 16 { 1 } else { 2 }, record_words: if narrow { 3 } else { 6 } }
    }

    /// A point as words. The second word counts only if `point_words` is 2.
    pub const fn point_to_words(self, x: u32, y: u32) -> [u32; 2] {
        if self.point_words == 1 {
            [x | y << 16, 0]
        } else {
            [x, y]
        }
    }

    /// The vertices and neighbours of a record, from its `record_words` words.
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

    /// Number of payload words in the answer to `Triangles` for this many records, or `None` if the number exceeds 32
    /// bits. With narrow records the ids take 16 bits each without gaps, low half of a word first, and an odd last half
    /// is zero. With wide records an id takes a word.
    pub const fn triangles_words(self, records: u32) -> Option<u32> {
        let words = self.packed_words(records);
        if words <= u32::MAX as u64 {
            Some(words as u32)
        } else {
            None
        }
    }

    /// The result of [`Layout::triangles_words`] in 64 bits, which hold every number.
    pub(crate) const fn packed_words(self, records: u32) -> u64 {
        let ids = 3 * records as u64;
        if self.record_words == 3 {
            ids.div_ceil(2)
        } else {
            ids
        }
    }

    /// The vertices of a record in the payload of a `Triangles` answer.
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

    /// Puts the vertices of a record into the payload of a `Triangles` answer. The words must have been zero there.
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

    /// The words of a record, of which a narrow layout uses the first three. Only the narrow layout has a place for
    /// `locked`.
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
