//! The committed Verilog is what the source exports. `INCIRCLE_BLESS=1` renews it.

use incircle_hdl::committed::{file, folder, renew, text, COMMITTED};

#[test]
fn committed_verilog_is_up_to_date() {
    if std::env::var_os("INCIRCLE_BLESS").is_some() {
        let files = renew().unwrap();
        panic!("blessed: {files:?} are written anew and nothing was compared; run again without INCIRCLE_BLESS");
    }
    for (config, top) in COMMITTED {
        let path = file((config, top));
        let held = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let exported = text(config, top, false).unwrap();
        let first = held.lines().zip(exported.lines()).position(|(held, exported)| held != exported);
        assert!(
            held == exported,
            "{} differs from the source at line {:?}: run `cargo run -p incircle-hdl -- export`",
            path.display(),
            first.map(|line| line + 1)
        );
    }
}

#[test]
fn nothing_else_is_committed() {
    let mut found: Vec<_> = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    let mut expected: Vec<_> = COMMITTED.map(file).into();
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}
