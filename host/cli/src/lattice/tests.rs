//! Tests of the lattice of a file.

use super::*;

fn table(points: &[[&str; 2]]) -> PointTable {
    let mut table = PointTable::of_rows([1, 2, 3]);
    for (index, point) in points.iter().enumerate() {
        table.push(point.map(str::as_bytes), index + 1).expect("numbers");
    }
    table
}

fn lattice(points: &[[&str; 2]]) -> Value {
    lay(&table(points), None).expect("finite numbers").to_json()
}

#[test]
fn the_first_lattice_that_fits_is_taken() {
    let lattice_of = |points: &[[&str; 2]]| {
        let found = lattice(points);
        (found["kind"].clone(), found["scale"].clone(), found["offset"].clone(), found["bits"].clone())
    };
    let whole = lattice_of(&[["-363", "4"], ["7.0", "5"]]);
    assert_eq!(whole, ("whole".into(), 1.into(), json!([-363, 4]), 9.into()));
    let decimal = lattice_of(&[["-101.473911", "33"], ["5", "0.1"]]);
    assert_eq!(decimal, ("decimal".into(), 1e-6.into(), json!([-101.473911, 0.1]), 27.into()));
    // So many digits are too long for steps of a power of ten, but the number is 2^-25.
    let binary = lattice_of(&[["0.0000000298023223876953125", "1"], ["0.5", "2"]]);
    assert_eq!(binary, ("binary".into(), 2f64.powi(-25).into(), json!([2f64.powi(-25), 1.0]), 26.into()));
    let doubles = lattice_of(&[["0.12345678901234567", "1e-5"], ["3", "2"]]);
    assert_eq!(doubles, ("doubles".into(), Value::Null, Value::Null, Value::Null));
    let wide = lattice_of(&[["9007199254740993", "0"], ["-4", "0"]]);
    assert_eq!(wide, ("whole".into(), 1.into(), json!([0, 0]), 54.into()));
}

#[test]
fn rounded_numbers_are_reported() {
    let rounded = |points: &[[&str; 2]]| {
        let table = table(points);
        let laid = lay(&table, None).expect("finite numbers");
        (laid.to_json()["kind"].clone(), laid.to_json()["rounded"].clone(), laid.line())
    };
    let line = |rounded: &str| {
        format!("lattice: none of up to 32 bits; exact on the nearest doubles ({rounded} rounded to them)")
    };
    // The nearest doubles of all these numbers are whole.
    let whole = [["1234567890123456789.5", "0"], ["1234567890123456790.5", "1"], ["1234567890123456791.5", "5"]];
    assert_eq!(rounded(&whole), ("doubles".into(), 3.into(), line("3 coordinates are")));
    // The nearest doubles of these are multiples of 2^-29.
    let binary = [["1234567.1234567891", "0"], ["1234567.1234567892", "5"], ["1234567", "7"]];
    assert_eq!(rounded(&binary), ("doubles".into(), 2.into(), line("2 coordinates are")));
    // A number too many makes all earlier ones doubles, exactly or not.
    let last = [["0.1", "0.5"], ["1e300", "1"]];
    assert_eq!(rounded(&last), ("doubles".into(), 2.into(), line("2 coordinates are")));
    let one = [["0.5", "0.25"], ["1e22", "0.1"]];
    assert_eq!(rounded(&one), ("doubles".into(), 1.into(), line("1 coordinate is")));
    // Doubles that are written out in full are those of the file, on a lattice or without one.
    let tenth = format!("{:.60}", 0.1);
    let near = [[tenth.as_str(), "0"], ["0.100000000000000033306690738754696212708950042724609375", "0"]];
    assert_eq!(rounded(&near).0, "binary");
    let far = [[tenth.as_str(), "0"], ["9007199254740992", "0"]];
    let plain = "lattice: none of up to 32 bits; exact on the doubles";
    assert_eq!(rounded(&far), ("doubles".into(), 0.into(), plain.to_owned()));
}

#[test]
fn wide_multiples_of_a_power_of_ten_have_long_steps() {
    let found = lattice(&[["0", "1000000000000"], ["-3000000000000", "5e12"]]);
    let offset = [-3_000_000_000_000i64, 1_000_000_000_000];
    let expected =
        json!({ "kind": "decimal", "scale": 1_000_000_000_000i64, "offset": offset, "bits": 3, "rounded": 0 });
    assert_eq!(found, expected);
    let set = table(&[["0", "0"], ["9000000000000000000", "0"]]);
    assert_eq!(lay(&set, None).expect("a lattice").line(), "lattice: decimals, steps of 1e18, 4 bits");
    // Whole numbers come first, and steps of ten may be too short.
    assert_eq!(lattice(&[["0", "0"], ["4000000000", "0"]])["kind"], "whole");
    let wide = lattice(&[["0", "10"], ["42949672960", "0"]]);
    assert_eq!((&wide["kind"], &wide["bits"]), (&"whole".into(), &36.into()));
    assert_eq!(lattice(&[["0", "10"], ["42949672950", "0"]])["scale"], 10);
}

#[test]
fn the_smallest_steps_have_a_length() {
    let mut table = PointTable::of_items("vertex");
    for point in [[5e-324, 0.0], [1.5e-323, 1e-323]] {
        table.push_doubles(point, 0).expect("finite numbers");
    }
    let found = lay(&table, None).expect("a lattice").to_json();
    assert_eq!((&found["kind"], &found["scale"]), (&"binary".into(), &5e-324.into()));
    assert_eq!(found["offset"], json!([5e-324, 0.0]));
    assert_eq!(lattice(&[["1e-323", "0"], ["5e-323", "2e-323"]])["scale"], 1e-323);
    // Shorter steps have no double as their length, so these decimals are rounded.
    assert_eq!(lattice(&[["1e-324", "0"], ["5e-324", "2e-324"]])["kind"], "doubles");
}

#[test]
fn a_set_that_is_quantised_needs_fewer_bits() {
    let table = table(&[["0", "0.5"], ["70000", "1"]]);
    let laid = lay(&table, Some((Quantize::Fit, 20))).expect("a grid of 20 bits");
    assert!(laid.check_bits(20, "model").is_ok());
    let failure = laid.check_bits(16, "serial").expect_err("20 bits");
    assert!(failure.message.ends_with("give --coord-bits 16"), "{failure}");
    assert!(!failure.message.contains("--quantize fit"), "{failure}");
}

#[test]
fn a_device_refuses_what_it_cannot_hold() {
    let table = table(&[["0", "0.5"], ["70000", "1"]]);
    let laid = lay(&table, None).expect("decimals");
    assert!(laid.check_bits(20, "model").is_ok());
    let failure = laid.check_bits(16, "clock").expect_err("20 bits");
    assert_eq!(failure.exit, Exit::Input);
    for part in ["20 bits", "clock", "16 bits", "--backend cpu", "--quantize"] {
        assert!(failure.message.contains(part), "{failure}");
    }
}
