//! Runs `LookupTable` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::leaf::LookupTable;
use rust_hdl_core::prelude::*;

named_ports!([const A: usize, const D: usize] LookupTable<A, Bits<D>>, [index], [value]);

#[test]
fn each_index_has_its_row() {
    let table = LookupTable::<4, Bits<40>>::new(|row| (0x7_0302_0177 * row as u64).into());
    let inputs = (0..200u64).map(|step| vec![step * 7 % 16]);
    Stepper::new("lookup_table_4x40", table, 1)
        .run(&["index"], &["value"], inputs, |input| vec![Some(u128::from(input[0]) * 0x7_0302_0177)]);
}
