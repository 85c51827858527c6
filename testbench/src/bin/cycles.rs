//! Renews the tables in `testbench/cycles.md`.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let text = incircle_testbench::cycles::document()?;
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("cycles.md"), text)?;
    Ok(())
}
