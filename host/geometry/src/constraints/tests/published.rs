//! Published inputs on which other libraries failed, and shapes like theirs. Each test cites its source.
#![allow(clippy::excessive_precision)] // the digits are those of the sources

use incircle_testkit::SplitMix64;

use super::brute::Graph;
use super::canonical::in_both_ways;
use crate::constraints::{snap, Domain, Error, Place, Plan};
use crate::point::Point;
use crate::verify::{verify_constrained, VerifyError};

/// The rings of a JSON list of rings of points.
fn rings(json: &str) -> Vec<Vec<[f64; 2]>> {
    let ring = |text: &str| -> Vec<[f64; 2]> {
        let words = text.split(|c: char| c.is_whitespace() || "[],".contains(c)).filter(|word| !word.is_empty());
        let values: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
        values.as_chunks().0.to_vec()
    };
    // Two brackets that close, whatever stands between them, end a ring.
    let flat: String = json.split_whitespace().collect();
    flat.split("]]").map(ring).filter(|ring| !ring.is_empty()).collect()
}

/// Rings as points and the constraints between them.
fn plan_of(rings: &[Vec<[f64; 2]>]) -> (Vec<[f64; 2]>, Vec<[u32; 2]>) {
    let (mut points, mut constraints) = (Vec::new(), Vec::new());
    for ring in rings {
        let (first, count) = (points.len() as u32, ring.len() as u32);
        constraints.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
        points.extend_from_slice(ring);
    }
    (points, constraints)
}

/// Makes the mesh inside rings. Returns what became of them in a few words.
fn outcome(name: &str, points: &[[f64; 2]], constraints: &[[u32; 2]]) -> String {
    let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(constraints) };
    match in_both_ways(points, &plan) {
        Ok(made) => {
            verify_constrained(points, &made.triangles, &plan).unwrap_or_else(|error| panic!("{name}: {error}"));
            format!("{name} {}", made.triangles.len())
        }
        Err(Error::Crossing { constraints, place, .. }) => {
            let [one, other] = constraints;
            if let Place::About(place) = place {
                assert!(place.iter().all(|value| value.is_finite()), "{name}: {place:?}");
            }
            format!("{name} {one} crosses {other}")
        }
        Err(Error::Empty { triangles }) => {
            assert_eq!(verify_constrained(points, &[], &plan), Err(VerifyError::EmptyDomain { triangles }), "{name}");
            format!("{name} empty")
        }
        Err(other) => panic!("{name}: {other}"),
    }
}

/// The same for rings whose crossings are made points of a grid.
fn snapped(name: &str, points: &[[f64; 2]], constraints: &[[u32; 2]]) {
    let bound = |pick: fn(f64, f64) -> f64, start: f64| points.as_flattened().iter().copied().fold(start, pick);
    let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
    let on_grid = |value: f64| ((value - low) / (high - low) * f64::from((1 << 20) - 1)).round() as u32;
    let points: Vec<Point> = points.iter().map(|&[x, y]| Point::new(on_grid(x), on_grid(y))).collect();
    let set = snap(&points, constraints).expect("20 bits");
    let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(&set.constraints) };
    match in_both_ways(&set.points, &plan) {
        Ok(made) => {
            verify_constrained(&set.points, &made.triangles, &plan).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
        Err(Error::Empty { .. }) => {}
        Err(other) => panic!("{name}: {other}"),
    }
}

