//! Reading records in parts: links that ask again for what was lost read a range in several questions, and put the
//! payloads together.

use incircle_protocol::{Command, Layout, RecordRange, ShortIds};

/// A command that reads a range of records, and the units in which its range may be divided.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReadOut {
    command: Command<()>,
    range: RecordRange,
    layout: Layout,
    /// Number of records whose payload always ends with a whole word. All parts but the last have a multiple of it.
    step: u32,
}

impl ReadOut {
    /// The read-out of this command; `None` for a command that reads no records.
    pub fn of(command: Command<()>, layout: Layout) -> Option<Self> {
        let (range, step) = match command {
            Command::Read(range) => (range, 1),
            Command::Triangles(range) => (range, 2),
            Command::ShortTriangles(range, _) => (range, ShortIds::WHOLE),
            _ => return None,
        };
        Some(Self { command, range, layout, step })
    }

    pub fn range(&self) -> RecordRange {
        self.range
    }

    /// The command that reads these records in the same form.
    pub fn part<P>(&self, first: u32, count: u32) -> Command<P> {
        let range = RecordRange { first, count };
        match self.command {
            Command::Triangles(_) => Command::Triangles(range),
            Command::ShortTriangles(_, ids) => Command::ShortTriangles(range, ids),
            _ => Command::Read(range),
        }
    }

    /// Number of words of payload of so many records.
    pub fn words(&self, count: u32) -> usize {
        usize::try_from(self.part::<()>(0, count).payload_words(self.layout)).unwrap_or(usize::MAX)
    }

    /// Most records of a part whose payload has at most `words` words. It has one step at least.
    pub fn most(&self, words: usize) -> u32 {
        let steps = words / self.words(self.step).max(1);
        u32::try_from(steps).unwrap_or(u32::MAX).max(1).saturating_mul(self.step)
    }

    /// The word of the payload of the whole range at which the part begins that begins with this record.
    pub fn place(&self, first: u32) -> usize {
        self.words(first.saturating_sub(self.range.first))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_the_whole() {
        let layout = Layout::of(16, 1024);
        let range = RecordRange { first: 7, count: 100 };
        let commands = [ShortIds::Ten, ShortIds::Twelve].map(|ids| Command::ShortTriangles(range, ids));
        for command in [Command::Read(range), Command::Triangles(range)].into_iter().chain(commands) {
            let read_out = ReadOut::of(command, layout).expect("a command that reads records");
            assert_eq!(read_out.range(), range);
            for words in [1, 12, 50, 1000] {
                let most = read_out.most(words);
                let (mut first, end, mut place) = (range.first, range.first + range.count, 0);
                while first < end {
                    let count = most.min(end - first);
                    assert_eq!(read_out.place(first), place, "{command:?}, {words} words, record {first}");
                    assert!(read_out.words(count) <= words.max(read_out.words(read_out.step)));
                    (first, place) = (first + count, place + read_out.words(count));
                }
                assert_eq!(place, command.payload_words(layout) as usize, "{command:?}, {words} words");
            }
        }
        assert!(ReadOut::of(Command::Counters, layout).is_none());
    }
}
