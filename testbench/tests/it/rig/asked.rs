//! The demands of a frame on the serial link: the fields of `Asked` as bits.

pub const HEARS: u32 = 1;
pub const HELLO: u32 = 1 << 1;
pub const OPENS: u32 = 1 << 2;
pub const RATE: u32 = 1 << 3;
pub const POLLS: u32 = 1 << 4;
pub const CLOSES: u32 = 1 << 5;
pub const TAKES: u32 = 1 << 6;
pub const REPEATS: u32 = 1 << 7;
pub const GAP: u32 = 1 << 8;
pub const NO_SESSION: u32 = 1 << 9;
pub const DROPS: u32 = 1 << 10;
