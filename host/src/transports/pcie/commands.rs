//! Which answers the words of commands ask for. A card is read for exactly so many bytes, so the driver must know.

use incircle_protocol::{
    command_opcode, Layout, Opcode, COUNTER_WORDS, IDENTITY_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS, PADDING,
};

/// Header and length of an answer.
pub(super) const HEAD_WORDS: u64 = 2;

/// What the next word of the command stream is.
#[derive(Clone, Copy, Debug)]
enum Awaited {
    Command,
    /// The number of points of an `Insert`.
    Points,
    /// So many words of points.
    Coordinates(u64),
    /// The first record of a `Read`, or of `Triangles`.
    First(Opcode),
    /// The number of records.
    Count(Opcode),
}

/// Follows the command stream.
#[derive(Debug)]
pub(super) struct CommandScan {
    layout: Layout,
    awaited: Awaited,
}

impl CommandScan {
    /// At the beginning of a command.
    pub fn new(layout: Layout) -> Self {
        Self { layout, awaited: Awaited::Command }
    }

    /// True if the next word begins a command.
    pub fn is_between_commands(&self) -> bool {
        matches!(self.awaited, Awaited::Command)
    }

    /// Takes any piece of the stream. For every command that ends in it, puts the most words that its answer may have into `answers`.
    pub fn take(&mut self, words: &[u32], answers: &mut Vec<u64>) {
        let mut rest = words;
        while let Some((&word, after)) = rest.split_first() {
            rest = after;
            self.awaited = match self.awaited {
                Awaited::Command => self.begin(word, answers),
                Awaited::Points => self.points(u64::from(word) * self.layout.point_words as u64, answers),
                Awaited::Coordinates(left) => {
                    let here = left.min(1 + rest.len() as u64);
                    // No more than the rest, which is in memory.
                    rest = &rest[here as usize - 1..];
                    self.points(left - here, answers)
                }
                Awaited::First(opcode) => Awaited::Count(opcode),
                Awaited::Count(opcode) => {
                    answers.push(HEAD_WORDS + self.words_of(opcode, word));
                    Awaited::Command
                }
            };
        }
    }

    fn begin(&self, word: u32, answers: &mut Vec<u64>) -> Awaited {
        let payload = match Opcode::from_u8(command_opcode(word)) {
            None if word == PADDING => return Awaited::Command,
            Some(Opcode::Insert) => return Awaited::Points,
            Some(opcode @ (Opcode::Read | Opcode::Triangles)) => return Awaited::First(opcode),
            Some(Opcode::Hello) => IDENTITY_WORDS,
            Some(Opcode::Counters) => COUNTER_WORDS,
            Some(Opcode::Latencies) => LATENCY_BUCKETS,
            Some(Opcode::Clear) | None => 0,
        };
        answers.push(HEAD_WORDS + payload as u64);
        Awaited::Command
    }

    /// What is awaited while so many words of points are.
    fn points(&self, left: u64, answers: &mut Vec<u64>) -> Awaited {
        if left > 0 {
            return Awaited::Coordinates(left);
        }
        answers.push(HEAD_WORDS + INSERT_REPORT_WORDS as u64);
        Awaited::Command
    }

    fn words_of(&self, opcode: Opcode, records: u32) -> u64 {
        match opcode {
            Opcode::Triangles => self.layout.triangles_words(records).map_or(u64::from(u32::MAX), u64::from),
            _ => u64::from(records) * self.layout.record_words as u64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::command_word;

    /// One of every command, with what its answer may have.
    fn commands() -> (Vec<u32>, Vec<u64>) {
        let word = command_word;
        let words = [
            vec![word(Opcode::Hello), word(Opcode::Clear) | 3, word(Opcode::Counters), word(Opcode::Latencies)],
            vec![word(Opcode::Insert), 3, 0x0400_0000, word(Opcode::Hello), 5, word(Opcode::Insert), 0, PADDING],
            vec![word(Opcode::Read), 7, 11, PADDING, PADDING, word(Opcode::Triangles), 0, 11, 0x2a00_0000],
        ];
        (words.concat(), vec![9, 2, 27, 130, 7, 7, 35, 19, 2])
    }

    #[test]
    fn every_command_has_its_answer_however_it_is_cut() {
        let (words, due) = commands();
        for piece in 1..=words.len() {
            let mut scan = CommandScan::new(Layout { point_words: 1, record_words: 3 });
            let mut answers = Vec::new();
            words.chunks(piece).for_each(|piece| scan.take(piece, &mut answers));
            assert_eq!((&answers, scan.is_between_commands()), (&due, true), "{piece}");
        }
    }

    #[test]
    fn wide_devices_have_longer_points_and_records() {
        let mut scan = CommandScan::new(Layout { point_words: 2, record_words: 6 });
        let mut answers = Vec::new();
        scan.take(&[command_word(Opcode::Insert), 2, 0, 0, 0], &mut answers);
        assert!(answers.is_empty() && !scan.is_between_commands());
        scan.take(&[0, command_word(Opcode::Read), 0, 5, command_word(Opcode::Triangles), 0, 5], &mut answers);
        assert_eq!(answers, [7, 32, 17]);
        scan.take(&[command_word(Opcode::Read), 0, u32::MAX], &mut answers);
        assert_eq!(answers[3], 2 + 6 * u64::from(u32::MAX));
    }
}
