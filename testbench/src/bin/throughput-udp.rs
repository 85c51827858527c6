//! Renews the table in `testbench/throughput-udp.md`.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let text = incircle_testbench::link::throughput_document(&|row| println!("{row}"))?;
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("throughput-udp.md"), text)?;
    Ok(())
}
