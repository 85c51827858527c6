//! Random runs of all kinds on grids full of ties, in 1 to 16 contexts, against the model by commands.

use crate::common::bench::Stalls;
use crate::common::living::{Fault, Pair};
use crate::common::Random;
use incircle_model::LivingDefect;
use incircle_protocol::{Config, RunKind};
use std::collections::BTreeSet;
use std::ops::Range;

/// A place of a grid, as a word.
fn place(x: u32, y: u32) -> u32 {
    x | y << 16
}

/// A random script.
pub struct Script {
    pub random: Random,
    pub contexts: u32,
    pub points: u32,
    pub ring: u32,
    /// Places of the points.
    places: Vec<u32>,
    stalls: Stalls,
    /// The kinds of runs.
    pub kinds: &'static [RunKind],
}

impl Script {
    pub fn new(seed: u32) -> Self {
        let mut random = Random(seed.into());
        let (w, h) = (3 + random.below(6), 3 + random.below(6));
        // Small moves need room between the places.
        let step = [1, 1, 9][random.below(3) as usize];
        let mut places: Vec<u32> = (0..w * h).map(|cell| place(step * (cell % w), step * (cell / w))).collect();
        shuffle(&mut places, &mut random);
        let contexts = [1, 2, 4, 8, 16, 16][random.below(6) as usize];
        let ring = [6, 12, 32, 32][random.below(4) as usize];
        let stalls = match random.below(4) {
            0 => Stalls { idle: 3, full: 3, beat: 0 },
            _ => Stalls::default(),
        };
        // Sometimes the memory is full.
        let count = (places.len() as u32).next_power_of_two();
        let points = if random.below(3) == 0 { (count / 2).max(4) } else { count };
        Self { random, contexts, points, ring, places, stalls, kinds: &RunKind::ALL }
    }

    /// A script in 16 contexts.
    pub fn crowded(seed: u32) -> Self {
        Self { contexts: 16, ..Self::new(seed) }
    }

    /// Runs the script on a core with or without one of its rules.
    ///
    /// # Errors
    /// What went wrong first.
    pub fn run(&mut self, defect: Option<LivingDefect>) -> Result<Pair, Fault> {
        let pair = Pair::new(self.config(), defect);
        self.run_on(pair)
    }

    pub fn config(&self) -> Config {
        Config { name: "test", points: self.points, ring: self.ring, contexts: self.contexts, engines: 1 }
    }

    /// Runs the script on this core.
    ///
    /// # Errors
    /// What went wrong first.
    pub fn run_on(&mut self, mut pair: Pair) -> Result<Pair, Fault> {
        let count = (4 + self.random.below(self.places.len() as u32 - 4)).min(self.points - 1) as usize;
        self.mesh_of(count, &mut pair)?;
        // A small mesh after a larger one has fewer records than the contexts have met.
        for _ in 0..self.random.below(3) {
            let count = 3 + self.random.below(2) as usize;
            self.mesh_of(count, &mut pair)?;
        }
        Ok(pair)
    }