/// The fixtures of earcut; `testbench/data/README.md` names their source and licence.
#[test]
fn fixtures_of_earcut_have_the_canonical_mesh_or_cross() {
    macro_rules! fixtures {
        ($($name:literal,)*) => {
            [$(($name, include_str!(concat!("../../../../../testbench/data/earcut/", $name, ".json")))),*]
        };
    }
    let all = fixtures![
        "bad-diagonals",
        "bad-hole",
        "boxy",
        "building",
        "collinear-diagonal",
        "degenerate",
        "dude",
        "eberly-3",
        "empty-square",
        "filtered-bridge-jhl",
        "hole-touching-outer",
        "hourglass",
        "infinite-loop-jhl",
        "issue107",
        "issue111",
        "issue119",
        "issue131",
        "issue142",
        "issue147",
        "issue149",
        "issue16",
        "issue17",
        "issue186",
        "issue29",
        "issue34",
        "issue45",
        "issue52",
        "issue83",
        "outside-ring",
        "self-tangent-1",
        "self-tangent-2",
        "self-tangent-3",
        "self-touching",
        "shared-points",
        "simplified-us-border",
        "steiner",
        "touching-holes",
        "touching-holes2",
        "touching-holes3",
        "touching-holes4",
        "touching-holes5",
        "touching2",
        "touching3",
        "touching4",
        "water3",
        "water3b",
    ];
    let mut found = Vec::new();
    for (name, json) in all {
        let (points, constraints) = plan_of(&rings(json));
        found.push(outcome(name, &points, &constraints));
        snapped(name, &points, &constraints);
    }
    assert_eq!(found, EXPECTED, "{found:#?}");
}

/// The number of triangles inside each, or the first constraints that cross. For 30 of them earcut's own tests expect
/// the same number. The test proves each mesh with the validator.
const EXPECTED: [&str; 46] = [
    "bad-diagonals 7",
    "bad-hole 17 crosses 44",
    "boxy 64",
    "building 13",
    "collinear-diagonal 18",
    "degenerate empty",
    "dude 106",
    "eberly-3 73",
    "empty-square empty",
    "filtered-bridge-jhl 28",
    "hole-touching-outer 77",
    "hourglass 2",
    "infinite-loop-jhl 2",
    "issue107 2",
    "issue111 19",
    "issue119 18",
    "issue131 12",
    "issue142 2 crosses 4",
    "issue147 30",
    "issue149 2",
    "issue16 12",
    "issue17 11",
    "issue186 41",
    "issue29 40",
    "issue34 139",
    "issue45 10",
    "issue52 109",
    "issue83 empty",
    "outside-ring 64",
    "self-tangent-1 23",
    "self-tangent-2 25",
    "self-tangent-3 177",
    "self-touching 124",
    "shared-points 4",
    "simplified-us-border 53 crosses 55",
    "steiner 10",
    "touching-holes 57",
    "touching-holes2 10",
    "touching-holes3 82",
    "touching-holes4 82",
    "touching-holes5 160",
    "touching2 8",
    "touching3 15",
    "touching4 20",
    "water3 197",
    "water3b 25",
];

