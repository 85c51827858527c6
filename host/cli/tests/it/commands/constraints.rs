//! `triangulate` and `verify` with constraints: what plans of all formats become, and what is refused with one
//! sentence.

use crate::common::{Run, Scratch};

/// A square of side 8 with a square hole of side 4, in the format of Shewchuk's Triangle, ids from 1.
pub const POLY: &str = "# a frame\n8 2 0 0\n1 0 0\n2 8 0\n3 8 8\n4 0 8\n5 2 2\n6 6 2\n7 6 6\n8 2 6\n\
                    8 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n1\n1 4 4\n";
/// The same as polygons.
const GEOJSON: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[8,0],[8,8],[0,8],[0,0]],
    [[2,2],[6,2],[6,6],[2,6],[2,2]]]}"#;
const WKT: &str = "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 6 2, 6 6, 2 6, 2 2))\n";

/// Runs `triangulate` on one file, and checks the mesh with `verify`.
pub fn made(name: &str, content: &str, options: &str) -> (Scratch, Run) {
    let scratch = Scratch::new();
    scratch.write(name, content);
    let run = scratch.run(&format!("triangulate {name} -o m.ele {options}")).ok();
    scratch.run(&format!("verify {name} m.ele {}", verify_options(options))).ok();
    (scratch, run)
}

/// The options of `triangulate` that `verify` needs, too.
fn verify_options(options: &str) -> String {
    let words: Vec<&str> = options.split_whitespace().collect();
    let own = words.chunks(2).filter(|pair| ["--constraints", "--domain", "--quantize"].contains(&pair[0]));
    own.flatten().copied().collect::<Vec<_>>().join(" ")
}

pub fn refused(name: &str, content: &str, options: &str, parts: &[&str]) {
    let scratch = Scratch::new();
    scratch.write(name, content);
    let before = scratch.files();
    scratch.run(&format!("triangulate {name} -o m.ele --edges m.edge {options}")).fails(3, parts).fails(3, &[name]);
    assert_eq!(scratch.files(), before);
}

#[test]
fn plans_of_all_formats_have_the_same_frame() {
    let rows = |scratch: &Scratch| scratch.read("m.ele").lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    let (poly, run) = made("p.poly", POLY, "");
    assert!(run.stderr.contains("8 constraints in 8 pieces; domain holes: 8 of 10 triangles, 1 region"), "{run:?}");
    assert_eq!(poly.read("m.ele").lines().next(), Some("8 3 1"));
    let (geojson, run) = made("p.geojson", GEOJSON, "");
    assert!(run.stderr.contains("domain even-odd: 8 of 10 triangles, 1 region"), "{run:?}");
    let (wkt, _) = made("p.wkt", WKT, "");
    assert_eq!(rows(&geojson), rows(&wkt));
    assert_eq!(rows(&poly).len(), rows(&wkt).len());
    let edges = "a,b\n0,1\n1,2\n2,3\n3,0\n4,5\n5,6\n6,7\n7,4\n";
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n8,0\n8,8\n0,8\n2,2\n6,2\n6,6\n2,6\n");
    scratch.write("e.csv", edges);
    scratch.run("triangulate p.csv -o m.ele --constraints e.csv --domain even-odd").ok();
    scratch.run("verify p.csv m.ele --constraints e.csv --domain even-odd").ok();
    assert_eq!(rows(&scratch), rows(&poly));
    // Without a domain all triangles are there, and another domain is another mesh.
    scratch.run("triangulate p.csv -o all.ele --constraints e.csv").ok();
    assert_eq!(scratch.read("all.ele").lines().next(), Some("10 3 0"));
    scratch.run("verify p.csv all.ele --constraints e.csv").ok();
    let parts = ["not the canonical constrained", "the domain lies on"];
    scratch.run("verify p.csv all.ele --constraints e.csv --domain even-odd").fails(1, &parts);
    scratch.run("verify p.csv m.ele").fails(1, &["not the canonical Delaunay"]);
}

