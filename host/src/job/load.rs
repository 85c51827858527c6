//! The words of a group, and what its records say.

use incircle_protocol::{
    batch_word, clear_word, command_word, infinite_vertex, Layout, Opcode, COUNTER_WORDS, INSERT_REPORT_WORDS,
};

use super::group::{Group, Ordered};
use super::Batch;
use crate::assemble::{check_last_half, checked_record, Assembly};
use crate::error::DeviceFault;

/// A command of a group: its words, and the words of the payload of its answer.
pub(super) struct Command {
    pub(super) opcode: Opcode,
    pub(super) words: Vec<u32>,
    pub(super) payload: usize,
}

/// A group with its words.
pub(super) struct Load {
    pub(super) group: Group,
    /// Points that are sent, repeated ones included.
    pub(super) points: usize,
    pub(super) commands: Vec<Command>,
}

/// Triangles and hull of a job.
type Assembled = (Vec<[u32; 3]>, Vec<u32>);

impl Batch<'_> {
    fn layout(&self) -> Layout {
        Layout::of(self.identity.coord_bits, self.identity.capacity)
    }

    /// `Clear`, `Insert` and the read-out. A frame has its counters read before its mesh, which ends the job.
    pub(super) fn load(&self, group: Group) -> Load {
        let layout = self.layout();
        let points = group.points(self.jobs);
        let mut insert = Vec::with_capacity(2 + points.len() * layout.point_words);
        insert.extend([command_word(Opcode::Insert), points.len() as u32]);
        for point in &points {
            insert.extend_from_slice(&layout.point_to_words(point.x, point.y)[..layout.point_words]);
        }
        let clear = if group.is_frame { clear_word(group.contexts) } else { batch_word(group.jobs.len() as u32) };
        let mut commands = vec![
            Command { opcode: Opcode::Clear, words: vec![clear], payload: 0 },
            Command { opcode: Opcode::Insert, words: insert, payload: INSERT_REPORT_WORDS },
        ];
        if group.is_frame {
            let words = vec![command_word(Opcode::Counters)];
            commands.push(Command { opcode: Opcode::Counters, words, payload: COUNTER_WORDS });
        }
        let records = group.records();
        let (opcode, payload) = match layout.triangles_words(records as u32) {
            Some(words) if self.link.packs_records() => (Opcode::Triangles, words as usize),
            _ => (Opcode::Read, records * layout.record_words),
        };
        commands.push(Command { opcode, words: vec![command_word(opcode), 0, records as u32], payload });
        Load { group, points: points.len(), commands }
    }

    /// The triangles and the hull of each job from the records of all.
    pub(super) fn assemble(&self, load: &Load, words: &[u32]) -> Result<Vec<Assembled>, DeviceFault> {
        let Load { group, points: sent, .. } = load;
        let (layout, capacity, records) = (self.layout(), self.identity.capacity, group.records());
        let assembly = |ordered| {
            let Ordered { job, prepared }: &Ordered = ordered;
            Assembly::new(&prepared.order, &self.jobs[*job], layout, capacity)
        };
        let mut assemblies: Vec<Assembly<'_>> = group.jobs.iter().map(assembly).collect();
        let is_packed = self.link.packs_records();
        for record in 0..records {
            let v = if is_packed {
                layout.vertices_from_words(words, record)
            } else {
                let width = layout.record_words;
                checked_record(layout, record, &words[record * width..][..width], records)?
            };
            let (job, [a, b, c]) = group.own_vertices(record, v, *sent, infinite_vertex(capacity))?;
            assemblies[job].take_vertices(record, a, b, c)?;
        }
        if is_packed {
            check_last_half(layout, 0, records, words)?;
        }
        assemblies.into_iter().map(Assembly::finish).collect()
    }
}
