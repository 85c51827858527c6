//! Proves that no two modules of a crate import each other, directly or around. A reader can therefore take the modules
//! of each crate from the bottom up.
//!
//! A module A imports a module B if a `use` or a path in the code of A names an item that B defines. Naming a module on
//! the way to an item imports nothing, and neither does `mod b;`.
//!
//! Items that B hands on (`pub use`) are its face, which counts as a module of its own. Taking an item from there
//! imports the face, and the face imports everything that it hands on. A parent may thus hand on the items of its
//! children, and its children may use what the parent itself defines; but a child that imports a sibling through the
//! parent's face stands in a circle. Parts that are compiled for tests only do not count.

mod circles;
mod imports;
mod source;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use cargo_metadata::MetadataCommand;

use circles::circles;
use imports::imports;
use source::Tree;

/// The one module that may stand in circles: the bus of the model by clock, which every block reads
/// and whose wires every block names.
const BUS: (&str, &str) = ("incircle-model", "clock::wires");

/// Number of modules of each package that still stand in circles. These numbers may only fall.
const KNOWN: [(&str, usize); 0] = [];

/// Circles of a crate, each a sorted list of modules.
fn circles_of(package: &str, tree: &Tree) -> Vec<Vec<String>> {
    let is_bus = |module: &str| (package, module) == BUS;
    let mut graph = imports(tree);
    for imported in graph.values_mut() {
        imported.retain(|module| !is_bus(module));
    }
    circles(&graph)
}

/// Root files of the programs and libraries of the workspace, with their packages.
fn roots() -> Vec<(String, PathBuf)> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml");
    let metadata = MetadataCommand::new().manifest_path(manifest).no_deps().exec().unwrap();
    let mut roots = Vec::new();
    for package in metadata.packages {
        let targets = package.targets.iter().filter(|target| target.is_lib() || target.is_bin());
        roots.extend(targets.map(|target| (package.name.to_string(), target.src_path.clone().into_std_path_buf())));
    }
    roots
}

fn read_file(path: &Path) -> Option<String> {
    std::fs::read_to_string(path).ok()
}

#[test]
fn no_module_imports_what_imports_it() {
    let mut found: BTreeMap<String, (usize, Vec<String>)> = BTreeMap::new();
    let roots = roots();
    assert!(roots.len() > 10, "{roots:?}");
    for (package, root) in roots {
        let tree = Tree::read(&root, &read_file).unwrap_or_else(|error| panic!("{error}"));
        let (modules, told) = found.entry(package.clone()).or_default();
        for circle in circles_of(&package, &tree) {
            *modules += circle.len();
            told.push(imports::told(&tree, &circle));
        }
    }
    let allowed = |package: &str| KNOWN.iter().find(|(known, _)| *known == package).map_or(0, |(_, modules)| *modules);
    found.retain(|package, (modules, _)| *modules > allowed(package));
    let told = found.iter().map(|(package, (modules, told))| format!("{package} ({modules}):\n{}", told.join("\n")));
    assert!(found.is_empty(), "Modules in circles of imports:\n{}", told.collect::<Vec<_>>().join("\n"));
}

#[test]
fn the_bus_is_there_and_says_why() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../sim/model/src/lib.rs");
    let tree = Tree::read(&root, &read_file).unwrap();
    assert!(imports(&tree).contains_key(BUS.1), "the exception names a module that no longer exists");
    let wires = std::fs::read_to_string(root.with_file_name("clock").join("wires.rs")).unwrap();
    let head: String = wires.lines().take_while(|line| line.starts_with("//!")).collect();
    assert!(head.contains("circle"), "{head}");
}

/// Circles of a crate that consists of these files.
fn made_up(package: &str, files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let read = |path: &Path| {
        let text = files.iter().find(|(name, _)| Path::new(name) == path).map(|(_, text)| text.to_string());
        text
    };
    circles_of(package, &Tree::read(Path::new("src/lib.rs"), &read).unwrap())
}

