//! Checks that each rule of the engine has one id, and that everything about a rule cites it: the page, the hardware,
//! the model by clock, and the defects that show what happens without the rule.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Ids of the rules, in the order of the page.
const RULES: [&str; 11] = ["L1", "L2", "L3", "L4", "L5", "L6", "L7", "L8", "L9", "L10", "L11"];

/// The tests of the model by clock.
const TESTS: &str = "sim/model/tests/it/clock";

/// The file or folder at a path from the root of the workspace.
fn at(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The Rust files of a folder and of the folders below.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut found = Vec::new();
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
    found
}

/// Rule ids in a text: an `L` and a number, standing alone.
fn ids(text: &str) -> BTreeSet<String> {
    let is_id =
        |word: &&str| word.strip_prefix('L').is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(is_id).map(String::from).collect()
}

/// Rule ids in comments of Rust files. `is_counted` chooses the comments, given a line without its indentation.
fn cited(files: &[PathBuf], is_counted: fn(&str) -> bool) -> BTreeSet<String> {
    let comments =
        |path: &PathBuf| text(path).lines().map(str::trim).filter(|line| is_counted(line)).flat_map(ids).collect();
    files.iter().flat_map(|path| -> BTreeSet<String> { comments(path) }).collect()
}

fn all_rules() -> BTreeSet<String> {
    RULES.map(String::from).into()
}

/// Ids of the rules of a mesh that lives, by the rows of their table.
fn living_rules() -> BTreeSet<String> {
    let page = text(&at("docs/living-mesh.md"));
    let rules: BTreeSet<String> = page
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| M")?.split_once(' ')?.0))
        .filter(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
        .map(|number| format!("M{number}"))
        .collect();
    assert!(rules.len() > 10, "{rules:?}");
    rules
}

/// Variants of `Defect`, each with the first line of its documentation.
fn defects() -> Vec<(String, String)> {
    let source = text(&at("sim/model/src/clock/defect.rs"));
    let body = source.split_once("pub enum Defect {").expect("the enum of defects").1;
    let mut found = Vec::new();
    let mut about = String::new();
    for line in body.lines().map(str::trim).take_while(|line| *line != "}") {
        match line.strip_prefix("/// ") {
            Some(first) if about.is_empty() => about = first.to_string(),
            Some(_) => {}
            None if line.is_empty() => {}
            None => found.push((line.trim_end_matches(',').to_string(), std::mem::take(&mut about))),
        }
    }
    found
}

#[test]
fn ids_are_found_as_words_only() {
    assert_eq!(ids("L3: see `L12`, (L4), AXI4L5, L, LL, L5_x"), BTreeSet::from(["L3", "L4", "L12"].map(String::from)));
}

#[test]
fn the_page_has_a_row_for_each_rule_in_order_and_names_no_other() {
    let page = text(&at("docs/engine.md"));
    let rows: Vec<String> =
        page.lines().filter_map(|line| ids(line.strip_prefix('|')?.split('|').next()?).pop_first()).collect();
    assert_eq!(rows, RULES);
    assert_eq!(ids(&page), all_rules());
}

#[test]
fn the_hardware_cites_each_rule_where_it_is_carried_out_and_no_other() {
    let files = sources(&at("hdl/src"));
    assert_eq!(cited(&files, |line| line.starts_with("// ")), all_rules(), "comments in kernels");
    assert_eq!(cited(&files, |line| line.starts_with("//")), all_rules(), "all comments");
}

#[test]
fn the_rooms_of_the_engine_name_each_rule_and_no_other() {
    let mut files = sources(&at("hdl/src/engine"));
    files.retain(|path| path.ends_with("mod.rs"));
    assert!(files.len() > 8, "{files:?}");
    let named: BTreeSet<String> = files
        .iter()
        .filter(|path| path.parent() != Some(&at("hdl/src/engine")))
        .flat_map(|path| cited(std::slice::from_ref(path), |line| line.starts_with("//!")))
        .collect();
    assert_eq!(named, all_rules());
}

#[test]
fn a_room_of_the_engine_names_the_rules_that_its_kernels_carry_out() {
    let folders = std::fs::read_dir(at("hdl/src/engine")).expect("the folder of the engine");
    for room in folders.map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
        let named = cited(&[room.join("mod.rs")], |line| line.starts_with("//!"));
        let carried_out = cited(&sources(&room), |line| line.starts_with("// "));
        assert!(carried_out.is_subset(&named), "{}: {carried_out:?} carried out, {named:?} named", room.display());
    }
}

#[test]
fn the_model_cites_each_rule_and_no_other() {
    let mut files = sources(&at("sim/model/src/clock"));
    files.retain(|path| !path.ends_with("defect.rs"));
    assert_eq!(cited(&files, |line| line.starts_with("//")), all_rules());
}

#[test]
fn each_defect_names_its_rule_first_and_each_rule_has_one() {
    let found = defects();
    assert!(found.len() >= RULES.len(), "{found:?}");
    let living = living_rules();
    for (name, about) in &found {
        let rule = about.split_once(": ").map(|(rule, _)| rule);
        let is_rule = |rule: &str| RULES.contains(&rule) || living.contains(rule);
        assert!(rule.is_some_and(is_rule), "{name} is documented as {about:?}");
    }
    assert_eq!(found.iter().flat_map(|(_, about)| ids(about)).collect::<BTreeSet<_>>(), all_rules());
}

#[test]
fn each_rule_has_a_test_that_leaves_it_out() {
    let files = ["defects", "deletion_defects", "move_defects"];
    let [tests, of_deletions, of_moves] = files.map(|name| text(&at(&format!("{TESTS}/{name}.rs"))));
    assert_eq!(ids(&tests), all_rules());
    let tests = tests + &of_deletions + &of_moves;
    for (name, _) in defects() {
        assert!(tests.contains(&format!("Defect::{name}")), "no test leaves out what {name} does");
    }
}
