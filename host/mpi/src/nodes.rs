//! The process of each step of the tree, which is a tile or a join.

use incircle::tiles::{Region, Step};

use crate::cuts::Cuts;

/// A step of the tree. Its place in the list is its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    pub region: Region,
    /// The process that does the step. A join is done by the process of its first child.
    pub rank: usize,
    /// 0 for a tile; for a join, one more than the highest level of its children.
    pub level: usize,
    /// Whether several processes have tiles below this step.
    pub is_shared: bool,
    /// The steps whose borders are joined, in the sequence of the curve; none for a tile.
    pub children: Vec<usize>,
}

/// All steps, in the sequence of the tree: each step after its children.
pub fn nodes(cuts: &Cuts) -> Vec<Node> {
    let (mut nodes, mut stack, mut owners) = (Vec::<Node>::new(), Vec::new(), cuts.owners.iter());
    for step in cuts.tree.steps() {
        stack.push(nodes.len());
        match step {
            Step::Tile { region, .. } => {
                let rank = owners.next().copied().unwrap_or(0);
                nodes.push(Node { region: *region, rank, level: 0, is_shared: false, children: Vec::new() });
            }
            Step::Join { region, children } => {
                let own = stack.pop();
                let children = stack.split_off(stack.len().saturating_sub(*children));
                stack.extend(own);
                let of = || children.iter().map(|&child| &nodes[child]);
                let rank = of().next().map_or(0, |child| child.rank);
                let level = 1 + of().map(|child| child.level).max().unwrap_or(0);
                let is_shared = of().any(|child| child.is_shared || child.rank != rank);
                nodes.push(Node { region: *region, rank, level, is_shared, children });
            }
        }
    }
    nodes
}

/// The places of the joins that several processes share, level by level. All of a level can be done side by side.
pub fn shared_levels(nodes: &[Node]) -> Vec<Vec<usize>> {
    let mut levels = Vec::new();
    for (place, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_shared) {
        if levels.len() <= node.level {
            levels.resize_with(node.level + 1, Vec::new);
        }
        levels[node.level].push(place);
    }
    levels.retain(|level| !level.is_empty());
    levels
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use incircle::tiles::Tree;

    use super::*;

    /// Sixteen equal tiles for these processes.
    fn cuts(owners: [usize; 16]) -> Cuts {
        let positions: Vec<u64> = (0..16).map(|k| k << 60).collect();
        Cuts { tree: Tree::of_positions(&positions, NonZeroUsize::MIN), owners: owners.to_vec() }
    }

    #[test]
    fn joins_within_a_process_are_not_shared() {
        let nodes = nodes(&cuts([0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2]));
        let joins: Vec<_> = nodes.iter().filter(|node| node.level > 0).collect();
        let seen: Vec<_> = joins.iter().map(|node| (node.rank, node.level, node.is_shared)).collect();
        assert_eq!(seen, [(0, 1, false), (0, 1, true), (1, 1, false), (2, 1, false), (0, 2, true)]);
        assert_eq!(nodes.last().map(|root| (root.region, root.children.len())), Some((Region::WHOLE, 4)));
        assert_eq!(shared_levels(&nodes), [vec![9], vec![20]]);
    }

    #[test]
    fn each_step_is_the_child_of_one_join() {
        let nodes = nodes(&cuts([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]));
        let mut children: Vec<usize> = nodes.iter().flat_map(|node| node.children.clone()).collect();
        children.sort_unstable();
        assert_eq!(children, (0..nodes.len() - 1).collect::<Vec<_>>());
    }
}
