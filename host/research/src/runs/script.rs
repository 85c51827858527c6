//! The runs of one table row after another, on one set of points.

use std::collections::HashSet;

use incircle_geometry::order::{brio_hilbert, hilbert};
use incircle_geometry::{orient2d, Point, Triangulation};
use incircle_model::RunCounts;
use incircle_protocol::{Outcome, RunKind};
use incircle_testkit::{generate, Distribution, SplitMix64};

use super::arguments::RunsArguments;
use super::core::{Core, Item};
use crate::orders::Failure;

/// Side of the grid.
const SIDE: u32 = 1 << 16;

/// The sums of the runs of a row.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub items: usize,
    pub clocks: u64,
    pub visits: u64,
    pub walk_visits: u64,
    pub writes: u64,
    pub aborts: u64,
    pub in_place: u64,
    pub latencies: Vec<u32>,
    /// The vertices that have too many neighbours to be deleted.
    pub refused: HashSet<u32>,
}

impl Tally {
    fn add(&mut self, items: usize, counts: &RunCounts, refused: Vec<u32>) {
        self.refused.extend(refused);
        self.items += items;
        self.clocks += counts.clocks;
        self.visits += counts.visits;
        self.walk_visits += counts.walk_visits;
        self.writes += counts.writes;
        self.aborts += counts.aborts;
        self.in_place += counts.moved_in_place;
        self.latencies.extend(&counts.latencies);
    }
}

/// Takes a row.
type Give<'g> = &'g mut dyn FnMut(&str, &Tally) -> Result<(), Failure>;

pub(super) struct Script<'a> {
    arguments: &'a RunsArguments,
    along_curve: bool,
    core: Core,
    /// The place of each vertex. The first three span a triangle, and stay.
    points: Vec<Point>,
    random: SplitMix64,
    /// The items of the next run go backwards along the curve, as the host has those of every second run. The model of
    /// the living engine expects all runs to go forwards, and so it is not given any that go backwards.
    backwards: bool,
}

impl<'a> Script<'a> {
    pub(super) fn new(
        arguments: &'a RunsArguments,
        set: Distribution,
        along_curve: bool,
        mut core: Core,
    ) -> Result<Self, Failure> {
        let made = generate(set, arguments.n as usize, 16, arguments.seed)?;
        let mut seen = HashSet::new();
        let all: Vec<Point> = made.into_iter().map(Point::from).filter(|&point| seen.insert(point)).collect();
        let mut points: Vec<Point> = brio_hilbert(&all).into_iter().map(|index| all[index as usize]).collect();
        let spans = |&place: &usize| orient2d(points[0], points[1], points[place]) != 0;
        let third = (2..points.len()).find(spans).ok_or("all points lie on one line")?;
        points.swap(2, third);
        core.load(&points)?;
        let random = SplitMix64::new(arguments.seed + 1);
        Ok(Self { arguments, along_curve, core, points, random, backwards: false })
    }

    pub(super) fn run(&mut self, give: Give) -> Result<(), Failure> {
        let places = self.places();
        // The contexts come to their stretches of the curve in a run that is not counted.
        let items = places.iter().map(|&point| Item { vertex: 0, point }).collect();
        self.tally(RunKind::Locate, items, None)?;
        for kind in [RunKind::Locate, RunKind::Interpolate, RunKind::Nearest] {
            let items = places.iter().map(|&point| Item { vertex: 0, point }).collect();
            give(&format!("{kind:?}"), &self.tally(kind, items, None)?)?;
        }
        for percent in [2, 5, 10] {
            let items = self.moves(percent);
            for Item { vertex, point } in &items {
                self.points[*vertex as usize] = *point;
            }
            give(&format!("Move {percent} %"), &self.tally(RunKind::Move, items, Some(Outcome::Done))?)?;
        }
        for _ in 0..self.arguments.rounds {
            self.change(give)?;
        }
        Ok(())
    }

