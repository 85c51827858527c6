//! Checks that the page of sizes says what the figures say.

use incircle_hdl::board::held_text;
use incircle_hdl::board::sizes::{figures, page, page_path, Size, Sizes, FAMILIES};

#[test]
fn the_page_is_what_the_figures_say() {
    let held = held_text(&page_path()).unwrap();
    assert!(held == page().unwrap(), "run `cargo run --release -p incircle-hdl -- sizes --table`");
}

#[test]
fn the_figures_are_those_of_cores() {
    let measured = Sizes::read(&figures()).unwrap();
    assert!(!measured.sizes.is_empty());
    for size in &measured.sizes {
        let config = size.config().expect("one of the sizes");
        assert_eq!(size.configuration, config.name);
        for (name, cells) in &size.cells {
            assert!(FAMILIES.iter().any(|family| family.name == name), "{name}");
            // An engine has twenty multipliers.
            assert_eq!(cells.multiplier, 20 * u64::from(config.engines), "{name}: {size:?}");
            assert!(cells.lut > 3000 && cells.ff > 4000 && cells.block_memory > 20, "{name}: {size:?}");
        }
    }
}

#[test]
fn new_figures_take_the_place_of_old_ones() {
    let size = |engines, points, family: &str, lut| {
        let cells = incircle_hdl::board::sizes::FamilyCells { lut, ..Default::default() };
        let cells = [(family.to_owned(), cells)].into();
        Size { configuration: String::new(), engines, points, contexts: 16, cells, placed: None }
    };
    let sizes = |sizes: Vec<Size>| Sizes { yosys: "1".into(), date: "2".into(), sizes };
    let old = sizes(vec![size(1, 8192, "ecp5", 1), size(1, 1024, "nexus", 2)]);
    let new =
        old.renewed_by(sizes(vec![size(1, 8192, "nexus", 3), size(1, 2048, "ecp5", 4), size(1, 1024, "nexus", 5)]));
    assert_eq!(new.sizes.iter().map(|size| size.points).collect::<Vec<_>>(), [1024, 2048, 8192]);
    assert_eq!(new.sizes[0].cells["nexus"].lut, 5);
    assert_eq!((new.sizes[2].cells["ecp5"].lut, new.sizes[2].cells["nexus"].lut), (1, 3));
}
