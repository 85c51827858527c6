//! Manifests and pages agree: the oldest compiler, the features of the libraries, and what docs.rs would show.

use std::path::{Path, PathBuf};

use super::documents::metadata;

/// Libraries for programs of others.
const LIBRARIES: [&str; 4] = ["incircle", "incircle-geometry", "incircle-protocol", "incircle-embedded"];
/// Manifests of the workspaces beside that of the project.
const OTHER_MANIFESTS: [&str; 5] = [
    "host/c/Cargo.toml",
    "host/embedded/qemu/Cargo.toml",
    "host/mpi/Cargo.toml",
    "host/python/Cargo.toml",
    "host/wasm/Cargo.toml",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The check builds everything with the pinned compiler, so that one is the oldest that is known to work.
#[test]
fn the_oldest_compiler_is_the_pinned_one() {
    let pinned = read("rust-toolchain.toml");
    let channel = pinned.split('"').nth(1).expect("a channel");
    let (oldest, _) = channel.rsplit_once('.').expect("a channel of three numbers");
    for package in metadata().workspace_packages() {
        let stated = package.rust_version.as_ref().expect("a package states its oldest compiler");
        assert_eq!(format!("{}.{}", stated.major, stated.minor), oldest, "{}", package.name);
    }
    for manifest in OTHER_MANIFESTS {
        assert!(read(manifest).contains(&format!("rust-version = \"{oldest}\"")), "{manifest} states another compiler");
    }
    let page = read("docs/library.md");
    assert!(page.contains(&format!("Rust {oldest}")), "docs/library.md states another compiler than {oldest}");
}

#[test]
fn libraries_describe_themselves_and_show_all_features() {
    let page = read("docs/library.md");
    let metadata = metadata();
    let libraries = metadata.packages.iter().filter(|package| LIBRARIES.contains(&package.name.as_str()));
    let mut found = 0;
    for package in libraries {
        found += 1;
        let name = &package.name;
        assert!(package.description.is_some() && package.license.is_some(), "{name}");
        assert!(page.contains(&format!("`{name}`")), "docs/library.md does not name {name}");
        for feature in package.features.keys().filter(|feature| *feature != "default") {
            assert!(
                page.contains(&format!("`{feature}`")),
                "docs/library.md does not name the feature {feature} of {name}"
            );
        }
        let shows_all = package.metadata["docs"]["rs"]["all-features"] == true;
        assert!(package.features.is_empty() || shows_all, "docs.rs would not show all features of {name}");
    }
    assert_eq!(found, LIBRARIES.len());
}
