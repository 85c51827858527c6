//! `incircle interpolate`: values of linear functions and at points, every format, and refusals.

use serde_json::Value;

use crate::common::Scratch;

/// Rows `x,y,value` below a header.
fn rows(text: &str) -> Vec<[f64; 3]> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,value"));
    let row = |line: &str| {
        let values: Vec<f64> = line.split(',').map(|value| value.parse().expect("a number")).collect();
        [values[0], values[1], values[2]]
    };
    lines.map(row).collect()
}

/// A scratch folder with points `x,y,z,depth`, where z is a linear function.
fn with_points() -> Scratch {
    let scratch = Scratch::new();
    let mut text = "x,y,z,depth\n".to_owned();
    for k in 0..60u32 {
        let (x, y) = (k * k * 7 % 101, k * 31 % 97);
        text.push_str(&format!("0.{x:03},-0.{y:03},{},{k}\n", 2 * i64::from(x) - i64::from(y)));
    }
    scratch.write("p.csv", text);
    scratch
}

#[test]
fn every_method_gives_linear_functions_and_the_values_of_points() {
    let scratch = with_points();
    scratch.write("q.csv", "0.0501,-0.0405\n0.05,-0.05\n9,9\n0.028,-0.062\n");
    for method in ["linear", "laplace", "sibson"] {
        scratch.run(&format!("interpolate p.csv --at q.csv -o v.csv --method {method} --quiet")).ok();
        let found = rows(&scratch.read("v.csv"));
        assert_eq!(found.len(), 4);
        assert!(found[2][2].is_nan() && found[2][..2] == [9.0, 9.0]);
        for [x, y, value] in [found[0], found[1], found[3]] {
            assert!((value - (2000.0 * x + 1000.0 * y)).abs() < 1e-9, "{method}: {x} {y} {value}");
        }
        // Point 2, with its depth.
        scratch.run(&format!("interpolate p.csv --value depth --at p.csv -o d.csv --method {method} --quiet")).ok();
        let depths: Vec<f64> = rows(&scratch.read("d.csv")).iter().map(|row| row[2]).collect();
        assert_eq!(depths[..3], [0.0, 1.0, 2.0]);
        scratch.run(&format!("interpolate p.csv --value 4 --at p.csv -o e.csv --method {method} --quiet")).ok();
        assert_eq!(scratch.read("d.csv"), scratch.read("e.csv"));
    }
    scratch.run("interpolate p.csv --at q.csv -o v.csv --outside nearest --quiet").ok();
    assert!(rows(&scratch.read("v.csv")).iter().all(|row| row[2].is_finite()));
}

#[test]
fn grids_have_all_multiples_of_the_step() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n-0.5,0,1\n3,0,8\n3,2.1,8\n-0.5,2.1,1\n");
    let run = scratch.run("interpolate p.csv --grid 0.5 -o g.asc").ok();
    assert!(run.stderr.contains("4 points, values at 40 places by linear, 0 without a value"), "{run:?}");
    let text = scratch.read("g.asc");
    let head = "ncols 8\nnrows 5\nxllcenter -0.5\nyllcenter 0\ncellsize 0.5\nNODATA_value -9999\n";
    assert!(text.starts_with(head), "{text}");
    let row = "1 2 3 4 5 6 7 8";
    assert_eq!(text[head.len()..].lines().collect::<Vec<_>>(), [row; 5]);
    scratch.run("interpolate p.csv --grid 0.5 -o g.csv --method sibson --threads 1 --quiet").ok();
    let found = rows(&scratch.read("g.csv"));
    assert_eq!((found.len(), found[0][..2].to_vec(), found[39][..2].to_vec()), (40, vec![-0.5, 0.0], vec![3.0, 2.0]));
    scratch.run("interpolate p.csv --grid 0.5 -o g.npy --quiet").ok();
    let bytes = scratch.bytes("g.npy");
    assert!(String::from_utf8_lossy(&bytes[..128]).contains("'shape': (5, 8"), "{bytes:?}");
    assert_eq!(bytes[128..136], 1f64.to_le_bytes());
    assert_eq!(bytes.len(), 128 + 40 * 8);
    // The quotient 0.3 / 0.1 of doubles is below 3.
    scratch.write("t.csv", "x,y,z\n0,0,0\n0.3,0,0.3\n0.3,0.7,0.7\n0,0.7,0\n");
    let run = scratch.run("interpolate t.csv --grid 0.1 -o g.csv").ok();
    assert!(run.stderr.contains("values at 32 places"), "{run:?}");
    let run = scratch.run("interpolate t.csv --contours 0.1 -o c.geojson").ok();
    assert!(run.stderr.contains("at 8 levels"), "{run:?}");
}

