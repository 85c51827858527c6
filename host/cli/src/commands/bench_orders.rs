//! `incircle bench orders`: what orders of insertion cost and save.

mod ranking;
mod way;

pub use way::Way;

use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use incircle::{Device, Hierarchy, Options, Order, Point, Report};
use incircle_protocol::{CORE_COORD_BITS, LARGE};
use incircle_testkit::Distribution;

use crate::arguments::OrdersArguments;
use crate::commands::generate::{check_count, make};
use crate::failure::Failure;
use crate::grid::failure_of;
use crate::output::{self, Output};

/// The figures of one order on one set.
struct Row {
    set: Distribution,
    /// Points asked for, and distinct ones.
    asked: usize,
    points: usize,
    way: Way,
    /// Nanoseconds per point: to order, and of the whole job on the software model, with guides where the order has them.
    order_ns: f64,
    total_ns: f64,
    /// Of an insertion: triangles visited by the walk, conflict tests, triangles removed.
    walk: f64,
    tests: f64,
    cavity: f64,
    /// Cycles of the largest core, which takes no guides; `None` for a set that it does not hold, and for a way it does not offer.
    cycles: Option<f64>,
}

/// Runs of which the fastest counts.
const RUNS: usize = 3;
const COLUMNS: &str = "set,points,order,order_ns,total_ns,walk,tests,cavity,cycles";

/// Runs the subcommand: a row as soon as it is done; files at the end.
pub fn run(arguments: &OrdersArguments) -> Result<(), Failure> {
    arguments.n.iter().try_for_each(|&n| check_count(n))?;
    let (csv, plot) = files_of(arguments)?;
    let ways = if arguments.orders.is_empty() { Way::usual() } else { arguments.orders.clone() };
    let mut rows: Vec<Row> = Vec::new();
    output::print(&header(arguments))?;
    for &n in &arguments.n {
        for set in sets_of(arguments) {
            let points = make(set, n, arguments.coord_bits, arguments.seed)?;
            let points: Vec<Point> = points.into_iter().map(Point::from).collect();
            for &way in &ways {
                let row = measure(set, &points, way, arguments.coord_bits)?;
                output::print(&row.line())?;
                rows.push(row);
            }
        }
    }
    output::print(&ranking::ranking(&rows))?;
    let csv = csv.map(|file| file.write(|out| out.write_all(to_csv(&rows).as_bytes()))).transpose()?;
    let plot = plot.map(|file| file.write(|out| out.write_all(draw(&rows).as_bytes()))).transpose()?;
    output::finish(csv.into_iter().chain(plot), || Ok(()))
}

/// The files for the figures and for the drawing, which cannot be one.
fn files_of(arguments: &OrdersArguments) -> Result<(Option<Output>, Option<Output>), Failure> {
    let prepare = |path: &Option<PathBuf>| path.as_deref().map(|path| Output::prepare(path, None)).transpose();
    let (csv, plot) = (prepare(&arguments.csv)?, prepare(&arguments.plot)?);
    if csv.as_ref().zip(plot.as_ref()).is_some_and(|(csv, plot)| csv.is_same(plot)) {
        return Err(Failure::usage("--csv and --plot name the same file: choose another file for one"));
    }
    Ok((csv, plot))
}

fn sets_of(arguments: &OrdersArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        let hard = [Distribution::TwoChains, Distribution::ParabolaInward];
        Distribution::LITERATURE.into_iter().chain(hard).collect()
    } else {
        arguments.sets.clone()
    }
}

fn measure(set: Distribution, points: &[Point], way: Way, coord_bits: u32) -> Result<Row, Failure> {
    let (order_ns, (report, total_ns), cycles) = match way {
        Way::Hierarchy => {
            let new = || Ok(Hierarchy::new());
            (0.0, fastest(points.len(), new, |hierarchy| way::by_arrival(hierarchy, points))?, None)
        }
        Way::Ordered(order) => {
            let (_, order_ns) = fastest(points.len(), || Ok(()), |()| Ok(order.order(points)))?;
            let address = format!("model?coord-bits={coord_bits}");
            let open = || Device::open(&address).map_err(|error| failure_of(&error));
            let total = fastest(points.len(), open, |device| triangulate(device, points, order))?;
            let cycles = cycles(points, order, coord_bits, &total.0)?;
            (order_ns, total, cycles)
        }
    };
    let counters = report.counters.unwrap_or_default();
    let mean = |count: u32| f64::from(count) / report.distinct.max(1) as f64;
    Ok(Row {
        set,
        asked: points.len(),
        points: report.distinct,
        way,
        order_ns,
        total_ns,
        walk: mean(counters.walk_visits),
        tests: mean(counters.tests),
        cavity: mean(counters.cavity_triangles),
        cycles,
    })
}

/// Does something three times, each with a thing made for it, and says how many nanoseconds a point the fastest took.
fn fastest<T, R>(
    points: usize,
    make: impl Fn() -> Result<T, Failure>,
    work: impl Fn(&mut T) -> Result<R, Failure>,
) -> Result<(R, f64), Failure> {
    let once = || {
        let mut thing = make()?;
        let since = Instant::now();
        let result = work(&mut thing)?;
        Ok((result, since.elapsed().as_secs_f64() * 1e9 / points.max(1) as f64))
    };
    let mut best = once()?;
    for _ in 1..RUNS {
        let next = once()?;
        best = if next.1 < best.1 { next } else { best };
    }
    Ok(best)
}

