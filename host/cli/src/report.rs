//! What a run says about itself: one JSON object for scripts, a few lines for people.

use std::time::Duration;

use incircle::{Counters, Quantization, Report, Shown};
use serde_json::{json, Map, Value};

use crate::backend::Backend;
use crate::failure::counted;

/// Everything that is reported of one triangulation.
pub struct RunReport<'a> {
    /// The library's report.
    pub job: &'a Report,
    /// Name of the back end and of its configuration.
    pub backend: (&'static str, Option<&'static str>),
    /// Bits of a coordinate of the grid; a core may have more.
    pub coord_bits: u32,
    /// What quantisation did.
    pub quantization: Option<&'a Quantization>,
    /// Seconds of the stages of the command, in the order in which they ran.
    pub stages: Vec<(&'static str, Duration)>,
}

impl<'a> RunReport<'a> {
    /// A report of a job on this back end, the command's own stages still empty.
    pub fn new(job: &'a Report, backend: &Backend, coord_bits: u32, quantization: Option<&'a Quantization>) -> Self {
        Self { job, backend: (backend.name, backend.config), coord_bits, quantization, stages: Vec::new() }
    }

    /// The object that `--json` prints. Cycles are there where the back end has a clock.
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
            "coord_bits": self.coord_bits,
            "capacity": job.capacity,
            "seconds": self.seconds(),
            "quantisation": self.quantization.map(quantization_json),
            "counters": job.counters.as_ref().map(counters_json),
        });
        if backend == "sim" {
            add_cycles(&mut object, job);
        }
        object
    }

    fn seconds(&self) -> Value {
        let seconds = |duration: Duration| Value::from(duration.as_secs_f64());
        let stages = self.stages.iter().map(|&(name, duration)| (name.to_owned(), seconds(duration)));
        let mut object: Map<String, Value> = stages.collect();
        let total = self.stages.iter().map(|&(_, duration)| duration).sum();
        object.insert("total".to_owned(), seconds(total));
        Value::Object(object)
    }

    /// The lines for people: the counts; with `verbose` also times and counters.
    pub fn lines(&self, verbose: bool) -> Vec<String> {
        let job = self.job;
        let mut lines = Vec::new();
        if let Some(q) = self.quantization {
            let ([x, y], merged) = (q.offset, counted(q.merged, "point"));
            lines.push(format!(
                "quantised to {} bits: scale {}, offset ({}, {}), largest error {:.3e}, {merged} fell together",
                q.coord_bits,
                Shown(q.scale),
                Shown(x),
                Shown(y),
                q.largest_error
            ));
        }
        lines.push(self.counts_line());
        if job.collinear {
            let why = if job.distinct < 3 { "fewer than three distinct points" } else { "all points lie on one line" };
            lines.push(format!("no triangles: {why}"));
        }
        if verbose {
            let stages = self.stages.iter().map(|(name, duration)| format!("{name} {:.6} s", duration.as_secs_f64()));
            lines.push(stages.collect::<Vec<_>>().join(", "));
            lines.extend(job.counters.as_ref().map(|counters| counters_json(counters).to_string()));
        }
        lines
    }

    fn counts_line(&self) -> String {
        let job = self.job;
        let total: Duration = self.stages.iter().map(|&(_, duration)| duration).sum();
        let duplicates = match job.duplicates {
            0 => String::new(),
            count => format!(" ({count} of them on the place of an earlier one)"),
        };
        format!(
            "{}{duplicates}, {}, {} on the hull; {}, {:.3} s",
            counted(job.points, "point"),
            counted(job.triangles, "triangle"),
            counted(job.hull, "point"),
            job.backend,
            total.as_secs_f64()
        )
    }
}

/// The cycle counts of a job on a core; zero where the host answered alone.
fn add_cycles(object: &mut Value, job: &Report) {
    let counters = job.counters.unwrap_or_default();
    let cycles = counters.insert_cycles;
    object["cycles"] = cycles.into();
    object["wait_cycles"] = counters.wait_cycles.into();
    object["read_cycles"] = counters.read_cycles.into();
    object["cycles_per_insertion"] = job.cycles_per_insertion().into();
}

/// What quantisation did, as an object.
pub fn quantization_json(quantization: &Quantization) -> Value {
    json!({
        "scale": quantization.scale,
        "offset": quantization.offset,
        "largest_error": quantization.largest_error,
        "merged": quantization.merged,
        "coord_bits": quantization.coord_bits,
    })
}

fn counters_json(counters: &Counters) -> Value {
    json!({
        "insert_cycles": counters.insert_cycles,
        "wait_cycles": counters.wait_cycles,
        "read_cycles": counters.read_cycles,
        "insertions": counters.insertions,
        "duplicates": counters.duplicates,
        "refused": counters.refused,
        "walk_visits": counters.walk_visits,
        "tests": counters.tests,
        "cavity_triangles": counters.cavity_triangles,
        "overflows": counters.overflows,
        "flips": counters.flips,
    })
}
