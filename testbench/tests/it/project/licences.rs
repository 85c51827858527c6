//! Packages of others come from crates.io alone, unchanged, and under licences that fit `MIT OR Apache-2.0`.

use std::path::{Path, PathBuf};

use super::documents::metadata;

/// Licences that ask for no more than notices.
const PERMISSIVE: [&str; 12] = [
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];
/// Packages under another licence, with that licence and the reason why it does no harm.
const EXCEPTIONS: [(&str, &str, &str); 1] =
    [("serialport", "MPL-2.0", "the licence covers only the files of that package, which are used as they are")];
const CRATES_IO: &str = "registry+https://github.com/rust-lang/crates.io-index";
/// Lock files of the workspaces beside that of the project.
const LOCK_FILES: [&str; 6] = [
    "Cargo.lock",
    "host/c/Cargo.lock",
    "host/embedded/qemu/Cargo.lock",
    "host/mpi/Cargo.lock",
    "host/python/Cargo.lock",
    "host/wasm/Cargo.lock",
];

/// Whether one of the choices that an SPDX expression offers asks for permissive licences alone. Packages from before
/// SPDX write `/` for `OR`. Brackets are read where they stand around choices, as in `(A OR B) AND C`.
fn is_permissive(expression: &str) -> bool {
    fn top_level<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
        let (mut depth, mut start, mut parts) = (0_i32, 0, Vec::new());
        for (place, letter) in text.char_indices() {
            depth += i32::from(letter == '(') - i32::from(letter == ')');
            if depth == 0 && place >= start && text[place..].starts_with(word) {
                parts.push(&text[start..place]);
                start = place + word.len();
            }
        }
        parts.push(&text[start..]);
        parts
    }
    let text = expression.trim();
    let choices = top_level(text, " OR ");
    if choices.len() > 1 {
        return choices.into_iter().any(is_permissive);
    }
    let all = top_level(text, " AND ");
    if all.len() > 1 {
        return all.into_iter().all(is_permissive);
    }
    let old = top_level(text, "/");
    if old.len() > 1 {
        return old.into_iter().any(is_permissive);
    }
    match text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        Some(inner) => is_permissive(inner),
        None => PERMISSIVE.contains(&text),
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

#[test]
fn expressions_are_read() {
    for (expression, is) in [
        ("MIT", true),
        ("MIT OR GPL-3.0-only", true),
        ("GPL-3.0-only", false),
        ("MIT AND GPL-3.0-only", false),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", true),
        ("(MIT OR Apache-2.0) AND MPL-2.0", false),
        ("(GPL-2.0 OR LGPL-3.0)", false),
        ("Unlicense/MIT", true),
        ("MIT / Apache-2.0", true),
        ("GPL-2.0/LGPL-3.0", false),
        ("Apache-2.0 WITH LLVM-exception OR GPL-2.0", true),
        ("", false),
    ] {
        assert_eq!(is_permissive(expression), is, "{expression}");
    }
}

#[test]
fn every_licence_is_permissive_or_a_known_exception() {
    let metadata = metadata();
    let packages: Vec<_> = metadata.packages.iter().filter(|package| package.source.is_some()).collect();
    assert!(packages.len() > 100, "only {} packages found", packages.len());
    let mut used = Vec::new();
    for package in packages {
        let (name, text) = (package.name.as_str(), package.license.as_deref().unwrap_or_default());
        let exception = EXCEPTIONS.iter().find(|(known, licence, _)| *known == name && *licence == text);
        used.extend(exception.map(|(known, ..)| *known));
        assert!(exception.is_some() || is_permissive(text), "{name} is under '{text}': use another package");
    }
    assert!(EXCEPTIONS.iter().all(|(name, ..)| used.contains(name)), "an exception is not needed any more: {used:?}");
}

#[test]
fn every_package_comes_from_crates_io_with_a_check_sum() {
    for file in LOCK_FILES {
        let text = std::fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        for package in text.split("[[package]]").skip(1) {
            let value = |key: &str| {
                package.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = \"")?.strip_suffix('"'))
            };
            let name = value("name").expect("a name");
            let Some(source) = value("source") else {
                assert!(is_own(name), "{file}: {name} is taken from a path, and is no package of the project");
                continue;
            };
            assert_eq!(source, CRATES_IO, "{file}: {name} comes from elsewhere");
            assert!(value("checksum").is_some_and(|sum| sum.len() == 64), "{file}: {name} has no check sum");
        }
    }
}

/// Whether a package without a source is the project's.
fn is_own(name: &str) -> bool {
    name == "verilated" || name == "incircle" || name.starts_with("incircle-")
}

#[test]
fn every_lock_file_is_checked() {
    let output = std::process::Command::new("git").args(["ls-files", "*Cargo.lock"]).current_dir(root()).output();
    let listed = String::from_utf8(output.expect("git").stdout).expect("names of files");
    // A checkout without git, such as an unpacked archive, lists none.
    assert!(listed.is_empty() || listed.lines().eq(LOCK_FILES), "{listed}");
}

/// The strings in double quotes of a text, in their order.
fn quoted(text: &str) -> Vec<&str> {
    text.split('"').skip(1).step_by(2).collect()
}

/// The text between two marks, which must be there.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let (_, rest) = text.split_once(start).unwrap_or_else(|| panic!("there is no {start:?}"));
    rest.split_once(end).unwrap_or_else(|| panic!("there is no {end:?} behind {start:?}")).0
}

#[test]
fn cargo_deny_is_told_the_same() {
    let read =
        |file: &str| std::fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    let deny = read("deny.toml");
    assert_eq!(quoted(between(&deny, "\nallow = [", "]")), PERMISSIVE);
    assert_eq!(quoted(between(&deny, "allow-registry = [", "]")), [CRATES_IO.trim_start_matches("registry+")]);
    let script = read("testbench/licences");
    let folders = between(&script, "for folder in ", ";").split(' ').map(|folder| match folder {
        "." => "Cargo.lock".to_owned(),
        folder => format!("{folder}/Cargo.lock"),
    });
    assert!(folders.eq(LOCK_FILES.map(str::to_owned)), "testbench/licences checks other lock files");
}
