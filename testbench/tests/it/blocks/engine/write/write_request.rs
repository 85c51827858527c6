//! Runs `RecordWrite` and `LinkWrite` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::ids::ID;
use crate::rig::stepper::bundles::{pack, WRITE};
use crate::rig::stepper::{named_ports, NamedPorts, Stepper};
use incircle_hdl::engine::{LinkWrite, RecordWrite};
use incircle_testkit::SplitMix64;

named_ports!([] RecordWrite, [id, v0, v1, v2, n0, n1, n2], [write]);
named_ports!([] LinkWrite, [id, slot, value], [write]);

const CYCLES: usize = 6_000;

fn write_form<U: NamedPorts>(
    name: &str,
    rust: U,
    inputs: &[&str],
    widths: &[u32],
    write: impl Fn(&[u64]) -> [u64; 12],
) {
    let mut numbers = SplitMix64::new(24);
    let stimuli: Vec<Vec<u64>> =
        (0..CYCLES).map(|_| widths.iter().map(|width| numbers.bits(*width)).collect()).collect();
    Stepper::new(name, rust, 1).run(inputs, &["write"], stimuli, |values| vec![Some(pack(WRITE, write(values)))]);
}

#[test]
fn record_write_writes_all_columns() {
    let inputs = ["id", "v0", "v1", "v2", "n0", "n1", "n2"];
    let rust = RecordWrite::default();
    write_form("record_write", rust, &inputs, &[ID; 7], |values| {
        let mut write = [1; 12];
        write[1] = values[0];
        write[6..].copy_from_slice(&values[1..]);
        write
    });
}

#[test]
fn link_write_writes_one_column() {
    let inputs = ["id", "slot", "value"];
    let rust = LinkWrite::default();
    write_form("link_write", rust, &inputs, &[ID, 2, ID], |values| {
        let [id, slot, value] = [values[0], values[1], values[2]];
        let [link0, link1, link2] = [0, 1, 2].map(|column| u64::from(column == slot));
        [1, id, 0, link0, link1, link2, 0, 0, 0, value, value, value]
    });
}
