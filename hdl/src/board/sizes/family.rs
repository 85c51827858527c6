//! The families of FPGAs, and what yosys calls their cells.

use super::super::mapping;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// The numbers of cells of each kind that a core takes in one family.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FamilyCells {
    /// Look-up tables of any number of inputs. Multiplexers count only where they take the place of look-up tables, in
    /// Nexus and GateMate.
    pub lut: u64,
    /// Cells of carry chains.
    pub carry: u64,
    /// Look-up tables that hold small memories or shift registers.
    pub lut_memory: u64,
    pub ff: u64,
    pub multiplier: u64,
    /// Block memories, counted in the smallest kind that the family has.
    pub block_memory: u64,
}

/// A kind of cell.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Lut,
    Carry,
    LutMemory,
    Ff,
    Multiplier,
    BlockMemory,
    /// Not counted: pins, clock buffers, constants, and multiplexers behind the look-up tables of a slice.
    None,
}

/// A family of FPGAs.
#[derive(Debug)]
pub struct Family {
    /// Name for the command line and the file of figures.
    pub name: &'static str,
    /// Name that the vendor uses.
    pub title: &'static str,
    /// The smallest block memory of the family.
    pub block: &'static str,
    /// The passes of yosys that map to the family; TOP stands for the top module. Empty for the ECP5, for which the
    /// boards have a script.
    pass: &'static str,
    /// Prefix of a name of cells, kind of the cells, and the number that one such cell counts for. The first prefix
    /// that fits decides.
    cells: &'static [(&'static str, Kind, u64)],
}

/// All families. The FPGAs of the boards belong to the first.
pub const FAMILIES: [Family; 6] = [
    Family {
        name: "ecp5",
        title: "Lattice ECP5",
        block: "18 kbit",
        pass: "",
        cells: &[
            ("LUT", Kind::Lut, 1),
            ("PFUMX", Kind::None, 1),
            ("L6MUX21", Kind::None, 1),
            ("CCU2C", Kind::Carry, 1),
            ("TRELLIS_DPR16X4", Kind::LutMemory, 2),
            ("TRELLIS_FF", Kind::Ff, 1),
            ("MULT18X18D", Kind::Multiplier, 1),
            ("DP16KD", Kind::BlockMemory, 1),
        ],
    },
    Family {
        name: "xilinx7",
        title: "Xilinx 7",
        block: "18 kbit",
        pass: "synth_xilinx -family xc7 -top TOP",
        cells: XILINX,
    },
    Family {
        name: "ultrascale-plus",
        title: "UltraScale+",
        block: "18 kbit",
        pass: "synth_xilinx -family xcup -top TOP",
        cells: XILINX,
    },
    Family {
        name: "nexus",
        title: "Lattice Nexus",
        block: "18 kbit",
        pass: "synth_nexus -top TOP",
        cells: &[
            ("LUT", Kind::Lut, 1),
            ("WIDEFN9", Kind::Lut, 2),
            ("INV", Kind::Lut, 1),
            ("CCU2", Kind::Carry, 1),
            ("DPR16X4", Kind::LutMemory, 2),
            ("FD1P3", Kind::Ff, 1),
            ("MULT", Kind::Multiplier, 1),
            ("PDP", Kind::BlockMemory, 1),
            ("DP16K", Kind::BlockMemory, 1),
            ("IB", Kind::None, 1),
            ("OB", Kind::None, 1),
            ("V", Kind::None, 1),
        ],
    },
    Family {
        name: "gowin",
        title: "Gowin GW1N and GW2A",
        block: "18 kbit",
        pass: "synth_gowin -top TOP",
        cells: &[
            ("LUT", Kind::Lut, 1),
            ("MUX2_", Kind::None, 1),
            ("ALU", Kind::Carry, 1),
            ("RAM16", Kind::LutMemory, 4),
            ("DFF", Kind::Ff, 1),
            ("MULT", Kind::Multiplier, 1),
            ("SDP", Kind::BlockMemory, 1),
            ("DP", Kind::BlockMemory, 1),
            ("IBUF", Kind::None, 1),
            ("OBUF", Kind::None, 1),
            ("GSR", Kind::None, 1),
            ("GND", Kind::None, 1),
            ("VCC", Kind::None, 1),
        ],
    },
    Family {
        name: "gatemate",
        title: "Cologne Chip GateMate",
        block: "20 kbit",
        pass: "setattr -unset ram_style m:*; synth_gatemate -top TOP",
        cells: &[
            ("CC_LUT", Kind::Lut, 1),
            ("CC_L2T", Kind::Lut, 1),
            ("CC_MX", Kind::Lut, 1),
            ("CC_ADDF", Kind::Carry, 1),
            ("CC_DFF", Kind::Ff, 1),
            ("CC_MULT", Kind::Multiplier, 1),
            ("CC_BRAM_20K", Kind::BlockMemory, 1),
            ("CC_BRAM_40K", Kind::BlockMemory, 2),
            ("CC_IBUF", Kind::None, 1),
            ("CC_OBUF", Kind::None, 1),
            ("CC_BUFG", Kind::None, 1),
            // A multiplexer of one bit that the mapping leaves behind takes a look-up table.
            ("$mux", Kind::Lut, 1),
        ],
    },
];

