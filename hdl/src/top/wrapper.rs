//! The outermost modules of the core and of the devices around it: hand-written Verilog with ANSI ports, because the
//! modules that rust-hdl emits have ports with names such as `command$valid`.
//!
//! The core, `incircle_core`:
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | one clock; synchronous reset, active high, of four clocks at power-up |
//! | `command_valid`, `command_ready`, `command_data` | in, out, in | 1, 1, 32 | the command stream |
//! | `response_valid`, `response_ready`, `response_data` | out, in, out | 1, 1, 64 | the answer stream |
//! | `response_both` | out | 1 | bits 63 to 32 hold a second word, which follows the first |
//! | `response_last` | out | 1 | the last word of the answer is among them |
//!
//! The core behind a serial link, `incircle_serial_top`:
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | one clock; synchronous reset, active high, needed once for two clocks |
//! | `rx`, `tx` | in, out | 1 | the line from and to the host |
//! | `leds` | out | 3 | alive, busy, error, from bit 0 up |
//!
//! The core behind a stream link, `incircle_stream_top`, with beats of W bits:
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `bus_clock`, `bus_reset_n` | in | 1 | clock and reset of the AXI ports; the reset is active low and synchronous |
//! | `s_axis_tdata`, `_tkeep` | in | W, W/8 | commands |
//! | `s_axis_tvalid`, `_tready`, `_tlast` | in, out, in | 1 | their handshake; `s_axis_tlast` means nothing |
//! | `m_axis_tdata`, `_tkeep` | out | W, W/8 | answers |
//! | `m_axis_tvalid`, `_tready`, `_tlast` | out, in, out | 1 | their handshake, and the mark of an answer's last beat |
//! | `s_axi_aw...`, `_w...`, `_b...`, `_ar...`, `_r...` | | | AXI4-Lite, addresses of 12 bits, data of 32 |
//! | `s_axi_awprot`, `s_axi_arprot` | in | 3 | mean nothing |
//! | `core_clock` | in | 1 | clock of the core |
//!
//! With the probe each module has the write port of the triangle memory as well, field by field: `PROBE`. On a chip of
//! several engines each of them has one, with the number of the engine in the names: `write1_valid`.
//!
//! A chip of several engines has the same ports. Its link and its engines come as two modules, which the outermost
//! module connects.

/// Name of the module of the core.
pub const CORE_NAME: &str = "incircle_core";
/// Name of the module of a core behind a serial link.
pub const SERIAL_TOP_NAME: &str = "incircle_serial_top";
/// Name of the module of a core behind a stream link.
pub const STREAM_TOP_NAME: &str = "incircle_stream_top";

/// Ports of the core without the probe: direction, name, width.
const CORE_PORTS: [(&str, &str, usize); 10] = [
    ("input", "clock", 1),
    ("input", "reset", 1),
    ("input", "command_valid", 1),
    ("output", "command_ready", 1),
    ("input", "command_data", 32),
    ("output", "response_valid", 1),
    ("input", "response_ready", 1),
    ("output", "response_data", 64),
    ("output", "response_both", 1),
    ("output", "response_last", 1),
];
const SERIAL_PORTS: [(&str, &str, usize); 5] =
    [("input", "clock", 1), ("input", "reset", 1), ("input", "rx", 1), ("output", "tx", 1), ("output", "leds", 3)];

/// Ports of a core behind a stream link with beats of `beat_bits` bits.
fn stream_ports(beat_bits: usize) -> [(&'static str, &'static str, usize); 29] {
    [
        ("input", "bus_clock", 1),
        ("input", "bus_reset_n", 1),
        ("input", "s_axis_tdata", beat_bits),
        ("input", "s_axis_tkeep", beat_bits / 8),
        ("input", "s_axis_tvalid", 1),
        ("output", "s_axis_tready", 1),
        ("output", "m_axis_tdata", beat_bits),
        ("output", "m_axis_tkeep", beat_bits / 8),
        ("output", "m_axis_tvalid", 1),
        ("input", "m_axis_tready", 1),
        ("output", "m_axis_tlast", 1),
        ("input", "s_axi_awaddr", 12),
        ("input", "s_axi_awvalid", 1),
        ("output", "s_axi_awready", 1),
        ("input", "s_axi_wdata", 32),
        ("input", "s_axi_wstrb", 4),
        ("input", "s_axi_wvalid", 1),
        ("output", "s_axi_wready", 1),
        ("output", "s_axi_bresp", 2),
        ("output", "s_axi_bvalid", 1),
        ("input", "s_axi_bready", 1),
        ("input", "s_axi_araddr", 12),
        ("input", "s_axi_arvalid", 1),
        ("output", "s_axi_arready", 1),
        ("output", "s_axi_rdata", 32),
        ("output", "s_axi_rresp", 2),
        ("output", "s_axi_rvalid", 1),
        ("input", "s_axi_rready", 1),
        ("input", "core_clock", 1),
    ]
}
/// The ports that a bus has but the device ignores: registers are the same for every kind of access.
const STREAM_UNUSED: [(&str, &str, usize); 3] =
    [("input", "s_axis_tlast", 1), ("input", "s_axi_awprot", 3), ("input", "s_axi_arprot", 3)];

