//! The report of a run: one JSON object for scripts, a few lines for people.

use std::time::Duration;

use incircle::{Counters, Latencies, Quantization, Report, Share};
use serde_json::{json, Value};

use crate::backend::Backend;
use crate::failure::counted;
use crate::lattice::Laid;
use crate::planned::Planned;
use crate::watch::{seconds_json, total};

/// The report of one triangulation by the command.
pub struct RunReport<'a> {
    /// The library's report of the job.
    pub job: &'a Report,
    /// Name of the back end and of its configuration. Several back ends have their names joined by " + ".
    pub backend: (&'a str, Option<&'static str>),
    /// Whether the back end counts cycles.
    pub has_clock: bool,
    /// The points with their lattice.
    pub laid: &'a Laid<'a>,
    /// The sentence about what was left out of the points, if anything was.
    pub left_out: Option<String>,
    /// The regions and pieces that constraints made, if there are any.
    pub planned: Option<&'a Planned>,
    /// Seconds of the stages of the command, in the order in which they ran.
    pub stages: Vec<(&'static str, Duration)>,
}

impl<'a> RunReport<'a> {
    /// Makes the report of a job on this back end, with the list of stages still empty.
    pub fn new(job: &'a Report, backend: &Backend, laid: &'a Laid<'a>) -> Self {
        Self {
            job,
            backend: (backend.name, backend.config.map(|config| config.name)),
            has_clock: backend.has_clock(),
            laid,
            left_out: None,
            planned: None,
            stages: Vec::new(),
        }
    }

    /// Makes the report of a job that several back ends shared, with the list of stages still empty.
    pub fn of_several(job: &'a Report, laid: &'a Laid<'a>) -> Self {
        let backend = (&*job.backend, None);
        Self { job, backend, has_clock: false, laid, left_out: None, planned: None, stages: Vec::new() }
    }

    /// The JSON object that `--json` prints. Cycles are part of the object if the back end has a clock.
    pub fn to_json(&self) -> Value {
        let job = self.job;
        let (backend, config) = self.backend;
        let mut object = json!({
            "points": job.points,
            "distinct": job.distinct,
            "duplicates": job.duplicates,
            "triangles": job.triangles,
            "hull": job.hull,
            "collinear": job.collinear,
            "backend": backend,
            "config": config,
            "order": job.order,
            "lattice": self.laid.to_json(),
            "coord_bits": job.coord_bits,
            "capacity": job.capacity,
            "contexts": job.contexts,
            "parts": job.parts,
            "engines": job.engines,
            "stuck_engines": job.stuck_engines,
            "seconds": seconds_json(&self.stages),
            "quantisation": self.laid.quantization().map(quantization_json),
            "counters": job.counters.as_ref().map(counters_json),
            "latency": job.latencies.as_ref().map(latencies_json),
        });
        if let Some(planned) = self.planned {
            object["plan"] = planned.to_json();
        }
        if self.has_clock {
            add_cycles(&mut object, job);
        }
        if !job.shares.is_empty() {
            object["shares"] = job.shares.iter().map(share_json).collect();
        }
        object
    }

    /// The lines for people: the counts, and with `verbose` also times and counters.
    pub fn lines(&self, verbose: bool) -> Vec<String> {
        let job = self.job;
        let mut lines = vec![self.laid.line()];
        lines.extend(self.left_out.clone());
        lines.push(self.counts_line());
        if job.collinear {
            let why = if job.distinct < 3 { "fewer than three distinct points" } else { "all points lie on one line" };
            lines.push(format!("no triangles: {why}"));
        }
        lines.extend(self.planned.map(|planned| planned.line(job.triangles)));
        lines.extend(self.planned.and_then(|planned| planned.snapping).map(|snapping| snapping.line()));
        for engine in &job.stuck_engines {
            lines.push(format!("engine {engine} of the device is stuck: another engine did its job"));
        }
        lines.extend(parts_line(job));
        lines.extend(job.shares.iter().map(share_line));
        if verbose {
            let stages = self.stages.iter().map(|(name, duration)| format!("{name} {:.6} s", duration.as_secs_f64()));
            lines.push(stages.collect::<Vec<_>>().join(", "));
            lines.extend(job.counters.iter().flat_map(|counters| counter_lines(counters, job.distinct)));
            lines.extend(job.latencies.as_ref().map(latency_line));
        }
        lines
    }