/// The cells of both families of Xilinx.
const XILINX: &[(&str, Kind, u64)] = &[
    ("LUT", Kind::Lut, 1),
    ("INV", Kind::Lut, 1),
    ("MUXF", Kind::None, 1),
    ("CARRY", Kind::Carry, 1),
    ("SRL", Kind::LutMemory, 1),
    ("RAMB18", Kind::BlockMemory, 1),
    ("RAMB36", Kind::BlockMemory, 2),
    // Memories of 32 or 64 words, each with the number of look-up tables that it takes.
    ("RAM32M16", Kind::LutMemory, 8),
    ("RAM64M8", Kind::LutMemory, 8),
    ("RAM32M", Kind::LutMemory, 4),
    ("RAM64M", Kind::LutMemory, 4),
    ("RAM32X1D", Kind::LutMemory, 2),
    ("RAM64X1D", Kind::LutMemory, 2),
    ("FD", Kind::Ff, 1),
    ("DSP48", Kind::Multiplier, 1),
    ("IBUF", Kind::None, 1),
    ("OBUF", Kind::None, 1),
    ("BUFG", Kind::None, 1),
];

impl Family {
    /// The family with this name, if there is one.
    pub fn named(name: &str) -> Option<&'static Self> {
        FAMILIES.iter().find(|family| family.name == name)
    }

    /// The script of yosys that maps the Verilog in a file to the family.
    pub(super) fn script(&self, verilog: &str, top: &str) -> String {
        if self.pass.is_empty() {
            return format!("read_verilog -D INCIRCLE_ECP5 {verilog}; {}", mapping(top));
        }
        // `setattr -unset init` drops initial values: reset sets every register that matters, and not every family has
        // registers with an initial value.
        let pass = self.pass.replace("TOP", top);
        format!("read_verilog {verilog}; hierarchy -top {top}; proc; flatten; setattr -unset init w:*; {pass}")
    }

    /// The numbers of cells, from the counts by type that yosys gives. Fails for a type that no prefix of the family
    /// fits, and for a count that is no number.
    pub(super) fn cells(&self, by_type: &Map<String, Value>) -> Result<FamilyCells, String> {
        let mut cells = FamilyCells::default();
        // Newer versions of yosys leave a `$scopeinfo` for each module that `flatten` took apart; it is no hardware.
        for (name, count) in by_type.iter().filter(|(name, _)| *name != "$scopeinfo") {
            let known = self.cells.iter().find(|(begin, ..)| name.starts_with(begin));
            let (_, kind, times) = known.ok_or_else(|| format!("{name} is of no known kind in {}", self.title))?;
            let count = times * count.as_u64().ok_or_else(|| format!("there is no number of {name}"))?;
            match kind {
                Kind::Lut => cells.lut += count,
                Kind::Carry => cells.carry += count,
                Kind::LutMemory => cells.lut_memory += count,
                Kind::Ff => cells.ff += count,
                Kind::Multiplier => cells.multiplier += count,
                Kind::BlockMemory => cells.block_memory += count,
                Kind::None => {}
            }
        }
        Ok(cells)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn cells_are_told_apart() {
        let xilinx = Family::named("xilinx7").unwrap();
        let counts = json!({"LUT1": 3, "LUT6": 4, "RAM32M": 2, "RAMB18E1": 1, "RAMB36E1": 10, "FDRE": 9, "BUFG": 1});
        let cells = xilinx.cells(counts.as_object().unwrap()).unwrap();
        let expected = FamilyCells { lut: 7, carry: 0, lut_memory: 8, ff: 9, multiplier: 0, block_memory: 21 };
        assert_eq!(cells, expected);
        let other = json!({"CC_LUT2": 1});
        assert!(xilinx.cells(other.as_object().unwrap()).unwrap_err().contains("CC_LUT2 is of no known kind"));
    }
}
