//! The files of all processes, one after the other, are the mesh of `incircle triangulate`, byte for byte.

use serde_json::Value;

use crate::{data, sentences, Scratch};

/// Asserts that a number of processes gives the mesh in `right.npy`, and returns the summary.
#[track_caller]
fn same_mesh(scratch: &Scratch, ranks: usize, inputs: &str, options: &str) -> Value {
    let output = scratch.run(ranks, &format!("triangulate {inputs} -o mesh --json -q {options}"));
    assert!(output.status.success(), "{ranks} ranks, {inputs}: {output:?}");
    let summary: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    let files: Vec<u8> = (0..ranks).flat_map(|rank| data(&scratch.path(&format!("mesh/{rank}.npy")))).collect();
    assert!(files == data(&scratch.path("right.npy")), "{ranks} ranks, {inputs}: {summary}");
    let counts = std::fs::read_to_string(scratch.path("mesh/mesh.json")).expect("the counts");
    let counts: Value = serde_json::from_str(&counts).expect("JSON");
    for key in ["points", "distinct", "duplicates", "triangles", "hull", "collinear", "files"] {
        assert_eq!(counts[key], summary[key], "{key}");
    }
    assert_eq!(counts["files"].as_array().map(Vec::len), Some(ranks));
    std::fs::remove_dir_all(scratch.path("mesh")).expect("the mesh");
    summary
}

#[test]
fn every_number_of_processes_gives_the_mesh_of_triangulate() {
    let scratch = Scratch::new();
    for set in ["uniform", "clusters", "line", "lattice", "circle", "two-chains", "box"] {
        scratch.incircle(&format!("generate {set} -n 3000 -o @p.npy"));
        scratch.incircle("triangulate @p.npy -o @right.npy -q");
        for ranks in [1, 2, 3, 4, 8] {
            let summary = same_mesh(&scratch, ranks, "p.npy", "--points 50");
            assert_eq!(summary["processes"], ranks);
        }
    }
}

#[test]
fn a_large_set_is_cut_by_a_sample() {
    let scratch = Scratch::new();
    for set in ["uniform", "clusters"] {
        scratch.incircle(&format!("generate {set} -n 400000 --bits 31 -o @p.npy"));
        scratch.incircle("triangulate @p.npy -o @right.npy -q");
        let summary = same_mesh(&scratch, 3, "p.npy", "");
        let most = summary["most_points"].as_u64().expect("a count");
        assert!(most < 160_000, "{set}: {most} points in one process");
        let levels = summary["levels"].as_array().expect("levels");
        assert_eq!(
            levels.last().map(|level| (level["regions"].as_u64(), level["open"].as_u64())),
            Some((Some(1), Some(0)))
        );
        assert!(levels[0]["border_share"].as_f64().is_some_and(|share| share < 0.1), "{summary}");
    }
}

#[test]
fn small_and_degenerate_sets_are_right() {
    let scratch = Scratch::new();
    let sets: Vec<(&str, Vec<[i64; 2]>)> = vec![
        ("none", vec![]),
        ("one", vec![[-5, 7]]),
        ("two", vec![[0, 0], [3, 4]]),
        ("four", vec![[4, 4], [4, 0], [0, 4], [0, 0]]),
        ("equal", vec![[3, 4]; 50]),
        ("collinear", (0..60).map(|k| [7 * k % 60, 3 * (7 * k % 60)]).collect()),
        ("wide", (0..40).map(|k| [k * 100_000_000, (k * k) % 17]).collect()),
        ("doubled", (0..90).map(|k| [k * 7 % 30 % 6, k * 7 % 30 / 6]).collect()),
    ];
    for (name, points) in sets {
        scratch.integers("p.npy", &points);
        scratch.incircle("triangulate @p.npy -o @right.npy -q");
        for ranks in [1, 2, 5] {
            for options in ["", "--points 2"] {
                let summary = same_mesh(&scratch, ranks, "p.npy", options);
                assert_eq!(summary["points"], points.len(), "{name}");
                let mut distinct = points.clone();
                distinct.sort_unstable();
                distinct.dedup();
                assert_eq!(summary["distinct"], distinct.len(), "{name}");
            }
        }
    }
}

#[test]
fn several_inputs_of_several_types_are_one_set() {
    let scratch = Scratch::new();
    let number = |k: i64| (k * k * 31 + 7 * k) % 97;
    let points: Vec<[i64; 2]> = (0..700).map(|k| [number(k) - 40, number(3 * k + 1) - 50]).collect();
    scratch.integers("all.npy", &points);
    scratch.incircle("triangulate @all.npy -o @right.npy -q");
    let numbers = |points: &[[i64; 2]]| points.as_flattened().to_vec();
    let shorts: Vec<u8> = numbers(&points[..100]).iter().flat_map(|&value| (value as i16).to_be_bytes()).collect();
    scratch.array("0.npy", ">i2", 100, &shorts);
    let doubles: Vec<u8> = numbers(&points[100..400]).iter().flat_map(|&value| (value as f64).to_le_bytes()).collect();
    scratch.array("1.npy", "<f8", 300, &doubles);
    scratch.integers("2.npy", &[]);
    scratch.integers("3.npy", &points[400..]);
    for ranks in [1, 3, 8] {
        let summary = same_mesh(&scratch, ranks, "0.npy 1.npy 2.npy 3.npy", "--points 40");
        assert!(summary["duplicates"].as_u64().is_some_and(|count| count > 0), "{summary}");
    }
}

#[test]
fn halves_and_quarters_have_a_lattice_in_common() {
    let scratch = Scratch::new();
    let points: Vec<[f64; 2]> =
        (0..300u32).map(|k| [f64::from(k * 7 % 41) / 4.0 - 3.0, f64::from(k * k % 53) / 2.0]).collect();
    let bytes = |points: &[[f64; 2]]| -> Vec<u8> {
        points.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect()
    };
    scratch.array("all.npy", "<f8", 300, &bytes(&points));
    scratch.incircle("triangulate @all.npy -o @right.npy -q");
    scratch.array("0.npy", "<f8", 120, &bytes(&points[..120]));
    scratch.array("1.npy", "<f8", 180, &bytes(&points[120..]));
    same_mesh(&scratch, 4, "0.npy 1.npy", "--points 20");
}

#[test]
fn progress_and_summary_come_from_the_first_process() {
    let scratch = Scratch::new();
    scratch.incircle("generate uniform -n 500 -o @p.npy");
    let output = scratch.run(2, "triangulate p.npy -o mesh");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    for step in ["read", "cut", "exchange", "local", "join", "sort", "write"] {
        assert_eq!(text.matches(&format!("{step}: ")).count(), 1, "{text}");
    }
    assert!(text.contains("500 points") && text.contains("2 processes"), "{text}");
    assert!(output.stdout.is_empty() && sentences(&output).is_empty());
}
