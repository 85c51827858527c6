//! Checks which package uses which: the hardware never calls its oracle, and the
//! library needs neither rust-hdl nor Verilator.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use cargo_metadata::{DependencyKind, MetadataCommand};

/// A use of one package by another.
#[derive(Clone, Debug)]
struct Use {
    package: String,
    kind: DependencyKind,
    optional: bool,
}

/// All direct uses of every package in the workspace, including packages from outside.
type Graph = BTreeMap<String, Vec<Use>>;

/// Packages of the workspace that each package may use directly, also in its tests.
const ALLOWED: [(&str, &[&str]); 13] = [
    ("incircle-testkit", &[]),
    ("incircle-protocol", &[]),
    ("incircle-model", &["incircle-protocol", "incircle-testkit"]),
    ("incircle-hdl", &["incircle-protocol", "incircle-testkit"]),
    ("incircle-blocks", &["incircle-protocol", "incircle-hdl"]),
    ("verilated", &[]),
    (
        "incircle-sim",
        &["incircle-protocol", "incircle-model", "incircle", "incircle-hdl", "verilated", "incircle-testkit"],
    ),
    ("incircle-geometry", &["incircle-testkit"]),
    ("incircle", &["incircle-protocol", "incircle-geometry", "incircle-model", "incircle-testkit"]),
    ("incircle-embedded", &["incircle-protocol", "incircle", "incircle-model", "incircle-testkit"]),
    ("incircle-cli", &["incircle-protocol", "incircle", "incircle-sim", "incircle-testkit"]),
    (
        "incircle-research",
        &["incircle-protocol", "incircle-geometry", "incircle-model", "incircle", "incircle-testkit"],
    ),
    (
        "incircle-testbench",
        &[
            "incircle-protocol",
            "incircle-model",
            "incircle-hdl",
            "incircle-sim",
            "verilated",
            "incircle",
            "incircle-cli",
            "incircle-blocks",
            "incircle-testkit",
        ],
    ),
];

/// Packages that a package must not reach by any path that ships, and the reason.
const UNREACHABLE: [(&str, &[&str], &str); 8] = [
    ("incircle-hdl", &["incircle-model", "incircle", "verilated"], "hardware must not be able to call its own oracle"),
    (
        "incircle-model",
        &["incircle-hdl", "rust-hdl", "verilated", "incircle-sim"],
        "the oracle must not be able to call the hardware",
    ),
    (
        "incircle",
        &["incircle-hdl", "rust-hdl", "verilated", "incircle-sim"],
        "the library is built without rust-hdl and Verilator",
    ),
    ("incircle-hdl", &["incircle-testkit"], TESTS_ONLY),
    ("incircle-model", &["incircle-testkit"], TESTS_ONLY),
    ("incircle", &["incircle-testkit"], TESTS_ONLY),
    ("incircle-geometry", &["incircle-testkit"], TESTS_ONLY),
    (
        "incircle-embedded",
        &["incircle", "incircle-model", "incircle-testkit"],
        "a microcontroller has room for the driver alone",
    ),
];

const TESTS_ONLY: &str = "what ships here does without the kit of the tests";

/// All breaches of the rules, a sentence for each.
fn breaches(graph: &Graph) -> Vec<String> {
    let mut found = Vec::new();
    for (package, uses) in graph {
        let Some((_, allowed)) = ALLOWED.iter().find(|(name, _)| name == package) else {
            found.push(format!("no rule says what {package} may use"));
            continue;
        };
        for used in uses {
            if graph.contains_key(&used.package)
                && used.package != *package
                && !allowed.contains(&used.package.as_str())
            {
                found.push(format!("{package} must not use {} directly", used.package));
            }
            let is_sim_of_the_command = package == "incircle-cli" && used.package == "incircle-sim";
            if is_sim_of_the_command && !used.optional {
                found.push("incircle-cli must use incircle-sim only as an option".to_string());
            }
        }
    }
    if graph.get("incircle-protocol").is_some_and(|uses| !uses.is_empty()) {
        found.push("incircle-protocol must use nothing at all".to_string());
    }
    for (package, forbidden, reason) in UNREACHABLE {
        for reached in reachable(graph, package) {
            // `rust-hdl` stands for all its parts; a name of this workspace stands for itself.
            let is_forbidden = forbidden
                .iter()
                .any(|&name| reached == name || (name == "rust-hdl" && reached.starts_with("rust-hdl-")));
            if is_forbidden {
                found.push(format!("{package} reaches {reached}: {reason}"));
            }
        }
    }
    found
}

/// Everything that a package uses, directly or through others, to be built and to run.
fn reachable(graph: &Graph, package: &str) -> BTreeSet<String> {
    let mut reached = BTreeSet::new();
    let mut open = vec![package.to_string()];
    while let Some(next) = open.pop() {
        for used in graph.get(&next).into_iter().flatten() {
            if used.kind != DependencyKind::Development && reached.insert(used.package.clone()) {
                open.push(used.package.clone());
            }
        }
    }
    reached
}

