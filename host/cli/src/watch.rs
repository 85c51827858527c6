//! A stopwatch for the stages of a command.

use std::time::{Duration, Instant};

use serde_json::{Map, Value};

/// A stopwatch for the stages of a command.
pub struct Watch {
    /// The time at which the stage began that is under way.
    pub since: Instant,
    /// The stages that ended, with the time that each took.
    pub stages: Vec<(&'static str, Duration)>,
}

impl Watch {
    /// Starts the first stage.
    pub fn start() -> Self {
        Self { since: Instant::now(), stages: Vec::new() }
    }

    /// Ends the stage that is under way, gives it its name, and starts the next one.
    pub fn ended(&mut self, stage: &'static str) {
        let now = Instant::now();
        self.stages.push((stage, now - self.since));
        self.since = now;
    }
}

/// The time of all stages.
pub fn total(stages: &[(&'static str, Duration)]) -> Duration {
    stages.iter().map(|&(_, duration)| duration).sum()
}

/// The seconds of each stage by its name, and of all as `total`.
pub fn seconds_json(stages: &[(&'static str, Duration)]) -> Value {
    let seconds = |duration: Duration| Value::from(duration.as_secs_f64());
    let mut object: Map<String, Value> =
        stages.iter().map(|&(name, duration)| (name.to_owned(), seconds(duration))).collect();
    object.insert("total".to_owned(), seconds(total(stages)));
    Value::Object(object)
}
