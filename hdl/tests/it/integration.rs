//! Runs the files in `hdl/integration`, which users copy into designs of their own, in Verilator.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use incircle_hdl::committed;
use incircle_protocol::SMALL;

/// A file of the repository, by its path from the root.
fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

/// The committed Verilog of `small` behind a stream link.
fn small_stream() -> PathBuf {
    committed::file((SMALL, committed::Top::Stream(64)))
}

/// Runs a program, which must end well, and returns what it printed.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(output.status.success(), "{command:?}: {printed}");
    printed
}

/// Triangles in the lines that begin with `prefix`, each from its smallest corner on.
fn triangles(text: &str, prefix: &str) -> BTreeSet<[u32; 3]> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(prefix));
    lines
        .map(|ids| {
            let mut ids: Vec<u32> = ids.split(' ').map(|id| id.parse().unwrap()).collect();
            let smallest = (0..3).min_by_key(|&place| ids[place]).unwrap();
            ids.rotate_left(smallest);
            ids.try_into().unwrap()
        })
        .collect()
}

#[test]
fn the_template_of_an_instance_passes_the_lint_of_the_package() {
    let package = std::fs::read_to_string(file("incircle.core")).unwrap();
    let (_, options) = package.split_once("verilator_options: [").expect("options of the target lint");
    let options = options.split(']').next().unwrap().split(", ");
    let mut verilator = Command::new("verilator");
    verilator.args(options).args(["--lint-only", "--top-module", "incircle_instance"]);
    run(verilator.arg(small_stream()).arg(file("hdl/integration/instance.v")));
}

#[test]
fn the_example_prints_the_mesh_of_its_page() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("integration-example");
    let mut verilator = Command::new("verilator");
    // The flags of the page, and `-O0` for the C++ compiler, because the example runs for milliseconds only.
    verilator.args(["--binary", "--timing", "-Wno-fatal", "-Wno-lint", "-Wno-TIMESCALEMOD", "-CFLAGS", "-O0"]);
    verilator.args(["--top-module", "incircle_example", "-o", "example", "--Mdir"]).arg(&folder);
    run(verilator.arg(small_stream()).arg(file("hdl/integration/example.v")));
    let printed = run(&mut Command::new(folder.join("example")));

    // What `incircle triangulate` makes of the seven points.
    let mesh = [[0, 1, 4], [0, 4, 6], [0, 6, 3], [1, 2, 5], [1, 5, 4], [2, 3, 6], [2, 6, 5], [4, 5, 6]];
    assert_eq!(triangles(&printed, "triangle "), mesh.into(), "{printed}");
    let page = std::fs::read_to_string(file("docs/core-in-your-design.md")).unwrap();
    assert_eq!(triangles(&page, "    triangle "), mesh.into(), "the page");
}
