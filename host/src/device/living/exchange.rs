//! Commands to a device with a mesh that lives, and the checks of its answers.

use std::time::Duration;

use incircle_protocol::{
    infinite_vertex, part_item, part_outcome, Clear, Command, Identity, InsertReport, Layout, Located, Opcode, Outcome,
    RecordRange, RunKind, INSERT_REPORT_WORDS,
};

use crate::device::backend::Backend;
use crate::error::{DeviceFault, Error};
use crate::job::assemble::Assembly;
use crate::job::Options;
use crate::limit::Limit;
use incircle_geometry::Point;

/// Largest number of items of a run, so that a device is not without an answer for long.
const MOST_ITEMS: usize = 1 << 16;

/// A device that takes runs.
pub(super) struct LivingDevice<'d> {
    backend: &'d mut dyn Backend,
    pub(super) identity: Identity,
    layout: Layout,
    timeout: Option<Duration>,
}

/// The answer to an item of a run: its outcome, and the words behind it.
pub(super) type Part = (Outcome, Located);

/// An item of a run. A kind that has no vertex or no point leaves it out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) vertex: u32,
    pub(super) point: Point,
}

impl<'d> LivingDevice<'d> {
    pub(super) fn new(backend: &'d mut dyn Backend, identity: Identity, timeout: Option<Duration>) -> Self {
        Self { backend, identity, layout: Layout::of(identity.coord_bits, identity.capacity), timeout }
    }

    pub(super) fn name(&self) -> String {
        self.backend.name()
    }

    pub(super) fn clocks(&self) -> Option<u64> {
        self.backend.clocks()
    }

    /// Whether the device takes runs of this kind.
    pub(super) fn takes(&self, kind: RunKind) -> bool {
        self.identity.takes(kind)
    }

    /// Makes the mesh of these points, which are different and begin with three that span a triangle. Their vertices
    /// are 0, 1, 2 and so on.
    pub(super) fn load(&mut self, points: &[Point], contexts: u32) -> Result<(), Error> {
        let mut words = Vec::new();
        self.exchange(Command::Clear(Clear::one_mesh(contexts)), points.len(), &mut words)?;
        let mut sent = Vec::with_capacity(points.len() * self.layout.point_words);
        points.iter().for_each(|&point| self.put_point(point, &mut sent));
        self.exchange(Command::insert(&sent, self.layout), points.len(), &mut words)?;
        let report = InsertReport::from_words(first_of::<INSERT_REPORT_WORDS>(&words));
        let (count, records) = (points.len() as u32, 2 * points.len() as u32 - 2);
        for (what, found, expected) in [
            ("points inserted", report.inserted, count),
            ("points arrived", report.arrived, count),
            ("records", report.records, records),
        ] {
            if found != expected {
                return Err(self.distrust(Opcode::Insert, DeviceFault::Count { what, found, expected }));
            }
        }
        Ok(())
    }

    /// Does a run of one item, and returns its answer.
    pub(super) fn ask(&mut self, kind: RunKind, vertex: Option<u32>, point: Option<Point>) -> Result<Part, Error> {
        let item = Item { vertex: vertex.unwrap_or(0), point: point.unwrap_or_default() };
        let mut parts = self.ask_all(kind, &[item])?;
        // Every item has its part: `ask_all` checks that.
        Ok(parts.pop().unwrap_or((Outcome::Missing, Located::default())))
    }

    /// Most items of a run of this kind.
    pub(super) fn most_items(&self, kind: RunKind) -> usize {
        MOST_ITEMS.min(self.backend.run_words() / kind.part_words()).max(1)
    }