/// Coordinates from the reports 98, 107, 109, 111, 113 and 116 of Stoeoef/spade on GitHub, as lines from point to
/// point. A point that the report 98 inserts in the end is a line of length zero here.
const REPORTED: [(&str, &[[[f64; 2]; 2]]); 6] = [
    (
        "spade 98",
        &[
            [[-20.926544189453125, 16.53529167175293], [-27.772645950317383, 4.197676658630371]],
            [[-20.03745460510254, 12.93730354309082], [-20.930097579956055, 11.93786907196045]],
            [[-15.576859474182129, 8.772907257080078], [-22.373262405395508, 12.348699569702148]],
            [[-10.038422584533691, 5.663522243499756], [-16.382625579833984, 9.09498119354248]],
            [[0.0, 0.0], [-13.11422061920166, 7.30709171295166]],
            [[-19.230497360229492, -3.7645812034606934], [-7.411926746368408, 3.486957311630249]],
            [[-25.072885513305664, -9.239323616027832], [-19.462360382080078, -1.621320366859436]],
            [[-32.41080856323242, -13.72575855255127], [-22.58626365661621, -2.076631784439087]],
            [[-32.41080856323242, -13.72575855255127], [-25.57504653930664, -4.952820301055908]],
            [[-33.08932113647461, 0.31093916296958923], [-25.955543518066406, 0.18878456950187683]],
            [[-21.296192169189453, 9.872323036193848]; 2],
        ],
    ),
    (
        "spade 107",
        &[
            [[0.9296344883099084, 0.03071359966930065], [0.26031306872107085, 0.34491289915959455]],
            [[0.7384289920396423, 0.4981747664368982], [0.06543525273452533, 0.34139896206401854]],
            [[0.9535295221136963, 0.9114305148801416], [0.8306091165247367, 0.08959389670590667]],
            [[0.9081582053528728, 0.4974568601123005], [0.5138795569454557, 0.3186272217036502]],
        ],
    ),
    (
        "spade 109",
        &[
            [[17.064112, -17.96008], [16.249594, -17.145563]],
            [[-25.290726, -24.435482], [-5.6608872, -24.435482]],
            [[17.878626, -18.774595], [15.435078, -16.331045]],
            [[16.331045, -21.951208], [-3.29879, -24.435482]],
        ],
    ),
    (
        "spade 111",
        &[
            [[18.69314193725586, 19.589109420776367], [18.69314193725586, 20.40362548828125]],
            [[19.507659912109375, 20.40362548828125], [17.878625869750977, 18.774595260620117]],
            [[20.322175979614258, 21.218143463134766], [15.435077667236328, 16.331045150756836]],
        ],
    ),
    (
        "spade 113",
        &[
            [[7.9910984, -59.344463], [15.484455, -48.762936]],
            [[15.484455, -48.762936], [-11.673287, -28.37192]],
            [[-11.673287, -28.37192], [-16.214716, -43.81278]],
            [[-16.214716, -43.81278], [-3.657666, -51.41967]],
            [[-3.657666, -51.41967], [7.9910984, -59.344463]],
        ],
    ),
    (
        "spade 116",
        &[
            [[15.435077667236328, 16.331045150756836], [20.322175979614258, 21.218143463134766]],
            [[18.69314193725586, 19.589109420776367], [19.507659912109375, 20.40362548828125]],
            [[19.507659912109375, 21.218143463134766], [19.507659912109375, 20.40362548828125]],
            [[17.878625869750977, 18.774595260620117], [19.507659912109375, 20.40362548828125]],
        ],
    ),
];

#[test]
fn reported_lines_have_a_mesh_or_the_place_of_their_crossing() {
    for (name, lines) in REPORTED {
        let points = lines.as_flattened();
        let constraints: Vec<[u32; 2]> = (0..lines.len() as u32).map(|k| [2 * k, 2 * k + 1]).collect();
        let plan = Plan::new(&constraints);
        match in_both_ways(points, &plan) {
            Ok(made) => drop(verify_constrained(points, &made.triangles, &plan).expect(name)),
            Err(Error::Crossing { constraints: [one, other], .. }) => assert!(one < other, "{name}"),
            Err(other) => panic!("{name}: {other}"),
        }
        snapped(name, points, &[&constraints[..], &constraints[..]].concat());
    }
}

