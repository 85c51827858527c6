//! The read-out of a mesh that has changed, which skips free records.

use super::answers::Answers;
use crate::clock::memory::Memory;

/// Number of words that wait, at most, when a record is read.
const ROOM: usize = 16;

#[derive(Clone, Debug, Default)]
pub(super) struct Reader {
    /// Whether the payload has only the vertices of the records that are not free.
    packs: bool,
    next: u32,
    left: u32,
    /// Number of records that are not free to be passed over.
    passed_over: u32,
    /// Low half of a word whose high half is still to come.
    half: Option<u32>,
}

impl Reader {
    /// Begins with the record of this number: of all ids, or of those that are not free.
    pub(super) fn start(&mut self, packs: bool, first: u32, count: u32) {
        let (next, passed_over) = if packs { (0, first) } else { (first, 0) };
        *self = Self { packs, next, left: count, passed_over, half: None };
    }

    /// Reads one record, if there is room for its words.
    pub(super) fn clock(&mut self, memory: &Memory, answers: &mut Answers) {
        if self.left == 0 || answers.waiting() >= ROOM {
            return;
        }
        let id = self.next;
        self.next += 1;
        if !self.packs {
            self.left -= 1;
            return answers.extend(&memory.record_words(id));
        }
        let v = memory.record(id).v;
        if v == [memory.infinite; 3] {
            return;
        }
        if self.passed_over > 0 {
            self.passed_over -= 1;
            return;
        }
        self.left -= 1;
        for id in v {
            match self.half.take() {
                Some(low) => answers.extend(&[low | id << 16]),
                None => self.half = Some(id),
            }
        }
        if let Some(low) = self.half.take_if(|_| self.left == 0) {
            answers.extend(&[low]);
        }
    }
}
