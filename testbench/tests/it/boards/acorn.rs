//! Checks the card in a PCI Express slot as far as possible without the vendor's tool. The top passes lint
//! around the exported device, the build script and the constraints run with stand-ins for the tool's commands,
//! and a missed clock ends the script.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn file(name: &str) -> PathBuf {
    root().join("constraints/acorn-cle-215").join(name)
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Runs the build script with stand-ins; `slack` is the slack that the stand-in for timing reports.
fn build(slack: &str, arguments: &[&str]) -> Output {
    let constraints = ["pins.xdc", "early.xdc", "crossings.xdc"].map(|name| file(name).display().to_string());
    Command::new("yosys")
        .args(["-q", "-c"])
        .arg(root().join("testbench/cells/vivado.tcl"))
        .env("SCRIPT", file("build.tcl"))
        .env("ARGUMENTS", arguments.join(" "))
        .env("SLACK", slack)
        .env("CONSTRAINTS", constraints.join(" "))
        .output()
        .expect("yosys starts")
}

fn printed(output: &Output) -> String {
    String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned()
}

#[test]
fn the_build_script_runs_to_its_end() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("acorn");
    std::fs::create_dir_all(&folder).unwrap();
    let device = folder.join("device.v");
    std::fs::write(&device, "").unwrap();
    let arguments = [device.to_str().unwrap(), folder.to_str().unwrap()];
    let good = build("0.3", &arguments);
    assert!(good.status.success(), "{}", printed(&good));
    assert!(printed(&good).contains("stand-in: write_bitstream"), "{}", printed(&good));

    let missed = build("-0.1", &arguments);
    assert!(!missed.status.success());
    assert!(printed(&missed).contains("the clocks are missed by -0.1 ns"), "{}", printed(&missed));
    assert!(!printed(&missed).contains("write_bitstream"), "{}", printed(&missed));

    let absent = build("0.3", &["absent.v", arguments[1]]);
    assert!(!absent.status.success());
    assert!(printed(&absent).contains("cannot read absent.v"), "{}", printed(&absent));
}

#[test]
fn every_pin_has_a_site_of_its_own() {
    let (top, xdc) = (text(&file("top.v")), text(&file("pins.xdc")));
    let ports = top.lines().filter_map(|line| {
        let line = line.trim().trim_end_matches(',');
        line.strip_prefix("input wire ").or_else(|| line.strip_prefix("output wire "))
    });
    let mut pins: Vec<String> = ports
        .flat_map(|port| match port.strip_prefix("[3:0] ") {
            Some(name) => (0..4).map(|bit| format!("{name}[{bit}]")).collect(),
            None => vec![port.to_string()],
        })
        .collect();
    pins.sort_unstable();
    let placed =
        xdc.lines().filter_map(|line| line.strip_prefix("set_property PACKAGE_PIN ")?.split_once(" [get_ports "));
    let (mut sites, mut named): (Vec<_>, Vec<_>) = placed
        .map(|(site, port)| {
            (site, port.trim_matches(['{', '}', ']']).to_string() + if port.contains('[') { "]" } else { "" })
        })
        .unzip();
    named.sort_unstable();
    assert_eq!(named, pins);
    sites.sort_unstable();
    sites.dedup();
    assert_eq!(sites.len(), pins.len(), "two pins share a site");
}

#[test]
fn the_top_fits_the_device_and_the_bridge() {
    let stand_ins = text(&root().join("testbench/cells/xilinx.v"));
    let device = incircle_hdl::export::stream_top(incircle_protocol::TINY, 128, false).unwrap();
    let design = format!("{stand_ins}{}{device}", text(&file("top.v")));
    let passed = incircle_testbench::gate::lint(&design, "acorn_cle_215");
    assert!(passed.is_ok(), "{}", passed.unwrap_err());
}
