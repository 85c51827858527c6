//! Tests of the command: tables, files, drawings, and all published figures at once.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

/// A folder that is made for one test and removed with it.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("incircle-research-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::create_dir_all(&folder).expect("the scratch folder can be made");
        Self(folder)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Runs the command with arguments that are separated by spaces.
    fn run(&self, arguments: &str) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_incircle-research"));
        command.args(arguments.split_whitespace()).current_dir(&self.0).stdin(Stdio::null());
        let output = command.output().expect("the command starts");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Run { code: output.status.code(), stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The exit code and the outputs of a run.
#[derive(Debug)]
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    #[track_caller]
    fn ok(self) -> Self {
        assert_eq!(self.code, Some(0), "{self:?}");
        self
    }
}

/// The words of every row, without the lines above the rows.
fn rows(run: &Run, above: usize) -> Vec<Vec<String>> {
    let lines = run.stdout.lines().skip(above);
    lines.map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
}

#[test]
fn orders_are_compared_as_table_csv_and_drawing() {
    let scratch = Scratch::new();
    let run = scratch
        .run("orders uniform parabola -n 300,600 --order hilbert,brio-hilbert,random --csv o.csv --plot o.svg")
        .ok();
    let rows = rows(&run, 2);
    assert_eq!(rows.len(), 2 * 2 * 3);
    let csv = scratch.read("o.csv");
    assert_eq!(csv.lines().next(), Some("set,points,order,order_ns,total_ns,walk,tests,cavity,cycles"));
    assert_eq!(csv.lines().count(), 1 + rows.len());
    for row in &rows {
        assert_eq!(row.len(), 9, "{row:?}");
        let value = |column: usize| row[column].parse::<f64>().unwrap_or_else(|_| panic!("column {column}: {row:?}"));
        assert!((3..9).all(|column| value(column) > 0.0), "{row:?}");
        // Every removed triangle was tested, or is the one at which the walk ended.
        assert!(value(7) <= value(6) + 1.0, "{row:?}");
    }
    // A walk from anywhere is longer than one along a curve.
    let walk = |order: usize| rows[3 + order][5].parse::<f64>().expect("a number");
    assert!(walk(2) > 2.0 * walk(0), "{rows:?}");
    let drawing = scratch.read("o.svg");
    assert!(drawing.starts_with("<svg ") && drawing.matches("<rect").count() == 1 + 2 * rows.len(), "{drawing}");
    // The error comes before any row.
    let one = scratch.run("orders uniform -n 100 --order hilbert --csv o.csv --plot ./o.csv");
    assert!(
        one.code == Some(2) && one.stderr.contains("--csv and --plot") && one.stderr.contains("the same file"),
        "{one:?}"
    );
    assert_eq!(scratch.read("o.csv"), csv);
    assert!(!run.stdout.contains("published"), "{run:?}");
    let wide = scratch.run("orders uniform -n 100 --coord-bits 20 --order hilbert").ok();
    assert!(wide.stdout.lines().last().is_some_and(|line| line.ends_with(" -")), "{wide:?}");
}

/// On sets where each point of a curve conflicts with all earlier triangles, rounds of random samples keep tests few.
/// The tests are counted, so the numbers are the same on every machine.
#[test]
fn plain_hilbert_collapses_on_hard_sets_and_rounds_do_not() {
    let scratch = Scratch::new();
    let run = scratch.run("orders two-chains parabola-inward -n 1024,4096 --order hilbert,brio-hilbert").ok();
    let rows = rows(&run, 2);
    assert_eq!(rows.len(), 2 * 2 * 2, "{run:?}");
    for pair in rows.chunks(2) {
        let tests = [&pair[0][6], &pair[1][6]].map(|text| text.parse::<f64>().expect("a number"));
        assert!(tests[0] > 5.0 * tests[1] && tests[1] < 15.0, "{pair:?}");
    }
}

#[test]
fn guides_shorten_walks_and_the_published_ranking_is_told() {
    let scratch = Scratch::new();
    let orders = "brio-hilbert,briodc-linear,briodc-log-u,input";
    let run = scratch.run(&format!("orders uniform line -n 3000 --order {orders} --csv o.csv")).ok();
    let rows: Vec<Vec<String>> = rows(&run, 2).into_iter().filter(|row| row.len() == 9).collect();
    assert_eq!(rows.len(), 2 * 4, "{run:?}");
    for of_set in rows.chunks(4) {
        let column = |way: usize, column: usize| of_set[way][column].parse::<f64>().expect("a number");
        let walk = |way: usize| column(way, 5);
        // On a line some vertices have many triangles, and a few points are enough to show the effect.
        assert!(walk(1) < 3.3 && walk(1) < walk(0), "{of_set:?}");
        // Both variants give the same order.
        assert_eq!(of_set[1][5..], of_set[2][5..], "{of_set:?}");
        assert!(column(1, 8) > 0.0, "{of_set:?}");
    }
    assert_eq!(scratch.read("o.csv").lines().count(), 1 + rows.len());
    let told = "3000 points, the literature's distributions among the rows: of 3 pairs more than 5 % apart there, ";
    assert!(run.stdout.contains(told), "{run:?}");
    assert!(run.stdout.contains("  briodc-linear"), "{run:?}");
}

