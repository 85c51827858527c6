//! The C++ compiler with the flags that Verilator's headers expect, and Verilator's own runtime.

use super::error::BuildError;
use super::verilator::Verilator;

/// The compiler for every file that includes `verilated.h`.
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
        // The function of a core that runs at every clock is larger than the processor's first cache. At some addresses
        // it takes half as long again; at multiples of 64 that was not seen.
        .flag_if_supported("-falign-functions=64")
        // Generated code has hundreds of unused names.
        .warnings(false)
        .debug(false);
    build
}

/// The compiler as text: its path, its flags and the line with its version. Compilers of equal text make equal objects.
/// The level of optimisation is left out, since each unit has a level of its own.
pub(super) fn compiler_text(verilator: &Verilator) -> Result<String, BuildError> {
    let mut build = compiler(verilator);
    // Any fixed level will do. Without one, cc would take that of the profile, on which no model depends.
    build.opt_level(0);
    let tool = build.try_get_compiler()?;
    let flags: Vec<_> = tool.args().iter().map(|flag| flag.to_string_lossy()).collect();
    // A compiler that does not start has no version here; compiling then reports the error.
    let printed = tool.to_command().arg("--version").output().map_or_else(|_| Vec::new(), |output| output.stdout);
    let printed = String::from_utf8_lossy(&printed);
    let version = printed.lines().next().unwrap_or("");
    Ok(format!("{} {}\n{version}", tool.path().display(), flags.join(" ")))
}

/// Compiles Verilator's runtime into the crate that is being built. The run side of this crate does so once for all
/// models of a program.
///
/// # Errors
/// The compiler is missing, or refuses the files.
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