#[test]
fn a_circle_is_found_however_it_is_written() {
    let back = [
        "use crate::a::A;",
        "use super::a::A;",
        "use crate::a::{self as other, A};",
        "use crate::{a::A as Other};",
        "use crate::a::*;",
        "use crate::a; fn f() { a::f() }",
        "fn f() -> crate::a::A { todo() }",
        "fn f() { super::a::f() }",
        "fn f() { assert_eq!(1, crate::a::f()) }",
        "fn f() { use crate::a::f; f() }",
        "struct B { a: crate::a::A }",
        "impl crate::a::T for B {}",
        "mod inner { fn f() { super::super::a::f() } } pub fn g() { self::inner::f() }",
    ];
    for text in back {
        let b = format!("{text} pub struct B2;");
        let a = "use crate::b::{B2, inner::f as g}; pub struct A; pub fn f() {} pub trait T {}";
        let files = [("src/lib.rs", "mod a; mod b;"), ("src/a.rs", a), ("src/b.rs", &b)];
        let found = made_up("any", &files);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        assert!(found[0].contains(&"a".to_string()), "{text}: {found:?}");
    }
}

#[test]
fn a_long_circle_through_folders_is_found_whole() {
    let files = [
        ("src/lib.rs", "pub mod a; pub mod b; mod c;"),
        ("src/a/mod.rs", "pub mod x;"),
        ("src/a/x.rs", "use crate::b::Y; pub struct X;"),
        ("src/b.rs", "mod y; pub use y::Y;"),
        ("src/b/y.rs", "use crate::c::C; pub struct Y;"),
        ("src/c.rs", "use crate::a::x::X; pub struct C;"),
    ];
    assert_eq!(made_up("any", &files), [["a::x", "b (face)", "b::y", "c"]]);
}

#[test]
fn a_child_that_imports_through_its_parent_is_found() {
    let siblings = |b: &str| {
        let files = [
            ("src/lib.rs", "mod room; pub use room::{A, B};"),
            ("src/room/mod.rs", "mod a; mod b; pub use a::A; pub use b::B;"),
            ("src/room/a.rs", "pub struct A;"),
            ("src/room/b.rs", b),
        ];
        made_up("any", &files)
    };
    assert_eq!(siblings("use super::A; pub struct B;"), [["room (face)", "room::b"]]);
    assert_eq!(siblings("use crate::A; pub struct B;"), [[" (face)", "room (face)", "room::b"]]);
    let none: [Vec<String>; 0] = [];
    assert_eq!(siblings("use super::a::A; pub struct B;"), none);
    assert_eq!(siblings("use crate::room::a::A; pub struct B;"), none);
    // Items that the parent defines are no detour. If the parent's code needs the child, though, there is a circle.
    let parent = |code: &'static str| {
        let files = [
            ("src/lib.rs", "mod room;"),
            ("src/room.rs", code),
            ("src/room/a.rs", "use super::WIDTH; pub struct A([u8; WIDTH]);"),
        ];
        made_up("any", &files)
    };
    assert_eq!(parent("mod a; pub use a::A; const WIDTH: usize = 1;"), none);
    assert_eq!(parent("mod a; pub use a::A; const WIDTH: usize = 1; fn f(a: A) {}"), [["room", "room::a"]]);
}

#[test]
fn what_is_compiled_for_tests_only_makes_no_circle() {
    let files = [
        ("src/lib.rs", "mod a; mod b;"),
        ("src/a.rs", "use crate::b::B; pub struct A; #[cfg(test)] use crate::b::C; #[cfg(test)] mod tests;"),
        ("src/a/tests.rs", "use crate::b::B;"),
        ("src/b.rs", "pub struct B; #[cfg(test)] mod tests { use super::*; use crate::a::A; }"),
    ];
    let none: [Vec<String>; 0] = [];
    assert_eq!(made_up("any", &files), none);
}

#[test]
fn only_the_bus_of_the_model_may_stand_in_a_circle() {
    let files = |wires: &'static str| {
        [
            ("src/lib.rs", "mod clock;"),
            ("src/clock/mod.rs", "mod ring; mod wires;"),
            ("src/clock/ring.rs", "use super::wires::Wires; pub struct Head;"),
            ("src/clock/wires.rs", wires),
        ]
    };
    let bus = files("use super::ring::Head; pub struct Wires;");
    assert_eq!(made_up("incircle-model", &bus), Vec::<Vec<String>>::new());
    assert_eq!(made_up("incircle", &bus), [["clock::ring", "clock::wires"]]);
}

#[test]
fn a_file_that_is_missing_or_no_rust_is_an_error() {
    let read = |text: &'static str| move |path: &Path| (path == Path::new("src/lib.rs")).then(|| text.to_string());
    assert!(Tree::read(Path::new("src/lib.rs"), &read("mod gone;")).is_err_and(|error| error.contains("gone")));
    assert!(Tree::read(Path::new("src/lib.rs"), &read("fn {")).is_err());
}
