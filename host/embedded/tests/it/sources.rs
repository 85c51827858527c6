//! What ships here needs neither the standard library nor an allocator. That the linker agrees is shown by
//! `host/embedded/qemu`, which needs packages of the system.

use std::path::{Path, PathBuf};

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] });
    // A file of this name holds unit tests alone.
    files.filter(|path| !path.ends_with("tests.rs")).collect()
}

/// The lines of a file before its unit tests.
fn shipped(text: &str) -> impl Iterator<Item = &str> {
    text.lines().take_while(|line| !line.contains("#[cfg(test)]"))
}

#[test]
fn protocol_and_driver_use_core_alone() {
    for folder in ["src", "../../protocol/src"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let root = std::fs::read_to_string(folder.join("lib.rs")).unwrap();
        assert!(root.lines().any(|line| line == "#![no_std]"), "{}", folder.display());
        for path in sources(&folder) {
            let text = std::fs::read_to_string(&path).unwrap();
            let found = shipped(&text).find(|line| line.contains("extern crate"));
            assert_eq!(found, None, "{}", path.display());
        }
    }
    // Another crate could bring an allocator along, so these are all.
    let manifest = include_str!("../../Cargo.toml");
    let uses = manifest.split("\n[dependencies]\n").nth(1).and_then(|rest| rest.split("\n[").next()).unwrap();
    let names: Vec<&str> = uses
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .filter_map(|line| line.split(['.', ' ']).next())
        .collect();
    assert_eq!(names, ["incircle-protocol", "embedded-io", "thiserror"]);
    assert!(uses.contains("thiserror = { version = \"2\", default-features = false }"));
    assert!(uses.contains("embedded-io = \"0.7\""), "its features `std` and `alloc` stay off");
}
