//! The public items of the libraries are the ones of the committed lists, so that no change to them goes unseen.
//! `INCIRCLE_BLESS=1` writes the lists anew.
//!
//! A list has all items with their types, bounds and fields, for all features, as rustdoc sees them; without blanket,
//! automatic and derived implementations. Meanings and behaviour are not in it.

use std::path::{Path, PathBuf};
use std::process::Command;

use public_api::Builder;

/// Packages with their folders.
const LIBRARIES: [(&str, &str); 4] = [
    ("incircle-protocol", "protocol"),
    ("incircle-geometry", "host/geometry"),
    ("incircle", "host"),
    ("incircle-embedded", "host/embedded"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Describes the public items of all libraries as JSON, and returns the folder of the files.
fn described() -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("public-api");
    let packages = LIBRARIES.iter().flat_map(|(package, _)| ["-p", package]);
    // JSON is a feature of nightly compilers. The pinned one has it, too, and so the same format everywhere.
    let done = Command::new(env!("CARGO"))
        .args(["doc", "--quiet", "--no-deps", "--locked", "--all-features"])
        .args(packages)
        .current_dir(root())
        .env("CARGO_TARGET_DIR", &target)
        .env("RUSTC_BOOTSTRAP", "1")
        .env("RUSTDOCFLAGS", "-Z unstable-options --output-format json")
        .output()
        .expect("cargo");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    target.join("doc")
}

/// The public items of a library, one in each line.
fn items(json: &Path) -> String {
    let api = Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true)
        .omit_auto_derived_impls(true)
        .build()
        .unwrap_or_else(|error| panic!("{}: {error}", json.display()));
    api.to_string()
}

/// The first line that only one of two lists has.
fn first_difference(found: &str, wanted: &str) -> String {
    let only =
        |one: &str, other: &str| one.lines().find(|line| !other.lines().any(|own| own == *line)).map(str::to_owned);
    match (only(found, wanted), only(wanted, found)) {
        (Some(new), _) => format!("the source has, and the list has not: {new}"),
        (None, Some(gone)) => format!("the list has, and the source has not: {gone}"),
        (None, None) => "the lists have the same lines in another order".to_owned(),
    }
}

#[test]
fn public_items_are_the_listed_ones() {
    let folder = described();
    let mut blessed = Vec::new();
    for (package, source) in LIBRARIES {
        let found = items(&folder.join(format!("{}.json", package.replace('-', "_"))));
        assert!(found.lines().count() > 50, "{package}: {found}");
        let list = root().join(source).join("public-api.txt");
        if std::env::var_os("INCIRCLE_BLESS").is_some() {
            std::fs::write(&list, &found).expect("a list that can be written");
            blessed.push(list);
            continue;
        }
        let wanted = std::fs::read_to_string(&list).unwrap_or_else(|error| panic!("{}: {error}", list.display()));
        assert!(
            found == wanted,
            "{package}: {}. If that is meant, run once with INCIRCLE_BLESS=1 and tell users in CHANGELOG.md",
            first_difference(&found, &wanted)
        );
    }
    assert!(blessed.is_empty(), "blessed: {blessed:?} are written anew and nothing was compared; run again without it");
}

#[test]
fn differences_are_told() {
    assert!(first_difference("a\nb\n", "a\n").ends_with("has not: b"));
    assert!(first_difference("a\n", "a\nc\n").ends_with("has not: c"));
    assert!(first_difference("a\nb\n", "b\na\n").contains("another order"));
}