    fn counts_line(&self) -> String {
        let job = self.job;
        let duplicates = match job.duplicates {
            0 => String::new(),
            count => format!(" ({count} of them with the coordinates of an earlier one)"),
        };
        format!(
            "{}{duplicates}, {}, {} on the hull; {}, {:.3} s",
            counted(job.points, "point"),
            counted(job.triangles, "triangle"),
            counted(job.hull, "point"),
            job.backend,
            total(&self.stages).as_secs_f64()
        )
    }
}

/// The share of one of several back ends, as a line.
fn share_line(share: &Share) -> String {
    let did = format!("{}: {}, {}", share.device, counted(share.parts, "part"), counted(share.points, "point"));
    match &share.left_out {
        Some(why) => format!("{did}; left out: {why}"),
        None => did,
    }
}

/// The share of one of several back ends, as a JSON object.
fn share_json(share: &Share) -> Value {
    json!({ "backend": share.device, "parts": share.parts, "points": share.points, "left_out": share.left_out })
}

/// The counters of the software model. The others are 0 on a back end without a clock.
const WITHOUT_CLOCK: [&str; 8] =
    ["insertions", "duplicates", "refused", "walk_visits", "tests", "cavity_triangles", "overflows", "flips"];

/// The counters as a table of name, value, and value per insertion. Latencies have a line of their own.
fn counter_lines(counters: &Counters, insertions: usize) -> Vec<String> {
    let has_clock = counters.insert_cycles > 0;
    let is_shown = |name: &str| !name.starts_with("latency") && (has_clock || WITHOUT_CLOCK.contains(&name));
    let named = counters.named().into_iter().filter(|(name, _)| is_shown(name));
    let line = |(name, value): (&str, u64)| {
        let what = name.replace('_', " ");
        format!("  {what:<17} {value:>12} {:>10.3} per insertion", value as f64 / insertions.max(1) as f64)
    };
    named.map(line).collect()
}

fn latency_line(latencies: &Latencies) -> String {
    let Latencies { min, median, p99, max, .. } = latencies;
    format!("  cycles of an insertion: least {min}, half up to {median}, 99 % up to {p99}, most {max}")
}

/// Adds the cycle counts of a job on a core. They are zero if the host answered without the device, and for a set in
/// parts, which has clocks instead.
pub fn add_cycles(object: &mut Value, job: &Report) {
    let counters = job.counters.unwrap_or_default();
    let cycles = counters.insert_cycles;
    object["cycles"] = cycles.into();
    object["wait_cycles"] = counters.wait_cycles.into();
    object["read_cycles"] = counters.read_cycles.into();
    object["cycles_per_insertion"] = job.cycles_per_insertion().into();
    object["clocks"] = job.clocks.into();
    object["clocks_per_point"] = job.clocks_per_point().into();
}

/// The line about the parts of a set; `None` if the set was not cut. With several back ends their lines say the rest.
pub fn parts_line(job: &Report) -> Option<String> {
    let parts = (job.parts > 0).then(|| counted(job.parts, "part"))?;
    if !job.shares.is_empty() {
        return Some(parts);
    }
    let capacity = counted(job.capacity as usize, "point");
    let clocks = job.clocks_per_point().map(|clocks| format!(", {clocks:.2} clocks a point with the read-out"));
    Some(format!("{parts}, on a device of {capacity}{}", clocks.unwrap_or_default()))
}

/// The quantisation as a JSON object.
pub fn quantization_json(quantization: &Quantization) -> Value {
    json!({
        "scale": quantization.scale,
        "offset": quantization.offset,
        "largest_error": quantization.largest_error,
        "merged": quantization.merged,
        "coord_bits": quantization.coord_bits,
    })
}

/// The counters as a JSON object, by name.
pub fn counters_json(counters: &Counters) -> Value {
    counters.named().into_iter().map(|(name, value)| (name.to_owned(), Value::from(value))).collect()
}

/// The largest excess of a percentile over its true value, as a share of the true value. The histogram has eight
/// buckets to an octave.
const RESOLUTION: f64 = 0.125;

/// The latencies of insertions as a JSON object.
pub fn latencies_json(latencies: &Latencies) -> Value {
    json!({
        "insertions": latencies.insertions,
        "min": latencies.min,
        "median": latencies.median,
        "p99": latencies.p99,
        "max": latencies.max,
        "resolution": RESOLUTION,
        "histogram": latencies.histogram,
    })
}
