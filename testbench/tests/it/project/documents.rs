//! The documents keep up with the project: links lead somewhere, the book has every page, examples are the compiled
//! ones, and the table of dependencies is what cargo says.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use cargo_metadata::{Metadata, MetadataCommand, Package};

/// All documents of the repository, by their paths from its root.
fn documents() -> BTreeSet<String> {
    fn look_into(folder: &Path, documents: &mut BTreeSet<String>) {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            // Folders of git and of builds are not ours. Cargo marks its own, but `docs/build` may come first.
            let is_ours = !name.starts_with('.') && name != "target" && !path.join("CACHEDIR.TAG").exists();
            if path.is_dir() && !path.is_symlink() && is_ours {
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

/// The lines of a document without those of its fenced examples.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut in_example = false;
    text.lines().filter(move |line| {
        let is_fence = line.starts_with("```");
        in_example ^= is_fence;
        !in_example && !is_fence
    })
}

/// The names under which the headings of a document are linked to.
fn anchors(text: &str) -> BTreeSet<String> {
    prose(text)
        .filter(|line| line.starts_with('#'))
        .map(|line| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || " -".contains(*c));
            kept.collect::<String>().replace(' ', "-")
        })
        .collect()
}

/// The file, by its path from the root, and the heading to which a link in `document` leads. The heading is empty if
/// the link names none.
fn destination<'a>(document: &str, link: &'a str) -> (String, &'a str) {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    if file.is_empty() {
        return (document.to_owned(), anchor);
    }
    let mut path = PathBuf::from(document);
    path.pop();
    for part in Path::new(file).components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => assert!(path.pop(), "{document} links to {link}, outside the repository"),
            part => path.push(part),
        }
    }
    (path.display().to_string(), anchor)
}

#[test]
fn a_link_leads_where_a_browser_goes() {
    for (link, file, anchor) in [
        ("view.rs", "docs/view.rs", ""),
        ("./view.rs", "docs/view.rs", ""),
        ("../README.md#back-ends", "README.md", "back-ends"),
        ("#ties", "docs/answer.md", "ties"),
    ] {
        assert_eq!(destination("docs/answer.md", link), (file.to_owned(), anchor), "{link}");
    }
    let text = "# One: `two`\n```\n# no heading\n```\n## Three\n";
    assert_eq!(anchors(text), BTreeSet::from(["one-two", "three"].map(str::to_owned)));
}

#[test]
fn links_lead_somewhere() {
    let mut checked = 0;
    let documents = documents();
    for known in [
        "README.md",
        "ARCHITECTURE.md",
        "docs/batches.md",
        "docs/claims.md",
        "docs/decisions.md",
        "docs/engine.md",
        "docs/where.md",
        "testbench/README.md",
        "testbench/cycles.md",
        "constraints/timing.md",
    ] {
        assert!(documents.contains(known), "{known} is not read");
    }
    for document in &documents {
        let text = read(document);
        for link in links(&text) {
            let (file, anchor) = destination(document, link);
            assert!(root().join(&file).exists(), "{document} links to {link}");
            assert!(anchor.is_empty() || anchors(&read(&file)).contains(anchor), "{document} links to {link}");
            checked += 1;
        }
    }
    assert!(checked >= 100, "only {checked} links found");
}

/// Everything in backquotes that looks like a path of this repository: files and folders, by their path from the root.
fn paths(text: &str) -> Vec<&str> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted.filter(|quote| quote.contains('/') && !quote.contains(char::is_whitespace)).collect()
}

#[test]
fn files_named_by_the_architecture_and_the_claims_exist() {
    for (page, least) in [("ARCHITECTURE.md", 20), ("docs/claims.md", 80)] {
        let text = read(page);
        let paths = paths(&text);
        assert!(paths.len() >= least, "{page}: only {} paths found", paths.len());
        for path in paths {
            assert!(root().join(path).exists(), "{page} names {path}");
        }
    }
}

#[test]
fn every_claim_names_what_holds_it() {
    let page = read("docs/claims.md");
    let rows = page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| what always holds |"));
    let rows: Vec<_> = rows.collect();
    assert!(rows.len() >= 35, "only {} claims found", rows.len());
    for row in rows {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let &[_, _, held_by] = cells.as_slice() else {
            panic!("not three columns: {row}");
        };
        assert!(!paths(held_by).is_empty(), "nothing holds this claim: {row}");
    }
}

#[test]
fn examples_are_the_ones_that_doctests_compile() {
    let library = read("host/src/lib.rs");
    let documentation: Vec<_> = library
        .lines()
        .filter_map(|line| line.strip_prefix("//!"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .collect();
    let documentation = documentation.join("\n");
    let mut compared = 0;
    for page in documents().iter().filter(|name| *name == "README.md" || name.starts_with("docs/")) {
        for example in read(page).split("```rust\n").skip(1) {
            let (example, _) = example.split_once("```").expect("its end");
            assert!(
                documentation.contains(example),
                "host/src/lib.rs does not have this example of {page}:\n{example}"
            );
            compared += 1;
        }
    }
    assert!(compared >= 5, "only {compared} examples found");
}

/// The contents of the book.
const SUMMARY: &str = "docs/SUMMARY.md";

/// The documents in the book, by their paths from the root.
fn pages_of_the_book() -> Vec<String> {
    let summary = read(SUMMARY);
    links(&summary).into_iter().map(|link| destination(SUMMARY, link).0).collect()
}

#[test]
fn the_book_has_every_page() {
    let listed = pages_of_the_book();
    let pages: BTreeSet<String> = listed.iter().cloned().collect();
    assert_eq!(pages.len(), listed.len(), "{SUMMARY} lists a page twice: {listed:?}");
    assert!(pages.len() >= 20, "{SUMMARY} lists only {} pages", pages.len());
    for document in documents().iter().filter(|name| name.starts_with("docs/") && *name != SUMMARY) {
        assert!(pages.contains(document), "{SUMMARY} does not list {document}");
    }
    // mdBook makes a page of what is listed and nothing of any other document, so a link to one would lead nowhere.
    for page in &pages {
        let text = read(page);
        for link in links(&text) {
            let (file, _) = destination(page, link);
            assert!(
                !file.ends_with(".md") || pages.contains(&file),
                "{page} links to {file}, which {SUMMARY} does not list"
            );
        }
    }
}

pub(super) fn metadata() -> Metadata {
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
    let page = read("docs/dependencies.md");
    let (_, section) = page.split_once("## Packages").expect("a section");
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
