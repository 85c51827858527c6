//! Runs on a core with a living engine, beside the model by commands: the same answers and the same mesh.

use super::bench::{Answer, Bench, Hang, Stalls};
use super::Random;
use incircle_model::{ClockModel, CommandModel, LivingDefect};
use incircle_protocol::{
    part_item, part_outcome, Clear, Command, Config, InsertReport, Layout, Outcome, RecordRange, RunKind, Status,
};
use std::collections::BTreeSet;

/// A core with a living engine and the model by commands, with the same mesh.
pub struct Pair {
    pub bench: Bench,
    model: CommandModel,
    layout: Layout,
    /// The place of each vertex, and whether it is in the mesh.
    pub points: Vec<Option<u32>>,
}

/// Why a core and the model part.
#[derive(Clone, Debug)]
pub enum Fault {
    Hang,
    Wrong(String),
}

impl From<Hang> for Fault {
    fn from(_: Hang) -> Self {
        Self::Hang
    }
}

impl Pair {
    pub fn new(config: Config, defect: Option<LivingDefect>) -> Self {
        let core = ClockModel::new(config).expect("a core that can be built");
        Self::of(
            config,
            match defect {
                Some(rule) => core.with_runs_without(rule),
                None => core.with_runs(),
            },
        )
    }

    /// This core and the model by commands.
    pub fn of(config: Config, core: ClockModel) -> Self {
        let mut bench = Bench::new(config);
        bench.core = core;
        let model = CommandModel::new(16, config.points, config.ring).expect("a model that can be built");
        let layout = Layout::of(16, config.points);
        Self {
            bench,
            model: model.with_contexts(config.contexts).with_runs(),
            layout,
            points: vec![None; config.points as usize],
        }
    }

    /// The answers of both to a command, the core's first.
    fn ask(&mut self, command: &Command<Vec<u32>>, stalls: Stalls, random: &mut Random) -> Result<[Answer; 2], Fault> {
        let mut words = Vec::new();
        command.encode(&mut words);
        let limit = 100_000 + 4000 * words.len() as u64;
        let core = self.bench.run(&words, 1, stalls, limit, random)?.swap_remove(0);
        self.model.send(&words);
        let mut answer = vec![0; 2];
        self.model.receive(&mut answer);
        let mut payload = vec![0; answer[1] as usize];
        let mut filled = 0;
        while filled < payload.len() {
            filled += self.model.receive(&mut payload[filled..]);
        }
        let (opcode, status) = (answer[0] as u8, (answer[0] >> 16) as u8);
        if (core.status, core.payload.len()) != (status, payload.len()) {
            return Err(Fault::Wrong(format!("status {} and {} words", core.status, core.payload.len())));
        }
        Ok([core, Answer { opcode, status, payload }])
    }

    /// Inserts points into an empty mesh.
    ///
    /// # Errors
    /// The core hangs, or answers otherwise than the model.
    pub fn load(&mut self, points: &[u32], contexts: u32) -> Result<(), Fault> {
        let (stalls, random) = (Stalls::default(), &mut Random(0));
        self.ask(&Command::Clear(Clear::one_mesh(contexts)), stalls, random)?;
        self.points.fill(None);
        self.insert(points, stalls, random)
    }

    /// Inserts points with an `Insert`.
    ///
    /// # Errors
    /// The core hangs, or answers otherwise than the model.
    pub fn insert(&mut self, points: &[u32], stalls: Stalls, random: &mut Random) -> Result<(), Fault> {
        let [core, model] = self.ask(&Command::insert(points.to_vec(), self.layout), stalls, random)?;
        if core.payload != model.payload {
            return Err(Fault::Wrong(format!("reports {:?} and {:?}", core.payload, model.payload)));
        }
        let report = InsertReport::from_words(core.payload[..].try_into().expect("a report"));
        let first = report.arrived as usize - points.len();
        for (place, &point) in points.iter().enumerate() {
            let is_new = !self.points.contains(&Some(point));
            self.points[first + place] = Some(point).filter(|_| is_new);
        }
        Ok(())
    }

