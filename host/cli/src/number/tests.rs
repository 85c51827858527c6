//! Tests of numbers as they are written in a text.

use super::*;
use incircle_testkit::SplitMix64;

fn decimal(text: &str) -> Option<(i64, u32)> {
    match parse(text.as_bytes()) {
        Some(Number::Decimal(Decimal { steps, digits })) => Some((steps, digits)),
        _ => None,
    }
}

#[test]
fn decimals_are_read_as_written() {
    for (text, expected) in [
        ("0", (0, 0)),
        ("-0.000", (0, 0)),
        ("-363", (-363, 0)),
        ("+7", (7, 0)),
        ("-101.473911", (-101_473_911, 6)),
        ("1.50", (15, 1)),
        (".5", (5, 1)),
        ("5.", (5, 0)),
        ("2.5e3", (2500, 0)),
        ("25E-4", (25, 4)),
        ("10e-4", (1, 3)),
        ("1e-300", (1, 300)),
        ("0e999999999999", (0, 0)),
        ("9223372036854775807", (i64::MAX, 0)),
        ("-9223372036854775808", (i64::MIN, 0)),
        ("000000000000000000000000012.5000000000000000000000000", (125, 1)),
    ] {
        assert_eq!(decimal(text), Some(expected), "{text}");
    }
}

#[test]
fn other_numbers_are_the_nearest_doubles() {
    let double = |value, is_exact| Some(Number::Double(Nearest { value, is_exact }));
    let beyond = |value, is_exact| Some(Number::Beyond(Nearest { value, is_exact }));
    assert_eq!(parse(b"1e300"), double(1e300, false));
    assert_eq!(parse(b"0.12345678901234567890123"), double(0.123_456_789_012_345_68, false));
    assert_eq!(parse(b"9223372036854775808"), beyond(9.223_372_036_854_776e18, true));
    assert_eq!(parse(b"9223372036854775809"), beyond(9.223_372_036_854_776e18, false));
    assert_eq!(parse(b"1e-999"), double(0.0, false));
    let value = |text: &[u8]| parse(text).map_or(0.0, |number| number.nearest().value);
    assert!(value(b"-inf").is_infinite() && value(b"nan").is_nan());
    for bad in ["", "-", "+", ".", "1,5", "0x10", "1e", "--1", "1.2.3", "1_000", "e5", " 1"] {
        assert_eq!(parse(bad.as_bytes()), None, "{bad}");
    }
}

#[test]
fn the_standard_library_reads_the_same_numbers() {
    let mut random = SplitMix64::new(7);
    let alphabet = b"0123456789.-+eE0019.";
    for _ in 0..200_000 {
        let len = 1 + random.below(24) as usize;
        let text: Vec<u8> = (0..len).map(|_| alphabet[random.below(alphabet.len() as u64) as usize]).collect();
        let library = std::str::from_utf8(&text).expect("ASCII").parse::<f64>().ok();
        let own = parse(&text).map(|number| match number {
            Number::Decimal(Decimal { steps, digits }) => nearest(i128::from(steps), digits),
            Number::Beyond(nearest) | Number::Double(nearest) => nearest.value,
        });
        // Minus zero is read as zero.
        assert_eq!(
            own.map(|value| value + 0.0),
            library.map(|value| value + 0.0),
            "{}",
            String::from_utf8_lossy(&text)
        );
    }
}

#[test]
fn numbers_are_told_from_their_nearest_doubles() {
    let is_exact = |text: &str| parse(text.as_bytes()).expect("a number").nearest().is_exact;
    let mut random = SplitMix64::new(9);
    for _ in 0..300 {
        let value = f64::from_bits(random.next_u64());
        let value = if value.is_finite() { value } else { 0.5 };
        for value in [value, (random.below(1 << 20) as f64 - 524_288.0) / 8192.0, value.trunc()] {
            let text = format!("{value:.1100}");
            assert!(is_exact(&text), "{value:e}");
            assert!(is_exact(&format!("{value:.770e}")), "{value:e}");
            // One more digit behind the last one.
            assert!(!is_exact(&format!("{text}1")), "{value:e}");
        }
    }
    for text in ["0", "-0.0", "0.5", "9007199254740992", "9007199254740994", "-9223372036854775808", "1e20", "1e22"] {
        assert!(is_exact(text), "{text}");
    }
    for text in ["0.1", "9007199254740993", "9007199254740992.5", "1e23", "9223372036854775807", "1e-20"] {
        assert!(!is_exact(text), "{text}");
    }
    assert!(is_double(5i128.pow(50), 50) && !is_double(5i128.pow(50) + 5, 50) && !is_double(7, 300));
}

#[test]
fn coordinates_are_compared_exactly() {
    let with = |coordinate, steps, digits| compare(coordinate, Decimal { steps, digits });
    // The double 0.1 is a little more than the decimal, and 0.3 a little less.
    assert_eq!(with(Coordinate::Double(0.1), 1, 1), Ordering::Greater);
    assert_eq!(with(Coordinate::Double(0.3), 3, 1), Ordering::Less);
    assert_eq!(with(Coordinate::Double(-0.3), -3, 1), Ordering::Greater);
    assert_eq!(with(Coordinate::Double(0.5), 5, 1), Ordering::Equal);
    assert_eq!(with(Coordinate::Double(0.0), 0, 0), Ordering::Equal);
    assert_eq!(with(Coordinate::Double(5e-324), 1, 18), Ordering::Less);
    assert_eq!(with(Coordinate::Double(9_223_372_036_854_775_808.0), i64::MAX, 0), Ordering::Greater);
    assert_eq!(with(Coordinate::Double(1e300), i64::MAX, 0), Ordering::Greater);
    assert_eq!(with(Coordinate::Decimal { steps: 15, digits: 1 }, 150, 2), Ordering::Equal);
    assert_eq!(with(Coordinate::Decimal { steps: i128::MIN, digits: 0 }, i64::MIN, 18), Ordering::Less);
}

#[test]
fn coordinates_are_shown_exactly() {
    let shown = |steps, digits| Coordinate::Decimal { steps, digits }.to_string();
    assert_eq!(shown(-101_473_911, 6), "-101.473911");
    assert_eq!(shown(-5, 1), "-0.5");
    assert_eq!(shown(1_050, 3), "1.05");
    assert_eq!(shown(2_000, 3), "2");
    assert_eq!(shown(9_007_199_254_740_993, 0), "9007199254740993");
    assert_eq!(shown(12, 300), "12e-300");
    assert_eq!(Coordinate::Double(0.1).to_string(), "0.1");
    assert_eq!(Coordinate::Double(1e300).to_string(), "1e300");
}
