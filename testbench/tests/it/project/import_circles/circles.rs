//! The circles of a graph: its strongly connected parts of more than one node.

use std::collections::{BTreeMap, BTreeSet};

use super::imports::Graph;

/// Returns all circles, each sorted. A node with an edge to itself alone is no circle.
pub fn circles(graph: &Graph) -> Vec<Vec<String>> {
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        graph.keys().map(|node| (node.as_str(), reach(graph, node))).collect();
    let mut found = BTreeSet::new();
    for (node, others) in &reached {
        let comes_back = |other: &&&str| reached.get(**other).is_some_and(|back| back.contains(node));
        let circle: BTreeSet<&str> = others.iter().filter(comes_back).copied().collect();
        if circle.len() > 1 {
            found.insert(circle);
        }
    }
    found.into_iter().map(|circle| circle.into_iter().map(str::to_string).collect()).collect()
}

/// All nodes that can be reached from this one.
fn reach<'a>(graph: &'a Graph, from: &str) -> BTreeSet<&'a str> {
    let next = |node: &str| graph.get(node).into_iter().flatten().map(String::as_str);
    let mut reached: BTreeSet<&str> = BTreeSet::new();
    let mut open: Vec<&str> = next(from).collect();
    while let Some(node) = open.pop() {
        if reached.insert(node) {
            open.extend(next(node));
        }
    }
    reached
}
