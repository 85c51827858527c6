//! The counts and times of a run, as JSON and as a line.

use std::time::Instant;

use serde_json::{json, Map, Value};

use crate::climb::Level;
use crate::folder::file_name;
use crate::world::World;

/// The counts of a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// The number of all points.
    pub points: u64,
    /// The number of points with the place of an earlier one.
    pub duplicates: u64,
    /// The number of points on the hull.
    pub hull: u64,
    /// The number of triangles of each process.
    pub triangles: Vec<u64>,
}

impl Counts {
    /// The number of all triangles.
    pub fn sum(&self) -> u64 {
        self.triangles.iter().sum()
    }

    /// The counts as a JSON object, which the folder of the mesh holds.
    pub fn to_json(&self) -> Value {
        let file = |(rank, count): (usize, &u64)| json!({ "name": file_name(rank), "triangles": count });
        json!({
            "points": self.points,
            "distinct": self.points - self.duplicates,
            "duplicates": self.duplicates,
            "triangles": self.sum(),
            "hull": self.hull,
            "collinear": self.sum() == 0,
            "files": self.triangles.iter().enumerate().map(file).collect::<Vec<_>>(),
        })
    }
}

/// The measurements of the run so far. Only the first process prints.
pub struct Log {
    progress: bool,
    began: Instant,
    since: Instant,
    steps: Vec<Entry>,
}

/// One step of the run.
struct Entry {
    name: &'static str,
    seconds: f64,
    /// The number of bytes that all processes sent to others.
    bytes: u64,
}

impl Log {
    /// Begins to measure.
    pub fn new(progress: bool) -> Self {
        let now = Instant::now();
        Self { progress, began: now, since: now, steps: Vec::new() }
    }

    /// Ends a step, and says so. All processes must call this, and they wait for each other.
    pub fn step(&mut self, world: &World, name: &'static str, what: &str) {
        let bytes = world.sum(&[world.take_sent()])[0];
        let seconds = self.since.elapsed().as_secs_f64();
        self.since = Instant::now();
        self.steps.push(Entry { name, seconds, bytes });
        if self.progress {
            eprintln!("{name}: {what}{seconds:.3} s");
        }
    }

    /// The whole summary as a JSON object.
    pub fn to_json(&self, counts: &Counts, most: u64, levels: &[Level]) -> Value {
        let mut object = counts.to_json();
        let mut seconds: Map<String, Value> =
            self.steps.iter().map(|step| (step.name.to_owned(), step.seconds.into())).collect();
        seconds.insert("total".to_owned(), self.began.elapsed().as_secs_f64().into());
        let bytes: Map<String, Value> =
            self.steps.iter().map(|step| (step.name.to_owned(), step.bytes.into())).collect();
        object["processes"] = counts.triangles.len().into();
        object["most_points"] = most.into();
        object["levels"] = levels.iter().map(|level| level_json(level, counts.points)).collect();
        object["seconds"] = seconds.into();
        object["bytes"] = bytes.into();
        object
    }

    /// The line for people.
    pub fn line(&self, counts: &Counts) -> String {
        let duplicates = match counts.duplicates {
            0 => String::new(),
            count => format!(" ({count} of them with the coordinates of an earlier one)"),
        };
        format!(
            "{} points{duplicates}, {} triangles, {} points on the hull; {} processes, {:.3} s",
            counts.points,
            counts.sum(),
            counts.hull,
            counts.triangles.len(),
            self.began.elapsed().as_secs_f64()
        )
    }
}

fn level_json(level: &Level, points: u64) -> Value {
    json!({
        "regions": level.regions,
        "border": level.border,
        "border_share": level.border as f64 / points.max(1) as f64,
        "open": level.open,
        "bytes": level.bytes,
    })
}
