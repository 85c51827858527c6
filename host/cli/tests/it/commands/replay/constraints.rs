//! Tests of `constrain` and `unconstrain` in scripts.

use crate::common::Scratch;

/// A kite whose short diagonal the canonical mesh has, with a constraint along the long one.
const KITE: &str = "insert 0 0\ninsert 4 -1\ninsert 8 0\ninsert 4 1\nconstrain 0 2\n";

#[test]
fn constraints_come_and_go_and_verify_knows() {
    let scratch = Scratch::new();
    scratch.write("wall.txt", format!("{KITE}locate 4 0\n"));
    scratch.run("replay wall.txt -o wall.ele --answers a.txt").ok();
    assert_eq!(scratch.read("wall.ele"), "2 3 0\n0 0 1 2\n1 0 2 3\n");
    assert_eq!(scratch.read("a.txt"), "edge 0 2\n");
    scratch.run("verify wall.txt wall.ele --script").ok();
    scratch.run("replay wall.txt -o model.ele --backend model").ok();
    assert_eq!(scratch.read("model.ele"), scratch.read("wall.ele"));
    scratch.write("free.txt", format!("{KITE}unconstrain 0\n"));
    scratch.run("replay free.txt -o free.ele").ok();
    assert_eq!(scratch.read("free.ele"), "2 3 0\n0 0 1 3\n1 1 2 3\n");
    scratch.run("verify free.txt free.ele --script").ok();
    scratch.run("verify wall.txt free.ele --script").fails(1, &["are not the canonical constrained Delaunay"]);
    scratch.run("verify free.txt wall.ele --script").fails(1, &["are not the canonical Delaunay"]);
}

#[test]
fn wrong_constraints_are_told_with_their_rows() {
    let cases = [
        ("constrain 1 3\n", "row 6: constraint 1 (from point 1 to point 3) would cross constraint 0"),
        ("move 1 4 1\nmove 1 4 -1\nconstrain 1 3\n", "row 8: constraint 1"),
        ("insert 4 0\nconstrain 1 3\ndelete 4\n", "row 8: constraint 1 (from point 1 to point 3) would cross"),
        ("delete 2\n", "row 6: point 2 is an end of a constraint: remove the constraint before"),
        ("constrain 0\n", "row 6 has 1 value behind 'constrain': the command is 'constrain I J'"),
        ("constrain 0 9\n", "row 6, column 3: there is no point 9"),
        ("unconstrain 1\n", "row 6, column 2: there is no constraint 1: before this row the script has 1 constraint"),
        ("unconstrain 0\nunconstrain 0\n", "row 7, column 2: constraint 0 is removed already"),
    ];
    for (rows, reason) in cases {
        let scratch = Scratch::new();
        scratch.write("s.txt", format!("{KITE}{rows}"));
        scratch.run("replay s.txt -o m.ele --answers a.txt").fails(3, &["s.txt: ", reason]);
        assert_eq!(scratch.files(), ["s.txt"]);
    }
}
