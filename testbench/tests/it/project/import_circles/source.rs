//! The modules of a crate as the compiler would find them, without the parts that are compiled for tests only.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::Visit;

/// Segments of a path as written, with `crate`, `super` and `self`.
pub type Segments = Vec<String>;

/// The parts of a module that matter for imports.
#[derive(Debug, Default)]
pub struct Module {
    /// Names of the items that the module defines.
    pub items: Vec<String>,
    /// Names that `use` brings in.
    pub uses: Vec<Use>,
    /// Paths in the code of the module.
    pub paths: Vec<Segments>,
}

/// A name that `use` brings in, or the whole content of a module.
#[derive(Debug)]
pub struct Use {
    /// The name; `None` if the whole content comes in.
    pub name: Option<String>,
    pub path: Segments,
    /// True if the module hands it on (`pub use`).
    pub is_handed_on: bool,
}

/// The modules of a crate by their paths; the path of the root is empty.
#[derive(Debug, Default)]
pub struct Tree {
    pub modules: BTreeMap<Segments, Module>,
}

/// Reads a file; `None` if there is no such file.
pub type Read<'a> = &'a dyn Fn(&Path) -> Option<String>;

impl Tree {
    /// Reads all modules below this root file.
    pub fn read(root: &Path, read: Read<'_>) -> Result<Self, String> {
        let mut tree = Self::default();
        let folder = root.parent().unwrap_or(Path::new("")).to_path_buf();
        let text = read(root).ok_or_else(|| format!("{} is missing", root.display()))?;
        tree.add_file(&text, root, folder, Segments::new(), read)?;
        Ok(tree)
    }

    fn add_file(
        &mut self,
        text: &str,
        file: &Path,
        folder: PathBuf,
        name: Segments,
        read: Read<'_>,
    ) -> Result<(), String> {
        let parsed = syn::parse_file(text).map_err(|error| format!("{}: {error}", file.display()))?;
        self.add(&parsed.items, &folder, name, read)
    }

    /// Adds the module with these items; its children are files in this folder.
    fn add(&mut self, items: &[syn::Item], folder: &Path, name: Segments, read: Read<'_>) -> Result<(), String> {
        let mut collector = Collector::default();
        for item in items {
            match item {
                syn::Item::Mod(module) if !is_for_tests(&module.attrs) => {
                    let mut child = name.clone();
                    child.push(module.ident.to_string());
                    self.add_child(module, folder, child, read)?;
                }
                syn::Item::Mod(_) => {}
                item => collector.visit_item(item),
            }
        }
        self.modules.insert(name, collector.module);
        Ok(())
    }

    fn add_child(
        &mut self,
        module: &syn::ItemMod,
        folder: &Path,
        name: Segments,
        read: Read<'_>,
    ) -> Result<(), String> {
        let inner = folder.join(module.ident.to_string());
        if let Some((_, items)) = &module.content {
            return self.add(items, &inner, name, read);
        }
        let beside = folder.join(format!("{}.rs", module.ident));
        let inside = inner.join("mod.rs");
        let file = [beside, inside].into_iter().find_map(|path| read(&path).map(|text| (path, text)));
        let (path, text) = file.ok_or_else(|| format!("the module {} has no file", name.join("::")))?;
        self.add_file(&text, &path, inner, name, read)
    }
}

/// True if a part with these attributes is compiled for tests only.
fn is_for_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let syn::Meta::List(list) = &attribute.meta else {
            return attribute.path().is_ident("test");
        };
        let words: Vec<String> = paths_of(list.tokens.clone()).into_iter().flatten().collect();
        let has = |word: &str| words.iter().any(|found| found == word);
        attribute.path().is_ident("cfg") && has("test") && !has("not") && !has("any")
    })
}

/// All paths in tokens that nobody parses, such as the arguments of a macro.
fn paths_of(tokens: TokenStream) -> Vec<Segments> {
    let mut paths = Vec::new();
    let mut path = Segments::new();
    let mut colons = 0;
    for token in tokens {
        match token {
            TokenTree::Ident(word) => {
                if colons != 2 && !path.is_empty() {
                    paths.push(std::mem::take(&mut path));
                }
                path.push(word.to_string());
                colons = 0;
            }
            TokenTree::Punct(mark) if mark.as_char() == ':' => colons += 1,
            TokenTree::Group(group) => {
                paths.push(std::mem::take(&mut path));
                colons = 0;
                paths.extend(paths_of(group.stream()));
            }
            _ => {
                paths.push(std::mem::take(&mut path));
                colons = 0;
            }
        }
    }
    paths.push(path);
    paths.retain(|path| !path.is_empty());
    paths
}

/// Collects the parts of a module, item by item.
#[derive(Default)]
struct Collector {
    module: Module,
    /// Depth within an item; modules and items inside it are not imports of anybody.
    depth: usize,
}

impl Collector {
    fn add_use(&mut self, before: &Segments, tree: &syn::UseTree, is_handed_on: bool) {
        let mut add = |name: Option<String>, path| self.module.uses.push(Use { name, path, is_handed_on });
        let with = |word: &syn::Ident| before.iter().cloned().chain([word.to_string()]).collect::<Segments>();
        match tree {
            syn::UseTree::Path(path) => self.add_use(&with(&path.ident), &path.tree, is_handed_on),
            syn::UseTree::Group(group) => group.items.iter().for_each(|item| self.add_use(before, item, is_handed_on)),
            syn::UseTree::Glob(_) => add(None, before.clone()),
            syn::UseTree::Name(name) if name.ident == "self" => {
                add(before.last().cloned(), before.clone());
            }
            syn::UseTree::Name(name) => add(Some(name.ident.to_string()), with(&name.ident)),
            syn::UseTree::Rename(rename) if rename.ident == "self" => {
                add(Some(rename.rename.to_string()), before.clone());
            }
            syn::UseTree::Rename(rename) => {
                add(Some(rename.rename.to_string()), with(&rename.ident));
            }
        }
    }
}

/// Name of an item, and its attributes.
fn head(item: &syn::Item) -> (Option<&syn::Ident>, &[syn::Attribute]) {
    match item {
        syn::Item::Const(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Enum(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Fn(item) => (Some(&item.sig.ident), &item.attrs),
        syn::Item::Macro(item) => (item.ident.as_ref(), &item.attrs),
        syn::Item::Static(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Struct(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Trait(item) => (Some(&item.ident), &item.attrs),
        syn::Item::TraitAlias(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Type(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Union(item) => (Some(&item.ident), &item.attrs),
        syn::Item::Impl(item) => (None, &item.attrs),
        syn::Item::Use(item) => (None, &item.attrs),
        _ => (None, &[]),
    }
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let (name, attributes) = head(item);
        if is_for_tests(attributes) {
            return;
        }
        if let (0, Some(name)) = (self.depth, name) {
            self.module.items.push(name.to_string());
        }
        self.depth += 1;
        syn::visit::visit_item(self, item);
        self.depth -= 1;
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        // A path that begins with `::` leads into another crate.
        if item.leading_colon.is_none() {
            let is_handed_on = !matches!(item.vis, syn::Visibility::Inherited);
            self.add_use(&Segments::new(), &item.tree, is_handed_on);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if !is_for_tests(&item.attrs) {
            syn::visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.leading_colon.is_none() {
            self.module.paths.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.module.paths.extend(paths_of(call.tokens.clone()));
        syn::visit::visit_macro(self, call);
    }

    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {
        // Attributes name derives and settings, not modules of the crate.
    }
}
