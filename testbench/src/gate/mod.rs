//! The gate that the Verilog of every block has to pass: lint, then synthesis with its checks.
//!
//! The Rust behaviour of a block and its Verilog can disagree, and rust-hdl does not report it. This gate
//! finds the half of such faults that tools can see in the text: undeclared names, latches, loops, undriven
//! nets. Co-simulation finds the other half.

mod error;
mod scratch;
mod synthesis;
mod tool;

pub use error::GateError;
use scratch::Scratch;
pub use synthesis::{artix_cell_count, cell_count, netlist, prove, synthesise, ArtixCells, Cells};
use tool::{complain, run};

/// Lint warnings that rust-hdl's output needs waived, each with the reason why no fault can hide behind the waiver.
const WAIVED: [&str; 5] = [
    // All modules of a design come in one file.
    "DECLFILENAME",
    // Literals are emitted with 32 bits. Real width faults do hide behind this waiver; co-simulation has to find them.
    "WIDTH",
    // A port is connected to a local of the same name one level below.
    "VARHIDDEN",
    // Every constant of a kernel is emitted, used or not.
    "UNUSEDPARAM",
    // A kernel is one process, so two independent paths through it look like a loop. The warning is a hint on speed
    // only: rust-hdl's own check and yosys look for loops signal by signal.
    "UNOPTFLAT",
];

/// Messages that are no faults though others of their kind are: the kind, and a text that the line must contain.
const ACCEPTED: [(&str, &str); 2] = [
    // Channels are packed bundles, and not every block reads all bits of one. For a signal that is not
    // used at all the message differs.
    ("UNUSEDSIGNAL: ", "Bits of signal are not used: "),
    // The wrapper of a core without the probe leaves that output open on purpose.
    ("PINCONNECTEMPTY: ", "empty reference: 'write'"),
];

/// Runs `verilator --lint-only -Wall` on the Verilog, with the waivers that rust-hdl needs; the source gives
/// a reason for each of them.
///
/// # Errors
/// Verilator is missing, or warns.
pub fn lint(verilog: &str, top: &str) -> Result<(), GateError> {
    lint_with(verilog, top, &WAIVED)
}

/// Lints as [`lint`] does but without any waiver, for Verilog written by hand.
///
/// # Errors
/// The errors of [`lint`].
pub fn lint_strictly(verilog: &str, top: &str) -> Result<(), GateError> {
    lint_with(verilog, top, &[])
}

fn lint_with(verilog: &str, top: &str, waived: &[&str]) -> Result<(), GateError> {
    let scratch = Scratch::new(top)?;
    // The file has the name of its top module, so that hand-written Verilog needs no waiver for its name.
    let file = format!("{top}.v");
    scratch.write(&file, verilog)?;
    // Errors still end Verilator with an exit code; warnings are judged one by one below.
    let mut arguments = vec!["--lint-only", "-Wall", "-Wno-fatal"];
    let waivers: Vec<_> = waived.iter().map(|warning| format!("-Wno-{warning}")).collect();
    arguments.extend(waivers.iter().map(String::as_str));
    arguments.extend(["--top-module", top, &file]);
    let printed = run("verilator", &arguments, top, &scratch)?;
    let is_accepted = |line: &str| {
        let mut accepted = ACCEPTED.iter();
        !waived.is_empty() && accepted.any(|(kind, detail)| line.contains(kind) && line.contains(detail))
    };
    let complaints: Vec<_> =
        printed.lines().filter(|line| line.starts_with("%Warning") && !is_accepted(line)).collect();
    complain("verilator", top, &complaints)
}

/// The whole gate: [`lint`], then [`synthesise`].
///
/// # Errors
/// The errors of the two.
pub fn pass(verilog: &str, top: &str) -> Result<(), GateError> {
    lint(verilog, top)?;
    synthesise(verilog, top)
}
