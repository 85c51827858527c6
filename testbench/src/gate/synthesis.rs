//! The half of the gate that is synthesis: yosys must accept the Verilog, without latches or invented nets.

use super::error::GateError;
use super::scratch::Scratch;
use super::tool::{complain, run};

const YOSYS: &str = "yosys";

/// Messages that yosys prints as remarks and that are faults in this project.
const COMPLAINTS: [&str; 2] = [
    // A name that nobody declared becomes a net of one bit that nobody drives.
    "implicitly declared",
    "Latch inferred",
];

/// Passes Verilog through yosys: hierarchy, processes, and its own check for undriven nets, double drivers and loops.
///
/// # Errors
/// Yosys is missing or refuses the text, or infers a latch or a net that nobody declared.
pub fn synthesise(verilog: &str, top: &str) -> Result<(), GateError> {
    let passes = format!("hierarchy -check -top {top}; proc; check -assert");
    yosys(verilog, top, &passes, &Scratch::new(top)?)
}

/// Cells of an ECP5 that a block takes after mapping, without placement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// Look-up tables of four inputs, without those in carry chains and in memory.
    pub lut4: u64,
    /// Carry cells, each of two look-up tables.
    pub carry: u64,
    /// Memories of 16 x 4 bits. Each takes two look-up tables, and two more that address them.
    pub distributed_ram: u64,
    /// Flip-flops of one bit.
    pub flip_flops: u64,
    /// Multipliers of 18 x 18 bits.
    pub multipliers: u64,
    /// Block memories of 18 kbit.
    pub block_ram: u64,
}

impl Cells {
    /// Checks that each count is within 5 % of the measured one. A memory that became flip-flops, logic that a constant
    /// swept away, or a change that doubles something falls outside.
    ///
    /// # Errors
    /// A sentence with the first count that differs, and what to do about it.
    pub fn check_near(&self, measured: &Self) -> Result<(), String> {
        let counts = [
            ("LUT4", self.lut4, measured.lut4),
            ("carry cells", self.carry, measured.carry),
            ("distributed RAMs", self.distributed_ram, measured.distributed_ram),
            ("flip-flops", self.flip_flops, measured.flip_flops),
            ("multipliers", self.multipliers, measured.multipliers),
            ("block RAMs", self.block_ram, measured.block_ram),
        ];
        check_counts(&counts)
    }
}

/// Checks that each count is within 5 % of the measured one. An entry is a name, the count and the measured count.
fn check_counts(counts: &[(&str, u64, u64)]) -> Result<(), String> {
    match counts.iter().find(|(_, count, measured)| 20 * count.abs_diff(*measured) > *measured) {
        None => Ok(()),
        Some((name, count, measured)) => Err(format!(
            "{count} {name}, but {measured} were measured: find out why, or measure again and renew the figures"
        )),
    }
}

/// Counts the cells that a block takes in an ECP5, by `synth_ecp5 -abc9`. A block takes seconds,
/// a core a minute or more.
///
/// # Errors
/// The errors of [`synthesise`], and a report that cannot be read.
pub fn cell_count(verilog: &str, top: &str) -> Result<Cells, GateError> {
    let scratch = Scratch::new(top)?;
    let passes = format!("synth_ecp5 -abc9 -top {top}; tee -q -o cells.json stat -json");
    yosys(verilog, top, &passes, &scratch)?;
    cells(&scratch.read("cells.json")?).map_err(|reason| GateError::Report {
        tool: YOSYS,
        top: top.to_string(),
        reason,
    })
}

/// Cells of an Artix-7 that a block takes after mapping, without placement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ArtixCells {
    /// Look-up tables of one to six inputs.
    pub luts: u64,
    /// Carry cells of four bits.
    pub carry: u64,
    /// Flip-flops of one bit.
    pub flip_flops: u64,
    /// Block memories of 18 kbit; one of 36 kbit counts as two.
    pub block_ram: u64,
}

impl ArtixCells {
    /// Checks the counts as [`Cells::check_near`] does.
    ///
    /// # Errors
    /// The errors of [`Cells::check_near`].
    pub fn check_near(&self, measured: &Self) -> Result<(), String> {
        check_counts(&[
            ("LUTs", self.luts, measured.luts),
            ("carry cells", self.carry, measured.carry),
            ("flip-flops", self.flip_flops, measured.flip_flops),
            ("half block RAMs", self.block_ram, measured.block_ram),
        ])
    }
}

