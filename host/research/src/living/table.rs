//! The table of the comparison.

use super::arguments::LivingArguments;
use super::script::Stage;

/// The times of one stage: seconds a command for each block, in a list for each contestant.
pub(super) struct Times {
    names: Vec<&'static str>,
    seconds: Vec<Vec<f64>>,
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The lines above the rows.
pub(super) fn header(arguments: &LivingArguments) -> String {
    let LivingArguments { n, commands, block, .. } = arguments;
    let kind = if arguments.grid { "a grid of 31 bits" } else { "doubles" };
    format!(
        "{n} uniform points, {kind}; {commands} commands a row, in blocks of {block}; ns a command, medians; in \
         brackets: ours by theirs\n"
    )
}

impl Times {
    pub(super) fn new(names: Vec<&'static str>) -> Self {
        Self { seconds: vec![Vec::new(); names.len()], names }
    }

    /// Notes the time of a command in the next block of a contestant.
    pub(super) fn note(&mut self, place: usize, seconds: f64) {
        self.seconds[place].push(seconds);
    }

    /// Our time by that of a contestant.
    fn ratio(&self, place: usize) -> f64 {
        median(self.seconds[0].iter().zip(&self.seconds[place]).map(|(ours, theirs)| ours / theirs).collect())
    }

    pub(super) fn row(&self, stage: Stage, along_curve: bool) -> String {
        let order = if along_curve { "Hilbert order" } else { "random order" };
        let mut text = format!("{:8} {order:14}", stage.name());
        for (place, name) in self.names.iter().enumerate() {
            let time = 1e9 * median(self.seconds[place].clone());
            text += &format!("  {name} {time:6.0}");
            if place > 0 {
                text += &format!(" ({:.2})", self.ratio(place));
            }
        }
        text + "\n"
    }
}
