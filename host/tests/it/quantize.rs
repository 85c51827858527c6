//! Quantisation: which values are taken as they are, which are moved, and which are refused.

use incircle::quantize::{integers, quantize, Quantization, Quantize};
use incircle::{Error, ErrorKind, Point};
use proptest::prelude::*;

#[test]
fn integers_of_the_grid_are_untouched() {
    let points = integers(&[[0.0, 65535.0], [-0.0, 7.0]], 16).expect("integers");
    assert_eq!(points, [Point::new(0, 65535), Point::new(0, 7)]);
    let wide = integers(&[[2_147_483_647.0, 0.0]], 31).expect("31 bits");
    assert_eq!(wide, [Point::new((1 << 31) - 1, 0)]);
    assert_eq!(integers(&[], 16).expect("nothing"), []);
}

#[test]
fn what_is_no_grid_integer_is_named() {
    let error = integers(&[[1.0, 2.0], [70_000.0, 1.0], [3.0, 0.5]], 16).expect_err("a fraction");
    assert!(matches!(error, Error::NotInteger { index: 2, axis: 'y', value } if value == 0.5));
    let error = integers(&[[1.0, 2.0], [70_000.0, 1.0]], 16).expect_err("too large");
    assert!(matches!(error, Error::OutOfGrid { index: 1, axis: 'x', coord_bits: 16, .. }));
    let error = integers(&[[1.0, -1.0]], 16).expect_err("negative");
    assert_eq!(
        error.to_string(),
        "the y of point 0 is -1, outside the grid of 16 bits, 0 to 65535: \
         quantise the points or use more coordinate bits"
    );
    let error = integers(&[[1e300, 0.0]], 31).expect_err("huge");
    assert_eq!(error.kind(), ErrorKind::BadInput);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for how in [Quantize::Fit, Quantize::Scale { scale: 1.0, offset: [0.0; 2] }] {
            let error = quantize(&[[0.5, 0.0], [0.0, value]], 16, how).expect_err("not finite");
            assert!(matches!(error, Error::NotFinite { index: 1, axis: 'y', .. }), "{error}");
        }
        assert!(matches!(integers(&[[value, 0.0]], 16), Err(Error::NotFinite { index: 0, axis: 'x', .. })));
    }
    for bits in [0, 32, u32::MAX] {
        assert!(matches!(integers(&[], bits), Err(Error::CoordBits(_))));
        assert!(matches!(quantize(&[], bits, Quantize::Fit), Err(Error::CoordBits(_))));
    }
}

#[test]
fn halves_round_to_even() {
    let how = Quantize::Scale { scale: 1.0, offset: [0.0, 0.0] };
    let (points, report) = quantize(&[[0.5, 1.5], [2.5, 3.5]], 16, how).expect("on the grid");
    assert_eq!(points, [Point::new(0, 2), Point::new(2, 4)]);
    assert_eq!((report.largest_error, report.merged), (0.5, 0));
}

#[test]
fn points_that_fall_together_are_counted() {
    let how = Quantize::Scale { scale: 1.0, offset: [0.0, 0.0] };
    // Four distinct points fall onto one grid point. One of them is given twice, with both signs of zero.
    let values = [[0.1, 0.0], [0.2, 0.0], [0.1, -0.0], [0.0, 0.3], [0.3, 0.3], [5.0, 5.0]];
    let (_, report) = quantize(&values, 16, how).expect("on the grid");
    assert_eq!(report.merged, 3);
}

#[test]
fn a_fitted_box_keeps_its_aspect() {
    let (points, report) = quantize(&[[-10.0, 5.0], [10.0, 5.0], [0.0, 10.0]], 8, Quantize::Fit).expect("fits");
    assert_eq!(points[0], Point::new(0, 0));
    assert_eq!(points[1], Point::new(255, 0));
    assert_eq!(points[2], Point::new(128, 64));
    assert_eq!(report.offset, [-10.0, 5.0]);
    assert_eq!(report.coord_bits, 8);
}

#[test]
fn a_single_place_keeps_scale_one() {
    let (points, report) = quantize(&[[1e9, -3.25]; 3], 16, Quantize::Fit).expect("one place");
    assert_eq!(points, [Point::new(0, 0); 3]);
    assert_eq!((report.scale, report.largest_error, report.merged), (1.0, 0.0, 0));
    assert!(quantize(&[], 16, Quantize::Fit).expect("nothing").0.is_empty());
}

#[test]
fn boxes_without_a_scale_are_refused() {
    for extent in [f64::MAX, f64::MIN_POSITIVE / 2.0] {
        let error = quantize(&[[-extent, 0.0], [extent, 0.0]], 16, Quantize::Fit).expect_err("no scale");
        assert!(matches!(error, Error::Extent { .. }), "{error}");
    }
    for (scale, offset) in [(0.0, 0.0), (-1.0, 0.0), (f64::NAN, 0.0), (f64::INFINITY, 0.0), (1.0, f64::NAN)] {
        let how = Quantize::Scale { scale, offset: [offset, 0.0] };
        assert!(matches!(quantize(&[], 16, how), Err(Error::Scale { .. })));
    }
}

#[test]
fn a_given_scale_does_not_clip() {
    let how = Quantize::Scale { scale: 100.0, offset: [-1.0, -1.0] };
    let error = quantize(&[[0.0, 0.0], [1.56, 0.0]], 8, how).expect_err("outside");
    assert!(matches!(error, Error::OutOfGrid { index: 1, axis: 'x', value, .. } if value == 256.0), "{error}");
    let error = quantize(&[[0.0, 1e300]], 8, Quantize::Scale { scale: 1e10, offset: [0.0; 2] });
    assert!(matches!(error, Err(Error::OutOfGrid { index: 0, axis: 'y', .. })));
}

/// Half a grid step, plus the error of the arithmetic itself.
fn tolerance(report: &Quantization, values: &[[f64; 2]]) -> f64 {
    let largest = values.as_flattened().iter().fold(0.0f64, |most, value| most.max(value.abs()));
    0.5 / report.scale * (1.0 + 1e-6) + largest * 1e-14
}

proptest! {
    #[test]
    fn fitting_fills_the_grid_within_half_a_step(
        values in prop::collection::vec((-1e6..1e6, -1e3..1e3), 2..200),
        bits in 1u32..32,
    ) {
        let values: Vec<[f64; 2]> = values.into_iter().map(|(x, y)| [x, y]).collect();
        let (points, report) = quantize(&values, bits, Quantize::Fit).expect("fits");
        let max = ((1u64 << bits) - 1) as u32;
        prop_assert!(points.iter().all(|p| p.x <= max && p.y <= max));
        prop_assert_eq!(points.iter().map(|p| p.x).min(), Some(0));
        prop_assert_eq!(points.iter().map(|p| p.x.max(p.y)).max(), Some(max));
        prop_assert!(report.largest_error <= tolerance(&report, &values));
        let distinct = |mut all: Vec<[u64; 2]>| {
            all.sort_unstable();
            all.dedup();
            all.len()
        };
        let inputs = distinct(values.iter().map(|v| v.map(f64::to_bits)).collect());
        let places = distinct(points.iter().map(|p| [p.x.into(), p.y.into()]).collect());
        prop_assert_eq!(report.merged, inputs - places);
    }
}
