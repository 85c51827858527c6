//! The C++ compiler with the flags that Verilator's headers expect, and Verilator's own runtime.

use super::error::BuildError;
use super::verilator::Verilator;

/// A compiler for everything that includes `verilated.h`.
pub(super) fn compiler(verilator: &Verilator) -> cc::Build {
    let mut build = cc::Build::new();
    build
        .cpp(true)
        .std("c++17")
        .include(verilator.include())
        .include(verilator.include().join("vltstd"))
        .define("VM_COVERAGE", "0")
        .define("VM_SC", "0")
        .define("VM_TRACE_FST", "0")
        // Generated code has unused names by the hundred.
        .warnings(false)
        .debug(false);
    build
}

/// Compiles Verilator's runtime into the crate that is being built; the run side of this crate does it once for
/// all models of a program.
///
/// # Errors
/// The compiler is missing or refuses the files.
pub fn compile_runtime(verilator: &Verilator) -> Result<(), BuildError> {
    let mut build = compiler(verilator);
    build.opt_level(2).define("VM_TRACE", "1").define("VM_TRACE_VCD", "1");
    for file in ["verilated.cpp", "verilated_threads.cpp", "verilated_vcd_c.cpp"] {
        build.file(verilator.include().join(file));
    }
    build.try_compile("verilated_runtime")?;
    println!("cargo:rustc-link-lib=pthread");
    Ok(())
}
