//! A core with runs that is driven by command words, with a word offered in every clock.

use incircle_geometry::Point;
use incircle_model::{ClockModel, Inputs, RunCounts};
use incircle_protocol::{part_item, part_outcome, Clear, Command, Config, Layout, Outcome, RunKind};

use crate::orders::Failure;

/// Number of clocks for a word after which a core counts as hung.
const PATIENCE: u64 = 1_000_000;

/// The core.
pub(super) struct Core {
    model: ClockModel,
    layout: Layout,
    /// The clocks of a run and of its items, where the model counts nothing else: that of the hardware.
    clocks_alone: Option<RunCounts>,
}

/// One item of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub vertex: u32,
    pub point: Point,
}

impl Core {
    /// The model of the living engine, or that of the blocks that the hardware has.
    pub(super) fn new(config: Config, is_hardware: bool) -> Result<Self, Failure> {
        let model = ClockModel::new(config).map_err(|refusal| Failure::from(refusal.to_string()))?;
        let model = if is_hardware { model.with_core_runs() } else { model.with_runs() };
        let clocks_alone = is_hardware.then(RunCounts::default);
        Ok(Self { model, layout: Layout::of(16, config.points), clocks_alone })
    }

    /// Makes the mesh of these points, which begin with three that span a triangle.
    pub(super) fn load(&mut self, points: &[Point]) -> Result<(), Failure> {
        let words: Vec<u32> = points.iter().map(|point| point.x | point.y << 16).collect();
        self.exchange(&Command::Clear(Clear::one_mesh(0)))?;
        self.exchange(&Command::insert(words, self.layout)).map(drop)
    }

    /// Does a run, of which every item must have this outcome if one is given. Also gives the vertices that have too
    /// many neighbours to be deleted.
    pub(super) fn run(
        &mut self,
        kind: RunKind,
        items: &[Item],
        outcome: Option<Outcome>,
    ) -> Result<(&RunCounts, Vec<u32>), Failure> {
        let mut words = Vec::with_capacity(2 * items.len());
        for Item { vertex, point } in items {
            words.extend(Some(*vertex).filter(|_| kind.has_vertex()));
            words.extend(Some(point.x | point.y << 16).filter(|_| kind.has_point()));
        }
        let (answer, clocks) = self.exchange(&Command::run(kind, words, self.layout))?;
        let mut refused = Vec::new();
        for part in answer[2..].chunks(kind.part_words()) {
            let found = part_outcome(part[0]);
            if found == Outcome::ManyNeighbors as u8 {
                refused.extend(items.get(part_item(part[0]) as usize).map(|item| item.vertex));
                continue;
            }
            if outcome.is_some_and(|outcome| outcome as u8 != found) {
                return Err(format!("{kind:?}: the outcome {found} of an item").into());
            }
        }
        if let Some(counts) = &mut self.clocks_alone {
            counts.clocks = clocks;
            counts.latencies = self.model.run_latencies().unwrap_or_default().to_vec();
            return Ok((counts, refused));
        }
        let counts = self.model.run_counts().ok_or_else(|| Failure::from("the core has no runs"))?;
        Ok((counts, refused))
    }

    /// Sends a command and takes the words of its answer. Also gives the number of clocks.
    fn exchange(&mut self, command: &Command<Vec<u32>>) -> Result<(Vec<u32>, u64), Failure> {
        let mut words = Vec::new();
        command.encode(&mut words);
        let (mut sent, mut answer, mut idle, mut clocks) = (0, Vec::new(), 0, 0);
        while sent < words.len() || answer.len() < 2 || answer.len() < 2 + answer[1] as usize {
            let outputs = self.model.outputs();
            let offered = words.get(sent).copied();
            answer.extend(outputs.answer_words());
            idle = if outputs.response_valid || outputs.command_ready { 0 } else { idle + 1 };
            if idle > PATIENCE {
                return Err("the core does not answer".into());
            }
            clocks += 1;
            sent += usize::from(offered.is_some() && outputs.command_ready);
            self.model.clock(Inputs {
                reset: false,
                command_valid: offered.is_some(),
                command_data: offered.unwrap_or(0),
                response_ready: true,
            });
        }
        Ok((answer, clocks))
    }
}
