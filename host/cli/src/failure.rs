//! How a run can fail: one sentence for the user and an exit code for scripts.

use std::fmt;

use incircle::{Error, ErrorKind};

/// The exit codes of the command; scripts rely on the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// A mesh did not pass verification.
    Rejected = 1,
    /// The command was called wrongly.
    Usage = 2,
    /// A file could not be read or written, or what it says is wrong.
    Input = 3,
    /// The device is not there, or may not be used.
    NoDevice = 4,
    /// The link to the device does not work.
    Link = 5,
    /// The device reported an error or was silent for too long.
    Device = 6,
    /// The device cannot hold the job.
    Capacity = 7,
    /// Interrupted by the user.
    Interrupted = 130,
}

/// A failed run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What scripts see.
    pub exit: Exit,
    /// What people see: one sentence, no newline.
    pub message: String,
}

impl Failure {
    /// A failure with this exit code and this sentence.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: message.into() }
    }

    /// Wrong input, exit code 3.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(Exit::Input, message)
    }

    /// Wrong use of the command, exit code 2.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// The same failure, its sentence opened with the name of the file it is about.
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

/// The exit code of a library error.
pub fn failure_of(error: &Error) -> Failure {
    let exit = match error.kind() {
        ErrorKind::BadInput => Exit::Input,
        ErrorKind::BadChoice => Exit::Usage,
        ErrorKind::DeviceNotFound => Exit::NoDevice,
        ErrorKind::Link => Exit::Link,
        ErrorKind::Capacity => Exit::Capacity,
        ErrorKind::Cancelled => return Failure::new(Exit::Interrupted, "interrupted: nothing was written"),
        // Timeouts, wrong answers, and whatever is added later.
        _ => Exit::Device,
    };
    Failure::new(exit, printable(&error.to_string()))
}

/// Characters of a wrong value that a message quotes.
const QUOTED: usize = 40;

/// A value as messages quote it: in quotes, control characters escaped, cut after 40 characters.
pub fn quoted(value: &[u8]) -> String {
    // Four bytes are the longest character, so the cut loses nothing that would be shown.
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

/// A count and what is counted, in the plural where it is not one.
pub fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// Text that may hold anything, such as a file name, as messages say it: on one line, and without power over the
/// terminal. Control characters, line ends and marks of writing direction are escaped.
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

/// Longest text of a library's own message, in characters.
const LONGEST: usize = 200;

/// The message of a library as one line of bounded length.
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