#[test]
fn contours_are_lines_of_equal_value() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0,0,0\n10,0,0\n10,10,0\n0,10,0\n5,5,10\n");
    let run = scratch.run("interpolate p.csv --contours 2.5 -o c.geojson").ok();
    assert!(run.stderr.contains("5 points, 3 contour lines at 5 levels"), "{run:?}");
    let json: Value = serde_json::from_str(&scratch.read("c.geojson")).expect("JSON");
    let features = json["features"].as_array().expect("features");
    let values: Vec<f64> = features.iter().filter_map(|it| it["properties"]["value"].as_f64()).collect();
    // All of the base counts as above 0, and the tip is a line without length.
    assert_eq!(values, [2.5, 5.0, 7.5]);
    for feature in &features[..3] {
        let line = feature["geometry"]["coordinates"].as_array().expect("a line");
        assert_eq!((line.len(), &line[0]), (5, &line[4]));
        let offset = feature["properties"]["value"].as_f64().expect("a level") / 2.0;
        for place in line {
            for coordinate in [&place[0], &place[1]] {
                let distance = (coordinate.as_f64().expect("a number") - 5.0).abs();
                assert!((distance - (5.0 - offset)).abs() < 1e-12, "{feature}");
            }
        }
    }
}

#[test]
fn reports_say_what_was_done() {
    let scratch = with_points();
    scratch.write("q.csv", "0.05,-0.05\n9,9\n");
    let run = scratch.run("interpolate p.csv --at q.csv -o v.npy --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("a report");
    assert_eq!((report["points"].as_u64(), report["places"].as_u64()), (Some(60), Some(2)));
    assert_eq!((report["without_value"].as_u64(), report["method"].as_str()), (Some(1), Some("linear")));
}

#[test]
fn wrong_input_is_one_sentence_and_no_file() {
    let scratch = with_points();
    scratch.write("line.csv", "x,y,z\n0,0,1\n1,1,2\n");
    scratch.write("gap.csv", "x,y,z\n0,0,1\n1,0,\n1,1,2\n");
    scratch.write("word.csv", "x,y,z\n0,0,1\n1,0,high\n1,1,2\n");
    scratch.write("flat.csv", "0,0\n1,0\n0,1\n");
    scratch.write("few.csv", "x,y,z\n1,1,1\n2,1,2\n1,2,3\n");
    scratch.write("flat.xyz", "0 0\n1 0\n0 1\n");
    scratch.write("some.geojson", "{\"type\":\"MultiPoint\",\"coordinates\":[[0,0,1],[1,0],[0,1,2]]}");
    let files = scratch.files();
    for (arguments, code, parts) in [
        ("gap.csv --grid 1 -o v.csv", 3, &["gap.csv: row 3, column 3: the value is missing"][..]),
        ("word.csv --grid 1 -o v.csv", 3, &["word.csv: row 3, column 3: 'high' is not a number"]),
        ("flat.csv --grid 1 -o v.csv", 3, &["flat.csv: the points have no values", "--value"]),
        (
            "some.geojson --grid 1 -o v.csv",
            3,
            &["some.geojson: z is left out: point 2 has none, but every point needs"],
        ),
        ("p.csv --value width --grid 1 -o v.csv", 3, &["p.csv: there is no column 'width'"]),
        ("p.csv --value 9 --grid 1 -o v.csv", 3, &["there is no column '9'", "a number from 1 to 4"]),
        ("line.csv --grid 1 -o v.csv", 3, &["line.csv: there is no triangle between the points"]),
        ("p.csv --grid 0 -o v.csv", 3, &["--grid '0' is zero: give a positive step, such as 0.5"]),
        ("p.csv --grid -1 -o v.csv", 3, &["--grid '-1' is negative: give a positive step"]),
        ("p.csv --grid wide -o v.csv", 3, &["--grid 'wide' is not a number: give a positive step"]),
        ("p.csv --grid 1e19 -o v.csv", 3, &["--grid '1e19' needs more than 64 bits: give a step"]),
        ("p.csv --grid inf -o v.csv", 3, &["--grid 'inf' is not finite"]),
        (
            "p.csv --grid 0.0000000001 -o v.csv",
            3,
            &["--grid '0.0000000001' gives 990000001 by 960000001 nodes", "MiB of free memory: give a larger step"],
        ),
        ("p.csv --grid 1e-18 -o v.csv", 3, &["--grid '1e-18' is too small for the points, which lie up to 9.900e16"]),
        ("p.csv --contours 0 -o v.geojson", 3, &["--contours '0' is zero: give a positive step, such as 10"]),
        ("p.csv --contours 0.001 -o v.geojson", 3, &["gives 234001 levels, more than 10000: give a larger step"]),
        ("p.csv --contours 1e-15 -o v.geojson", 3, &["--contours '1e-15' is too small for the values, which lie up"]),
        ("few.csv --grid 7 -o v.asc", 3, &["the grid has no node", "smaller --grid"]),
        ("p.csv --contours 1 -o v.csv", 2, &["contours are written as GeoJSON"]),
        ("p.csv --at none.csv -o v.csv", 3, &["none.csv"]),
        ("p.csv --at flat.csv -o v.asc", 2, &["an ASCII grid has the values of a grid"]),
        ("p.csv --at flat.csv -o v.txt", 2, &["the name tells no format of values"]),
        ("flat.xyz --value z --grid 1 -o v.csv", 2, &["--value names a column of CSV"]),
    ] {
        scratch.run(&format!("interpolate {arguments}")).fails(code, parts);
        assert_eq!(scratch.files(), files, "{arguments}");
    }
    assert_eq!(scratch.run("interpolate p.csv -o v.csv").code, Some(2));
}

#[test]
fn a_geotiff_has_the_rows_of_the_grid_and_its_place() {
    use tiff::decoder::{Decoder, DecodingResult};
    use tiff::tags::Tag;
    let scratch = Scratch::new();
    // A triangle, so that nodes beyond its long side have no value.
    scratch.write("p.csv", "x,y,z\n-0.3,0.1,1\n0.5,0.1,5\n-0.3,0.5,9\n");
    scratch.run("interpolate p.csv --grid 0.1 -o g.tif --quiet").ok();
    scratch.run("interpolate p.csv --grid 0.1 -o g.csv --quiet").ok();
    let file = std::io::Cursor::new(scratch.bytes("g.tif"));
    let mut decoder = Decoder::new(file).expect("a TIFF");
    assert_eq!(decoder.dimensions().expect("sides"), (9, 5));
    assert_eq!(decoder.get_tag_f64_vec(Tag::ModelPixelScaleTag).expect("the step"), [0.1, 0.1, 0.0]);
    let place = decoder.get_tag_f64_vec(Tag::ModelTiepointTag).expect("the place");
    assert_eq!(place, [0.0, 0.0, 0.0, -0.3, 0.5, 0.0]);
    let keys = decoder.get_tag_u16_vec(Tag::GeoKeyDirectoryTag).expect("the keys");
    assert_eq!(keys, [1, 1, 0, 1, 1025, 0, 1, 2]);
    assert_eq!(decoder.get_tag_ascii_string(Tag::GdalNodata).expect("the missing value"), "nan");
    let DecodingResult::F64(values) = decoder.read_image().expect("values") else { panic!("not doubles") };
    let expected: Vec<f64> = rows(&scratch.read("g.csv")).iter().map(|row| row[2]).collect();
    let from_top: Vec<f64> = expected.chunks(9).rev().flatten().copied().collect();
    assert!(values.iter().zip(&from_top).all(|(a, b)| a == b || a.is_nan() && b.is_nan()), "{values:?}");
    assert!(values[8].is_nan() && values[0] == 9.0 && values[36] == 1.0);
    let files = scratch.files();
    scratch.run("interpolate p.csv --grid 7 -o h.tif").fails(3, &["the grid has no node", "smaller --grid"]);
    scratch.run("interpolate p.csv --at p.csv -o h.tiff").fails(2, &["a GeoTIFF has the values of a grid"]);
    assert_eq!(scratch.files(), files);
}

#[test]
fn no_value_of_an_ascii_grid_stands_for_a_missing_one() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0,0,-9999\n2,0,1\n0,2,-99999\n");
    scratch.run("interpolate p.csv --grid 1 -o g.asc --quiet").ok();
    let text = scratch.read("g.asc");
    let rows: Vec<&str> = text.lines().skip(5).collect();
    let expected = ["NODATA_value -999999", "-99999 -999999 -999999", "-54999 -49999 -999999", "-9999 -4999 1"];
    assert_eq!(rows, expected);
}

