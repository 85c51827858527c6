//! Finds which module imports which: paths are followed to the modules that define what they name.
//!
//! A module that hands on items of others (`pub use`) is two nodes: its own code, and its face, which imports
//! everything that it hands on. Handing on is no import of the code.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{Segments, Tree, Use};

/// Imports of each module, as names of modules and faces.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

/// Longest chain of `use` that is followed; a chain that leads back to itself would never end.
const HOPS: u32 = 16;

/// Meaning of a path's first or further name in a module.
enum Meaning {
    /// A module of the crate.
    Module(Segments),
    /// An item of that module.
    Item,
    /// An item that another path names, seen from that module; true if the module hands it on.
    Other(Segments, bool),
}

/// A crate, with everything that its modules bring in whole (`use a::*`) looked up once.
struct Crate<'a> {
    tree: &'a Tree,
    /// Modules that each module brings in whole.
    globs: BTreeMap<&'a Segments, Vec<Segments>>,
    /// All names that mean something in each module.
    names: BTreeMap<&'a Segments, BTreeSet<String>>,
}

/// Returns the imports of all modules and of all faces.
pub fn imports(tree: &Tree) -> Graph {
    let krate = Crate::of(tree);
    let both = |name: &Segments| {
        [(name.join("::"), krate.imports_of(name, false)), (face(name), krate.imports_of(name, true))]
    };
    tree.modules.keys().flat_map(both).collect()
}

/// Name of the node for everything that a module hands on.
fn face(module: &Segments) -> String {
    format!("{} (face)", module.join("::"))
}

impl<'a> Crate<'a> {
    fn of(tree: &'a Tree) -> Self {
        let mut found = Self { tree, globs: BTreeMap::new(), names: BTreeMap::new() };
        for (name, module) in &tree.modules {
            let children =
                tree.modules.keys().filter(|child| child.split_last().is_some_and(|(_, of)| of == &name[..]));
            let names = children.filter_map(|child| child.last()).chain(&module.items);
            let names = names.chain(module.uses.iter().filter_map(|used| used.name.as_ref()));
            found.names.insert(name, names.cloned().collect());
        }
        let globs = tree.modules.iter().map(|(name, module)| {
            let paths = module.uses.iter().filter(|used| used.name.is_none()).map(|used| &used.path);
            let targets = paths.filter_map(|path| found.module_at(name, path));
            (name, targets.filter(|target| target != name).collect())
        });
        found.globs = globs.collect();
        found.spread_names();
        found
    }

    /// Names spread from a module to those that bring it in whole, until no module gets a new one.
    fn spread_names(&mut self) {
        loop {
            let mut grown = false;
            for (name, targets) in &self.globs {
                for target in targets {
                    let handed = self.names[target].clone();
                    let names = self.names.entry(name).or_default();
                    let before = names.len();
                    names.extend(handed);
                    grown |= names.len() > before;
                }
            }
            if !grown {
                return;
            }
        }
    }

    /// The imports of the code of a module, or of its face.
    fn imports_of(&self, name: &Segments, of_face: bool) -> BTreeSet<String> {
        let module = &self.tree.modules[name];
        let mut imported = BTreeSet::new();
        for used in module.uses.iter().filter(|used| used.is_handed_on == of_face) {
            let end = self.follow(name, &used.path, HOPS, &mut imported);
            if let (None, Some(whole)) = (&used.name, end) {
                // Nobody knows which of the names are needed, so all count.
                imported.extend([whole.join("::"), face(&whole)]);
            }
        }
        for path in module.paths.iter().filter(|_| !of_face) {
            self.follow(name, path, HOPS, &mut imported);
        }
        imported.remove(&if of_face { face(name) } else { name.join("::") });
        imported
    }

    /// Adds the modules from which a path, written in this module, takes something. Returns the module at which the
    /// path ends, if it ends at one.
    fn follow(&self, from: &Segments, path: &[String], hops: u32, imported: &mut BTreeSet<String>) -> Option<Segments> {
        let mut here = from.clone();
        for word in path {
            match word.as_str() {
                "crate" => here.clear(),
                "self" => {}
                "super" => drop(here.pop()),
                word => match self.meaning(&here, word)? {
                    Meaning::Module(module) => here = module,
                    Meaning::Item => {
                        imported.insert(here.join("::"));
                        return None;
                    }
                    Meaning::Other(target, is_handed_on) => {
                        // A `use` in the module itself is followed but does not count.
                        if here != *from {
                            imported.insert(if is_handed_on { face(&here) } else { here.join("::") });
                        }
                        here = self.follow(&here, &target, hops.checked_sub(1)?, imported)?;
                    }
                },
            }
        }
        Some(here)
    }

    /// The module at which a path ends, if it ends at one.
    fn module_at(&self, from: &Segments, path: &[String]) -> Option<Segments> {
        self.follow(from, path, HOPS, &mut BTreeSet::new())
    }

    /// Meaning of a word in a module; `None` if it is nothing of this crate.
    fn meaning(&self, module: &Segments, word: &str) -> Option<Meaning> {
        let child: Segments = module.iter().cloned().chain([word.to_string()]).collect();
        if self.tree.modules.contains_key(&child) {
            return Some(Meaning::Module(child));
        }
        let content = self.tree.modules.get(module)?;
        if content.items.iter().any(|item| item == word) {
            return Some(Meaning::Item);
        }
        if let Some(used) = content.uses.iter().find(|used| used.name.as_deref() == Some(word)) {
            // `use name::...` leads into another crate if the module has nothing else of this name.
            let is_foreign = used.path.first().map(String::as_str) == Some(word);
            return (!is_foreign).then(|| Meaning::Other(used.path.clone(), used.is_handed_on));
        }
        let has = |target: &&Segments| self.names[target].contains(word);
        let target = self.globs.get(module).into_iter().flatten().find(has)?;
        let path = ["crate".to_string()].into_iter().chain(target.iter().cloned()).chain([word.to_string()]);
        let hands_on = |used: &Use| used.name.is_none() && used.is_handed_on;
        Some(Meaning::Other(path.collect(), content.uses.iter().any(hands_on)))
    }
}

/// A circle in words: each of its modules, with its imports within the circle.
pub fn told(tree: &Tree, circle: &[String]) -> String {
    let shown = |module: &str| if module.is_empty() { "the root".to_string() } else { module.to_string() };
    let graph = imports(tree);
    let within = |module: &String| {
        let imported = graph[module].iter().filter(|imported| circle.contains(imported));
        format!("{} -> {}", shown(module), imported.map(|module| shown(module)).collect::<Vec<_>>().join(", "))
    };
    circle.iter().map(within).collect::<Vec<_>>().join("; ")
}