    /// Does a run of these items, and returns the answer to each in their order. A change that the device was asked for
    /// twice counts as done if it was done the first time.
    pub(super) fn ask_all(&mut self, kind: RunKind, items: &[Item]) -> Result<Vec<Part>, Error> {
        let mut sent = Vec::with_capacity(items.len() * kind.item_words(self.layout));
        for &Item { vertex, point } in items {
            sent.extend(Some(vertex).filter(|_| kind.has_vertex()));
            if kind.has_point() {
                self.put_point(point, &mut sent);
            }
        }
        let mut words = Vec::new();
        let repeats = self.backend.repeats();
        self.exchange(Command::run(kind, &sent, self.layout), items.len(), &mut words)?;
        let was_repeated = self.backend.repeats() != repeats;
        let mut parts: Vec<Option<Part>> = vec![None; items.len()];
        for part in words.chunks(kind.part_words()) {
            let head = part.first().copied().unwrap_or(u32::MAX);
            let place = parts.get_mut(part_item(head) as usize).filter(|place| place.is_none());
            match (place, Outcome::from_u8(part_outcome(head))) {
                (Some(place), Some(outcome)) => {
                    // The second time the vertex is there already, or gone.
                    let outcome = match (kind, outcome) {
                        (RunKind::InsertAs, Outcome::InUse) | (RunKind::Delete, Outcome::Missing) if was_repeated => {
                            Outcome::Done
                        }
                        _ => outcome,
                    };
                    *place = Some((outcome, Located::from_words(&part[1..])));
                }
                _ => return Err(self.distrust(kind.opcode(), DeviceFault::Part { item: part_item(head), found: head })),
            }
        }
        // As many parts as items have come, and none came twice.
        Ok(parts.into_iter().flatten().collect())
    }

    /// The triangles and the hull of the mesh, in canonical form. `ranks` has the index in `points` of each vertex of
    /// the device that is in the mesh.
    pub(super) fn read(&mut self, ranks: &[Option<u32>], points: &[Point]) -> Result<(Vec<[u32; 3]>, Vec<u32>), Error> {
        let living: Vec<u32> = ranks.iter().copied().flatten().collect();
        let records = 2 * living.len() as u32 - 2;
        let mut words = Vec::new();
        self.exchange(Command::Triangles(RecordRange { first: 0, count: records }), living.len(), &mut words)?;
        self.assemble(ranks, &living, points, &words).map_err(|fault| self.distrust(Opcode::Triangles, fault))
    }

    /// Checks the records in the words, and makes the mesh of them.
    fn assemble(
        &self,
        ranks: &[Option<u32>],
        living: &[u32],
        points: &[Point],
        words: &[u32],
    ) -> Result<(Vec<[u32; 3]>, Vec<u32>), DeviceFault> {
        let infinite = infinite_vertex(self.identity.capacity);
        // The number of each vertex among those that are in the mesh.
        let mut numbers = vec![u32::MAX; ranks.len()];
        let of_living = ranks.iter().zip(&mut numbers).filter(|(rank, _)| rank.is_some());
        of_living.zip(0..).for_each(|((_, place), number)| *place = number);
        let mut assembly = Assembly::new(living, points, self.identity.capacity);
        for record in 0..2 * living.len() - 2 {
            let vertices = self.layout.vertices_from_words(words, record);
            let number = |vertex: u32| match numbers.get(vertex as usize) {
                _ if vertex == infinite => Ok(infinite),
                Some(&number) if number != u32::MAX => Ok(number),
                _ => Err(DeviceFault::VertexOutOfRange { record, vertex, points: living.len() }),
            };
            let [a, b, c] = vertices;
            assembly.take_vertices(record, [number(a)?, number(b)?, number(c)?])?;
        }
        assembly.finish()
    }

    /// Takes a wrong answer as a fault of the device, which is not asked again.
    pub(super) fn distrust(&mut self, opcode: Opcode, fault: DeviceFault) -> Error {
        self.backend.distrust(opcode, fault)
    }

    fn exchange(&mut self, command: Command<&[u32]>, points: usize, words: &mut Vec<u32>) -> Result<(), Error> {
        let usual = || Options::default_timeout(points).saturating_mul(self.backend.slow());
        let limit = Limit::of(self.timeout.unwrap_or_else(usual));
        self.backend.exchange(command, words, limit)
    }

    fn put_point(&self, point: Point, words: &mut Vec<u32>) {
        words.extend(&self.layout.point_to_words(point.x, point.y)[..self.layout.point_words]);
    }
}

/// The first words of a payload, whose length has been checked.
fn first_of<const N: usize>(words: &[u32]) -> [u32; N] {
    std::array::from_fn(|place| words.get(place).copied().unwrap_or(0))
}
