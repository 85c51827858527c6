//! `incircle voronoi`: files of cells beside half planes in fractions, and refusals.

use incircle_testkit::{cell_neighbors, clipped_cell, SplitMix64};
use serde_json::Value;

use crate::common::Scratch;

fn numbers(value: &Value) -> Vec<u32> {
    value.as_array().expect("a list").iter().map(|item| item.as_u64().expect("an index") as u32).collect()
}

fn corners(ring: &Value) -> Vec<[f64; 2]> {
    let place = |place: &Value| [0, 1].map(|axis| place[axis].as_f64().expect("a number"));
    ring.as_array().expect("a ring").iter().map(place).collect()
}

/// A few points of a small square as CSV, and as numbers.
fn draw(random: &mut SplitMix64) -> (String, Vec<[i64; 2]>) {
    let points: Vec<[i64; 2]> =
        (0..2 + random.below(9)).map(|_| [0; 2].map(|_: i64| random.below(6) as i64 - 3)).collect();
    (points.iter().map(|[x, y]| format!("{x},{y}\n")).collect(), points)
}

#[test]
fn features_are_the_cells_of_half_planes() {
    let mut random = SplitMix64::new(287);
    let clip = [[-4, -3], [5, -3], [5, 4], [-4, 4]];
    for _ in 0..20 {
        let scratch = Scratch::new();
        let (text, points) = draw(&mut random);
        scratch.write("p.csv", text);
        scratch.run("voronoi p.csv -o c.geojson --clip -4,-3,5,4 --quiet").ok();
        let json: Value = serde_json::from_str(&scratch.read("c.geojson")).expect("JSON");
        let features = json["features"].as_array().expect("features");
        let mut distinct = points.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(features.len(), distinct.len(), "{points:?}");
        for feature in features {
            let index = feature["properties"]["point"].as_u64().expect("an index") as usize;
            // Of equal points, the lowest index has the cell.
            assert_eq!(points.iter().position(|point| *point == points[index]), Some(index));
            let expected = clipped_cell(&points, index, &clip);
            let rounded = |place: &[i128; 3]| [0, 1].map(|axis| place[axis] as f64 / place[2] as f64);
            let mut expected: Vec<[f64; 2]> = expected.iter().map(rounded).collect();
            let mut found = corners(&feature["geometry"]["coordinates"][0]);
            assert_eq!(found.first(), found.last());
            found.pop();
            found.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
            expected.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
            assert_eq!(found, expected, "cell {index} of {points:?}");
            let inside = cell_neighbors(&points, index, &clip);
            assert_eq!(numbers(&feature["properties"]["inside"]), inside, "cell {index} of {points:?}");
        }
        let areas = features.iter().map(|feature| feature["properties"]["area"].as_f64().expect("an area"));
        assert!((areas.sum::<f64>() - 63.0).abs() < 1e-12);
    }
}

#[test]
fn cells_without_a_clip_have_rays() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n0,4\n2,2\n4,0\n");
    let run = scratch.run("voronoi p.csv -o c.json").ok();
    assert!(run.stderr.contains("6 points, 5 cells, 4 Voronoi vertices, not clipped"), "{run:?}");
    let json: Value = serde_json::from_str(&scratch.read("c.json")).expect("JSON");
    assert_eq!(corners(&json["vertices"]).len(), 4);
    let cells = json["cells"].as_array().expect("cells");
    let rays: Vec<String> = cells.iter().map(|cell| cell["rays"].to_string()).collect();
    assert_eq!(rays, ["[[0,-4],[-4,0]]", "[[4,0],[0,-4]]", "[[0,4],[4,0]]", "[[-4,0],[0,4]]", "[]"]);
    assert_eq!(numbers(&cells[4]["neighbors"]), [0, 1, 2, 3]);
    assert_eq!(numbers(&cells[0]["neighbors"]), [1, 4, 3]);
}

#[test]
fn decimals_and_doubles_are_rounded_once() {
    let scratch = Scratch::new();
    // The circumcentre lies a third of a step of 0.000001 from a point of the lattice.
    scratch.write("p.csv", "-0.1,0\n-0.099997,0\n-0.099999,0.000002\n");
    scratch.run("voronoi p.csv -o c.json --quiet").ok();
    let json: Value = serde_json::from_str(&scratch.read("c.json")).expect("JSON");
    assert_eq!(corners(&json["vertices"]), [[-0.0999985, 0.0000005]]);
    scratch.write("q.csv", "0.5,0.25\n3,0.25\n1,2\n");
    scratch.run("voronoi q.csv -o c.json --quiet").ok();
    let json: Value = serde_json::from_str(&scratch.read("c.json")).expect("JSON");
    // The centre (x, y) of 0.5, 3 and of the third point: y = 0.25 + (1.75² - 0.5 * 2) / 3.5.
    assert_eq!(corners(&json["vertices"]), [[1.75, 0.25 + (1.75 * 1.75 - 1.0) / 3.5]]);
}

