//! Scripts of changes and questions, for a mesh that lives.
//!
//! A script has a command in each row: `insert X Y`, `delete I`, `move I X Y`, `constrain I J`, `unconstrain C`,
//! `locate X Y` or `nearest X Y`. `I` and `J` are numbers of insertions and `C` is that of a constraint, counted from
//! 0. [`read`](read::read) reads a script and checks it to its end, so that
//! [`play`](play::play), which carries it out, meets no wrong command. [`Recipe`] makes scripts for
//! `incircle generate`.

mod answer;
mod film;
mod film_svg;
mod play;
mod read;
mod recipe;
#[cfg(test)]
mod tests;

use crate::points::PointTable;

pub use answer::{write_answers, Answer};
pub use film::{Film, MOST_FRAMES};
pub use film_svg::write_film;
pub use play::{play, Played};
pub use read::read;
pub use recipe::{Recipe, ScriptWriter};

/// A command of a script. A command with a place has the next one of [`Script::places`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Insert a point.
    Insert,
    /// Delete the point of this index.
    Delete(u32),
    /// Move the point of this index.
    Move(u32),
    /// Say what a place is.
    Locate,
    /// Say which living point is nearest to a place.
    Nearest,
    /// Make the line between the points of these indices a constraint.
    Constrain([u32; 2]),
    /// Remove the constraint of this number.
    Unconstrain(u32),
}

/// The names of the commands with the values behind each, for messages and for counting.
pub const FORMS: [(&str, &str); 7] = [
    ("insert", "X Y"),
    ("delete", "I"),
    ("move", "I X Y"),
    ("locate", "X Y"),
    ("nearest", "X Y"),
    ("constrain", "I J"),
    ("unconstrain", "C"),
];

impl Command {
    /// The position of the command's name in [`FORMS`].
    pub fn form(self) -> usize {
        match self {
            Self::Insert => 0,
            Self::Delete(_) => 1,
            Self::Move(_) => 2,
            Self::Locate => 3,
            Self::Nearest => 4,
            Self::Constrain(_) => 5,
            Self::Unconstrain(_) => 6,
        }
    }

    /// Whether the command has a place.
    pub fn has_place(self) -> bool {
        !matches!(self, Self::Delete(_) | Self::Constrain(_) | Self::Unconstrain(_))
    }
}

/// A script in which every index is that of a living point.
#[derive(Clone, Debug)]
pub struct Script {
    /// The commands, in order.
    pub commands: Vec<Command>,
    /// The places of all commands that have one, in order.
    pub places: PointTable,
    /// The points, by index.
    points: Vec<ScriptPoint>,
    /// The constraints, by number.
    constraints: Vec<ScriptConstraint>,
    /// The row of each command, counted from 1.
    rows: Vec<usize>,
    /// The most points that live at one time.
    pub most_living: usize,
}

/// The end of a point of a script: where it lies at last, and whether it still lives.
#[derive(Clone, Copy, Debug)]
struct ScriptPoint {
    /// The number of its last place.
    place: u32,
    is_living: bool,
    /// The number of ends of constraints that it is.
    ends: u32,
}

/// The ends of a constraint of a script, and whether it is still there at the end.
#[derive(Clone, Copy, Debug)]
struct ScriptConstraint {
    ends: [u32; 2],
    is_there: bool,
}

impl Script {
    /// The number of each command, in the order of [`FORMS`].
    pub fn counts(&self) -> [usize; FORMS.len()] {
        let mut counts = [0; FORMS.len()];
        self.commands.iter().for_each(|command| counts[command.form()] += 1);
        counts
    }

    /// The number of insertions.
    pub fn insertions(&self) -> usize {
        self.points.len()
    }

    /// The indices of the points that live at the end, in rising order.
    pub fn living(&self) -> Vec<u32> {
        (0u32..).zip(&self.points).filter(|(_, point)| point.is_living).map(|(index, _)| index).collect()
    }

    /// Whether a command is about a constraint.
    pub fn has_constraints(&self) -> bool {
        !self.constraints.is_empty()
    }

    /// The constraints that are there at the end. Their ends count the living points, whose indices are given.
    pub fn last_constraints(&self, living: &[u32]) -> Vec<[u32; 2]> {
        let rank = |index: u32| living.partition_point(|&other| other < index) as u32;
        self.constraints.iter().filter(|own| own.is_there).map(|own| own.ends.map(rank)).collect()
    }

    /// The row of a command, counted from 1, which is given by its position.
    pub fn row(&self, command: usize) -> usize {
        self.rows.get(command).copied().unwrap_or_default()
    }

    /// The numbers of the last places of these points, which were inserted.
    pub fn last_places(&self, indices: &[u32]) -> Vec<u32> {
        indices.iter().map(|&index| self.points[index as usize].place).collect()
    }

    /// All points that were inserted, by index, each at its last place.
    pub fn all_points(&self) -> PointTable {
        let places: Vec<u32> = self.points.iter().map(|point| point.place).collect();
        self.places.select(&places)
    }

    /// The points that live at the end, in the order of their indices.
    pub fn living_points(&self) -> PointTable {
        self.places.select(&self.last_places(&self.living()))
    }
}
