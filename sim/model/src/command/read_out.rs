//! The read-out: records become words in windows, as the host takes them.

use super::awaited::{Range, Reading};
use super::CommandModel;
use crate::mesh::Record;
use incircle_protocol::{Opcode, Status};

impl CommandModel {
    /// Begins the read-out of `count` records from the first on, or answers that there are not so many.
    pub(super) fn take_read(&mut self, range: Range, first: u32, count: u32) {
        let (opcode, length, there) = match range {
            Range::Records => {
                let length = count.checked_mul(self.layout.record_words as u32);
                (Opcode::Read, length, self.mesh.records().len() as u32)
            }
            Range::Vertices => (Opcode::Triangles, self.layout.triangles_words(count), self.mesh.live_records()),
            Range::ShortVertices(ids) => {
                (Opcode::Triangles, u32::try_from(ids.words(count)).ok(), self.mesh.live_records())
            }
        };
        match (first.checked_add(count), length) {
            (Some(end), Some(length)) if end <= there => {
                self.begin_answer(opcode as u8, Status::Ok, length);
                self.reading = Reading { range, next: self.id_of(range, first), left: count };
            }
            _ => self.answer(opcode as u8, Status::BadRange, &[]),
        }
    }

    /// Id of the record with this number in the range.
    fn id_of(&self, range: Range, number: u32) -> u32 {
        let records = self.mesh.records();
        if matches!(range, Range::Records) || self.mesh.live_records() as usize == records.len() {
            return number;
        }
        let mut live = records.iter().enumerate().filter(|(_, record)| !self.mesh.is_free(record));
        live.nth(number as usize).map_or(records.len(), |(id, _)| id) as u32
    }

    /// Turns the next records of the range being read into words; false if none is left.
    ///
    /// Only a window is converted at a time, so reading a large mesh takes no memory of the mesh's size. The window has
    /// a multiple of eight records, so that its ids fill whole words.
    pub(super) fn read_on(&mut self) -> bool {
        const WINDOW: u32 = 4096;
        let Reading { range, next, left } = self.reading;
        if left == 0 {
            return false;
        }
        let (count, mut last) = (left.min(WINDOW), next);
        let mesh = &self.mesh;
        let counts = |record: &&Record| matches!(range, Range::Records) || !mesh.is_free(record);
        let window = (next..).zip(&mesh.records()[next as usize..]).filter(|(_, record)| counts(record));
        let window = window.take(count as usize).inspect(|&(id, _)| last = id).map(|(_, record)| record);
        match range {
            Range::Records => {
                for record in window {
                    let words = self.layout.record_to_words(record.v, record.n, false);
                    self.answers.extend(&words[..self.layout.record_words]);
                }
            }
            Range::Vertices => {
                let length = self.layout.triangles_words(count).unwrap_or(0);
                let mut words = vec![0; length as usize];
                for (place, record) in window.enumerate() {
                    self.layout.vertices_to_words(record.v, &mut words, place);
                }
                self.answers.extend(words);
            }
            Range::ShortVertices(ids) => {
                let mut words = vec![0; usize::try_from(ids.words(count)).unwrap_or(0)];
                for (place, record) in window.enumerate() {
                    ids.vertices_to_words(record.v, &mut words, count as usize, place);
                }
                self.answers.extend(words);
            }
        }
        self.reading = Reading { range, next: last + 1, left: left - count };
        true
    }

    /// Converts the rest of the range being read, before another answer or a change of the mesh.
    pub(super) fn finish_reading(&mut self) {
        while self.read_on() {}
    }
}
