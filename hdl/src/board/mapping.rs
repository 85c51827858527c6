//! How yosys maps a design to the ECP5.

/// What mapping takes a wire to cost, in picoseconds: about what wires of the routed core take. The tool's default, 300, favours more
/// levels of tables, which then miss the clock.
const WIRE_PICOSECONDS: u32 = 900;

/// Options of nextpnr besides those that name files and device: its default placer leaves block RAMs further from what they belong to.
pub(super) const PLACER: [&str; 2] = ["--placer", "static"];

/// The passes from a design that has been read to its cells, `top` being its root module.
///
/// They are those of `synth_ecp5 -abc9` but for two things: initial values of the generated Verilog are dropped, as reset sets what
/// matters and a register that resets to 1 would otherwise need a table; and mapping tries its longer script.
pub fn mapping(top: &str) -> String {
    let synth = format!("synth_ecp5 -abc9 -top {top}");
    [
        &format!("hierarchy -top {top}"),
        "proc",
        "setattr -unset init incircle*/w:*",
        &format!("{synth} -run begin:map_luts"),
        "scratchpad -copy abc9.script.flow2 abc9.script",
        &format!("abc9 -W {WIRE_PICOSECONDS}"),
        "clean",
        &format!("{synth} -run map_cells:"),
        "check -assert",
    ]
    .join("; ")
}
