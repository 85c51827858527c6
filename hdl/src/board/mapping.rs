//! The mapping of a design to the ECP5 and its placement, in the words of the files in `constraints/ecp5`.
//! `constraints/ecp5/timing` reads the same files.

use incircle_protocol::{Config, QUAD};

/// The passes of yosys, with the placeholder TOP for the root module.
const PASSES: &str = include_str!("../../../constraints/ecp5/mapping.ys");

/// Options of nextpnr, one or more a line.
const PLACER: &str = include_str!("../../../constraints/ecp5/placer.txt");

/// Options of nextpnr for `quad` and for cores with runs, in place of those.
const QUAD_PLACER: &str = include_str!("../../../constraints/ecp5/placer-quad.txt");

/// The passes that turn a design that yosys has read into cells; `top` is its root module.
pub fn mapping(top: &str) -> String {
    let passes: Vec<_> = lines(PASSES).map(|pass| pass.replace("TOP", top)).collect();
    passes.join("; ")
}

/// Options of nextpnr for a core of this configuration, or for one with runs, except those that name files and the
/// device.
pub(super) fn placer(config: Config, has_runs: bool) -> impl Iterator<Item = &'static str> {
    let options = if has_runs || config.name == QUAD.name { QUAD_PLACER } else { PLACER };
    lines(options).flat_map(str::split_whitespace)
}

/// The lines that are neither empty nor comments.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
}

#[cfg(test)]
mod tests {
    use super::super::{constraints, BOARDS};
    use super::*;
    use incircle_protocol::{DUAL, FULL, SMALL};

    #[test]
    fn a_floorplan_fixes_each_place_once() {
        let floorplan = |config| BOARDS[0].floorplan(config);
        assert!(floorplan(SMALL).is_none() && floorplan(DUAL).is_none());
        for config in [FULL, QUAD] {
            let file = constraints().join("ecp5").join(floorplan(config).expect("a file"));
            let text = std::fs::read_to_string(file).expect("a floorplan");
            let mut places: Vec<_> = lines(&text).filter_map(|line| line.split('"').nth(1)).collect();
            let cells = places.len();
            assert_eq!(cells, lines(&text).count());
            places.sort_unstable();
            places.dedup();
            assert!(cells > 80 && places.len() == cells);
        }
    }

    #[test]
    fn comments_and_placeholders_are_gone() {
        let mapping = mapping("some_top");
        assert!(mapping.starts_with("hierarchy -top some_top; proc; "), "{mapping}");
        assert!(!mapping.contains("TOP") && !mapping.contains('#') && !mapping.contains('\n'), "{mapping}");
        for config in [FULL, DUAL] {
            assert!(placer(config, false).eq(["--placer", "static", "--tmg-ripup"]));
        }
        assert!(placer(QUAD, false).eq(["--placer", "static"]) && placer(FULL, true).eq(placer(QUAD, false)));
    }
}
