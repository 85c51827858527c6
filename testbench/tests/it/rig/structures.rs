//! The structures that travel between blocks, as numbers: said here a second time, so that a field that moves is noticed.

/// Widths of the fields, the lowest first.
pub type Layout<const N: usize> = [u32; N];

/// owner, rotates, locks, x, after, `f_entry`, f, u.
pub const TOKEN: Layout<8> = [5, 1, 1, 6, 6, 6, 15, 15];
/// `is_pair`, `is_triple`, owner, rotates, locks, x, after, `f_entry`, f, u, after and u of the second visit, u of the third.
pub const BUNDLE: Layout<13> = [1, 1, 5, 1, 1, 6, 6, 6, 15, 15, 6, 15, 15];
/// v0, v1, v2, n0, n1, n2, slot, took, foreign, again, and which vertex is infinite.
pub const TURNED: Layout<13> = [15, 15, 15, 15, 15, 15, 2, 1, 1, 1, 1, 1, 1];
/// conflict, located, `falls_onto_corner`, `is_left`, `is_straight`, `walk_next`.
pub const VERDICT: Layout<6> = [1, 1, 1, 1, 1, 15];
/// valid, id, vertices, link0, link1, link2, v0, v1, v2, n0, n1, n2.
pub const WRITE: Layout<12> = [1, 15, 1, 1, 1, 1, 15, 15, 15, 15, 15, 15];

/// The fields side by side, the first in the lowest bits.
pub fn pack<const N: usize>(layout: Layout<N>, fields: [u64; N]) -> u128 {
    let mut packed = 0;
    let mut offset = 0;
    for (width, field) in layout.into_iter().zip(fields) {
        assert!(field >> width == 0, "{field} has more than {width} bits");
        packed |= u128::from(field) << offset;
        offset += width;
    }
    packed
}

/// The fields of a packed structure.
pub fn unpack<const N: usize>(layout: Layout<N>, packed: u128) -> [u64; N] {
    let mut offset = 0;
    layout.map(|width| {
        let field = (packed >> offset) as u64 & ((1 << width) - 1);
        offset += width;
        field
    })
}

/// Fields of random bits; `bits` gives a number of that many.
pub fn random<const N: usize>(layout: Layout<N>, bits: impl FnMut(u32) -> u64) -> [u64; N] {
    layout.map(bits)
}

/// A bundle of context 1 from these ring entries.
pub fn bundle(entries: &[u64]) -> u128 {
    let [is_pair, is_triple] = [2, 3].map(|visits| u64::from(entries.len() >= visits));
    let [x, x2, x3] = [0, 1, 2].map(|place| entries.get(place).copied().unwrap_or(0));
    pack(BUNDLE, [is_pair, is_triple, 1, 1, 0, x, x2, 0, 0, 0, x3, 0, 0])
}

/// A write of a record with these columns; `columns` has a bit for the vertices and one for each link.
pub fn write(id: u64, columns: u64, v0: u64, n1: u64) -> u128 {
    let [vertices, link0, link1, link2] = [0, 1, 2, 3].map(|bit| columns >> bit & 1);
    pack(WRITE, [1, id, vertices, link0, link1, link2, v0, 0, 0, 0, n1, 0])
}
