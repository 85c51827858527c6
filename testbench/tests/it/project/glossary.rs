//! Checks that the glossary is kept: the file of each term exists, and no retired word stands where it is refused.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn glossary() -> String {
    std::fs::read_to_string(root().join("docs/glossary.md")).expect("the glossary is there")
}

/// Cells of all rows of three columns below `heading`, without the head of the table.
fn rows<'a>(page: &'a str, heading: &str) -> Vec<[&'a str; 3]> {
    let (_, section) = page.split_once(&format!("## {heading}\n")).unwrap_or_else(|| panic!("no section {heading}"));
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with('|') && !line.starts_with("|---")).skip(1);
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        <[&str; 3]>::try_from(cells).unwrap_or_else(|cells| panic!("not three columns: {cells:?}"))
    })
    .collect()
}

/// `text` in small letters with one blank between words. Underscores separate words, and so do the capitals
/// within a name, and line ends with the marks of a comment.
fn words(text: &str) -> String {
    let mut words = String::from(" ");
    let mut was_small = false;
    for c in text.chars() {
        let begins_a_word = !c.is_alphanumeric() || (was_small && c.is_uppercase());
        if begins_a_word && !words.ends_with(' ') {
            words.push(' ');
        }
        if c.is_alphanumeric() {
            words.extend(c.to_lowercase());
        }
        was_small = c.is_lowercase();
    }
    if !words.ends_with(' ') {
        words.push(' ');
    }
    words
}

/// Text files that git tracks, except this test and the glossary.
fn sources() -> Vec<(String, String)> {
    let output = Command::new("git").arg("-C").arg(root()).args(["ls-files", "-z"]).output().expect("git runs");
    assert!(output.status.success(), "git ls-files: {}", String::from_utf8_lossy(&output.stderr));
    let list = String::from_utf8(output.stdout).expect("names in UTF-8");
    list.split('\0')
        .filter(|name| *name != "docs/glossary.md" && !name.ends_with("project/glossary.rs"))
        .filter_map(|name| Some((name.to_owned(), std::fs::read_to_string(root().join(name)).ok()?)))
        .collect()
}

/// Folders or files in backquotes, or the root for `everywhere`.
fn places(cell: &str) -> Vec<&str> {
    if cell == "everywhere" {
        vec![""]
    } else {
        cell.split('`').skip(1).step_by(2).collect()
    }
}

#[test]
fn no_retired_word_is_used() {
    let page = glossary();
    let retired = rows(&page, "Retired words");
    assert!(retired.len() >= 8, "{} rows of retired words", retired.len());
    let sources: Vec<_> = sources().into_iter().map(|(name, text)| (name, words(&text))).collect();
    assert!(sources.len() > 500, "{} sources", sources.len());
    let mut found = Vec::new();
    for [refused, cell, instead] in retired {
        for place in places(cell) {
            assert!(
                place.is_empty() || root().join(place).exists(),
                "the glossary names {place}, which does not exist"
            );
            for word in refused.split(", ") {
                let looked_for = words(word);
                let uses = sources.iter().filter(|(name, _)| name.starts_with(place));
                let uses = uses.filter(|(_, text)| text.contains(&looked_for));
                found.extend(uses.map(|(name, _)| format!("{name}: '{word}', say '{instead}'")));
            }
        }
    }
    found.sort();
    found.dedup();
    assert!(found.is_empty(), "retired words:\n{}", found.join("\n"));
}

#[test]
fn a_retired_word_is_found_in_names_and_across_lines() {
    assert!(words("self.takes_Token.next").contains(&words("token")));
    assert!(words("fn next(WaitingToken)").contains(&words("waiting token")));
    assert!(words("/// It gives\n/// up.").contains(&words("gives up")));
    assert!(!words("tokenize").contains(&words("token")));
}

#[test]
fn the_file_of_each_term_exists() {
    let page = glossary();
    let mut terms = Vec::new();
    for heading in ["The triangulation", "One insertion", "Many insertions", "Jobs"] {
        for [term, meaning, place] in rows(&page, heading) {
            assert!(meaning.ends_with('.'), "{term}: its meaning is no sentence");
            assert!(!terms.contains(&term), "{term} is explained twice");
            terms.push(term);
            // Links are checked by the test of all documents.
            if let Some(path) = place.strip_prefix('`').and_then(|rest| rest.strip_suffix('`')) {
                assert!(root().join(path).exists(), "{term}: {path} does not exist");
            }
        }
    }
    assert!(terms.len() >= 40, "{} terms", terms.len());
}
