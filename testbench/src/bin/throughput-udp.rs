//! Renews the table in `testbench/throughput-udp.md`. With the name of a core, such as `dual`, only prints its rows.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(core) = std::env::args().nth(1) {
        return incircle_testbench::link::throughput_rows(&core, &|row| println!("{row}"));
    }
    let text = incircle_testbench::link::throughput_document(&|row| println!("{row}"))?;
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("throughput-udp.md"), text)?;
    Ok(())
}
