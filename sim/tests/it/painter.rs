//! The example `hdl/integration/painter` in Verilator, at its video output: every pixel is that of the CPU's mesh,
//! painted here by plain code. The same files pass lint and the checks of yosys.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use incircle::Point;

const POINTS: usize = 128;
const WIDTH: i64 = 256;
const HEIGHT: i64 = 240;
const SCREEN: (usize, usize) = (640, 480);
/// Columns of black to the left of the picture.
const BORDER: usize = 64;

/// A point of the painter: its place, its step, and the value that is painted there.
struct Moving {
    at: [i64; 2],
    step: [i64; 2],
    value: i64,
}

/// The points of the first picture: the corners of the picture, then random ones.
fn first_points() -> Vec<Moving> {
    let mut random = 0x1234_5678_u32;
    let points = (0..POINTS).map(|id| {
        let drawn = random;
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        let bits = |from: u32, count: u32| i64::from(drawn >> from & ((1 << count) - 1));
        let value = bits(24, 8);
        if let Some(at) = [[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]].get(id) {
            return Moving { at: *at, step: [0, 0], value };
        }
        let row = bits(8, 8);
        let at = [bits(0, 8), if row < HEIGHT { row } else { row - 128 }];
        let step = [bits(16, 2), bits(18, 2)].map(|choice| [1, 2, -1, -2][choice as usize]);
        Moving { at, step, value }
    });
    points.collect()
}

/// Moves all points to their places in the next picture.
fn advance(points: &mut [Moving]) {
    for point in points {
        for (axis, size) in [WIDTH, HEIGHT].into_iter().enumerate() {
            let next = point.at[axis] + point.step[axis];
            if (0..size).contains(&next) {
                point.at[axis] = next;
            } else {
                point.step[axis] = -point.step[axis];
            }
        }
    }
}

/// Twice the area of the triangle, positive if its corners stand counter-clockwise.
fn orient2d(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The value of every pixel, row by row. Whether a pixel lies in a triangle is decided on a grid that is a million
/// times as fine, where each pixel is moved a little to the right and less upwards, so that none lies on an edge.
fn values(points: &[Moving]) -> Vec<i64> {
    const FINE: i64 = 1_000_000;
    let set: Vec<Point> = points.iter().map(|point| Point::from(point.at.map(|place| place as u32))).collect();
    let mesh = incircle::triangulate(&set).unwrap();
    let mut values = vec![None; (WIDTH * HEIGHT) as usize];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|id| &points[id as usize]);
        let [a, b, c] = corners.map(|corner| corner.at);
        let fine = [a, b, c].map(|at| at.map(|place| place * FINE));
        for (place, value) in values.iter_mut().enumerate() {
            let pixel = [place as i64 % WIDTH, place as i64 / WIDTH];
            let moved = [pixel[0] * FINE + 1000, pixel[1] * FINE + 1];
            let sides = [0, 1, 2].map(|edge| orient2d(fine[edge], fine[(edge + 1) % 3], moved));
            assert!(!sides.contains(&0), "{pixel:?} was moved off every edge");
            if sides.iter().all(|side| *side > 0) {
                let weights = [orient2d(b, c, pixel), orient2d(c, a, pixel), orient2d(a, b, pixel)];
                let sum: i64 = (0..3).map(|corner| weights[corner] * corners[corner].value).sum();
                assert_eq!(value.replace(sum / orient2d(a, b, c)), None, "two triangles have {pixel:?}");
            }
        }
    }
    values.into_iter().map(|value| value.expect("a triangle has the pixel")).collect()
}

/// Red, green and blue of a value.
fn colour(value: i64) -> [i64; 3] {
    let up = (value % 64) * 4 + value % 64 / 16;
    match value / 64 {
        0 => [0, up, 255],
        1 => [0, 255, 255 - up],
        2 => [up, 255, 0],
        _ => [255, 255 - up, 0],
    }
}

