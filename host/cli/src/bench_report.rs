//! The output of `incircle bench`: a table for people, a JSON object for scripts.

use incircle::{Counters, Report, Stage};
use incircle_testkit::Distribution;
use serde_json::{json, Value};

use crate::arguments::BenchArguments;
use crate::failure::counted;
use crate::fit::Fit;
use crate::report::{add_cycles, counters_json, latencies_json, parts_line};

/// The measurement of one set.
pub struct Measured {
    /// The set that was triangulated.
    pub set: Distribution,
    /// The library's report of the run.
    pub report: Report,
    /// Seconds of the whole library call.
    pub seconds: f64,
    /// A line through the times of several sizes, for a board.
    pub fit: Option<Fit>,
}

/// The facts that all rows of a table have in common.
pub struct Bench<'a> {
    /// The arguments of the command.
    pub arguments: &'a BenchArguments,
    /// Bits of a coordinate of the sets.
    pub coord_bits: u32,
    /// Name of the back end.
    pub backend: &'static str,
    /// Name of the configuration of a core in simulation.
    pub config: Option<&'static str>,
    /// Whether the back end counts cycles.
    pub has_clock: bool,
    /// The frequency in MHz that turns cycles into times.
    pub mhz: f64,
    /// Bits per second of the line to a board.
    pub rate: Option<u32>,
    /// Points that the back end holds.
    pub capacity: u32,
    /// Contexts that work, or threads of the back end `cpu`.
    pub contexts: u32,
}

/// Columns of the table of a core, with their widths. Visits and tests are per insertion, ports in per
/// cent of the cycles.
const CORE_COLUMNS: [(&str, usize); 16] = [
    ("points", 7),
    ("cycles", 8),
    ("ms", 8),
    ("visits", 8),
    ("tests", 7),
    ("aborts", 8),
    ("priority", 10),
    ("retries", 9),
    ("issue", 7),
    ("write", 7),
    ("commit", 8),
    ("release", 9),
    ("min", 6),
    ("median", 8),
    ("p99", 7),
    ("max", 7),
];

/// Columns of the table of a back end without a clock, with their widths. Times are in nanoseconds.
const MODEL_COLUMNS: [(&str, usize); 6] =
    [("points", 10), ("ns/point", 10), ("insertion", 11), ("visits", 8), ("tests", 8), ("overflows", 11)];

/// Width of the column with the names of sets.
const SET_WIDTH: usize = 15;

