//! The gate that the Verilog of every block passes: lint, then synthesis with its checks.
//!
//! rust-hdl's Rust behaviour and its Verilog can disagree without a word from rust-hdl; this gate finds the half of it that tools
//! can see in the text (undeclared names, latches, loops, undriven nets). Co-simulation finds the other half.

mod error;
mod scratch;
mod synthesis;
mod tool;

pub use error::GateError;
use scratch::Scratch;
pub use synthesis::{artix_cell_count, cell_count, netlist, prove, synthesise, ArtixCells, Cells};
use tool::{complain, run};

/// Lint warnings that rust-hdl's output needs waived, and why none of them hides a fault that the gate is there to find.
const WAIVED: [&str; 5] = [
    // All modules of a design come in one file.
    "DECLFILENAME",
    // Literals are emitted as 32 bits. Real width faults hide behind this waiver: co-simulation is there to find them.
    "WIDTH",
    // A port that is connected to a local of the same name further in.
    "VARHIDDEN",
    // Every constant of a kernel is emitted, used or not.
    "UNUSEDPARAM",
    // A kernel is one process, so two independent paths through it look like a circle. A hint on speed only: rust-hdl's own
    // check and yosys look for circles signal by signal.
    "UNOPTFLAT",
];

/// Messages that are no faults though others of their kind are: the kind, and what else stands in the line.
const ACCEPTED: [(&str, &str); 2] = [
    // Channels are packed bundles, and not every block reads all of one. That a signal is not used at all reads otherwise.
    ("UNUSEDSIGNAL: ", "Bits of signal are not used: "),
    // The wrapper of a core without the probe leaves that output open, in so many words.
    ("PINCONNECTEMPTY: ", "empty reference: 'write'"),
];

/// Passes Verilog through `verilator --lint-only -Wall` with the waivers that rust-hdl needs, each with its reason in the source.
///
/// # Errors
/// Verilator is missing, or warns.
pub fn lint(verilog: &str, top: &str) -> Result<(), GateError> {
    lint_with(verilog, top, &WAIVED)
}

/// As [`lint`] without any waiver: for Verilog written by hand.
///
/// # Errors
/// As [`lint`].
pub fn lint_strictly(verilog: &str, top: &str) -> Result<(), GateError> {
    lint_with(verilog, top, &[])
}

fn lint_with(verilog: &str, top: &str, waived: &[&str]) -> Result<(), GateError> {
    let scratch = Scratch::new(top)?;
    // Named as its top module, so that hand-written files need no waiver for their name.
    let file = format!("{top}.v");
    scratch.write(&file, verilog)?;
    // Errors still end it with an exit code; warnings are judged one by one.
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
/// Theirs.
pub fn pass(verilog: &str, top: &str) -> Result<(), GateError> {
    lint(verilog, top)?;
    synthesise(verilog, top)
}