#[test]
fn a_polygon_in_a_file_cuts_cells_into_pieces() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "1,1\n9,1\n5,9\n");
    // A shape like a U: the cell of the lower middle has none, the upper ends belong to different cells.
    let ring = "[[0,0],[10,0],[10,10],[6,10],[6,4],[4,4],[4,10],[0,10],[0,0]]";
    let polygon = format!("{{\"type\":\"Polygon\",\"coordinates\":[{ring}]}}");
    scratch.write("u.geojson", format!("{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{polygon}}}"));
    scratch.write("u.csv", "0,0\n10,0\n10,10\n6,10\n6,4\n4,4\n4,10\n0,10\n");
    scratch.run("voronoi p.csv -o one.geojson --clip-to u.geojson --quiet").ok();
    scratch.run("voronoi p.csv -o other.geojson --clip-to u.csv --quiet").ok();
    assert_eq!(scratch.read("one.geojson"), scratch.read("other.geojson"));
    let json: Value = serde_json::from_str(&scratch.read("one.geojson")).expect("JSON");
    let kinds: Vec<&str> = json["features"]
        .as_array()
        .expect("features")
        .iter()
        .filter_map(|it| it["geometry"]["type"].as_str())
        .collect();
    assert_eq!(kinds, ["Polygon", "Polygon", "MultiPolygon"]);
    let run = scratch.run("voronoi p.csv -o c.svg --clip-to u.csv --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("a report");
    assert_eq!((report["clip"].as_str(), report["clip_corners"].as_u64()), (Some("given"), Some(8)));
    assert!(scratch.read("c.svg").ends_with("</svg>\n"));
}

#[test]
fn holes_of_a_polygon_stay_empty() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "2,2\n8,2\n5,40\n");
    // A hole across the border of the first two cells, and one inside the first cell; rings may turn either way.
    let ring = |low: [f64; 2], high: [f64; 2]| {
        let ([a, b], [c, d]) = (low, high);
        format!("[[{a},{b}],[{c},{b}],[{c},{d}],[{a},{d}],[{a},{b}]]")
    };
    let rings = [ring([0.0, 0.0], [10.0, 8.0]), ring([4.0, 2.0], [6.0, 4.0]), ring([1.0, 1.0], [1.5, 3.0])].join(",");
    scratch.write("c.geojson", format!("{{\"type\":\"Polygon\",\"coordinates\":[{rings}]}}"));
    scratch.run("voronoi p.csv -o cells.geojson --clip-to c.geojson --quiet").ok();
    let json: Value = serde_json::from_str(&scratch.read("cells.geojson")).expect("JSON");
    let features = json["features"].as_array().expect("features");
    let areas: Vec<f64> = features.iter().filter_map(|it| it["properties"]["area"].as_f64()).collect();
    assert_eq!(areas, [40.0 - 2.0 - 1.0, 40.0 - 2.0]);
    let counts = features.iter().map(|it| it["geometry"]["coordinates"].as_array().map_or(0, Vec::len));
    assert_eq!(counts.collect::<Vec<_>>(), [2, 1]);
    scratch.run("voronoi p.csv -o cells.svg --clip-to c.geojson --quiet").ok();
    scratch.run("lloyd p.csv -o q.csv --clip-to c.geojson --iterations 3 --quiet").ok();
}

