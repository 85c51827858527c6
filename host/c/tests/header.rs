//! The header is the one that the sources ask for.

use std::path::Path;

const TOP: &str =
    "/* The C interface of incircle, made of the Rust sources by cbindgen. A test compares it with them.\n \
    *\n * Each function returns INCIRCLE_OK or another status, and incircle_error() then has a sentence about it. */\n";

#[test]
fn the_header_is_that_of_the_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut config = cbindgen::Config { language: cbindgen::Language::C, ..Default::default() };
    config.header = Some(TOP.to_owned());
    config.include_guard = Some("INCIRCLE_H".to_owned());
    config.cpp_compat = true;
    config.documentation_style = cbindgen::DocumentationStyle::C99;
    config.style = cbindgen::Style::Type;
    config.usize_is_size_t = true;
    config.export.include =
        ["options", "plan", "relaxation", "relaxed"].map(|name| format!("incircle_{name}")).to_vec();
    let files = ["status", "mesh", "constrained", "living", "questions", "grid", "diagram", "lloyd", "surface"];
    let files = files.map(|file| root.join("src").join(file).with_extension("rs"));
    let builder =
        files.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| builder.with_src(file));
    let mut made = Vec::new();
    builder.generate().expect("sources that cbindgen reads").write(&mut made);
    let made = String::from_utf8(made).expect("UTF-8");
    let path = root.join("include/incircle.h");
    if std::env::var_os("INCIRCLE_BLESS").is_some() {
        std::fs::write(&path, &made).expect("a header that can be written");
        panic!("{} was written: look at `git diff`, and run the test again without INCIRCLE_BLESS", path.display());
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == made, "the header differs from the sources: run the test with INCIRCLE_BLESS=1");
}