/// The fields of the write port with their widths, lowest bit first, in the order of [`Write`](crate::engine::Write).
const PROBE: [(&str, usize); 10] = [
    ("valid", 1),
    ("id", 15),
    ("vertices", 1),
    ("links", 3),
    ("v0", 15),
    ("v1", 15),
    ("v2", 15),
    ("n0", 15),
    ("n1", 15),
    ("n2", 15),
];

/// The Verilog of the wrapper around the root module `core`, which has this many engines.
pub fn wrapper(core: &str, engines: u32, with_probe: bool) -> String {
    let probe = Probe { engines, is_shown: with_probe };
    let mut inside = probe.inside();
    let open = if engines > 1 {
        inside += "    wire unused_busy;\n";
        "        .is_busy(unused_busy),\n"
    } else {
        ""
    };
    inside += &format!("    {core} core (\n{}{open}{}\n    );\n", connections(&CORE_PORTS), probe.connections());
    module(CORE_NAME, &CORE_PORTS, probe, &inside)
}

/// The Verilog of the wrapper around the root module `device` of a core behind a serial link.
pub fn serial_wrapper(device: &str, with_probe: bool) -> String {
    around(SERIAL_TOP_NAME, [&SERIAL_PORTS, &[]], device, with_probe)
}

/// The Verilog of the wrapper around the root module `device` of a core behind a stream link with beats of `beat_bits`
/// bits.
pub fn stream_wrapper(device: &str, beat_bits: usize, with_probe: bool) -> String {
    around(STREAM_TOP_NAME, [&stream_ports(beat_bits), &STREAM_UNUSED], device, with_probe)
}

/// Interfaces of the modules inside. A pin has the name of an interface and of a signal in it: `command_valid` is
/// `command$valid`.
const INTERFACES: [&str; 5] = ["command", "response", "s_axis", "m_axis", "s_axi"];

/// The port of the inner module to which a pin is connected.
fn port_of(pin: &str) -> String {
    let signal = |interface: &str| Some(format!("{interface}${}", pin.strip_prefix(interface)?.strip_prefix('_')?));
    INTERFACES.into_iter().find_map(signal).unwrap_or_else(|| pin.to_string())
}

/// Ports with their direction, name and width.
pub(super) type Ports<'a> = &'a [(&'a str, &'a str, usize)];

/// The write ports of the triangle memories.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    pub(super) engines: u32,
    /// The fields are ports. Without the probe a write port ends in a wire that synthesis removes.
    pub(super) is_shown: bool,
}

impl Probe {
    /// The names of the write ports.
    fn ports(self) -> Vec<String> {
        match self.engines {
            1 => vec!["write".into()],
            engines => (0..engines).map(|engine| format!("write{engine}")).collect(),
        }
    }

    pub(super) fn inside(self) -> String {
        let bits: usize = PROBE.iter().map(|(_, width)| width).sum();
        let wire = |port: String| format!("    wire [{}:0] unused_{port};\n", bits - 1);
        self.ports().into_iter().filter(|_| !self.is_shown).map(wire).collect()
    }

    fn declarations(self) -> impl Iterator<Item = String> {
        let fields = |port: String| PROBE.map(|(name, width)| declared("output", &format!("{port}_{name}"), width));
        self.ports().into_iter().filter(move |_| self.is_shown).flat_map(fields)
    }

    pub(super) fn connections(self) -> String {
        let connected = |port: String| {
            let fields: Vec<String> = PROBE.iter().rev().map(|(name, _)| format!("{port}_{name}")).collect();
            let write = if self.is_shown { format!("{{{}}}", fields.join(", ")) } else { format!("unused_{port}") };
            format!("        .{port}({write})")
        };
        self.ports().into_iter().map(connected).collect::<Vec<_>>().join(",\n")
    }
}

fn declared(direction: &str, name: &str, width: usize) -> String {
    let range = if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) };
    format!("{direction} wire {range}{name}")
}

/// Connections of an instance to pins of the same names.
pub(super) fn connections(ports: Ports) -> String {
    ports.iter().map(|(_, name, _)| format!("        .{}({name}),\n", port_of(name))).collect()
}