#[test]
fn every_back_end_and_number_gives_the_same_bytes() {
    let (cpu, _) = made("p.poly", POLY, "");
    let (model, _) = made("p.poly", POLY, "--backend model");
    assert_eq!(cpu.read("m.ele"), model.read("m.ele"));
    let (eights, _) = made("p.wkt", &WKT.replace('8', "0.8").replace('6', "0.6").replace('2', "0.2"), "");
    let (plain, _) = made("p.wkt", WKT, "");
    assert_eq!(eights.read("m.ele"), plain.read("m.ele"));
    made("p.wkt", WKT, "--quantize fit");
    made("p.poly", POLY, "--quantize 100");
}

/// Points and constraints without a crossing: squares, each in the next, and points inside of all, two at one place.
fn squares() -> (String, String) {
    let (mut points, mut edges) = (String::new(), String::new());
    for ring in 0..12 {
        let (near, far) = (ring, 40 - ring);
        points += &format!("{near},{near}\n{far},{near}\n{far},{far}\n{near},{far}\n");
        (0..4).for_each(|corner| edges += &format!("{},{}\n", 4 * ring + corner, 4 * ring + (corner + 1) % 4));
    }
    (points + "20,20\n20,20\n19,21\n", edges)
}

#[test]
fn the_processor_alone_and_two_steps_give_the_same_files_and_reports() {
    // Two back ends triangulate first, and the constraints are forced afterwards. One processor does both at once.
    let (points, edges) = squares();
    let scratch = Scratch::new();
    scratch.write("p.csv", points);
    scratch.write("e.csv", edges);
    scratch.write("p.geojson", GEOJSON);
    scratch.write("p.poly", POLY);
    let with = ["p.csv --constraints e.csv", "p.csv --constraints e.csv --domain even-odd", "p.geojson", "p.poly"];
    for set in with {
        let made = |backends: &str| {
            let lists = "-o m.json --edges m.edge --neighbors m.neigh --json";
            let run = scratch.run(&format!("triangulate {set} {lists} {backends}")).ok();
            let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
            let same = ["points", "distinct", "duplicates", "triangles", "hull", "collinear", "lattice", "plan"];
            let counts = same.map(|key| report[key].clone());
            (["m.json", "m.edge", "m.neigh"].map(|name| scratch.bytes(name)), counts)
        };
        let (alone, together) = (made(""), made("--backend cpu --backend cpu"));
        assert!(alone == together, "{set}: {:?} {:?}", alone.1, together.1);
        assert!(made("--backend cpu --threads 1") == alone && made("--backend model") == alone, "{set}");
    }
}

#[test]
fn the_processor_alone_and_two_steps_refuse_with_the_same_sentence() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0.5,0\n4,0\n4,3\n0,3\n2,1\n");
    for (edges, domain) in
        [("0,2\n1,3\n", "all"), ("0,1\n1,2\n", "even-odd"), ("0,1\n1,2\n0,2\n", "non-zero"), ("0,1\n", "holes")]
    {
        scratch.write("e.csv", edges);
        let told = |backends: &str| {
            let run =
                scratch.run(&format!("triangulate p.csv -o m.ele --constraints e.csv --domain {domain} {backends}"));
            assert_eq!(scratch.files(), ["e.csv", "p.csv"]);
            (run.code, run.stdout, run.stderr)
        };
        let alone = told("");
        assert_eq!(alone.0, Some(3), "{alone:?}");
        assert_eq!(alone, told("--backend cpu --backend cpu"));
    }
    scratch.write("e.csv", "0,1\n");
    let run = scratch.run("triangulate p.csv -o m.ele --constraints e.csv --timeout 0.000000001");
    let plain = scratch.run("triangulate p.csv -o m.ele --timeout 0.000000001");
    assert_eq!((run.code, run.stderr), (plain.code, plain.stderr));
}