impl Bench<'_> {
    /// The lines above the rows.
    pub fn header(&self) -> String {
        let BenchArguments { n, seed, job, .. } = self.arguments;
        let coord_bits = self.coord_bits;
        let mhz = self.mhz;
        let config = self.config.map_or(String::new(), |config| format!(" {config}"));
        let rate = self.rate.map_or(String::new(), |rate| format!(" at {rate} bits per second"));
        let is_cpu = self.backend == "cpu";
        let contexts = counted(self.contexts as usize, if is_cpu { "thread" } else { "context" });
        let order = if is_cpu { String::new() } else { format!(", order {}", job.order().name()) };
        let about = format!(
            "{}{config}{rate}, {contexts}; sets of {}, {coord_bits} bits, seed {seed}{order}\n",
            self.backend,
            counted(*n as usize, "point")
        );
        if !self.has_clock {
            return about + &line("set", MODEL_COLUMNS.map(|(name, _)| name.to_owned()), MODEL_COLUMNS) + "\n";
        }
        // Each group name ends where the last column of the group ends.
        let groups = [
            (format!("at {mhz} MHz"), 3),
            ("per insertion".to_owned(), 5),
            ("in all".to_owned(), 8),
            ("% of the cycles".to_owned(), 12),
            ("cycles of an insertion".to_owned(), 16),
        ];
        let mut above = String::new();
        for (group, end) in groups {
            let width = SET_WIDTH + CORE_COLUMNS[..end].iter().map(|(_, width)| width).sum::<usize>();
            above += &format!("{group:>0$}", width.saturating_sub(above.len()));
        }
        format!("{about}{above}\n{}\n", line("set", CORE_COLUMNS.map(|(name, _)| name.to_owned()), CORE_COLUMNS))
    }

    /// The row of a set.
    pub fn row(&self, measured: &Measured) -> String {
        let set = measured.set.to_string();
        let row = if self.has_clock {
            line(&set, self.core_cells(&measured.report), CORE_COLUMNS)
        } else {
            line(&set, model_cells(measured), MODEL_COLUMNS)
        };
        let below = parts_line(&measured.report).into_iter().chain(measured.fit.as_ref().map(ToString::to_string));
        below.fold(row, |row, line| format!("{row}\n{:SET_WIDTH$}{line}", ""))
    }

    fn core_cells(&self, report: &Report) -> [String; 16] {
        let counters = report.counters.unwrap_or_default();
        let mean = |count: u32| Some(f64::from(count) / report.distinct as f64);
        let percent = |cycles: u32| Some(100.0 * busy(cycles, &counters)?);
        let latencies = report.latencies.as_ref();
        let latency = |value: Option<u32>| value.map_or_else(nothing, |cycles| cycles.to_string());
        // Counters are missing where the host answered without the device.
        let asked = |text: String| if report.counters.is_some() { text } else { nothing() };
        [
            report.distinct.to_string(),
            shown(report.cycles_per_insertion(), 2),
            asked(shown(Some(1000.0 * self.seconds(&counters)), 3)),
            asked(shown(mean(counters.walk_visits), 2)),
            asked(shown(mean(counters.tests), 2)),
            asked(counters.aborts.to_string()),
            asked(counters.priorities_taken.to_string()),
            asked(counters.root_retries.to_string()),
            shown(percent(counters.issue_cycles), 1),
            shown(percent(counters.write_cycles), 1),
            shown(percent(counters.commit_cycles), 1),
            shown(percent(counters.release_cycles), 1),
            latency(latencies.map(|it| it.min)),
            latency(latencies.map(|it| it.median)),
            latency(latencies.map(|it| it.p99)),
            latency(latencies.map(|it| it.max)),
        ]
    }

    /// Seconds of the insertions at the frequency of the table.
    fn seconds(&self, counters: &Counters) -> f64 {
        counters.insert_cycles as f64 / (self.mhz * 1e6)
    }

    /// The JSON object that `--json` prints.
    pub fn to_json(&self, rows: &[Measured]) -> Value {
        let BenchArguments { n, seed, job, .. } = self.arguments;
        let coord_bits = self.coord_bits;
        let mut object = json!({
            "backend": self.backend,
            "config": self.config,
            "capacity": self.capacity,
            "contexts": self.contexts,
            "order": if self.backend == "cpu" { Value::Null } else { job.order().name().into() },
            "n": n,
            "coord_bits": coord_bits,
            "seed": seed,
            "sets": rows.iter().map(|measured| self.row_json(measured)).collect::<Vec<_>>(),
        });
        if self.has_clock {
            object["mhz"] = self.mhz.into();
        }
        if let Some(rate) = self.rate {
            object["bits_per_second"] = rate.into();
        }
        object
    }

    fn row_json(&self, measured: &Measured) -> Value {
        let report = &measured.report;
        let stage = |stage: Stage| report.stage(stage).map(|duration| duration.as_secs_f64());
        let mut object = json!({
            "set": measured.set.to_string(),
            "distinct": report.distinct,
            "triangles": report.triangles,
            "hull": report.hull,
            "parts": report.parts,
            "seconds": {
                "order": stage(Stage::Order),
                "insert": stage(Stage::Insert),
                "read": stage(Stage::Read),
                "assemble": stage(Stage::Assemble),
                "total": measured.seconds,
            },
            "counters": report.counters.as_ref().map(counters_json),
            "latency": report.latencies.as_ref().map(latencies_json),
        });
        if let Some(fit) = &measured.fit {
            object["fit"] = fit.to_json();
        }
        if self.has_clock {
            let counters = report.counters.unwrap_or_default();
            add_cycles(&mut object, report);
            object["seconds_at_mhz"] = self.seconds(&counters).into();
            object["busy"] = json!({
                "issue": busy(counters.issue_cycles, &counters),
                "write": busy(counters.write_cycles, &counters),
                "commit": busy(counters.commit_cycles, &counters),
                "release": busy(counters.release_cycles, &counters),
            });
        }
        object
    }
}

fn model_cells(measured: &Measured) -> [String; 6] {
    let report = &measured.report;
    let distinct = report.distinct as f64;
    let insertion = report.stage(Stage::Insert).map(|duration| duration.as_secs_f64() * 1e9 / distinct);
    let counters = report.counters;
    let mean = |count: Option<u32>| shown(count.map(|count| f64::from(count) / distinct), 2);
    [
        report.distinct.to_string(),
        shown(Some(measured.seconds * 1e9 / report.points as f64), 1),
        shown(insertion, 1),
        mean(counters.map(|it| it.walk_visits)),
        mean(counters.map(|it| it.tests)),
        counters.map_or_else(nothing, |it| it.overflows.to_string()),
    ]
}

/// The given cycles as a share of the cycles of all insertions; `None` if there are no insertions.
fn busy(cycles: u32, counters: &Counters) -> Option<f64> {
    (counters.insert_cycles > 0).then(|| f64::from(cycles) / counters.insert_cycles as f64)
}

/// The text of a cell without a value.
fn nothing() -> String {
    "-".to_owned()
}

fn shown(value: Option<f64>, decimals: usize) -> String {
    value.filter(|value| value.is_finite()).map_or_else(nothing, |value| format!("{value:.decimals$}"))
}

fn line<const N: usize>(set: &str, cells: [String; N], columns: [(&str, usize); N]) -> String {
    let mut line = format!("{set:<SET_WIDTH$}");
    for (cell, (_, width)) in cells.iter().zip(columns) {
        line += &format!("{cell:>width$}");
    }
    line
}