#[test]
fn means_of_the_largest_values_are_numbers() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0,0,-1.7e308\n4,0,1.7e308\n0,4,1.7e308\n4,4,-1.7e308\n1,2,1.7e308\n");
    for method in ["linear", "laplace", "sibson"] {
        scratch.run(&format!("interpolate p.csv --grid 0.5 -o v.csv --method {method} --quiet")).ok();
        let found = rows(&scratch.read("v.csv"));
        assert_eq!(found.len(), 81);
        assert!(found.iter().all(|row| row[2].abs() <= 1.7e308), "{method}: {found:?}");
    }
}

/// Grids have the values that the same places have in a file, in every kind of numbers.
#[test]
fn nodes_of_a_grid_are_places_like_others() {
    let scratch = Scratch::new();
    for (points, step) in [
        ("0,0,1\n300,7,5\n13,200,9\n-40,90,2\n", "3"),
        ("0.1,0.2,1\n30.7,7.25,5\n1.3,20,9\n-4,9.5,2\n", "0.37"),
        ("0.1234567890123,0.2,1\n30.7,7.25,5\n1e-17,20,9\n-4,9.5,2\n", "0.5"),
        ("0,5000000000,1\n7000000000,0,3\n6,8000000001,5\n", "333333333"),
    ] {
        scratch.write("p.csv", format!("x,y,z\n{points}"));
        scratch.run(&format!("interpolate p.csv --grid {step} -o g.csv --method sibson --quiet")).ok();
        let grid = scratch.read("g.csv");
        let places: Vec<&str> = grid.lines().skip(1).filter_map(|row| Some(row.rsplit_once(',')?.0)).collect();
        assert!(places.len() > 300, "{points}");
        scratch.write("q.csv", places.join("\n"));
        scratch.run("interpolate p.csv --at q.csv -o v.csv --method sibson --quiet").ok();
        assert_eq!(scratch.read("v.csv"), grid, "{points}");
    }
}

