//! Cores as netlists of ECP5 cells, with models of the cells: lock-step runs what placement gets.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use incircle_hdl::board::mapping;
use incircle_hdl::export::{self, ExportError};
use incircle_hdl::top::CORE_NAME;
use incircle_protocol::{Config, SMALL};

use super::cores::DUAL_TINY;

/// Cells that synthesis maps to; each has a model.
const CELLS: [&str; 8] = ["CCU2C", "DP16KD", "L6MUX21", "LUT4", "MULT18X18D", "PFUMX", "TRELLIS_DPR16X4", "TRELLIS_FF"];

/// The passes of the boards. Nets that have a name and no use are dropped, as they would be simulated too.
fn passes() -> String {
    let mapping = mapping(CORE_NAME);
    format!("read_verilog -D INCIRCLE_ECP5 design.v; {mapping}; opt_clean -purge; write_verilog -noattr netlist.v")
}

/// Synthesis leaves open the pins that a cell does not need in its mode.
const OPEN_PINS: &str = "/* verilator lint_off PINMISSING */\n";

/// Name and configuration of each core that is simulated as a netlist.
const NETLISTS: [(&str, Config); 2] = [("netlist_small", SMALL), ("netlist_dual_tiny", DUAL_TINY)];

/// Name of the netlist of `small` with runs. Its synthesis takes minutes, so it is made only if `INCIRCLE_ONLY` names
/// it.
const LIVING: &str = "netlist_living_small";

/// Name and Verilog of every netlist, with that of a core with runs if `with_runs` says so. Each has the probe.
pub fn all(with_runs: bool) -> Vec<(&'static str, String)> {
    let made = |design: Result<String, ExportError>, name| {
        netlist(name, &design.unwrap_or_else(|error| panic!("{name}: {error}")))
    };
    let mut netlists: Vec<_> =
        NETLISTS.iter().map(|&(name, config)| (name, made(export::core(config, true), name))).collect();
    if with_runs {
        netlists.push((LIVING, made(export::core_with_runs(SMALL, true), LIVING)));
    }
    netlists
}

fn netlist(name: &str, design: &str) -> String {
    let mut text = OPEN_PINS.to_string() + &synthesised(name, design);
    for cell in CELLS {
        let path = format!("cells/{cell}.v");
        text += &fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    }
    text
}

/// Synthesises a design, or returns the netlist of the last build if the design and the version of yosys are the same.
fn synthesised(name: &str, design: &str) -> String {
    let folder = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it")).join("netlists").join(name);
    let key = [&yosys(&["-V"], Path::new(".")), &passes(), design].join("\n");
    let [key_file, design_file, netlist_file] = ["key", "design.v", "netlist.v"].map(|file| folder.join(file));
    let read = |path: &Path| fs::read_to_string(path).ok();
    if let (true, Some(netlist)) = (read(&key_file).is_some_and(|kept| kept == key), read(&netlist_file)) {
        return netlist;
    }
    let write = |path: &Path, text: &str| {
        fs::write(path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    };
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    }
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    write(&design_file, design);
    yosys(&["-q", "-p", &passes()], &folder);
    let netlist = read(&netlist_file).unwrap_or_else(|| panic!("yosys has left no {}", netlist_file.display()));
    // The key is written last: a build that was cut short leaves none, and its netlist is not taken for a whole one.
    write(&key_file, &key);
    netlist
}

/// Runs yosys and returns all that it prints.
fn yosys(arguments: &[&str], folder: &Path) -> String {
    let output = Command::new("yosys").args(arguments).current_dir(folder).output();
    let output =
        output.unwrap_or_else(|error| panic!("cannot start yosys ({error}): install the Debian package yosys"));
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(output.status.success(), "yosys ends with {}:\n{printed}", output.status);
    printed
}
