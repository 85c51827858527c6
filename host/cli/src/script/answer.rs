//! The answers to the questions of a script, a row each.

use std::io::{self, Write};

use incircle::living::Location;

/// The answer to a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The answer to `locate`.
    Located(Location),
    /// The answer to `nearest`: the index of the point; `None` if no point lives.
    Nearest(Option<u32>),
}

/// Writes answers: `vertex I`, `edge I J`, `triangle I J K` or `outside I J` for a place, `I` for the nearest point,
/// and `none` if there is none.
pub fn write_answers(answers: &[Answer], out: &mut dyn Write) -> io::Result<()> {
    for answer in answers {
        match answer {
            Answer::Located(Location::Vertex(i)) => writeln!(out, "vertex {i}")?,
            Answer::Located(Location::Edge([i, j])) => writeln!(out, "edge {i} {j}")?,
            Answer::Located(Location::Triangle([i, j, k])) => writeln!(out, "triangle {i} {j} {k}")?,
            Answer::Located(Location::Outside([i, j])) => writeln!(out, "outside {i} {j}")?,
            Answer::Nearest(Some(i)) => writeln!(out, "{i}")?,
            Answer::Located(Location::None) | Answer::Nearest(None) => writeln!(out, "none")?,
        }
    }
    Ok(())
}
