//! Ids of triangles and vertices for the memories of the mesh.

use incircle_testkit::SplitMix64;

/// Bits of an id at a port.
pub const ID: u32 = 15;

pub const LAST_ID: u64 = (1 << ID) - 1;

/// Returns random ids whose low bits are often equal, with random bits above them.
pub fn id(numbers: &mut SplitMix64, stored_bits: u32) -> u64 {
    let near = [0, LAST_ID - 3][numbers.bits(1) as usize] ^ numbers.bits(2);
    if stored_bits == ID {
        near
    } else {
        near & ((1 << stored_bits) - 1) | numbers.bits(ID) >> stored_bits << stored_bits
    }
}