    /// Deletes a quarter of the vertices and inserts them again, and then in turn some of them.
    fn change(&mut self, give: Give) -> Result<(), Failure> {
        let mut vertices: Vec<u32> = (3..self.points.len() as u32).collect();
        self.random.shuffle(&mut vertices);
        vertices.truncate(self.points.len() / 4);
        let item = |vertex: u32| Item { vertex, point: self.points[vertex as usize] };
        let mut items: Vec<Item> = vertices.into_iter().map(item).collect();
        let deleted = self.tally(RunKind::Delete, items.clone(), Some(Outcome::Done))?;
        give("Delete", &deleted)?;
        items.retain(|item| !deleted.refused.contains(&item.vertex));
        give("InsertAs", &self.tally(RunKind::InsertAs, items.clone(), Some(Outcome::Done))?)?;
        // Runs of both kinds in turn, each of a quarter of the items.
        let mut mix = Tally::default();
        for part in items.chunks(items.len().div_ceil(2)) {
            let mut part = part.to_vec();
            for kind in [RunKind::Delete, RunKind::InsertAs] {
                let tally = self.tally(kind, part.clone(), Some(Outcome::Done))?;
                part.retain(|item| !tally.refused.contains(&item.vertex));
                mix.items += tally.items;
                mix.clocks += tally.clocks;
                mix.visits += tally.visits;
                mix.walk_visits += tally.walk_visits;
                mix.writes += tally.writes;
                mix.aborts += tally.aborts;
                mix.latencies.extend(tally.latencies);
            }
        }
        give("Delete, InsertAs", &mix)
    }

    /// Does runs of these items.
    fn tally(&mut self, kind: RunKind, mut items: Vec<Item>, outcome: Option<Outcome>) -> Result<Tally, Failure> {
        let mut tally = Tally::default();
        self.random.shuffle(&mut items);
        for chunk in items.chunks(self.arguments.items as usize) {
            let dealt = self.deal(kind, chunk);
            self.backwards = self.arguments.hardware && !self.backwards;
            let (counts, refused) = self.core.run(kind, &dealt, outcome)?;
            tally.add(dealt.len(), counts, refused);
        }
        Ok(tally)
    }

    /// The items in their order, dealt to the contexts: item `i` belongs to context `i mod k`.
    fn deal(&self, kind: RunKind, items: &[Item]) -> Vec<Item> {
        let contexts = self.arguments.contexts as usize;
        // The walk goes to where a vertex was before its move, which is near.
        let place = |item: &Item| if kind.has_point() { item.point } else { self.points[item.vertex as usize] };
        let places: Vec<Point> = items.iter().map(place).collect();
        let sorted: Vec<Item> = match self.along_curve {
            true => hilbert(&places).into_iter().map(|index| items[index as usize]).collect(),
            false => items.to_vec(),
        };
        let lengths = (0..contexts).map(|context| (sorted.len() + contexts - 1 - context) / contexts);
        let mut stretches = Vec::new();
        let mut rest = &sorted[..];
        for length in lengths {
            let (stretch, after) = rest.split_at(length);
            stretches.push(stretch);
            rest = after;
        }
        let at = |stretch: &[Item], place: usize| match self.backwards {
            true => stretch[stretch.len() - 1 - place],
            false => stretch[place],
        };
        (0..sorted.len()).map(|place| at(stretches[place % contexts], place / contexts)).collect()
    }

    /// Places near the points, at most the mean distance of points away.
    fn places(&mut self) -> Vec<Point> {
        let mean = f64::from(SIDE) / (self.points.len() as f64).sqrt();
        let reach = mean as u32;
        let mut near = |value: u32| {
            let moved = value + self.random.below_u32(2 * reach);
            moved.saturating_sub(reach).min(SIDE - 1)
        };
        self.points.iter().map(|point| Point::new(near(point.x), near(point.y))).collect()
    }

    /// Moves of all vertices but the first three by a share of the distance to the nearest neighbour, in any direction,
    /// to places that no vertex has or gets.
    fn moves(&mut self, percent: u32) -> Vec<Item> {
        let mesh = Triangulation::from(self.points.iter().copied());
        let distance = |a: Point, b: Point| f64::from(a.x.abs_diff(b.x)).hypot(f64::from(a.y.abs_diff(b.y)));
        let mut taken: HashSet<Point> = self.points.iter().copied().collect();
        let mut items = Vec::new();
        for vertex in 3..self.points.len() as u32 {
            let at = self.points[vertex as usize];
            let neighbors = mesh.iter().flat_map(|mesh| mesh.neighbors(vertex).into_iter().flatten());
            let nearest = neighbors.map(|other| distance(at, self.points[other as usize])).fold(f64::MAX, f64::min);
            let step = (nearest * f64::from(percent) / 100.0).round().max(1.0);
            let angle = self.random.unit() * std::f64::consts::TAU;
            let moved = |value: u32, by: f64| (f64::from(value) + by.round()).clamp(0.0, f64::from(SIDE - 1)) as u32;
            let point = Point::new(moved(at.x, step * angle.cos()), moved(at.y, step * angle.sin()));
            if taken.insert(point) {
                items.push(Item { vertex, point });
            }
        }
        items
    }
}
