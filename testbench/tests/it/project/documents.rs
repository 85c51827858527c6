//! The documents keep up with the project: links lead somewhere, the library's example is the compiled one, and the table of
//! dependencies is what cargo says.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use cargo_metadata::{Metadata, MetadataCommand, Package};

/// All documents of the repository, by their paths from its root.
fn documents() -> BTreeSet<String> {
    fn look_into(folder: &Path, documents: &mut BTreeSet<String>) {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            // Folders of git and of builds are none of the repository's.
            if path.is_dir() && !path.is_symlink() && !name.starts_with('.') && !path.join("CACHEDIR.TAG").exists() {
                look_into(&path, documents);
            } else if name.ends_with(".md") {
                let inside = path.strip_prefix(root()).expect("a path in the repository");
                documents.insert(inside.display().to_string());
            }
        }
    }
    let mut documents = BTreeSet::new();
    look_into(&root(), &mut documents);
    documents
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The targets of all `[...](...)` in a document, without those on the web.
fn links(text: &str) -> Vec<&str> {
    text.split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'))
        .map(|(target, _)| target)
        .filter(|target| !target.starts_with("http"))
        .collect()
}

/// The name under which a heading of this document is linked to.
fn anchors(text: &str) -> BTreeSet<String> {
    text.lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || " -".contains(*c));
            kept.collect::<String>().replace(' ', "-")
        })
        .collect()
}

#[test]
fn links_lead_somewhere() {
    let mut checked = 0;
    let documents = documents();
    for known in ["README.md", "docs/engine.md", "testbench/README.md", "testbench/cycles.md", "constraints/timing.md"]
    {
        assert!(documents.contains(known), "{known} is not read");
    }
    for document in &documents {
        let text = read(document);
        for link in links(&text) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = root().join(document);
            let target = folder.parent().expect("a folder").join(file);
            assert!(target.exists(), "{document} links to {link}");
            if !anchor.is_empty() {
                let text = std::fs::read_to_string(&target).expect("a text");
                assert!(anchors(&text).contains(anchor), "{document} links to {link}");
            }
            checked += 1;
        }
    }
    assert!(checked >= 10, "only {checked} links found");
}

/// Everything in backquotes that looks like a path of this repository.
fn paths(text: &str) -> Vec<&str> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted.filter(|quote| quote.contains('/') && quote.ends_with(".rs") && !quote.contains(['*', ' '])).collect()
}

#[test]
fn files_named_by_the_architecture_exist() {
    let text = read("ARCHITECTURE.md");
    let paths = paths(&text);
    assert!(paths.len() >= 15, "only {} paths found", paths.len());
    for path in paths {
        let places = ["", "hdl/src", "sim/model/src", "host/src"];
        let exists = places.iter().any(|place| root().join(place).join(path).exists());
        assert!(exists, "ARCHITECTURE.md names {path}");
    }
}

#[test]
fn the_example_is_the_one_that_doctests_compile() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once("```rust\n").expect("an example");
    let (example, _) = rest.split_once("```").expect("its end");
    let library = read("host/src/lib.rs");
    let documentation: Vec<_> = library
        .lines()
        .filter_map(|line| line.strip_prefix("//!"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .collect();
    assert!(documentation.join("\n").contains(example), "host/src/lib.rs differs");
}

fn metadata() -> Metadata {
    MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .other_options(["--locked".to_string()])
        .exec()
        .expect("cargo metadata")
}

/// `MIT/Apache-2.0` and `Apache-2.0 OR MIT` are the same.
fn licence(text: &str) -> BTreeSet<String> {
    let parts = text.split(['/', ' ']).filter(|part| !part.is_empty() && *part != "OR");
    parts.map(str::to_owned).collect()
}

/// Name and licence of every package from outside that a package of the workspace names.
fn dependencies(metadata: &Metadata) -> BTreeMap<String, BTreeSet<String>> {
    let outside = metadata
        .workspace_packages()
        .into_iter()
        .flat_map(|package: &Package| package.dependencies.iter().filter(|dependency| dependency.path.is_none()));
    let names: BTreeSet<_> = outside.map(|dependency| dependency.name.clone()).collect();
    let used = metadata.packages.iter().filter(|package| names.contains(package.name.as_str()));
    used.map(|package| {
        let text = package.license.as_deref().unwrap_or("none");
        (package.name.to_string(), licence(text))
    })
    .collect()
}

#[test]
fn the_table_of_dependencies_is_complete() {
    let readme = read("README.md");
    let (_, section) = readme.split_once("## Licence").expect("a section");
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let mut listed = BTreeMap::new();
    for row in rows {
        let cells: Vec<_> = row.trim_matches('|').split('|').map(str::trim).collect();
        let &[names, _, text] = cells.as_slice() else {
            panic!("not three columns: {row}");
        };
        for name in names.split(", ") {
            listed.insert(name.trim_matches('`').to_owned(), licence(text));
        }
    }
    assert_eq!(listed, dependencies(&metadata()));
}
