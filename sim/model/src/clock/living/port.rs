//! Takes the words of runs, and of the other commands to a mesh that has changed, and deals their items to the
//! contexts.

use super::context::Context;
use super::item::{Item, Signature};
use super::reader::Reader;
use super::shared::Shared;
use crate::clock::memory::Memory;
use crate::predicate::Point;
use incircle_protocol::{answer_header, signed_header, InsertReport, Opcode, RunKind, Status};

/// Number of items that wait for a context, at most.
pub(super) const DEPTH: usize = 32;

/// The meaning of the next word, or the event that is awaited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Idle,
    /// Number of items.
    Count,
    Items,
    /// The items of a run that is refused are passed over.
    Refused(Status),
    /// The items that have come are being done.
    Settle,
    First,
    Last,
    /// The answer is being given.
    Answer,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Port {
    state: State,
    opcode: u8,
    signature: Signature,
    /// Whether there is a mesh to ask and to change.
    has_mesh: bool,
    /// Number of items that have come; of a run that is refused, of words that are still to come.
    number: u32,
    left: u64,
    /// The first word of an item that has two.
    vertex: Option<u32>,
    first: u32,
    /// Number of contexts that work.
    contexts: usize,
}

impl Port {
    /// Begins a command.
    pub(super) fn begin(&mut self, opcode: Opcode, contexts: usize, has_mesh: bool, signature: Signature) {
        let reads = matches!(opcode, Opcode::Read | Opcode::Triangles);
        let state = if reads { State::First } else { State::Count };
        *self = Self { state, opcode: opcode as u8, signature, has_mesh, contexts, ..Self::default() };
    }

    /// Whether a command is in progress.
    pub(super) fn is_active(&self) -> bool {
        self.state != State::Idle
    }

    /// Number of items that have come.
    pub(super) fn items(&self) -> u32 {
        self.number
    }

    /// Whether a word is taken.
    pub(super) fn is_ready(&self, contexts: &[Context]) -> bool {
        match self.state {
            State::Count | State::First | State::Last | State::Refused(_) => true,
            // An item of two words waits with its first.
            State::Items => contexts[self.context()].items.len() < DEPTH,
            State::Idle | State::Settle | State::Answer => false,
        }
    }

    /// The context of the next item.
    fn context(&self) -> usize {
        self.number as usize % self.contexts
    }

    fn begin_answer(&self, sh: &mut Shared, status: Status, length: u32) {
        let Signature { engine, tag } = self.signature;
        sh.answers.begin(signed_header(answer_header(self.opcode, status), engine, tag), length);
    }

    /// Takes a word.
    pub(super) fn take(&mut self, word: u32, contexts: &mut [Context], sh: &mut Shared, reader: &mut Reader) {
        match self.state {
            State::Count => self.take_count(word, sh),
            State::Items => self.take_item(word, contexts, sh),
            State::Refused(status) => {
                self.left -= 1;
                self.refuse_if_over(status, sh);
            }
            State::First => (self.first, self.state) = (word, State::Last),
            State::Last => self.take_range(word, sh, reader),
            State::Idle | State::Settle | State::Answer => {}
        }
    }

    fn take_count(&mut self, count: u32, sh: &mut Shared) {
        self.left = count.into();
        if sh.replies {
            let length = count.checked_mul(sh.kind.part_words() as u32);
            let item_words = 1 + u64::from(sh.kind.has_vertex() && sh.kind.has_point());
            match length {
                _ if !self.has_mesh => self.state = State::Refused(Status::NoMesh),
                None => self.state = State::Refused(Status::BadRange),
                Some(length) => {
                    self.begin_answer(sh, Status::Ok, length);
                    self.state = if count == 0 { State::Settle } else { State::Items };
                    return;
                }
            }
            self.left *= item_words;
            if let State::Refused(status) = self.state {
                self.refuse_if_over(status, sh);
            }
        } else {
            self.state = if count == 0 { State::Settle } else { State::Items };
        }
    }

    fn refuse_if_over(&mut self, status: Status, sh: &mut Shared) {
        if self.left == 0 {
            self.begin_answer(sh, status, 0);
            self.state = State::Answer;
        }
    }

    fn take_item(&mut self, word: u32, contexts: &mut [Context], sh: &mut Shared) {
        let point = Point { x: word & 0xffff, y: word >> 16 };
        let item = match (sh.kind, self.vertex.take()) {
            // A point of an `Insert` is the next vertex.
            _ if !sh.replies => Item { number: 0, vertex: sh.arrived, point },
            (RunKind::Delete, _) => Item { number: self.number, vertex: word, point },
            (kind, None) if kind.has_vertex() => return self.vertex = Some(word),
            (_, vertex) => Item { number: self.number, vertex: vertex.unwrap_or(u32::MAX), point },
        };
        let context = self.context();
        self.number = self.number.wrapping_add(1);
        self.left -= 1;
        if self.left == 0 {
            self.state = State::Settle;
        }
        if !sh.replies {
            if sh.arrived == sh.config.points {
                sh.refused += 1;
                return;
            }
            sh.arrived += 1;
        }
        contexts[context].items.push_back(item);
        if contexts[context].item.is_none() {
            sh.wake(context);
        }
    }

    fn take_range(&mut self, count: u32, sh: &mut Shared, reader: &mut Reader) {
        let packs = self.opcode == Opcode::Triangles as u8;
        let there = if packs { sh.records - sh.free.len() } else { sh.records };
        self.state = State::Answer;
        if u64::from(self.first) + u64::from(count) > u64::from(there) {
            return self.begin_answer(sh, Status::BadRange, 0);
        }
        let length = if packs { (3 * count).div_ceil(2) } else { 3 * count };
        self.begin_answer(sh, Status::Ok, length);
        reader.start(packs, self.first, count);
    }

    /// Ends the command if its items are done and its answer has been taken.
    pub(super) fn clock(&mut self, is_done: bool, sh: &mut Shared, reader: &mut Reader, memory: &Memory) {
        match self.state {
            State::Settle if is_done && !sh.replies => {
                let report = InsertReport {
                    arrived: sh.arrived,
                    inserted: sh.vertices,
                    duplicates: sh.duplicates,
                    refused: sh.refused,
                    records: sh.records - sh.free.len(),
                };
                let status = if sh.refused == 0 { Status::Ok } else { Status::Full };
                let words = report.to_words();
                self.begin_answer(sh, status, words.len() as u32);
                sh.answers.extend(&words);
                self.state = State::Answer;
            }
            State::Settle if is_done && sh.answers.is_over() => self.state = State::Idle,
            State::Answer => {
                reader.clock(memory, &mut sh.answers);
                if sh.answers.is_over() {
                    self.state = State::Idle;
                }
            }
            _ => {}
        }
    }
}