#[test]
fn orders_are_drawn() {
    let scratch = Scratch::new();
    scratch.run("draw kuzmin -n 64 --order briodc-linear -o guided.svg").ok();
    let drawing = scratch.read("guided.svg");
    assert!(
        drawing.starts_with("<svg ") && drawing.contains("64 points, kuzmin, in the order briodc-linear"),
        "{drawing}"
    );
    let run = scratch.run("draw kuzmin --order zigzag -o zigzag.svg");
    assert!(run.code == Some(2) && run.stderr.contains("brio-squarified-peano"), "{run:?}");
}

#[test]
fn one_command_makes_all_published_figures() {
    let scratch = Scratch::new();
    let run = scratch.run("figures --table 40 --ranking 60 --walks 80 --out kept").ok();
    for part in
        ["== All orders", "== Published ranking", "5 % apart there", "== Guided walks", "ns a point to order beside"]
    {
        assert!(run.stdout.contains(part), "no {part:?} in {run:?}");
    }
    // The table has random order, 12 curves alone and in rounds, and both variants of BrioDC, on 7 sets.
    assert_eq!(scratch.read("kept/orders.csv").lines().count(), 1 + 7 * 27);
    assert_eq!(scratch.read("kept/ranking.csv").lines().count(), 1 + 5 * 14);
    assert_eq!(scratch.read("kept/walks.csv").lines().count(), 1 + 5 * 2);
    assert!(scratch.read("kept/orders.svg").starts_with("<svg "));
}

/// Every run compares all answers and meshes, and fails where they differ.
#[test]
fn the_mesh_that_lives_answers_as_spade_does() {
    let scratch = Scratch::new();
    for grid in ["", "--grid"] {
        let run = scratch.run(&format!("living -n 400 --commands 150 --block 40 --without-cgal {grid}")).ok();
        assert_eq!(rows(&run, 2).len(), 2 * 4 + 1, "{run:?}");
        assert!(run.stdout.contains("all answers are equal, and so are all meshes"), "{run:?}");
    }
}

/// The tests are counted, so the numbers are the same on every machine.
#[test]
fn ways_to_fill_holes_are_compared_by_their_tests() {
    let run = Scratch::new().run("holes -n 1000 --wheels 5").ok();
    let rows = rows(&run, 1);
    assert!(rows.len() > 12, "{run:?}");
    assert!(run.stdout.contains("wheel, 128 neighbours"), "{run:?}");
    let triangle = rows.iter().find(|row| row[1] == "3").expect("a vertex with three neighbours");
    assert!(triangle.ends_with(&["insertion", "0.0", "+", "0.0", "(0)"].map(str::to_owned)), "{triangle:?}");
}

/// The command compares all meshes and answers, and fails if any differ.
#[test]
fn a_mesh_of_features_stays_on_the_core_from_frame_to_frame() {
    let scratch = Scratch::new();
    let run = || scratch.run("tracks -n 300 --frames 3 --places 100 -k 8").ok();
    let cycles = |run: &Run| -> Vec<Vec<u64>> {
        let numbers = |row: &String| {
            let core = row.split('|').skip(1).take(2).flat_map(str::split_whitespace);
            core.map(|word| word.parse().expect("a number of clocks")).collect()
        };
        run.stdout.lines().skip(4).map(str::to_owned).collect::<Vec<_>>().iter().map(numbers).collect()
    };
    let rows = cycles(&run());
    assert_eq!(rows.len(), 4, "a row for each motion");
    for row in &rows {
        let &[changes, places, read_out, anew] = &row[..] else { panic!("four counts: {row:?}") };
        assert!(changes > 0 && places >= 4 * 100 && read_out >= 2 * 290 && anew > read_out, "{row:?}");
    }
    assert!(3 * rows[2][0] < rows[0][0], "changes of a tenth of the features cost less: {rows:?}");
    assert_eq!(rows, cycles(&run()), "cycles are the same in every run");
}
