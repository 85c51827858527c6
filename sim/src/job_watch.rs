//! Finds the jobs in a stream of command words, for waveforms of a single job.

use incircle_protocol::{Command, CommandReader, Layout};

/// The meaning of a word for the waveform of the chosen job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moment {
    /// The chosen job begins with this word, its `Clear`.
    Begins,
    /// The next job begins with this word, so the answers of the chosen one are out.
    Ends,
    /// Any other word.
    Other,
}

/// Counts the jobs in the words that a core takes.
#[derive(Debug)]
pub(crate) struct JobWatch {
    /// Number of the chosen job, counted from 1.
    job: u64,
    /// Number of jobs that have begun.
    begun: u64,
    reader: CommandReader,
    /// Words of points that are still to come.
    point_words: u64,
    layout: Layout,
}

impl JobWatch {
    /// Waits for the job of this number, the first being 1, on a core whose points have this layout.
    pub(crate) fn new(job: u64, layout: Layout) -> Self {
        Self { job, begun: 0, reader: CommandReader::default(), point_words: 0, layout }
    }

    /// Notes the next word that the core takes.
    pub(crate) fn take(&mut self, word: u32) -> Moment {
        if self.point_words > 0 {
            self.point_words -= 1;
            return Moment::Other;
        }
        match self.reader.take(word) {
            Some(Ok(Command::Clear(_))) => {
                self.begun += 1;
                match self.begun.checked_sub(self.job) {
                    Some(0) => Moment::Begins,
                    Some(1) => Moment::Ends,
                    _ => Moment::Other,
                }
            }
            Some(Ok(command)) => {
                self.point_words = command.point_words(self.layout);
                Moment::Other
            }
            _ => Moment::Other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::{command_word, Opcode, CORE_COORD_BITS};

    #[test]
    fn points_that_look_like_commands_begin_no_job() {
        let clear = command_word(Opcode::Clear);
        let mut watch = JobWatch::new(2, Layout::of(CORE_COORD_BITS, 8));
        let words = [command_word(Opcode::Hello), clear, command_word(Opcode::Insert), 3, clear, clear, clear, clear];
        let moments: Vec<Moment> = words.iter().map(|&word| watch.take(word)).collect();
        assert_eq!(moments[..7], [Moment::Other; 7]);
        assert_eq!(moments[7], Moment::Begins);
        assert_eq!(watch.take(command_word(Opcode::Counters)), Moment::Other);
        assert_eq!([watch.take(clear), watch.take(clear)], [Moment::Ends, Moment::Other]);
    }
}