/// The whole screen as numbers, pixel by pixel.
fn screen(values: &[i64]) -> Vec<i64> {
    let picture = BORDER..BORDER + 2 * WIDTH as usize;
    let pixels = (0..SCREEN.1).flat_map(|y| (0..SCREEN.0).map(move |x| (x, y)));
    let pixels = pixels.flat_map(|(x, y)| {
        let place = picture.contains(&x).then(|| (y / 2) * WIDTH as usize + (x - BORDER) / 2);
        place.map_or([0; 3], |place| colour(values[place]))
    });
    pixels.collect()
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

/// The Verilog of the design, without its test bench: the committed core, and the files of the example.
fn sources() -> Vec<PathBuf> {
    let folder = fs::read_dir(file("hdl/integration/painter")).unwrap();
    let mut sources: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
    sources.retain(|path| path.extension().is_some_and(|end| end == "v") && !path.ends_with("bench.v"));
    sources.push(file("hdl/verilog/incircle_small.v"));
    assert!(sources.len() > 5, "{sources:?}");
    sources
}

/// Runs a program, which must end well, and returns what it printed.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(output.status.success(), "{command:?}: {printed}");
    printed
}

/// The numbers of a picture behind its head.
fn numbers(picture: &Path) -> Vec<i64> {
    let text = fs::read_to_string(picture).unwrap();
    let body = text.strip_prefix("P3\n640 480\n255\n").expect("the head of a picture");
    body.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

#[test]
fn every_pixel_is_that_of_the_mesh_of_the_cpu() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("painter");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let mut verilator = Command::new("verilator");
    // The flags of the page.
    verilator.args(["--binary", "--timing", "-Wno-fatal", "-Wno-lint", "-Wno-TIMESCALEMOD"]);
    verilator.args(["--top-module", "painter_bench", "--Mdir"]).arg(folder.join("obj_dir"));
    run(verilator.args(sources()).arg(file("hdl/integration/painter/bench.v")));
    let printed = run(Command::new(folder.join("obj_dir/Vpainter_bench")).arg("+pictures=2").current_dir(&folder));
    assert!(printed.contains("picture_2.ppm has 307200 pixels"), "{printed}");

    // Configuration clears the memory of the picture, so the first screen shows value 0 everywhere.
    let zeros = vec![0; (WIDTH * HEIGHT) as usize];
    assert!(numbers(&folder.join("picture_0.ppm")) == screen(&zeros), "picture 0");
    let mut points = first_points();
    for picture in 1..=2 {
        let found = numbers(&folder.join(format!("picture_{picture}.ppm")));
        let wanted = screen(&values(&points));
        assert_eq!(found.len(), wanted.len(), "picture {picture}");
        let wrong = found.chunks(3).zip(wanted.chunks(3)).position(|(found, wanted)| found != wanted);
        let shown = wrong.map(|place| (place % SCREEN.0, place / SCREEN.0, &found[3 * place..][..3]));
        assert_eq!(shown, None, "picture {picture}: the first wrong pixel");
        advance(&mut points);
    }
}

#[test]
fn the_design_passes_lint_and_the_checks_of_yosys() {
    let package = fs::read_to_string(file("incircle.core")).unwrap();
    let (_, options) = package.split_once("verilator_options: [").expect("options of the target lint");
    let options = options.split(']').next().unwrap().split(", ");
    run(Command::new("verilator").args(options).args(["--lint-only", "--top-module", "painter"]).args(sources()));

    let files: Vec<_> = sources().iter().map(|path| path.display().to_string()).collect();
    let script = format!("read_verilog {}; hierarchy -check -top painter; proc; check -assert", files.join(" "));
    let printed = run(Command::new("yosys").args(["-p", &script]));
    for fault in ["implicitly declared", "Latch inferred"] {
        assert!(!printed.contains(fault), "yosys says {fault:?}");
    }
}
