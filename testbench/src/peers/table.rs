//! Prints the results: a table for people, objects for scripts.

use serde_json::{json, Map, Value};

use super::arguments::Arguments;
use super::contestant::{Missing, Run};
use super::outcome::Outcome;

/// Widths of the column with the set and of the other columns.
const SET: usize = 16;
const COLUMN: usize = 12;

/// The median of some numbers, or `None` if there are none.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

impl Outcome {
    fn nanoseconds(&self, run: &Run) -> f64 {
        run.seconds * 1e9 / self.points.max(1) as f64
    }

    /// Nanoseconds per point of a contestant.
    fn time(&self, place: usize) -> Option<f64> {
        median(self.runs[place].iter().map(|run| self.nanoseconds(run)).collect())
    }

    /// Nanoseconds per point that the processor spent on one thread.
    fn busy_time(&self, place: usize) -> Option<f64> {
        median(self.runs[place].iter().map(|run| run.busy * 1e9 / self.points.max(1) as f64).collect())
    }

    /// Time of one contestant divided by that of another.
    fn ratio(&self, one: usize, other: usize, time: fn(&Run) -> f64) -> Option<f64> {
        let pairs = self.runs[one].iter().zip(&self.runs[other]);
        median(pairs.map(|(one, other)| time(one) / time(other)).collect())
    }

    /// Number of repetitions in which a contestant found another number of triangles than ours.
    fn differing(&self, place: usize) -> usize {
        let pairs = self.runs[place].iter().zip(&self.runs[0]);
        pairs.filter(|(one, ours)| one.triangles != ours.triangles).count()
    }
}

/// The lines above the rows.
pub(super) fn header(arguments: &Arguments, names: &[&str], missing: &[Missing]) -> String {
    let memory = if arguments.cold { "as the system gives it" } else { "at hand" };
    let mut text = format!(
        "ns per point, medians; {} bits; memory: {memory}; in brackets: cpu with one thread by it\n",
        arguments.bits
    );
    text += "an asterisk: not always as many triangles as ours; order: share of the ordering in cpu with one thread\n";
    for Missing { name, reason } in missing {
        text += &format!("{name}: {reason}\n");
    }
    text += &format!("{:<SET$}{:>9}{:>9}", "set", "points", "distinct");
    for name in names {
        text += &format!("{name:>0$}", COLUMN + 6);
    }
    text + "   order\n"
}

/// The row of an outcome.
pub(super) fn row(outcome: &Outcome) -> String {
    let mut text = format!("{:<SET$}{:>9}{:>9}", outcome.set.to_string(), outcome.points, outcome.distinct);
    for place in 0..outcome.names.len() {
        let time = outcome.time(place).unwrap_or(f64::NAN);
        let mark = if outcome.differing(place) > 0 { "*" } else { "" };
        let ratio = match outcome.ratio(0, place, |run| run.seconds) {
            Some(ratio) if place > 0 => format!("({ratio:.2})"),
            _ => String::new(),
        };
        text += &format!("{:>COLUMN$}{ratio:>6}", format!("{mark}{time:.0}"));
    }
    let order = median(outcome.order_share.clone()).unwrap_or(f64::NAN);
    text + &format!("{:>6.0} %\n", 100.0 * order)
}

/// The JSON object of an outcome.
pub(super) fn json(outcome: &Outcome, missing: &[Missing]) -> String {
    let contestants = outcome.names.iter().enumerate().map(|(place, &name)| {
        let least = outcome.runs[place].iter().map(|run| outcome.nanoseconds(run)).min_by(f64::total_cmp);
        json!({
            "name": name,
            "ns_per_point": outcome.time(place),
            "least_ns_per_point": least,
            "busy_ns_per_point": outcome.busy_time(place),
            "ours_by_it": outcome.ratio(0, place, |run| run.seconds),
            "ours_by_it_busy": outcome.ratio(0, place, |run| run.busy),
            "ours_all_threads_by_it": outcome.ratio(1, place, |run| run.seconds),
            "triangles": outcome.runs[place].last().map(|run| run.triangles),
            "repetitions_with_other_triangles": outcome.differing(place),
        })
    });
    let missing: Map<String, Value> =
        missing.iter().map(|peer| (peer.name.to_owned(), Value::from(peer.reason.as_str()))).collect();
    let object = json!({
        "dist": outcome.set.to_string(),
        "n": outcome.points,
        "distinct": outcome.distinct,
        "bits": outcome.bits,
        "repetitions": outcome.runs[0].len(),
        "cold": outcome.cold,
        "order_share": median(outcome.order_share.clone()),
        "contestants": contestants.collect::<Vec<_>>(),
        "missing": missing,
    });
    format!("{object}\n")
}
