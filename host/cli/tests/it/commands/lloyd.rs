//! `incircle lloyd`: places on fine lattices, any threads, and refusals.

use serde_json::Value;

use crate::common::Scratch;

#[test]
fn two_points_end_in_the_middles_of_halves() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n1,0\n");
    let run = scratch.run("lloyd p.csv -o q.csv --until-still --clip 0,0,1,3 --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("a report");
    assert_eq!((report["end"].as_str(), report["moved"].as_u64()), (Some("still"), Some(0)));
    assert_eq!(scratch.read("q.csv"), "0.25,1.5\n0.75,1.5\n");
    // A number of steps ends when nothing moves any more, with the same places.
    let steps = report["iterations"].as_u64().expect("steps");
    let run = scratch.run("lloyd p.csv -o r.csv --iterations 1000000 --clip 0,0,1,3").ok();
    assert!(run.stderr.contains(&format!("{steps} steps, 0 moved in the last; ended by: still in step {steps};")));
    assert_eq!(scratch.read("r.csv"), scratch.read("q.csv"));
    // Steps of a tenth become finer by powers of two.
    scratch.write("t.csv", "-0.1,0.2\n0.1,0.2\n");
    scratch.run("lloyd t.csv -o q.csv --iterations 1 --clip=-0.1,0,0.1,0.4 --quiet").ok();
    assert_eq!(scratch.read("q.csv"), "-0.05,0.2\n0.05,0.2\n");
}

#[test]
fn threads_orders_and_formats_change_nothing() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 9000 --bits 16 --seed 3 -o p.csv").ok();
    for (name, threads) in [("one", 1), ("three", 3)] {
        scratch.run(&format!("lloyd p.csv -o {name}.csv --iterations 3 --threads {threads} --quiet")).ok();
    }
    let one = scratch.read("one.csv");
    assert_eq!(one, scratch.read("three.csv"));
    let reversed: Vec<String> = scratch.read("p.csv").lines().rev().map(str::to_owned).collect();
    scratch.write("r.csv", reversed.join("\n"));
    scratch.run("lloyd r.csv -o r-out.csv --iterations 3 --quiet").ok();
    let back: Vec<String> = scratch.read("r-out.csv").lines().rev().map(str::to_owned).collect();
    assert_eq!(back, one.lines().collect::<Vec<_>>());
    assert_ne!(one, scratch.read("p.csv"));
    scratch.run("lloyd p.csv -o q.npy --iterations 1 --quantize fit --quiet").ok();
    assert_eq!(scratch.bytes("q.npy").len(), 128 + 9000 * 16);
}

#[test]
fn points_gather_in_the_dark_of_an_image() {
    let scratch = Scratch::new();
    // Dark on the upper left.
    scratch.write("i.pgm", "P2 2 2 100\n0 98 98 98\n");
    scratch.run("generate uniform -n 60 --bits 12 --seed 7 -o few.csv").ok();
    let run = "lloyd few.csv -o end.csv --clip 0,0,4096,4096 --iterations 300 --density i.pgm --json";
    let report: Value = serde_json::from_str(&scratch.run(run).ok().stdout).expect("a report");
    assert_eq!((report["density"]["columns"].as_u64(), report["density"]["rows"].as_u64()), (Some(2), Some(2)));
    let is_in = |line: &&str| {
        let mut numbers = line.split(',').map(|number| number.parse::<f64>().expect("a number"));
        numbers.next() < Some(2048.0) && numbers.next() > Some(2048.0)
    };
    let gathered = scratch.read("end.csv").lines().filter(is_in).count();
    // Spread evenly it would be 15. Steps are slow to gather points: in the end it would be 42.
    assert!(gathered > 20, "{gathered} of 60");
    scratch.run("generate uniform -n 4500 --bits 12 --seed 7 -o p.csv").ok();
    let region = "--clip 0,0,4096,4096 --iterations 3";
    scratch.run(&format!("lloyd p.csv -o q.csv {region} --density i.pgm --quiet")).ok();
    let places = scratch.read("q.csv");
    let run = scratch.run(&format!("lloyd p.csv -o r.csv {region} --density i.pgm --threads 1")).ok();
    assert!(run.stderr.contains("density: an image of 2 by 2 pixels"), "{run:?}");
    assert_eq!(scratch.read("r.csv"), places);
    // The same picture as a PNG of 16 bits, with other bytes but the same weights.
    let mut encoder = png::Encoder::new(std::fs::File::create(scratch.path("i.png")).expect("a file"), 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let light = (98u32 * 65535 / 100) as u16;
    let pixels: Vec<u8> = [0, light, light, light].into_iter().flat_map(u16::to_be_bytes).collect();
    encoder.write_header().expect("a header").write_image_data(&pixels).expect("pixels");
    scratch.run(&format!("lloyd p.csv -o s.csv {region} --density i.png --quiet")).ok();
    assert_eq!(scratch.read("s.csv"), places);
}

#[test]
fn images_that_tell_no_density_are_one_sentence_and_no_file() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n");
    scratch.write("white.pgm", "P2 2 1 9\n9 9\n");
    scratch.write("short.pgm", "P2 2 2 9\n0 1\n");
    scratch.write("text.png", "no image");
    scratch.write("cut.jpg", &include_bytes!("../common/grey.jpg")[..200]);
    let files = scratch.files();
    for (image, part) in [
        ("white.pgm", "white.pgm: all pixels of the image are white"),
        ("short.pgm", "short.pgm: the PGM image cannot be read (2 of 4 pixels are there)"),
        ("text.png", "text.png: the image is neither PNG, JPEG nor PGM"),
        ("cut.jpg", "cut.jpg: the JPEG image cannot be read"),
        ("none.png", "none.png: the file cannot be read"),
    ] {
        scratch.run(&format!("lloyd p.csv --iterations 1 -o q.csv --density {image}")).fails(3, &[part]);
        assert_eq!(scratch.files(), files, "{image}");
    }
    scratch
        .run("lloyd p.csv --iterations 1 -o white.pgm --format csv --density white.pgm")
        .fails(2, &["both the input"]);
}

#[test]
fn wrong_input_is_one_sentence_and_no_file() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n");
    scratch.write("line.csv", "0,0\n4,0\n");
    scratch.write("wide.csv", "0,0\n16777216,1\n3,9\n");
    scratch.write("tenths.csv", "0.1,1e300\n3,9\n");
    let files = scratch.files();
    for (arguments, code, parts) in [
        (
            "wide.csv --iterations 1 -o q.csv",
            3,
            &["wide.csv: ", "need 25 bits", "8 spare bits of 31: give --quantize fit"][..],
        ),
        ("wide.csv --iterations 1 -o q.csv --quantize fit --coord-bits 24", 3, &["give --coord-bits 23 or fewer"]),
        ("tenths.csv --iterations 1 -o q.csv", 3, &["lie on no lattice", "--quantize fit"]),
        ("line.csv --iterations 1 -o q.csv", 3, &["has no area: give --clip"]),
        ("p.csv --iterations 1 -o q.csv --clip 1,1,1,2", 3, &["the clip has no area"]),
        ("p.csv --iterations 1 -o q.txt", 2, &["the name tells no format of points"]),
    ] {
        scratch.run(&format!("lloyd {arguments}")).fails(code, parts);
        assert_eq!(scratch.files(), files, "{arguments}");
    }
    assert_eq!(scratch.run("lloyd p.csv -o q.csv").code, Some(2));
}
