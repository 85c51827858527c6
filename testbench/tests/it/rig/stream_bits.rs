//! Bits and words at the ports of the stream link.

use crate::rig::stepper::{NamedPorts, Stepper};

/// Drives these inputs of one bit.
pub fn set_bits<U: NamedPorts>(block: &mut Stepper<U>, bits: &[(&'static str, bool)]) {
    for (port, bit) in bits {
        block.set(port, *bit);
    }
}

/// Puts words side by side, the first in the lowest bits.
pub fn wide(words: &[u32]) -> u128 {
    words.iter().rev().fold(0, |number, word| number << 32 | u128::from(*word))
}