    /// Does a run, and compares the answers of both, item by item.
    ///
    /// # Errors
    /// The core hangs, or answers otherwise than the model.
    pub fn run(
        &mut self,
        kind: RunKind,
        items: &[u32],
        stalls: Stalls,
        random: &mut Random,
    ) -> Result<Vec<Outcome>, Fault> {
        let [core, model] = self.ask(&Command::run(kind, items.to_vec(), self.layout), stalls, random)?;
        if core.status != Status::Ok as u8 {
            return Ok(Vec::new());
        }
        let words = kind.part_words();
        let mut outcomes = Vec::new();
        let mut parts: Vec<&[u32]> = core.payload.chunks(words).collect();
        parts.sort_by_key(|part| part_item(part[0]));
        for (number, (part, expected)) in parts.iter().zip(model.payload.chunks(words)).enumerate() {
            if meaning(part) != meaning(expected) {
                return Err(Fault::Wrong(format!("{kind:?} {number}: {part:x?} and not {expected:x?}")));
            }
            outcomes.extend(Outcome::from_u8(part_outcome(part[0])));
        }
        self.note(kind, items, &outcomes);
        Ok(outcomes)
    }

    /// Takes note of the changes of a run.
    fn note(&mut self, kind: RunKind, items: &[u32], outcomes: &[Outcome]) {
        for (item, &outcome) in items.chunks(kind.item_words(self.layout)).zip(outcomes) {
            let point = match (kind, outcome) {
                (RunKind::Delete, Outcome::Done) | (RunKind::Move, Outcome::Duplicate) => None,
                (RunKind::InsertAs | RunKind::Move, Outcome::Done) => Some(item[1]),
                _ => continue,
            };
            self.points[item[0] as usize] = point;
        }
    }

    /// Reads both meshes and compares their triangles.
    ///
    /// # Errors
    /// The core hangs, or its mesh is another one.
    pub fn check(&mut self) -> Result<(), Fault> {
        let count = self.points.iter().flatten().count() as u32;
        if count < 3 {
            return Ok(());
        }
        let records = 2 * count - 2;
        let command = Command::Triangles(RecordRange { first: 0, count: records });
        let [core, model] = self.ask(&command, Stalls::default(), &mut Random(0))?;
        if core.status != Status::Ok as u8 {
            return Err(Fault::Wrong(format!("no {records} records")));
        }
        let triangles = [core, model].map(|answer| {
            let at = |record| self.layout.vertices_from_words(&answer.payload, record);
            (0..records as usize).map(at).map(turned).collect::<BTreeSet<_>>()
        });
        if triangles[0] != triangles[1] || triangles[0].len() != records as usize {
            return Err(Fault::Wrong("another mesh".into()));
        }
        let is_locked = |id| self.bench.core.lock_holder(id).is_some();
        match (0..2 * self.bench.config.points).find(|&id| is_locked(id)) {
            Some(id) => Err(Fault::Wrong(format!("the lock of record {id} is left"))),
            None => Ok(()),
        }
    }
}

/// A triangle with its lowest vertex first.
fn turned(mut triangle: [u32; 3]) -> [u32; 3] {
    let lowest = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
    triangle.rotate_left(lowest);
    triangle
}

/// The meaning of a part, whatever the order of its vertices.
fn meaning(part: &[u32]) -> (u32, Vec<(u32, u64)>) {
    let is_ordered = part_outcome(part[0]) == Outcome::Outside as u8 || part.len() == 2;
    let weight = |slot: usize| match part.get(4 + 2 * slot..6 + 2 * slot) {
        Some(words) => u64::from(words[0]) | u64::from(words[1]) << 32,
        None => 0,
    };
    let vertices = part[1..].iter().take(3);
    let mut named: Vec<(u32, u64)> = vertices.enumerate().map(|(slot, &vertex)| (vertex, weight(slot))).collect();
    if part_outcome(part[0]) == Outcome::Triangle as u8 {
        let lowest = (0..3).min_by_key(|&k| named[k].0).unwrap_or(0);
        named.rotate_left(lowest);
    } else if !is_ordered {
        // Of two triangles that hold a place on an edge either may be weighed: the weights have the same ratio.
        let divisor = named.iter().fold(0, |divisor, &(_, weight)| gcd(divisor, weight)).max(1);
        named.iter_mut().for_each(|(_, weight)| *weight /= divisor);
        named.sort_unstable();
    }
    (part[0], named)
}

fn gcd(a: u64, b: u64) -> u64 {
    match b {
        0 => a,
        _ => gcd(b, a % b),
    }
}
