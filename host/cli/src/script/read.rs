//! Reading scripts: every row is checked, and so is every index.

use incircle::MAX_POINTS;

use super::{Command, Script, ScriptConstraint, ScriptPoint, FORMS};
use crate::failure::{counted, quoted, Exit, Failure};
use crate::memory::Memory;
use crate::points::{Place, PointTable};
use crate::text;

/// Reads a script. Empty rows, and all that follows a `#`, are skipped.
///
/// A row that is no command, a wrong number of values, a coordinate that is not a finite number, an index of a point
/// that is not inserted yet or is deleted, a constraint that is not there, and the deletion of an end of a constraint
/// are refused with the row. Whether constraints cross is found when the script is carried out.
pub fn read(bytes: &[u8], memory: Memory) -> Result<Script, Failure> {
    if bytes.is_empty() {
        return Err(Failure::input(
            "the file is empty: a script without commands is a file with a comment, such as '#'",
        ));
    }
    let places = PointTable::of_rows([2, 3, 4]).within(memory);
    let mut script = Script {
        commands: Vec::new(),
        places,
        points: Vec::new(),
        constraints: Vec::new(),
        rows: Vec::new(),
        most_living: 0,
    };
    let mut living = 0;
    for (row, content) in text::rows(text::without_mark(bytes)?) {
        let mut words = text::words(text::without_comment(content));
        let Some(name) = words.next() else { continue };
        let command = read_command(name, words, row, &mut script)?;
        script.commands.push(command);
        script.rows.push(row);
        match command {
            Command::Insert => living += 1,
            Command::Delete(_) => living -= 1,
            _ => {}
        }
        script.most_living = script.most_living.max(living);
        check_counts(&script, row)?;
    }
    script.places = script.places.complete()?;
    Ok(script)
}

/// Reads a command whose name stands in front of these values, and notes its place and its point.
fn read_command<'a>(
    name: &[u8],
    values: impl Iterator<Item = &'a [u8]>,
    row: usize,
    script: &mut Script,
) -> Result<Command, Failure> {
    let form = FORMS.iter().position(|(known, _)| known.as_bytes() == name).ok_or_else(|| no_command(name, row))?;
    let [a, b, c] = read_values(FORMS[form], values, row)?;
    Ok(match FORMS[form].0 {
        "insert" => {
            script.push_place([a, b], 2, row)?;
            let place = script.last_place();
            script.points.push(ScriptPoint { place, is_living: true, ends: 0 });
            Command::Insert
        }
        "delete" => {
            let index = script.read_index(a, 2, row)?;
            let point = &mut script.points[index as usize];
            if point.ends > 0 {
                return Err(Failure::input(format!(
                    "row {row}: point {index} is an end of a constraint: remove the constraint before"
                )));
            }
            point.is_living = false;
            Command::Delete(index)
        }
        "move" => {
            let index = script.read_index(a, 2, row)?;
            script.push_place([b, c], 3, row)?;
            script.points[index as usize].place = script.last_place();
            Command::Move(index)
        }
        "constrain" => {
            let ends = [script.read_index(a, 2, row)?, script.read_index(b, 3, row)?];
            ends.iter().for_each(|&end| script.points[end as usize].ends += 1);
            script.constraints.push(ScriptConstraint { ends, is_there: true });
            Command::Constrain(ends)
        }
        "unconstrain" => {
            let number = script.read_constraint(a, row)?;
            let ends = script.constraints[number as usize].ends;
            ends.iter().for_each(|&end| script.points[end as usize].ends -= 1);
            script.constraints[number as usize].is_there = false;
            Command::Unconstrain(number)
        }
        name => {
            script.push_place([a, b], 2, row)?;
            if name == "locate" {
                Command::Locate
            } else {
                Command::Nearest
            }
        }
    })
}

/// The failure of a row that begins with no name of a command.
fn no_command(name: &[u8], row: usize) -> Failure {
    let shown = quoted(name);
    Failure::input(format!(
        "row {row}: {shown} is no command: the commands are insert, delete, move, locate, nearest, \
         constrain and unconstrain"
    ))
}

/// The values behind the name of a command, of which there must be as many as its form has.
fn read_values<'a>(
    (name, form): (&str, &str),
    values: impl Iterator<Item = &'a [u8]>,
    row: usize,
) -> Result<[&'a [u8]; 3], Failure> {
    let mut found = [&b""[..]; 3];
    let mut count = 0;
    for value in values {
        if let Some(place) = found.get_mut(count) {
            *place = value;
        }
        count += 1;
    }
    if count != form.split(' ').count() {
        let values = counted(count, "value");
        return Err(Failure::input(format!("row {row} has {values} behind '{name}': the command is '{name} {form}'")));
    }
    Ok(found)
}

/// Refuses more points and places than a triangulation can have.
fn check_counts(script: &Script, row: usize) -> Result<(), Failure> {
    if script.most_living > MAX_POINTS {
        return Err(Failure::new(
            Exit::Capacity,
            format!("row {row}: {MAX_POINTS} points live already, the most that a mesh can have: delete some before"),
        ));
    }
    if script.places.len() > u32::MAX as usize {
        return Err(Failure::new(
            Exit::Capacity,
            format!("row {row}: the script has more than {} places: divide it into several scripts", u32::MAX),
        ));
    }
    Ok(())
}

impl Script {
    /// Adds a place whose x stands in this column of the row.
    fn push_place(&mut self, place: [&[u8]; 2], column: usize, row: usize) -> Result<(), Failure> {
        self.places.set_columns([column, column + 1, column + 2]);
        self.places.push(place, row)
    }

    /// The number of the last place that was added.
    fn last_place(&self) -> u32 {
        // More than 2^32 - 1 places are refused after the row.
        self.places.len().saturating_sub(1) as u32
    }

    /// Reads the index of a living point.
    fn read_index(&self, value: &[u8], column: usize, row: usize) -> Result<u32, Failure> {
        let place = Place::Cell { row, column };
        let index = text::whole(value, "an index", place)?;
        match self.points.get(index as usize) {
            Some(point) if point.is_living => Ok(index),
            Some(_) => Err(Failure::input(format!("{place}: point {index} is deleted: its index is never used again"))),
            None => Err(Failure::input(format!(
                "{place}: there is no point {index}: before this row the script has {}, counted from 0",
                counted(self.points.len(), "insertion")
            ))),
        }
    }

    /// Reads the number of a constraint that is there.
    fn read_constraint(&self, value: &[u8], row: usize) -> Result<u32, Failure> {
        let place = Place::Cell { row, column: 2 };
        let number = text::whole(value, "the number of a constraint", place)?;
        match self.constraints.get(number as usize) {
            Some(own) if own.is_there => Ok(number),
            Some(_) => Err(Failure::input(format!("{place}: constraint {number} is removed already"))),
            None => Err(Failure::input(format!(
                "{place}: there is no constraint {number}: before this row the script has {}, counted from 0",
                counted(self.constraints.len(), "constraint")
            ))),
        }
    }
}
