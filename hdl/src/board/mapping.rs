//! How the tools map a design to the ECP5 and place it: what `constraints/ecp5` says, which `constraints/ecp5/timing` reads as well.

/// The passes of yosys, with a placeholder for the root module.
const PASSES: &str = include_str!("../../../constraints/ecp5/mapping.ys");

/// Options of nextpnr.
const PLACER: &str = include_str!("../../../constraints/ecp5/placer.txt");

/// The file that gives places to block RAMs of `full` in the largest devices.
pub(super) const FLOORPLAN: &str = "floorplan.ys";

/// The passes from a design that has been read to its cells, `top` being its root module.
pub fn mapping(top: &str) -> String {
    let passes: Vec<_> = lines(PASSES).map(|pass| pass.replace("TOP", top)).collect();
    passes.join("; ")
}

/// Options of nextpnr besides those that name files and device.
pub(super) fn placer() -> impl Iterator<Item = &'static str> {
    lines(PLACER).flat_map(str::split_whitespace)
}

/// Lines that say something.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_placeholders_are_gone() {
        let mapping = mapping("some_top");
        assert!(mapping.starts_with("hierarchy -top some_top; proc; "), "{mapping}");
        assert!(!mapping.contains("TOP") && !mapping.contains('#') && !mapping.contains('\n'), "{mapping}");
        assert!(placer().eq(["--placer", "static", "--tmg-ripup"]));
    }
}
