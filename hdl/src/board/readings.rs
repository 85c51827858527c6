//! Reads the figures in the reports of the tools.

use super::error::BoardError;
use super::json;
use super::report::Cells;
use serde_json::Value;
use std::path::Path;

/// A limit that no device reaches, in MHz; a figure above it is no measurement.
const MOST_MHZ: f64 = 1e5;

/// The cells that synthesis counts.
pub(super) const COUNTED: [&str; 6] = ["LUT4", "CCU2C", "TRELLIS_DPR16X4", "TRELLIS_FF", "MULT18X18D", "DP16KD"];

/// The counts in the file that synthesis wrote: of the core alone, and of the whole design.
pub(super) fn counts(path: &Path) -> Result<(Cells, Cells), BoardError> {
    let text = std::fs::read_to_string(path).map_err(BoardError::file(path))?;
    counts_of(&text).map_err(|reason| BoardError::form(path, reason))
}

/// The counts in a text that has, for each of [`COUNTED`], a line with all cells and a line with those of the core.
fn counts_of(text: &str) -> Result<(Cells, Cells), String> {
    // No device has more cells than fit in 32 bits.
    let count = |line: &str| line.strip_suffix(" objects.")?.trim().parse::<u32>().ok();
    let counts: Vec<u64> = text.lines().filter_map(count).map(u64::from).collect();
    // For each kind of cell all, then those of the core.
    let [luts, carries, memories, ffs, dsps, ebrs] = match counts.as_chunks::<2>() {
        (pairs, []) if pairs.len() == 6 => [0, 1, 2, 3, 4, 5].map(|kind| pairs[kind]),
        _ => {
            return Err(format!("it holds {} counts, not {}", counts.len(), 2 * COUNTED.len()));
        }
    };
    // A carry cell takes two look-up tables, and a distributed memory keeps its bits in two.
    let lut = |luts: u64, carries: u64, memories: u64| luts + 2 * carries + 2 * memories;
    let cells = |side: usize| Cells {
        lut: lut(luts[side], carries[side], memories[side]),
        ff: ffs[side],
        dsp: dsps[side],
        ebr: ebrs[side],
    };
    let (all, core) = (cells(0), cells(1));
    if !core.is_within(all) {
        return Err(format!("the core has more cells than there are: {core:?}, {all:?}"));
    }
    Ok((core, all))
}

/// The highest frequencies of a board in MHz: of the core's clock, and of the clock of the Ethernet port if `port`
/// gives the name of its pin and its constraint.
pub(super) fn fmax(path: &Path, clock_mhz: u32, port: Option<(&str, u32)>) -> Result<(f64, Option<f64>), BoardError> {
    fmax_of(&json::read(path)?, clock_mhz, port).map_err(|reason| BoardError::form(path, reason))
}

/// The highest frequencies in a report, whose constraints must be those that were asked for: nextpnr derives them from
/// the pins and the PLL.
fn fmax_of(report: &Value, clock_mhz: u32, port: Option<(&str, u32)>) -> Result<(f64, Option<f64>), String> {
    let clocks = report.get("fmax").and_then(Value::as_object).ok_or("it has no fmax")?;
    let (ports, cores): (Vec<_>, Vec<_>) =
        clocks.iter().partition(|(name, _)| port.is_some_and(|(pin, _)| name.contains(pin)));
    let of_port = match (port, ports.as_slice()) {
        (None, _) => None,
        (Some((_, mhz)), [(_, clock)]) => Some(achieved(clock, mhz)?),
        (Some((pin, _)), _) => return Err(format!("the Ethernet port has one clock, and it names none of pin {pin}")),
    };
    let [(_, clock)] = cores.as_slice() else {
        return Err("a core has one clock, and it does not name one".into());
    };
    Ok((achieved(clock, clock_mhz)?, of_port))
}