/// Points and constraints in the kinds of trouble that the inputs of artem-ogre/CDT and the report 2999 of CGAL/cgal
/// name. The numbers are other ones.
fn troubles() -> Vec<(&'static str, Graph)> {
    let graph = |points: &[[u32; 2]], constraints: &[[u32; 2]]| Graph {
        points: points.to_vec(),
        constraints: constraints.to_vec(),
    };
    let hanging = [[0, 20], [6, 18], [9, 23], [12, 18], [19, 21], [9, 26], [9, 31]];
    let square = [[0, 0], [8, 0], [8, 12], [0, 12], [2, 0], [6, 0], [6, 4], [2, 4], [3, 0], [5, 0], [5, 2], [3, 2]];
    let ring = |first: u32| [[first, first + 1], [first + 1, first + 2], [first + 2, first + 3], [first + 3, first]];
    vec![
        ("an edge that hangs into the chain", graph(&hanging[..6], &[[0, 4]])),
        ("two edges that hang into the chain", graph(&hanging, &[[0, 4]])),
        ("hanging edges that are constraints", graph(&hanging, &[[5, 6], [2, 5], [0, 4]])),
        (
            "many points on one constraint",
            graph(
                &[[0, 1], [2, 2], [4, 2], [2, 0], [4, 0], [6, 1], [8, 1], [10, 2], [10, 0], [14, 1]],
                &[[0, 9], [9, 0]],
            ),
        ),
        (
            "a square with a crack",
            graph(
                &[[0, 0], [16, 0], [16, 16], [9, 16], [8, 8], [7, 16], [0, 16]],
                &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 0]],
            ),
        ),
        ("holes that share a side with the boundary", graph(&square, &[ring(0), ring(4), ring(8)].concat())),
        ("rings that are given twice", graph(&square, &[ring(0), ring(4), ring(4), ring(0)].concat())),
        (
            "a line along a side and beyond it",
            graph(
                &[[10, 5], [5, 10], [0, 5], [5, 0], [2, 5], [8, 5]],
                &[[0, 1], [1, 2], [2, 3], [3, 0], [2, 5], [4, 0]],
            ),
        ),
        (
            "three constraints of which two end on the third",
            graph(&[[0, 4], [12, 10], [6, 7], [3, 0], [4, 6], [1, 9]], &[[2, 3], [0, 1], [4, 5]]),
        ),
        ("no constraint at all", graph(&square, &[])),
        ("constraints of length zero", graph(&[[0, 0], [4, 0], [0, 4], [4, 0]], &[[1, 1], [1, 3], [3, 1], [0, 0]])),
    ]
}

#[test]
fn kinds_of_trouble_have_the_mesh_of_the_definition() {
    let mut random = SplitMix64::new(91);
    for (name, graph) in troubles() {
        assert!(!graph.crosses(), "{name}");
        let points: Vec<Point> = graph.points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let plan = Plan::new(&graph.constraints);
        let made = in_both_ways(&points, &plan).unwrap_or_else(|error| panic!("{name}: {error}"));
        let fixed = graph.pieces().keys().copied().collect();
        assert_eq!(made.triangles, graph.flipped(&fixed, &mut random), "{name}");
        verify_constrained(&points, &made.triangles, &plan).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// A letter with a hole and a tail, as plans of Shewchuk's Triangle have them; the numbers are our own.
#[test]
fn a_letter_with_a_hole_keeps_its_shape() {
    let outer = [(0, 0), (4, 0), (7, 8), (13, 8), (16, 0), (20, 0), (12, 24), (8, 24)];
    let hole = [(8, 11), (10, 18), (12, 11)];
    let points: Vec<Point> = outer.iter().chain(&hole).map(|&(x, y)| Point::new(x, y)).collect();
    let mut constraints: Vec<[u32; 2]> = (0..8).map(|k| [k, (k + 1) % 8]).collect();
    constraints.extend([[8, 9], [9, 10], [10, 8]]);
    let holes = [Point::new(10, 13)];
    let plan = Plan { domain: Domain::Holes, holes: &holes, ..Plan::new(&constraints) };
    let made = in_both_ways(&points, &plan).expect("a letter");
    verify_constrained(&points, &made.triangles, &plan).expect("the right mesh");
    let twice = |ring: &[(i128, i128)]| -> i128 {
        let next = ring.iter().skip(1).chain(ring.first());
        ring.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<i128>().abs()
    };
    let wide = |ring: &[(u32, u32)]| ring.iter().map(|&(x, y)| (x.into(), y.into())).collect::<Vec<(i128, i128)>>();
    assert_eq!(made.twice_area, Some(twice(&wide(&outer)) - twice(&wide(&hole))));
}