/// The Verilog of a module with ANSI ports.
pub(super) fn module(name: &str, ports: Ports, probe: Probe, inside: &str) -> String {
    let declarations = ports.iter().map(|&(direction, name, width)| declared(direction, name, width));
    let declarations: Vec<_> = declarations.chain(probe.declarations()).collect();
    let declarations = declarations.join(",\n    ");
    format!(
        "\
`default_nettype none
module {name} (
    {declarations}
);
{inside}endmodule
`default_nettype wire
"
    )
}

/// The Verilog of a module with ANSI ports around the module `device`. The ports in `unused` are connected to nothing.
fn around(name: &str, [ports, unused]: [Ports; 2], device: &str, with_probe: bool) -> String {
    let probe = Probe { engines: 1, is_shown: with_probe };
    let inside = probe.inside() + &sinks(unused);
    let inside = inside + &format!("    {device} device (\n{}{}\n    );\n", connections(ports), probe.connections());
    module(name, &[ports, unused].concat(), probe, &inside)
}

/// Wires that use ports which are connected to nothing.
fn sinks(unused: Ports) -> String {
    unused.iter().map(|(_, name, _)| format!("    wire unused_{name} = &{{1'b0, {name}}};\n")).collect()
}

/// The two streams between a link and the engines of a chip, with the signals beside them.
const BETWEEN: [(&str, &str, usize); 10] = [
    ("", "core_reset", 1),
    ("", "command_valid", 1),
    ("", "command_ready", 1),
    ("", "command_data", 32),
    ("", "response_valid", 1),
    ("", "response_ready", 1),
    ("", "response_data", 64),
    ("", "response_both", 1),
    ("", "response_last", 1),
    ("", "device_busy", 1),
];

/// The modules of a chip of several engines, or of a core with runs, behind a link.
#[derive(Clone, Copy)]
pub struct ChipParts<'a> {
    /// The root module of the link, and that of the engines or of the core with runs.
    pub link: &'a str,
    pub chip: &'a str,
    pub engines: u32,
    pub with_probe: bool,
}

impl ChipParts<'_> {
    /// The wires between link and engines, and the instance of the engines with this clock.
    pub(super) fn engines(self, clock: &str) -> String {
        let Self { chip, engines, with_probe, .. } = self;
        let probe = Probe { engines, is_shown: with_probe };
        let wires = BETWEEN.iter().map(|(_, name, width)| format!("    {};\n", declared("", name, *width).trim()));
        let streams = connections(&BETWEEN[1..9]);
        // All that a core of one engine holds shows in its streams.
        let (busy, idle) = match engines {
            1 => ("", "    assign device_busy = 1'b0;\n"),
            _ => ("        .is_busy(device_busy),\n", ""),
        };
        wires.collect::<String>()
            + idle
            + &probe.inside()
            + &format!(
                "    {chip} engines (\n        .clock({clock}),\n        .reset(core_reset),\n{streams}{busy}{}\n    \
                 );\n",
                probe.connections()
            )
    }

    /// The Verilog of the outermost module of a chip behind a serial link.
    pub fn serial(self) -> String {
        let pins = connections(&SERIAL_PORTS).replace(".reset(reset)", ".reset(resets)").replace(".leds(", ".lamps(");
        let link = format!("    {} link (\n{pins}{}\n    );\n", self.link, link_side());
        // A register takes the reset first, because the pin may be far away.
        let resets = "    reg resets;\n    always @(posedge clock) resets <= reset;\n";
        let inside = resets.to_string() + &self.engines("clock") + &link;
        module(SERIAL_TOP_NAME, &SERIAL_PORTS, self.probe(), &inside)
    }

    /// The Verilog of the outermost module of a chip behind a stream link with beats of `beat_bits` bits.
    pub fn stream(self, beat_bits: usize) -> String {
        let ports = stream_ports(beat_bits);
        let link = format!("    {} link (\n{}{}\n    );\n", self.link, connections(&ports), link_side());
        let inside = sinks(&STREAM_UNUSED) + &self.engines("core_clock") + &link;
        module(STREAM_TOP_NAME, &[&ports[..], &STREAM_UNUSED].concat(), self.probe(), &inside)
    }

    pub(super) fn probe(self) -> Probe {
        Probe { engines: self.engines, is_shown: self.with_probe }
    }
}

/// The connections of a link to the wires between it and the engines.
pub(super) fn link_side() -> String {
    connections(&BETWEEN).trim_end_matches(",\n").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_are_named_for_signals_of_interfaces() {
        let ports = ["command_valid", "s_axi_awaddr", "s_axis_tdata", "core_clock"].map(port_of);
        assert_eq!(ports, ["command$valid", "s_axi$awaddr", "s_axis$tdata", "core_clock"]);
    }

    #[test]
    fn the_probe_is_as_wide_as_the_write_port() {
        let width: usize = PROBE.iter().map(|(_, width)| width).sum();
        assert_eq!(width, <crate::engine::Write as rust_hdl_core::prelude::Synth>::BITS);
    }
}