/// Counts the cells that a block takes in an Artix-7, by `synth_xilinx`.
///
/// # Errors
/// The errors of [`cell_count`].
pub fn artix_cell_count(verilog: &str, top: &str) -> Result<ArtixCells, GateError> {
    let scratch = Scratch::new(top)?;
    let passes = format!("synth_xilinx -family xc7 -flatten -noiopad -top {top}; tee -q -o cells.json stat -json");
    yosys(verilog, top, &passes, &scratch)?;
    let report = |reason| GateError::Report { tool: YOSYS, top: top.to_string(), reason };
    let count = counts(&scratch.read("cells.json")?).map_err(report)?;
    let all = |cells: &[&str]| cells.iter().map(|cell| count(cell)).sum::<u64>();
    Ok(ArtixCells {
        luts: all(&["LUT1", "LUT2", "LUT3", "LUT4", "LUT5", "LUT6"]),
        carry: count("CARRY4"),
        flip_flops: all(&["FDRE", "FDSE", "FDCE", "FDPE"]),
        block_ram: count("RAMB18E1") + 2 * count("RAMB36E1"),
    })
}

/// Returns the flat netlist of a design as JSON: registers, memories and the logic between them, before any mapping.
///
/// # Errors
/// The errors of [`synthesise`].
pub fn netlist(verilog: &str, top: &str) -> Result<String, GateError> {
    let scratch = Scratch::new(top)?;
    let passes = format!(
        "hierarchy -check -top {top}; proc; flatten; opt_expr; opt_clean; memory_collect; opt_clean; \
         write_json netlist.json"
    );
    yosys(verilog, top, &passes, &scratch)?;
    Ok(scratch.read("netlist.json")?)
}

/// Proves every assertion in a design by induction over its clocks, from its initial state. The edges of several clocks
/// may come in any order and together.
///
/// # Errors
/// The errors of [`synthesise`]; also [`GateError::Refused`] if an assertion can fail, or if `steps` steps
/// are too few for the proof.
pub fn prove(verilog: &str, top: &str, has_several_clocks: bool, steps: u32) -> Result<(), GateError> {
    let clocks = if has_several_clocks { "clk2fflogic; opt -full; " } else { "" };
    let passes = format!(
        "hierarchy -check -top {top}; proc; flatten; opt -full; memory -nordff; opt -full; {clocks}\
         sat -tempinduct -prove-asserts -set-assumes -maxsteps {steps} -verify"
    );
    yosys_on("read_verilog -formal", verilog, top, &passes, &Scratch::new(top)?)
}

fn yosys(verilog: &str, top: &str, passes: &str, scratch: &Scratch) -> Result<(), GateError> {
    yosys_on("read_verilog", verilog, top, passes, scratch)
}

fn yosys_on(reader: &str, verilog: &str, top: &str, passes: &str, scratch: &Scratch) -> Result<(), GateError> {
    scratch.write("design.v", verilog)?;
    let script = format!("{reader} design.v; {passes}");
    let printed = run(YOSYS, &["-p", &script], top, scratch)?;
    let complaints: Vec<_> =
        printed.lines().filter(|line| COMPLAINTS.iter().any(|complaint| line.contains(complaint))).collect();
    complain(YOSYS, top, &complaints)
}

/// Number of cells of each type in a report.
fn counts(report: &str) -> Result<impl Fn(&str) -> u64, String> {
    let report: serde_json::Value = serde_json::from_str(report).map_err(|error| error.to_string())?;
    let counts = report
        .pointer("/design/num_cells_by_type")
        .and_then(serde_json::Value::as_object)
        .cloned()
        .ok_or("it has no table design/num_cells_by_type")?;
    Ok(move |cell: &str| counts.get(cell).and_then(serde_json::Value::as_u64).unwrap_or(0))
}

fn cells(report: &str) -> Result<Cells, String> {
    let count = counts(report)?;
    Ok(Cells {
        lut4: count("LUT4"),
        carry: count("CCU2C"),
        distributed_ram: count("TRELLIS_DPR16X4"),
        flip_flops: count("TRELLIS_FF"),
        multipliers: count("MULT18X18D"),
        block_ram: count("DP16KD"),
    })
}