#[test]
fn lists_tell_edges_neighbours_and_constraints() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n0,4\n2,0\n");
    scratch.write("e.csv", "0,1\n4,1\n2,3\n3,3\n");
    scratch.run("triangulate p.csv -o m.json --constraints e.csv --edges m.edge --neighbors m.neigh").ok();
    let edges = "7 1\n0 0 3 0\n1 0 4 1\n2 1 2 0\n3 1 4 1 # constraints 0 1\n4 2 3 3\n5 2 4 0\n6 3 4 0\n";
    assert_eq!(scratch.read("m.edge"), edges);
    assert_eq!(scratch.read("m.neigh"), "3 3\n0 2 -1 -1\n1 2 -1 -1\n2 0 1 -1\n");
    let json = scratch.read("m.json");
    assert!(
        json.ends_with("\"regions\":[\n0,\n0,\n0],\n\"pieces\":[\n[0,4,[0]],\n[1,4,[0,1]],\n[2,3,[2]]]}\n"),
        "{json}"
    );
    scratch.run("triangulate p.csv -o m.svg --constraints e.csv").ok();
    assert!(scratch.read("m.svg").contains("stroke=\"#e4572e\""));
}

#[test]
fn regions_of_a_poly_have_their_attributes() {
    let two =
        "6 2 0 0\n0 0 0\n1 4 0\n2 8 0\n3 8 4\n4 4 4\n5 0 4\n7 0\n0 0 1\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 0\n6 1 4\n\
               0\n3\n0 1 1 2.5 0.1\n1 7 1 -7\n2 6 2 9\n";
    let (scratch, run) = made("p.poly", two, "");
    assert!(run.stderr.contains("2 regions"), "{run:?}");
    assert_eq!(scratch.read("m.ele"), "4 3 1\n0 0 1 4 2.5\n1 0 4 5 2.5\n2 1 2 3 -7\n3 1 3 4 -7\n");
    let points = Scratch::new();
    points.write("p.node", "4 2 0 0\n0 0 0\n1 4 0\n2 4 4\n3 0 4\n");
    points.write("p.poly", "0 2 0 0\n1 0\n0 0 2\n0\n");
    points.run("triangulate p.poly -o m.ele --domain all --json").ok();
    assert_eq!(points.read("m.ele"), "2 3 0\n0 0 1 2\n1 0 2 3\n");
    // The file of points counts from 1, and no segment names its last point.
    points.write("p.node", "5 2 0 0\n1 0 0\n2 8 0\n3 8 8\n4 0 8\n5 4 3\n");
    points.write("p.poly", "0 2 0 0\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
    for from in ["", "--from poly"] {
        points.run(&format!("triangulate p.poly -o m.ele {from}")).ok();
        assert_eq!(points.read("m.ele"), "4 3 1\n0 0 1 4 0\n1 0 4 3 0\n2 1 2 4 0\n3 2 3 4 0\n");
    }
}

#[test]
fn the_report_counts_what_constraints_made() {
    let (scratch, _) = made("p.geojson", GEOJSON, "");
    let run = scratch.run("triangulate p.geojson -o m.ele --json").ok();
    let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    let plan = serde_json::json!({
        "constraints": 8, "pieces": 8, "domain": "even-odd", "triangles": 8, "regions": 1, "snapping": null,
        "twice_area": "96",
    });
    assert_eq!(report["plan"], plan);
}

#[test]
fn bad_plans_are_refused_with_numbers() {
    let csv = "0,0\n4,0\n4,4\n0,4\n";
    let with = |edges: &str, options: &str, parts: &[&str]| {
        let scratch = Scratch::new();
        scratch.write("p.csv", csv);
        scratch.write("e.csv", edges);
        scratch.run(&format!("triangulate p.csv -o m.ele --constraints e.csv {options}")).fails(3, parts);
        assert_eq!(scratch.files(), ["e.csv", "p.csv"]);
    };
    with("0,1\n1,4\n", "", &["e.csv", "row 2, column 2", "point 4 does not exist", "4 points"]);
    with("0,1,2\n", "", &["e.csv", "row 1 has 3 columns"]);
    with("0,x\n", "", &["row 1, column 2", "'x'"]);
    with("0,2\n1,3\n", "", &["e.csv: constraint 1 (from point 1 to point 3) crosses constraint 0", "at (2, 2)"]);
    with("0,1\n1,2\n", "--domain even-odd", &["not closed", "point 0", "odd (1)"]);
    // Whole numbers of 128 bits do not hold the place where these cross.
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n1e-37,0\n1e-37,1.3e-37\n0,1e-37\n");
    scratch.write("e.csv", "0,2\n1,3\n");
    let run = scratch.run("triangulate p.csv -o m.ele --constraints e.csv");
    run.fails(3, &["crosses constraint 0", "at about (4.3478", "e-38, 5.6521"]);
    with("0,1\n1,2\n0,2\n", "--domain non-zero", &["2 of its constraints begin at point 0, and 0 end there"]);
    with("0,1\n", "--domain holes", &["the domain is empty: none of the 2 triangles"]);
    let ring = |ring: &str| format!(r#"{{"type":"Polygon","coordinates":[{ring}]}}"#);
    let geojson = |text: &str, parts: &[&str]| refused("p.geojson", &ring(text), "", parts);
    geojson("[[0,0],[4,0],[4,4]]", &["ring of 3 points", "four or more"]);
    geojson("[[0,0],[4,0],[4,4],[0,0.5]]", &["not closed", "begins at (0, 0) and ends at (0, 0.5)"]);
    geojson("[[0.5,0],[4,3],[4,0],[0,3],[0.5,0]]", &["crosses", "at (32/15, 7/5)"]);
    geojson("7", &["'7' where a list of positions belongs"]);
    refused("p.wkt", "LINESTRING (0 0)", "", &["row 1", "a line of 1 point"]);
    refused("p.wkt", "CIRCLE (0 0)", "", &["'CIRCLE' is no geometry"]);
    refused("p.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 0)", "", &["expected ',' or ')'"]);
    let poly = |from: &str, to: &str, parts: &[&str]| refused("p.poly", &POLY.replace(from, to), "", parts);
    poly("1 4 4\n", "1 40 4\n", &["hole 1, counted from 1, at (40, 4), lies outside the hull"]);
    poly("1 4 4\n", "1 4 2\n", &["hole 1, counted from 1, at (4, 2), lies on the constraint from point 4 to"]);
    poly("8 8 5\n", "8 8 9\n", &["a segment ends at point 9", "8 points begin at 1"]);
    poly("\n1\n1 4 4\n", "\n2\n1 4 4\n", &["promises 2 holes", "is 1"]);
    poly("\n1\n1 4 4\n", "\n1\n1 4 4\n0\n7\n", &["behind the last section"]);
    poly("8 0\n1 1 2\n", "9 0\n1 1 2\n", &["row 20 has 1 value: a segment is a row"]);
    refused("p.poly", "0 2 0 0\n0 0\n", "", &["p.node"]);
}

#[test]
fn plans_need_the_whole_set_in_memory_and_their_own_commands() {
    let scratch = Scratch::new();
    scratch.write("p.poly", POLY);
    scratch.run("triangulate p.poly -o m.ele --memory 64M --domain all").fails(2, &["--memory"]);
    scratch.run("tile split p.poly -o t --points 20000").fails(2, &["'triangulate' and 'verify'"]);
    scratch.run("triangulate p.poly -o m.ele --edges m.ele").fails(2, &["both the mesh and a list"]);
    scratch.run("triangulate p.poly -o m.ele --edges l --neighbors l").fails(2, &["the same file"]);
    assert_eq!(scratch.run("triangulate p.poly -o m.ele --domain some").code, Some(2));
    assert_eq!(scratch.files(), ["p.poly"]);
}
