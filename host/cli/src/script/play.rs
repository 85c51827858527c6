//! Carrying out a script on a mesh that lives.

use incircle::{living, Error, LivingMesh, PlanePoint};

use super::answer::Answer;
use super::film::Film;
use super::{Command, Script};
use crate::connections::Connections;
use crate::failure::{failure_of, Failure};
use crate::interrupt;
use crate::progress::CountMeter;

/// The number of commands after which an interrupt is noticed and the progress is shown.
const SLICE: usize = 1 << 10;

/// The results of a script.
pub struct Played {
    /// The answers, in the order of the questions.
    pub answers: Vec<Answer>,
    /// The mesh of the living points, which are counted from 0 in the order of their indices; empty if it was not
    /// wanted.
    pub mesh: Connections,
}

/// Carries out a script on a mesh without points. `points` are its places in the numbers in which they are
/// triangulated.
///
/// The frames of the script are added to `film`, if there is one. The mesh at the end is made only if `wants_mesh`.
/// Without a film, the insertions at the start of a script are made in one step, which takes a fraction of the time.
pub fn play<P: PlanePoint>(
    script: &Script,
    points: &[P],
    mesh: &mut impl LivingMesh<P>,
    mut film: Option<&mut Film>,
    wants_mesh: bool,
    meter: &CountMeter,
) -> Result<Played, Failure> {
    let is_insertion = |command: &&Command| **command == Command::Insert;
    let lead = if film.is_some() { 0 } else { script.commands.iter().take_while(is_insertion).count() };
    let last = lead.saturating_sub(1);
    mesh.insert_all(&points[..lead])
        .map_err(|error| failure_at(&error, script, last.min(mesh.next_index() as usize)))?;
    meter.advance(lead as u64);
    let mut answers = Vec::new();
    let mut place = lead;
    let mut done = lead;
    for slice in script.commands[lead..].chunks(SLICE) {
        interrupt::check()?;
        for &command in slice {
            // A deletion has no place and does not look at the point.
            let point = points.get(place).copied();
            if let Some(film) = film.as_deref_mut() {
                film.note(command, place as u32);
            }
            place += usize::from(command.has_place());
            let answer = step(mesh, command, point);
            answers.extend(answer.map_err(|error| refused(&error, script, done))?);
            done += 1;
            if let Some(film) = film.as_deref_mut().filter(|film| film.is_due(done)) {
                film.take(mesh, done).map_err(|error| failure_of(&error))?;
            }
        }
        meter.advance(slice.len() as u64);
    }
    let mesh = if wants_mesh {
        Connections::of_mesh(mesh.mesh().map_err(|error| failure_of(&error))?)
    } else {
        Connections::default()
    };
    Ok(Played { answers, mesh })
}

/// Carries out a command, and returns the answer to a question. `point` is the place of the command, if it has one.
fn step<P: PlanePoint>(
    mesh: &mut impl LivingMesh<P>,
    command: Command,
    point: Option<P>,
) -> Result<Option<Answer>, Error> {
    match (command, point) {
        (Command::Insert, Some(point)) => mesh.insert(point).map(|_| None),
        (Command::Delete(index), _) => mesh.delete(index).map(|()| None),
        (Command::Move(index), Some(point)) => mesh.move_to(index, point).map(|()| None),
        (Command::Locate, Some(point)) => Ok(Some(Answer::Located(mesh.locate(point)?))),
        (Command::Nearest, Some(point)) => Ok(Some(Answer::Nearest(mesh.nearest(point)?))),
        (Command::Constrain([from, to]), _) => mesh.insert_constraint(from, to).map(|_| None),
        (Command::Unconstrain(number), _) => mesh.remove_constraint(number).map(|()| None),
        // The reader gives each such command a place.
        (_, None) => Ok(None),
    }
}

/// The failure of the command with this number, counted from 0. The reader cannot know where constraints cross; the
/// place is left out, because it is in the numbers of the lattice. The reader refuses all else that no triangulation
/// takes, so what is left is a memory that is full, and faults of a device.
fn refused(error: &Error, script: &Script, number: usize) -> Failure {
    let Some([[constraint, a, b], [other, c, d]]) = crossing(error) else {
        return failure_at(error, script, number);
    };
    let row = script.row(number);
    Failure::input(format!(
        "row {row}: constraint {other} (from point {c} to point {d}) would cross constraint {constraint} (from point \
         {a} to point {b}): insert a point at the crossing before, or remove one of the two"
    ))
}

/// Number and ends of both constraints, if the error says that they would cross.
fn crossing(error: &Error) -> Option<[[u32; 3]; 2]> {
    let Error::Living(error) = error else { return None };
    let living::Error::Crossing { constraints: [one, other], ends: [[a, b], [c, d]], .. } = **error else {
        return None;
    };
    Some([[one, a, b], [other, c, d]])
}

/// The failure at the row of this command, or behind the last one.
fn failure_at(error: &Error, script: &Script, number: usize) -> Failure {
    let failure = failure_of(error);
    let place = match script.commands.len() > number {
        true => format!("row {}", script.row(number)),
        false => "at the end".into(),
    };
    Failure { message: format!("{place}: {}", failure.message), ..failure }
}
