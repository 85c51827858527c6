//! Pages for `man`.

use crate::common::Scratch;

#[test]
fn a_page_has_name_options_and_examples() {
    let page = Scratch::new().run("man tile split").ok().stdout;
    for part in ["\n.TH incircle-tile-split 1 ", "\n.SH NAME\n", "\n.SH OPTIONS\n", "\\-\\-points", "Examples:"] {
        assert!(page.contains(part), "{part} is missing:\n{page}");
    }
    let all = Scratch::new().run("man").ok().stdout;
    assert!(all.contains("\n.TH incircle 1 ") && all.contains("incircle\\-tile(1)"), "{all}");
}

#[test]
fn a_subcommand_that_there_is_not_is_refused() {
    Scratch::new().run("man tile cut").fails(2, &["'incircle tile' has no subcommand 'cut'", "incircle tile --help"]);
    Scratch::new().run("man fly").fails(2, &["'incircle' has no subcommand 'fly'"]);
}