/// The frequency that a clock reaches, whose constraint must be `clock_mhz`.
fn achieved(clock: &Value, clock_mhz: u32) -> Result<f64, String> {
    let number = |key: &str| clock.get(key).and_then(Value::as_f64);
    let constraint = number("constraint").ok_or("its clock has no constraint")?;
    // nextpnr counts in whole picoseconds, so the constraint differs a little.
    if (constraint / f64::from(clock_mhz) - 1.0).abs() > 1e-3 {
        return Err(format!("the clock is to be {clock_mhz} MHz, and is {constraint} MHz"));
    }
    let achieved = number("achieved").ok_or("its clock has no achieved frequency")?;
    if !(achieved > 0.0 && achieved < MOST_MHZ) {
        return Err(format!("its clock achieves {achieved:e} MHz, which is no measurement"));
    }
    Ok(achieved)
}

/// Cells used after placement, and cells that the device has.
pub(super) fn cells(path: &Path) -> Result<(Cells, Cells), BoardError> {
    cells_of(&json::read(path)?).ok_or_else(|| BoardError::form(path, "it does not say what is used"))
}

fn cells_of(report: &Value) -> Option<(Cells, Cells)> {
    let cells = |of: &str| {
        let count = |cell: &str| report.pointer(&format!("/utilization/{cell}/{of}"))?.as_u64();
        Some(Cells {
            lut: count("TRELLIS_COMB")?,
            ff: count("TRELLIS_FF")?,
            dsp: count("MULT18X18D")?,
            ebr: count("DP16KD")?,
        })
    };
    cells("used").zip(cells("available")).filter(|(used, available)| used.is_within(*available))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn counts_are_told_apart() {
        let lines = [10, 9, 4, 3, 2, 1, 50, 40, 20, 20, 31, 27].map(|count| format!("{count} objects.\n"));
        let (core, all) = counts_of(&lines.concat()).unwrap();
        assert_eq!(core, Cells { lut: 9 + 6 + 2, ff: 40, dsp: 20, ebr: 27 });
        assert_eq!(all, Cells { lut: 10 + 8 + 4, ff: 50, dsp: 20, ebr: 31 });
        assert_eq!(counts_of(&lines[1..].concat()).unwrap_err(), "it holds 11 counts, not 12");
    }

    #[test]
    fn the_clock_is_the_one_that_was_meant() {
        let clock = json!({"achieved": 89.3, "constraint": 60.002});
        assert_eq!(fmax_of(&json!({"fmax": {"clock": clock}}), 60, None), Ok((89.3, None)));
        assert!(fmax_of(&json!({"fmax": {"clock": clock}}), 65, None).unwrap_err().contains("is to be 65 MHz"));
        assert!(fmax_of(&json!({"fmax": {"a": clock, "b": clock}}), 60, None).unwrap_err().contains("one clock"));
        assert!(fmax_of(&json!({"fmax": {}}), 60, None).is_err());
        assert!(fmax_of(&json!({}), 60, None).is_err());
    }

    #[test]
    fn the_clock_of_the_port_is_told_apart_by_its_pin() {
        let (core, phy) =
            (json!({"achieved": 130.5, "constraint": 125.0}), json!({"achieved": 140.25, "constraint": 125.0}));
        let both = json!({"fmax": {"$glbnet$clock": core, "$glbnet$rx_pin$TRELLIS_IO_IN": phy}});
        assert_eq!(fmax_of(&both, 125, Some(("rx_pin", 125))), Ok((130.5, Some(140.25))));
        assert!(fmax_of(&both, 125, None).unwrap_err().contains("one clock"));
        assert!(fmax_of(&both, 125, Some(("rx_pin", 120))).unwrap_err().contains("is to be 120 MHz"));
        let alone = json!({"fmax": {"$glbnet$clock": core}});
        assert!(fmax_of(&alone, 125, Some(("rx_pin", 125))).unwrap_err().contains("names none of pin rx_pin"));
    }

    #[test]
    fn cells_are_read() {
        let count = |used: u64| json!({"used": used, "available": 100});
        let report = json!({"utilization": {
            "TRELLIS_COMB": count(1), "TRELLIS_FF": count(2), "MULT18X18D": count(3), "DP16KD": count(4)
        }});
        let (used, available) = cells_of(&report).unwrap();
        assert_eq!(used, Cells { lut: 1, ff: 2, dsp: 3, ebr: 4 });
        assert_eq!(available, Cells { lut: 100, ff: 100, dsp: 100, ebr: 100 });
        assert_eq!(cells_of(&json!({"utilization": {}})), None);
    }
}