/// Triangulates in this order.
fn triangulate(device: &mut Device, points: &[Point], order: Order) -> Result<Report, Failure> {
    let options = Options { order, insert_chunk: points.len(), ..Options::default() };
    let mesh = device.session().and_then(|mut session| session.triangulate_with(points, &options));
    mesh.map(|mesh| mesh.report).map_err(|error| failure_of(&error))
}

/// Cycles of an insertion on the largest core, if it holds the points.
fn cycles(points: &[Point], order: Order, coord_bits: u32, report: &Report) -> Result<Option<f64>, Failure> {
    if report.distinct > LARGE.points as usize || coord_bits > CORE_COORD_BITS {
        return Ok(None);
    }
    let mut device = Device::clock_model(LARGE).map_err(|error| failure_of(&error))?;
    triangulate(&mut device, points, order).map(|report| report.cycles_per_insertion())
}

fn header(arguments: &OrdersArguments) -> String {
    format!(
        "{} bits, seed {}; ns per point to order, and in all on the software model; per insertion: triangles walked, tests, \
         triangles removed, cycles of the core {}, which takes no guides\n{:<15}{:>9}  {:<36}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
        arguments.coord_bits, arguments.seed, LARGE.name, "set", "points", "order", "order", "in all", "walk", "tests",
        "cavity", "cycles"
    )
}

impl Row {
    fn line(&self) -> String {
        let cycles = self.cycles.map_or_else(|| "-".to_owned(), |cycles| format!("{cycles:.2}"));
        format!(
            "{:<15}{:>9}  {:<36}{:>9.1}{:>9.1}{:>9.2}{:>9.2}{:>9.2}{cycles:>9}\n",
            self.set.to_string(),
            self.points,
            self.way.name(),
            self.order_ns,
            self.total_ns,
            self.walk,
            self.tests,
            self.cavity
        )
    }
}

fn to_csv(rows: &[Row]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for row in rows {
        let Row { set, points, way, order_ns, total_ns, walk, tests, cavity, cycles, .. } = row;
        let (name, cycles) = (way.name(), cycles.map_or_else(String::new, |cycles| cycles.to_string()));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{set},{points},{name},{order_ns},{total_ns},{walk},{tests},{cavity},{cycles}");
    }
    text
}

/// Height of a bar, and width of the names and of the longest bar, in pixels.
const BAR: usize = 16;
const NAMES: usize = 240;
const LONGEST: f64 = 360.0;

/// What a column of bars shows: its name, the length of a bar, and the number beside it.
type Column = (&'static str, fn(&Row) -> f64, fn(&Row) -> f64);

const DRAWN: [Column; 2] = [
    ("triangles walked per insertion (bars: square root)", |row| row.walk.sqrt(), |row| row.walk),
    ("ns per point in all", |row| row.total_ns, |row| row.total_ns),
];

/// Where a column begins.
const fn left(column: usize) -> usize {
    NAMES + column * (LONGEST as usize + 80)
}

/// Words in the drawing. Writing to a string cannot fail.
fn say(text: &mut String, x: usize, y: usize, words: &str) {
    let _ = writeln!(text, "<text x=\"{x}\" y=\"{y}\">{words}</text>");
}

/// Bars for each set: walk steps to the left, nanoseconds in all to the right.
fn draw(rows: &[Row]) -> String {
    let groups: Vec<&[Row]> = rows.chunk_by(|one, other| one.set == other.set && one.asked == other.asked).collect();
    let (width, height) = (left(DRAWN.len()), BAR * (rows.len() + 2 * groups.len() + 2));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fdfcf9\"/>\n"
    );
    let mut y = BAR;
    for (column, (name, ..)) in DRAWN.iter().enumerate() {
        say(&mut text, left(column), y, name);
    }
    for group in groups {
        y += 2 * BAR;
        let title = group.first().map_or_else(String::new, |row| format!("{}, {} points", row.set, row.points));
        say(&mut text, 8, y, &title);
        for row in group {
            y += BAR;
            say(&mut text, 16, y, row.way.name());
            draw_bars(&mut text, row, rows, y);
        }
    }
    text + "</svg>\n"
}

/// The bars of one row, as long as its share of the longest of all.
fn draw_bars(text: &mut String, row: &Row, rows: &[Row], y: usize) {
    for (column, (_, length, number)) in DRAWN.iter().enumerate() {
        let longest = rows.iter().map(length).fold(f64::MIN_POSITIVE, f64::max);
        let (x, bar) = (left(column), LONGEST * length(row) / longest);
        let (top, thick) = (y - BAR + 5, BAR - 4);
        let _ = writeln!(text, "<rect x=\"{x}\" y=\"{top}\" width=\"{bar:.1}\" height=\"{thick}\" fill=\"#2a8c98\"/>");
        say(text, x + bar as usize + 4, y, &format!("{:.1}", number(row)));
    }
}