    /// Makes a mesh of so many points, and does some runs on it.
    fn mesh_of(&mut self, count: usize, pair: &mut Pair) -> Result<(), Fault> {
        let mut first: Vec<u32> = self.places[..count].to_vec();
        let is_flat = |p: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| ((p[k] & 0xffff) as i64, (p[k] >> 16) as i64));
            (b.0 - a.0) * (c.1 - a.1) == (b.1 - a.1) * (c.0 - a.0)
        };
        while is_flat(&first) {
            shuffle(&mut self.places, &mut self.random);
            first = self.places[..count].to_vec();
        }
        pair.load(&first, self.contexts)?;
        pair.check()?;
        for _ in 0..2 + self.random.below(5) {
            self.step(pair)?;
        }
        Ok(())
    }

    fn step(&mut self, pair: &mut Pair) -> Result<(), Fault> {
        let kind = self.kinds[self.random.below(self.kinds.len() as u32) as usize];
        let items = match kind {
            RunKind::InsertAs => self.insertions(pair),
            RunKind::Delete => self.deletions(pair),
            RunKind::Move => self.moves(pair),
            _ => (0..1 + self.random.below(40)).map(|_| self.any_place()).collect(),
        };
        let mut items = items;
        if self.ring < 32 && self.contexts > 1 {
            // The number of neighbours, which the list may refuse, depends on the order of the changes.
            match kind {
                RunKind::Delete => items.truncate(1),
                RunKind::Move => items.truncate(2),
                _ => {}
            }
        }
        let changes = kind.is_change();
        pair.run(kind, &items, self.stalls, &mut self.random)?;
        if changes {
            pair.check()?;
        }
        Ok(())
    }

    fn any_place(&mut self) -> u32 {
        let at = self.places[self.random.below(self.places.len() as u32) as usize];
        let [x, y] = [at & 0xffff, at >> 16].map(|value| value + 2);
        place((x + self.random.below(5)).saturating_sub(4), (y + self.random.below(5)).saturating_sub(4))
    }

    /// Vertices that are in the mesh, in random order.
    fn living(&mut self, pair: &Pair) -> Vec<u32> {
        let mut living: Vec<u32> = (0..self.points).filter(|&vertex| pair.points[vertex as usize].is_some()).collect();
        shuffle(&mut living, &mut self.random);
        living
    }

    /// Places without a vertex, in random order.
    fn empty_places(&mut self, pair: &Pair) -> Vec<u32> {
        let taken: BTreeSet<u32> = pair.points.iter().copied().flatten().collect();
        let mut empty: Vec<u32> = self.places.iter().copied().filter(|place| !taken.contains(place)).collect();
        shuffle(&mut empty, &mut self.random);
        empty
    }

    fn insertions(&mut self, pair: &Pair) -> Vec<u32> {
        let mut dead: Vec<u32> = (0..self.points).filter(|&vertex| pair.points[vertex as usize].is_none()).collect();
        shuffle(&mut dead, &mut self.random);
        let keep = 1 + self.random.below(dead.len().max(1) as u32) as usize;
        let mut items: Vec<u32> =
            dead.iter().zip(self.empty_places(pair)).take(keep).flat_map(|(&vertex, place)| [vertex, place]).collect();
        // A vertex that is in use, one beyond the capacity, and a place that is taken.
        let living = self.living(pair);
        match self.random.below(4) {
            0 => items.extend([living[0], self.places[0]]),
            1 => items.extend([self.points + 3, self.places[0]]),
            2 if items.len() / 2 < dead.len() => {
                items.extend([dead[dead.len() - 1], pair.points[living[0] as usize].unwrap_or(0)]);
            }
            _ => {}
        }
        items
    }

    /// All vertices but three that span a triangle may go.
    fn deletions(&mut self, pair: &Pair) -> Vec<u32> {
        let mut living = self.living(pair);
        if living.len() < 6 || self.random.below(8) == 0 {
            // One alone may be refused.
            living.truncate(1);
            return living;
        }
        let Some(kept) = triple(&living, pair) else {
            return vec![];
        };
        living.retain(|vertex| !kept.contains(vertex));
        let share = [1, 2, 3][self.random.below(3) as usize];
        living.truncate((living.len() / share).max(1));
        if self.random.below(4) == 0 {
            living.push(self.points + 9);
        }
        living
    }

    fn moves(&mut self, pair: &Pair) -> Vec<u32> {
        let mut living = self.living(pair);
        let Some(kept) = triple(&living, pair) else {
            return vec![];
        };
        living.retain(|vertex| !kept.contains(vertex));
        let mut taken: BTreeSet<u32> = pair.points.iter().copied().flatten().collect();
        let empty = self.empty_places(pair);
        let (mut items, mut empty) = (Vec::new(), empty.into_iter());
        let small = self.random.below(2) == 0;
        for vertex in living {
            let at = pair.points[vertex as usize].unwrap_or(0);
            let to = match small {
                true => {
                    let [x, y] = [at & 0xffff, at >> 16].map(|value| (value + self.random.below(7)).saturating_sub(3));
                    Some(place(x, y))
                }
                false => empty.next(),
            };
            if let Some(to) = to.filter(|to| taken.insert(*to)) {
                items.extend([vertex, to]);
            }
        }
        items
    }
}

/// Three of the vertices that span a triangle.
fn triple(vertices: &[u32], pair: &Pair) -> Option<[u32; 3]> {
    let at = |vertex: u32| {
        let place = pair.points[vertex as usize].unwrap_or(0);
        ((place & 0xffff) as i64, (place >> 16) as i64)
    };
    let (&one, &two) = (vertices.first()?, vertices.get(1)?);
    let (a, b) = (at(one), at(two));
    let spans = |&&c: &&u32| {
        let c = at(c);
        (b.0 - a.0) * (c.1 - a.1) != (b.1 - a.1) * (c.0 - a.0)
    };
    vertices.iter().find(spans).map(|&three| [one, two, three])
}

fn shuffle(values: &mut [u32], random: &mut Random) {
    for place in (1..values.len()).rev() {
        values.swap(place, random.below(place as u32 + 1) as usize);
    }
}

/// Runs scripts with these kinds of runs on a core, which must agree with the model by commands.
pub fn agree(seeds: Range<u32>, kinds: &'static [RunKind], pair_of: fn(Config) -> Pair) {
    for seed in seeds {
        let mut script = Script::new(seed);
        script.kinds = kinds;
        let pair = pair_of(script.config());
        match script.run_on(pair) {
            Ok(_) => {}
            Err(Fault::Hang) => panic!("script {seed} hangs"),
            Err(Fault::Wrong(fault)) => panic!("script {seed}: {fault}"),
        }
    }
}

/// The seeds of long tests: as many as `INCIRCLE_SCRIPTS` says.
pub fn many() -> Range<u32> {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    1000..1000 + scripts.unwrap_or(10_000)
}

fn living_engine(config: Config) -> Pair {
    Pair::new(config, None)
}

#[test]
fn hundreds_of_scripts_agree_with_the_model_by_commands() {
    agree(0..400, &RunKind::ALL, living_engine);
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_agree_with_the_model_by_commands() {
    agree(many(), &RunKind::ALL, living_engine);
}
