//! Renews the table in `testbench/goodput.md`.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let text = incircle_testbench::link::document()?;
    print!("{text}");
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("goodput.md"), text)?;
    Ok(())
}