/// The workspace as cargo sees it, and the default features of `incircle-cli`.
fn workspace() -> (Graph, Vec<String>) {
    let metadata = MetadataCommand::new()
        .manifest_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml"))
        .no_deps()
        .exec()
        .unwrap();
    let mut graph = Graph::new();
    let mut default_features = Vec::new();
    for package in metadata.packages {
        let uses = package.dependencies.iter().map(|dependency| Use {
            package: dependency.name.clone(),
            kind: dependency.kind,
            optional: dependency.optional,
        });
        graph.insert(package.name.to_string(), uses.collect());
        if package.name.as_str() == "incircle-cli" {
            default_features = package.features.get("default").cloned().unwrap_or_default();
        }
    }
    (graph, default_features)
}

#[test]
fn the_workspace_keeps_the_rules() {
    let (graph, default_features) = workspace();
    assert_eq!(graph.len(), ALLOWED.len(), "{:?}", graph.keys());
    let found = breaches(&graph);
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(default_features.is_empty(), "{default_features:?}");
}

/// A graph of normal uses that keeps all the rules, with one more use. For tests are the uses of the kit, and all uses
/// of `incircle-embedded` but one.
fn allowed_graph_and(user: &str, used: &str, kind: DependencyKind) -> Graph {
    let mut graph: Graph = ALLOWED
        .iter()
        .map(|(package, allowed)| {
            let is_for_tests = |used: &str| {
                used == "incircle-testkit" || *package == "incircle-embedded" && used != "incircle-protocol"
            };
            let uses = allowed.iter().map(|used| Use {
                package: used.to_string(),
                kind: if is_for_tests(used) { DependencyKind::Development } else { DependencyKind::Normal },
                optional: *used == "incircle-sim",
            });
            (package.to_string(), uses.collect())
        })
        .collect();
    graph.get_mut(user).unwrap().push(Use { package: used.to_string(), kind, optional: false });
    graph
}

#[test]
fn a_graph_that_keeps_the_rules_passes() {
    let graph = allowed_graph_and("incircle-hdl", "rust-hdl-core", DependencyKind::Normal);
    assert_eq!(breaches(&graph), Vec::<String>::new());
}

/// One use more than allowed, and the checker's complaint about it: user, used, kind, part of a sentence.
const BREACHES: [(&str, &str, DependencyKind, &str); 21] = [
    ("incircle-hdl", "incircle-model", DependencyKind::Normal, "incircle-hdl reaches incircle-model"),
    ("incircle-hdl", "incircle-model", DependencyKind::Development, "incircle-hdl must not use incircle-model"),
    ("incircle-hdl", "incircle", DependencyKind::Normal, "incircle-hdl reaches incircle-model"),
    ("incircle-protocol", "incircle-model", DependencyKind::Normal, "incircle-hdl reaches incircle-model"),
    ("incircle-protocol", "serde", DependencyKind::Normal, "incircle-protocol must use nothing"),
    ("incircle-model", "rust-hdl-core", DependencyKind::Normal, "incircle-model reaches rust-hdl-core"),
    ("incircle", "rust-hdl-core", DependencyKind::Build, "incircle reaches rust-hdl-core"),
    ("incircle", "rust-hdl", DependencyKind::Normal, "incircle reaches rust-hdl"),
    ("incircle", "verilated", DependencyKind::Normal, "incircle reaches verilated"),
    ("incircle", "incircle-sim", DependencyKind::Normal, "incircle reaches incircle-hdl"),
    ("incircle-model", "incircle-sim", DependencyKind::Normal, "incircle reaches verilated"),
    ("incircle", "incircle-sim", DependencyKind::Development, "incircle must not use incircle-sim"),
    ("incircle-cli", "incircle-sim", DependencyKind::Normal, "only as an option"),
    (
        "incircle-geometry",
        "incircle-protocol",
        DependencyKind::Normal,
        "incircle-geometry must not use incircle-protocol",
    ),
    ("incircle-embedded", "incircle", DependencyKind::Normal, "incircle-embedded reaches incircle-model"),
    ("incircle", "incircle-research", DependencyKind::Development, "incircle must not use incircle-research"),
    ("incircle-cli", "incircle-research", DependencyKind::Normal, "incircle-cli must not use incircle-research"),
    ("incircle", "incircle-testkit", DependencyKind::Normal, "incircle reaches incircle-testkit"),
    ("incircle-hdl", "incircle-blocks", DependencyKind::Development, "incircle-hdl must not use incircle-blocks"),
    ("incircle-testkit", "incircle", DependencyKind::Normal, "incircle-testkit must not use incircle directly"),
    ("incircle-cli", "incircle-testbench", DependencyKind::Development, "incircle-cli must not use incircle-testbench"),
];

#[test]
fn each_kind_of_breach_is_found() {
    for (user, used, kind, sentence) in BREACHES {
        let found = breaches(&allowed_graph_and(user, used, kind));
        assert!(found.iter().any(|breach| breach.contains(sentence)), "{user} -> {used} gives {found:?}");
    }
}

#[test]
fn a_package_without_a_rule_is_found() {
    let mut graph = allowed_graph_and("incircle-hdl", "rust-hdl-core", DependencyKind::Normal);
    graph.insert("incircle-new".to_string(), Vec::new());
    assert_eq!(breaches(&graph), ["no rule says what incircle-new may use"]);
}