#[test]
fn wrong_input_is_one_sentence_and_no_file() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n");
    scratch.write("line.csv", "0,0\n4,0\n");
    scratch.write("bow.csv", "0,0\n4,4\n4,0\n0,4\n");
    scratch.write("point.geojson", "{\"type\":\"Point\",\"coordinates\":[1,2]}");
    let ring = "[[0,0],[9,0],[9,9],[0,0]]";
    scratch.write("hole.geojson", format!("{{\"type\":\"Polygon\",\"coordinates\":[{ring},{ring}]}}"));
    let far = "[[20,20],[29,20],[29,29],[20,20]]";
    scratch.write("far.geojson", format!("{{\"type\":\"Polygon\",\"coordinates\":[{ring},{far}]}}"));
    scratch.write("text.geojson", format!("{{\"type\":\"Polygon\",\"coordinates\":[{ring},[[1,1],[1]]]}}"));
    let open = "[[1,1],[2,1.50],[2,2],[1,2]]";
    scratch.write("open.geojson", format!("{{\"type\":\"Polygon\",\"coordinates\":[{ring},{open}]}}"));
    scratch.write("short.geojson", "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[9,0],[0,0]]]}");
    scratch.write("empty.geojson", "{\"type\":\"Polygon\",\"coordinates\":[]}");
    scratch.write("wide.csv", "0,0\n1,4294967296\n0.5,9\n");
    scratch.write("bad.csv", "0,0\n1,x\n");
    let files = scratch.files();
    for (arguments, code, parts) in [
        ("p.csv -o c.geojson --clip 1,1,1,5", 3, &["--clip: the clip has no area"][..]),
        ("p.csv -o c.geojson --clip-to bow.csv", 3, &["bow.csv: the border of the clip crosses", "edges 0 and 2"]),
        ("p.csv -o c.geojson --clip-to line.csv", 3, &["line.csv: the clip has no area"]),
        ("p.csv -o c.geojson --clip-to point.geojson", 3, &["point.geojson: the type is 'Point'"]),
        ("p.csv -o c.geojson --clip-to hole.geojson", 3, &["hole.geojson: the border of the clip crosses"]),
        (
            "p.csv -o c.geojson --clip-to far.geojson",
            3,
            &["far.geojson: hole 1 of the clip, counted from 1, lies outside"],
        ),
        (
            "p.csv -o c.geojson --clip-to text.geojson",
            3,
            &["text.geojson: corner 2 of ring 2 is '[1]', not two numbers"],
        ),
        (
            "p.csv -o c.geojson --clip-to open.geojson",
            3,
            &["open.geojson: the polygon has a ring that is not closed: it begins at (1, 1) and ends at (1, 2); repeat"],
        ),
        ("p.csv -o c.geojson --clip-to short.geojson", 3, &["short.geojson: the polygon has a ring of 3 points"]),
        ("p.csv -o c.geojson --clip-to empty.geojson", 3, &["empty.geojson: the polygon has no ring"]),
        ("p.csv -o c.geojson --clip-to none.csv", 3, &["none.csv"]),
        ("line.csv -o c.geojson", 3, &["the rectangle around the points has no area"]),
        ("wide.csv -o c.json", 3, &["wide.csv: ", "lattice of up to 31 bits: give --quantize fit"]),
        ("bad.csv -o c.json", 3, &["bad.csv: row 2, column 2"]),
        ("p.csv -o c.txt", 2, &["the name tells no format of cells: add --format geojson or json or svg"]),
        ("p.csv -o -", 2, &["standard output: the name tells no format"]),
    ] {
        scratch.run(&format!("voronoi {arguments}")).fails(code, parts);
        assert_eq!(scratch.files(), files, "{arguments}");
    }
    let run = scratch.run("voronoi p.csv -o c.geojson --clip 1,1,5");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("give four numbers 'X0,Y0,X1,Y1'"), "{run:?}");
}

#[test]
fn small_sets_have_cells() {
    let scratch = Scratch::new();
    scratch.write("none.csv", "x,y\n");
    scratch.write("one.csv", "3,4\n3,4\n");
    scratch.write("two.csv", "0,0\n2,0\n");
    for (name, cells) in [("none", 0), ("one", 1), ("two", 2)] {
        let run = scratch.run(&format!("voronoi {name}.csv -o {name}.geojson --clip 0,0,9,9 --json")).ok();
        let report: Value = serde_json::from_str(&run.stdout).expect("a report");
        assert_eq!(report["cells"].as_u64(), Some(cells), "{name}");
        let json: Value = serde_json::from_str(&scratch.read(&format!("{name}.geojson"))).expect("JSON");
        assert_eq!(json["features"].as_array().map(Vec::len), Some(cells as usize), "{name}");
        scratch.run(&format!("voronoi {name}.csv -o {name}.json --quiet")).ok();
    }
}

#[test]
fn decimals_that_are_binary_fractions_keep_their_places() {
    let scratch = Scratch::new();
    // Ten decimals: the points have steps of 2^-10, because steps of 10^-10 would need too many bits.
    scratch.write("p.csv", "0.0009765625,0.0009765625\n1,0\n0,1\n1,1\n");
    scratch.run("voronoi p.csv -o c.geojson --clip 0,0,1,1 --quiet").ok();
    let json: Value = serde_json::from_str(&scratch.read("c.geojson")).expect("JSON");
    let rings = json["features"].as_array().expect("features").iter().map(|one| &one["geometry"]["coordinates"][0]);
    let places: Vec<[f64; 2]> = rings.flat_map(corners).collect();
    assert!(places.contains(&[0.0, 0.0]) && places.contains(&[1.0, 1.0]), "{places:?}");
    assert!(places.iter().flatten().all(|value| (0.0..=1.0).contains(value)), "{places:?}");
}
