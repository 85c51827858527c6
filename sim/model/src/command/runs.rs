//! Runs: questions and changes of a mesh that stands, item by item.

use super::awaited::{Awaited, Run, MOST_ITEM_WORDS};
use super::CommandModel;
use crate::predicate::Point;
use incircle_protocol::{part_head, Located, Outcome, RunKind, Status};

/// An item: its vertex and its point, as far as its kind has them.
struct Item {
    vertex: u32,
    point: Option<Point>,
}

impl CommandModel {
    /// Begins a run of `count` items. The head of the answer is sent now if there is something to answer.
    pub(super) fn begin_run(&mut self, kind: RunKind, count: u32) {
        let length = count.checked_mul(kind.part_words() as u32);
        let refusal = match length {
            _ if !self.mesh.can_change() => Some(Status::NoMesh),
            None => Some(Status::BadRange),
            Some(length) => {
                self.begin_answer(kind.opcode() as u8, Status::Ok, length);
                None
            }
        };
        self.await_items(Run { kind, done: 0, left: count, refusal, words: [0; MOST_ITEM_WORDS], filled: 0 });
    }

    fn await_items(&mut self, run: Run) {
        self.awaited = Awaited::Items(run);
        if run.left == 0 {
            self.awaited = Awaited::Command;
            if let Some(status) = run.refusal {
                self.answer(run.kind.opcode() as u8, status, &[]);
            }
        }
    }

    /// Takes the next word of an item, and does the item if it is complete.
    pub(super) fn take_item_word(&mut self, mut run: Run, word: u32) {
        run.words[run.filled] = word;
        run.filled += 1;
        if run.filled == run.kind.item_words(self.layout) {
            if run.refusal.is_none() {
                self.do_item(run.kind, run.done, &run.words);
            }
            (run.done, run.left, run.filled) = (run.done.wrapping_add(1), run.left - 1, 0);
        }
        self.await_items(run);
    }

    /// Carries out an item and answers it.
    fn do_item(&mut self, kind: RunKind, number: u32, words: &[u32; MOST_ITEM_WORDS]) {
        let Item { vertex, point } = self.item(kind, words);
        match (kind, point) {
            (RunKind::Delete, _) => {
                let changed = self.mesh.delete(vertex);
                self.give_vertex(number, changed);
            }
            (RunKind::InsertAs, Some(point)) => {
                let changed = self.mesh.insert_as(vertex, point);
                self.give_vertex(number, changed);
            }
            (RunKind::Move, Some(point)) => {
                let changed = self.mesh.move_to(vertex, point);
                self.give_vertex(number, changed);
            }
            (RunKind::Nearest, Some(point)) => {
                let nearest = self.mesh.nearest(point);
                self.give_vertex(number, (Outcome::Vertex, nearest));
            }
            (RunKind::Locate | RunKind::Interpolate, Some(point)) => {
                let (outcome, located) = self.mesh.look_at(point);
                self.give(kind, number, outcome, &located.to_words());
            }
            (_, None) => self.give_off_grid(kind, number, vertex),
        }
    }

    /// Answers an item whose point is off the grid. The vertex of an item is looked at first.
    fn give_off_grid(&mut self, kind: RunKind, number: u32, vertex: u32) {
        let refusal = match kind {
            RunKind::InsertAs => self.mesh.refuses_new(vertex),
            RunKind::Move if !self.mesh.has_vertex(vertex) => Some(Outcome::Missing),
            _ => None,
        };
        let words = Located { vertices: [vertex, 0, 0], weights: [0; 3] }.to_words();
        self.give(kind, number, refusal.unwrap_or(Outcome::OffGrid), &words);
    }

    fn give_vertex(&mut self, number: u32, (outcome, vertex): (Outcome, u32)) {
        self.answers.extend([part_head(number, outcome), vertex]);
    }

    /// Answers an item with the first of these words, as many as its kind has.
    fn give(&mut self, kind: RunKind, number: u32, outcome: Outcome, words: &[u32]) {
        self.answers.push_back(part_head(number, outcome));
        self.answers.extend(&words[..kind.part_words() - 1]);
    }

    /// The item in these words. There is no point if the kind has none or a coordinate has too many bits.
    fn item(&self, kind: RunKind, words: &[u32; MOST_ITEM_WORDS]) -> Item {
        let (vertex, at) = if kind.has_vertex() { (words[0], 1) } else { (0, 0) };
        let [x, y] = match self.layout.point_words {
            1 => [words[at] & 0xffff, words[at] >> 16],
            _ => [words[at], words.get(at + 1).copied().unwrap_or(0)],
        };
        let is_on_grid = (x | y) >> self.identity.coord_bits == 0;
        Item { vertex, point: (kind.has_point() && is_on_grid).then_some(Point { x, y }) }
    }
}
