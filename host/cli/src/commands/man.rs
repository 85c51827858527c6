//! `incircle man`: prints pages for `man`.

use clap::{Command, CommandFactory};

use crate::arguments::{Cli, ManArguments};
use crate::failure::Failure;
use crate::output;

/// Prints the page of a subcommand, or of the whole command.
pub fn run(arguments: &ManArguments) -> Result<(), Failure> {
    let mut all = Cli::command();
    all.build();
    let mut found = &all;
    for (depth, name) in arguments.path.iter().enumerate() {
        found = found.find_subcommand(name).ok_or_else(|| {
            let parent = ["incircle"].into_iter().chain(arguments.path[..depth].iter().map(String::as_str));
            let parent = parent.collect::<Vec<_>>().join(" ");
            Failure::usage(format!("'{parent}' has no subcommand '{name}': '{parent} --help' lists them"))
        })?;
    }
    output::print(&page(found))
}

/// The page of a command, in the language of `man`.
fn page(command: &Command) -> String {
    let mut text = Vec::new();
    // Writing into memory never fails.
    let page = clap_mangen::Man::new(command.clone())
        .manual("incircle")
        .source(concat!("incircle ", env!("CARGO_PKG_VERSION")));
    let _ = page.render(&mut text);
    String::from_utf8_lossy(&text).into_owned()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::fs;
    use std::path::{Path, PathBuf};

    use clap_complete::Shell;

    use super::*;

    /// Shells, and where packages of systems keep their scripts.
    const SHELLS: [(Shell, &str); 3] = [
        (Shell::Bash, "bash-completion/completions/incircle"),
        (Shell::Zsh, "zsh/site-functions/_incircle"),
        (Shell::Fish, "fish/vendor_completions.d/incircle.fish"),
    ];

    /// Adds the pages of a command and of its subcommands.
    fn add_pages(command: &Command, files: &mut BTreeMap<String, String>) {
        let name = command.get_display_name().unwrap_or(command.get_name());
        files.insert(format!("man/man1/{name}.1"), page(command));
        for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
            add_pages(below, files);
        }
    }

    /// All that the folder should have, by the path of each file in it.
    fn wanted() -> BTreeMap<String, String> {
        let mut all = Cli::command();
        all.build();
        let mut files = BTreeMap::new();
        add_pages(&all, &mut files);
        for (shell, path) in SHELLS {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "incircle", &mut script);
            files.insert(path.to_owned(), String::from_utf8(script).unwrap());
        }
        files
    }

    /// All files below a folder, by their paths from `root`.
    fn below(folder: &Path, root: &Path, found: &mut BTreeMap<String, String>) {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                below(&path, root, found);
            } else {
                let name = path.strip_prefix(root).unwrap().display().to_string();
                found.insert(name, fs::read_to_string(&path).unwrap());
            }
        }
    }

    /// `INCIRCLE_BLESS=1` writes the folder anew.
    #[test]
    fn the_folder_share_has_what_the_command_prints() {
        let share: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("share");
        let wanted = wanted();
        assert!(wanted.len() > 15 && wanted.contains_key("man/man1/incircle-tile-split.1"), "{:?}", wanted.keys());
        if std::env::var_os("INCIRCLE_BLESS").is_some() {
            let _ = fs::remove_dir_all(&share);
            for (path, text) in &wanted {
                let file = share.join(path);
                fs::create_dir_all(file.parent().unwrap()).unwrap();
                fs::write(file, text).unwrap();
            }
            panic!("blessed: the folder is written anew and nothing was compared; run again without INCIRCLE_BLESS");
        }
        let mut found = BTreeMap::new();
        below(&share, &share, &mut found);
        assert!(found.keys().eq(wanted.keys()), "{:?} in place of {:?}", found.keys(), wanted.keys());
        for (path, text) in &wanted {
            assert!(found[path] == *text, "{path} is not what the command prints: run once with INCIRCLE_BLESS=1");
        }
    }
}
