//! Failures of a run: one sentence for the user and an exit code for scripts.

use std::fmt;

use incircle::{Error, ErrorKind};

/// The exit codes of the command. Scripts rely on the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// A mesh did not pass verification.
    Rejected = 1,
    /// The arguments of the command were wrong.
    Usage = 2,
    /// A file could not be read or written, or its content is wrong.
    Input = 3,
    /// The device does not exist, or the user may not use it.
    NoDevice = 4,
    /// The link to the device does not work.
    Link = 5,
    /// The device reported an error or was silent for too long.
    Device = 6,
    /// There are more points than a set may have, or a memory cannot hold them: that of the computer, or that of a
    /// device that keeps a mesh.
    Capacity = 7,
    /// The user interrupted the run.
    Interrupted = 130,
}

/// The failure of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The exit code, for scripts.
    pub exit: Exit,
    /// The message, for people: one sentence without a newline.
    pub message: String,
}

impl Failure {
    /// Makes a failure of an exit code and a sentence. Control characters are escaped, because a sentence may quote a
    /// file: names in the header of a PLY file must not control the terminal.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: printable(&message.into()) }
    }

    /// Makes a failure of wrong input, with exit code 3.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(Exit::Input, message)
    }

    /// Makes a failure of wrong arguments, with exit code 2.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// Puts the name of the file before the sentence.
    pub fn in_file(mut self, name: impl fmt::Display) -> Self {
        self.message = format!("{name}: {}", self.message);
        self
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// The failure that stands for an error of the library.
pub fn failure_of(error: &Error) -> Failure {
    let exit = match error.kind() {
        ErrorKind::BadInput => Exit::Input,
        ErrorKind::BadChoice => Exit::Usage,
        ErrorKind::DeviceNotFound => Exit::NoDevice,
        ErrorKind::Link => Exit::Link,
        ErrorKind::Capacity => Exit::Capacity,
        ErrorKind::Cancelled => return Failure::new(Exit::Interrupted, "interrupted: nothing was written"),
        // Timeouts, wrong answers, and kinds that the library adds later.
        _ => Exit::Device,
    };
    // The library counts the jobs of a batch from 0, and the command counts jobs from 1, as for `--trace-job`.
    let told = match error {
        Error::InJob { job, source } => format!("job {} of the batch, counted from 1: {source}", job + 1),
        error => error.to_string(),
    };
    Failure::new(exit, printable(&told))
}

/// Most characters of a wrong value that a message quotes.
const QUOTED: usize = 40;

/// A value as messages show it: in quotes, with control characters escaped, cut after 40 characters.
pub fn quoted(value: &[u8]) -> String {
    // A character has at most four bytes, so the cut removes nothing that would be shown.
    let head = &value[..value.len().min(4 * QUOTED + 4)];
    let text = String::from_utf8_lossy(head);
    let mut characters = text.chars();
    let shown: String = characters.by_ref().take(QUOTED).flat_map(char::escape_debug).collect();
    if characters.next().is_some() || head.len() < value.len() {
        format!("'{shown}…' ({} bytes)", value.len())
    } else {
        format!("'{shown}'")
    }
}

/// A count with its noun, in the plural unless the count is one.
pub fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// Makes arbitrary text, such as a file name, safe for a message: one line that cannot control the terminal. Control
/// characters, line ends and marks of writing direction are escaped.
pub fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        let marks = matches!(character, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        if character.is_control() || marks {
            shown.extend(character.escape_debug());
        } else {
            shown.push(character);
        }
    }
    shown
}

/// Most characters of a message that comes from another library.
const LONGEST: usize = 200;

/// The message of another library as one line of bounded length.
pub fn one_line(message: &str) -> String {
    let words: Vec<&str> = message.split_whitespace().collect();
    let line = words.join(" ");
    match line.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}…", &line[..cut]),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_as_they_are_but_for_what_moves_the_cursor() {
        assert_eq!(printable("Höhe 'a\\b'\u{301}.csv"), "Höhe 'a\\b'\u{301}.csv");
        assert_eq!(printable("a\n\u{1b}[2J\u{9b}\u{202e}b"), "a\\n\\u{1b}[2J\\u{9b}\\u{202e}b");
    }

    #[test]
    fn one_is_not_many() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "point")), ["0 points", "1 point", "2 points"]);
    }

    #[test]
    fn long_values_are_cut() {
        assert_eq!(quoted(b"12a"), "'12a'");
        assert_eq!(quoted(b"a\nb"), "'a\\nb'");
        let long = vec![b'7'; 1_000_000];
        let shown = quoted(&long);
        assert!(shown.len() < 80 && shown.ends_with("(1000000 bytes)"), "{shown}");
    }
}