#[test]
fn a_geotiff_of_many_strips_keeps_its_rows() {
    use tiff::decoder::{Decoder, DecodingResult};
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0,0,0\n999,0,999\n0,499,499000\n999,499,499999\n");
    scratch.run("interpolate p.csv --grid 1 -o g.tif --quiet").ok();
    let mut decoder = Decoder::new(std::io::Cursor::new(scratch.bytes("g.tif"))).expect("a TIFF");
    let DecodingResult::F64(values) = decoder.read_image().expect("values") else { panic!("not doubles") };
    assert_eq!(values.len(), 500_000);
    let wrong = (0..values.len()).find(|&k| (values[k] - (k % 1000 + (499 - k / 1000) * 1000) as f64).abs() > 1e-6);
    assert_eq!(wrong, None);
}

#[test]
fn devices_with_meshes_that_live_give_the_bytes_of_the_processor() {
    let scratch = Scratch::new();
    let mut text = "x,y,z\n".to_owned();
    for k in 0..300u32 {
        // Whole numbers with duplicates and points on lines.
        text.push_str(&format!("{},{},{}\n", k * k % 37, k * 7 % 31, k % 11));
    }
    scratch.write("p.csv", text);
    scratch.run("interpolate p.csv --grid 0.5 -o cpu.csv --quiet").ok();
    for device in ["model", "clock"] {
        scratch.run(&format!("interpolate p.csv --grid 0.5 -o {device}.csv --backend {device} --quiet")).ok();
        assert_eq!(scratch.read(&format!("{device}.csv")), scratch.read("cpu.csv"));
    }
    scratch.run("interpolate p.csv --grid 0.5 -o one.csv --backend cpu --quiet").ok();
    assert_eq!(scratch.read("one.csv"), scratch.read("cpu.csv"));
    scratch.write("wide.csv", "x,y,z\n0,0,1\n1,4000000000,2\n7,9,3\n");
    scratch.write("line.csv", "x,y,z\n0,0,1\n1,1,2\n7,7,3\n");
    let files = scratch.files();
    for (arguments, code, part) in [
        ("p.csv --grid 1 --method sibson --backend model", 2, "a device gives linear values at places"),
        ("p.csv --grid 1 --outside nearest --backend model", 2, "leave out --backend"),
        ("wide.csv --at p.csv --backend model", 3, "give --backend cpu"),
        ("line.csv --at p.csv --backend model", 3, "there is no triangle between the points"),
        (
            "p.csv --at p.csv --backend clock?config=dual",
            2,
            "cannot keep a mesh that lives: use the back end model or clock",
        ),
    ] {
        scratch.run(&format!("interpolate {arguments} -o x.csv")).fails(code, &[part]);
        assert_eq!(scratch.files(), files, "{arguments}");
    }
}
