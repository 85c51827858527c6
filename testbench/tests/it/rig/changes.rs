//! Random scripts of `InsertAs`, `Delete`, `Move`, `Insert` and questions for a core with runs beside its model by
//! clock, and beside the model by commands, which gives the parts and the meshes.

use incircle_model::CommandModel;
use incircle_protocol::{
    command_word, Clear, Config, InsertReport, Located, Meshes, Opcode, Outcome, RunKind, CORE_COORD_BITS,
};
use incircle_testbench::lockstep::{Job, Lockstep, Mismatch, Stalls};
use incircle_testkit::SplitMix64;
use std::collections::{BTreeMap, BTreeSet};

/// Items of an `InsertAs`: vertex and point.
type Item = [u32; 2];

/// A core with its model by clock, and the model by commands.
pub struct Rig {
    pair: Lockstep,
    commands: CommandModel,
    config: Config,
    random: SplitMix64,
    pub stalls: Stalls,
    /// Whether a mesh stands, and the places that have been named since the last clear.
    stands: bool,
    places: Vec<u32>,
    /// The place of each vertex that is in the mesh, and the number of ids in use.
    living: BTreeMap<u32, u32>,
    arrived: u32,
    /// Number of parts with each outcome; entry 15 counts the runs that name a vertex or a place twice.
    pub seen: [usize; 16],
}

impl Rig {
    pub fn new(pair: Lockstep, config: Config, seed: u64) -> Self {
        // The number of neighbours depends on the order of deletions, so the model by commands has a long list.
        let commands = CommandModel::new(CORE_COORD_BITS, config.points, 64)
            .unwrap_or_else(|error| panic!("{error}"))
            .with_contexts(config.contexts)
            .with_runs();
        let (random, stalls) = (SplitMix64::new(seed), Stalls::ALL[seed as usize % 9]);
        Self {
            pair: pair.with_core_runs(),
            commands,
            config,
            random,
            stalls,
            stands: false,
            places: Vec::new(),
            living: BTreeMap::new(),
            arrived: 0,
            seen: [0; 16],
        }
    }

    /// The answer of the model by commands.
    fn expected(&mut self, words: &[u32]) -> Vec<u32> {
        self.commands.send(words);
        let mut answer = vec![0; 1 << 14];
        let count = self.commands.receive(&mut answer);
        assert!(count < answer.len());
        answer.truncate(count);
        answer
    }

    fn answer(&mut self, words: &[u32], length: usize) -> Result<Vec<u32>, Box<Mismatch>> {
        let job = Job { commands: words.to_vec(), answers: length };
        let random = &mut self.random;
        Ok(self.pair.run(&job, self.stalls, &mut || random.next_u64())?)
    }

    /// A command whose answer is that of the model by commands, word for word.
    fn same(&mut self, words: &[u32]) -> Result<Vec<u32>, Box<Mismatch>> {
        let expected = self.expected(words);
        let answer = self.answer(words, expected.len())?;
        assert_eq!(answer, expected, "command {words:x?}");
        Ok(answer)
    }

    fn clear(&mut self) -> Result<(), Box<Mismatch>> {
        let contexts = self.random.below(u64::from(self.config.contexts) + 1) as u32;
        let clear = Clear { contexts, meshes: Meshes::One, tag: self.random.bits(8) as u8 };
        self.stands = false;
        self.places.clear();
        self.living.clear();
        self.arrived = 0;
        self.same(&[clear.word()]).map(drop)
    }

    fn insert(&mut self, points: &[u32]) -> Result<(), Box<Mismatch>> {
        let report = self.same(&[&[command_word(Opcode::Insert), points.len() as u32], points].concat())?;
        self.stands = report[6] > 0;
        self.places.extend_from_slice(points);
        let arrived = InsertReport::from_words(report[2..].try_into().expect("a report")).arrived;
        for (vertex, &place) in (self.arrived..arrived).zip(points) {
            if !self.living.values().any(|&other| other == place) {
                self.living.insert(vertex, place);
            }
        }
        self.arrived = arrived;
        Ok(())
    }

    /// An `InsertAs` of these items. If they are all different, the parts must be those of the model by commands.
    fn insert_as(&mut self, items: &[Item]) -> Result<(), Box<Mismatch>> {
        let run =
            |items: &[Item]| [&[command_word(Opcode::InsertAs), items.len() as u32], items.as_flattened()].concat();
        let length = 2 + if self.stands { 2 * items.len() } else { 0 };
        let answer = self.answer(&run(items), length)?;
        if !self.stands {
            assert_eq!(answer, self.expected(&run(items)));
            return Ok(());
        }
        let parts = sorted(&answer[2..], 2);
        assert_eq!(parts.len(), items.len(), "each item has a part");
        parts.iter().for_each(|part| self.seen[(part[0] >> 24) as usize] += 1);
        let vertices: BTreeSet<u32> = items.iter().map(|item| item[0]).collect();
        let places: BTreeSet<u32> = items.iter().map(|item| item[1]).collect();
        if vertices.len() == items.len() && places.len() == items.len() {
            let expected = self.expected(&run(items));
            assert_eq!(answer[..2], expected[..2]);
            assert_eq!(parts, sorted(&expected[2..], 2), "items {items:x?}");
            self.note(items, &parts);
            return Ok(());
        }
        self.seen[15] += 1;
        self.note(items, &parts);
        let is_done = |part: &[u32]| part[0] >> 24 == Outcome::Done as u32;
        let done: Vec<Item> =
            items.iter().zip(&parts).filter(|(_, part)| is_done(part)).map(|(item, _)| *item).collect();
        let expected = self.expected(&run(&done));
        assert!(expected[2..].chunks(2).all(is_done), "items that were done can be done");
        Ok(())
    }

    /// A `Delete` of these vertices. The model by commands deletes the vertices whose parts say `Done`, and must then
    /// refuse all others with the outcomes that the parts have.
    fn delete(&mut self, vertices: &[u32]) -> Result<(), Box<Mismatch>> {
        let run = |vertices: &[u32]| [&[command_word(Opcode::Delete), vertices.len() as u32], vertices].concat();
        let length = 2 + if self.stands { 2 * vertices.len() } else { 0 };
        let answer = self.answer(&run(vertices), length)?;
        if !self.stands {
            assert_eq!(answer, self.expected(&run(vertices)));
            return Ok(());
        }
        let parts = sorted(&answer[2..], 2);
        assert_eq!(parts.len(), vertices.len(), "each item has a part");
        let outcome = |part: &[u32]| part[0] >> 24;
        let is = |part: &[u32], wanted: Outcome| outcome(part) == wanted as u32;
        let items = || vertices.iter().copied().zip(&parts);
        items().for_each(|(vertex, part)| assert_eq!(part[1], vertex));
        parts.iter().for_each(|part| self.seen[outcome(part) as usize] += 1);
        let done: Vec<u32> = items().filter(|(_, part)| is(part, Outcome::Done)).map(|(vertex, _)| vertex).collect();
        self.living.retain(|vertex, _| !done.contains(vertex));
        let expected = self.expected(&run(&done));
        assert!(expected[2..].chunks(2).all(|part| is(part, Outcome::Done)), "vertices that were deleted can be");
        // A vertex that is named twice may be missing for one item while the other finds that it cannot be deleted. The
        // model by commands has a longer list, and would delete it.
        let is_alone = |vertex: u32| vertices.iter().filter(|&&other| other == vertex).count() == 1;
        for (vertex, part) in items().filter(|&(vertex, _)| is_alone(vertex)) {
            if !is(part, Outcome::Done) && !is(part, Outcome::ManyNeighbors) {
                let expected = self.expected(&run(&[vertex]));
                assert_eq!(outcome(&expected[2..]), outcome(part), "{vertex}: {part:x?}, not {expected:x?}");
            }
        }
        Ok(())
    }

    /// Takes note of the new places of these items, as far as their parts say that they are done.
    fn note(&mut self, items: &[Item], parts: &[Vec<u32>]) {
        for (&[vertex, place], part) in items.iter().zip(parts) {
            if part[0] >> 24 == Outcome::Done as u32 {
                self.living.insert(vertex, place);
                self.arrived = self.arrived.max(vertex + 1);
            }
        }
    }

    /// A `Move` of these items.
    ///
    /// Three vertices that span a triangle stay, unless the run has one item: so no vertex has to. If all vertices and
    /// places differ, the model by commands moves those of which the parts say so, with the same outcome. Otherwise the
    /// parts say which vertices have moved, in the order of their ends, and which are out of the mesh, because another
    /// vertex has their place. The model by commands then deletes all of these, and inserts those that have moved.
    fn move_to(&mut self, items: &[Item]) -> Result<(), Box<Mismatch>> {
        let run = |items: &[Item]| [&[command_word(Opcode::Move), items.len() as u32], items.as_flattened()].concat();
        let length = 2 + if self.stands { 2 * items.len() } else { 0 };
        let answer = self.answer(&run(items), length)?;
        if !self.stands {
            assert_eq!(answer, self.expected(&run(items)));
            return Ok(());
        }
        let is = |part: &[u32], outcome: Outcome| part[0] >> 24 == outcome as u32;
        let goes = |part: &[u32]| is(part, Outcome::Done) || is(part, Outcome::Duplicate);
        let in_order: Vec<(Item, Vec<u32>)> =
            answer[2..].chunks(2).map(|part| (items[(part[0] & 0xff_ffff) as usize], part.to_vec())).collect();
        let parts = sorted(&answer[2..], 2);
        assert_eq!(parts.len(), items.len(), "each item has a part");
        for (item, part) in items.iter().zip(&parts) {
            self.seen[(part[0] >> 24) as usize] += 1;
            assert!(is(part, Outcome::Duplicate) || part[1] == item[0], "{part:x?} names vertex {:x}", item[0]);
            let is_alone = items.iter().filter(|other| other[0] == item[0]).count() == 1;
            assert!(!is_alone || is(part, Outcome::Missing) != self.living.contains_key(&item[0]), "{part:x?}");
        }
        let vertices: BTreeSet<u32> = items.iter().map(|item| item[0]).collect();
        // A place that a vertex of the run has counts, too.
        let left = vertices.iter().filter_map(|vertex| self.living.get(vertex).copied());
        let own = items.iter().filter(|item| self.living.get(&item[0]) == Some(&item[1])).count();
        let places: BTreeSet<u32> = items.iter().map(|item| item[1]).chain(left.clone()).collect();
        let is_clean = vertices.len() == items.len() && places.len() + own == items.len() + left.count();
        if is_clean {
            let is_counted = |part: &[u32]| goes(part) || is(part, Outcome::Flat);
            let done: Vec<Item> =
                items.iter().zip(&parts).filter(|(_, part)| is_counted(part)).map(|(item, _)| *item).collect();
            let expected = self.expected(&run(&done));
            let meaning = |part: &[u32]| (part[0] >> 24, part[1]);
            let own: Vec<_> = parts.iter().filter(|part| is_counted(part)).map(|part| meaning(part)).collect();
            assert_eq!(own, expected[2..].chunks(2).map(meaning).collect::<Vec<_>>(), "items {items:x?}");
        } else {
            self.seen[15] += 1;
            let out: BTreeSet<u32> = in_order.iter().filter(|(_, part)| goes(part)).map(|(item, _)| item[0]).collect();
            let delete: Vec<u32> = [command_word(Opcode::Delete), out.len() as u32].into_iter().chain(out).collect();
            let expected = self.expected(&delete);
            assert!(expected[2..].chunks(2).all(|part| is(part, Outcome::Done)), "they were in the mesh");
            let ends: BTreeMap<u32, (u32, &Vec<u32>)> = in_order
                .iter()
                .filter(|(_, part)| goes(part))
                .map(|([vertex, place], part)| (*vertex, (*place, part)))
                .collect();
            let moved = ends.iter().filter(|(_, (_, part))| is(part, Outcome::Done));
            let moved: Vec<u32> = moved.flat_map(|(&vertex, &(place, _))| [vertex, place]).collect();
            let insert = [&[command_word(Opcode::InsertAs), moved.len() as u32 / 2], &moved[..]].concat();
            let expected = self.expected(&insert);
            assert!(expected[2..].chunks(2).all(|part| is(part, Outcome::Done)), "items {items:x?}: {in_order:x?}");
        }
        for ([vertex, place], part) in in_order {
            match () {
                () if is(&part, Outcome::Done) => drop(self.living.insert(vertex, place)),
                () if is(&part, Outcome::Duplicate) => drop(self.living.remove(&vertex)),
                () => {}
            }
        }
        Ok(())
    }

    /// Up to this many items of a `Move`, to places on a grid of this side.
    fn moves(&mut self, most: u64, side: u64) -> Vec<Item> {
        let mut vertices: Vec<u32> = self.living.keys().copied().collect();
        self.random.shuffle(&mut vertices);
        let kept = spanning(&vertices, &self.living);
        let is_single = kept.is_none() || self.random.once_in(6);
        if !is_single {
            vertices.retain(|vertex| !kept.unwrap_or_default().contains(vertex));
        }
        vertices.truncate(if is_single { 1 } else { self.random.below(most + 1) as usize });
        let is_clean = is_single || !self.random.once_in(4);
        let is_small = self.random.once_in(2);
        let mut places: BTreeSet<u32> = vertices.iter().filter_map(|vertex| self.living.get(vertex).copied()).collect();
        let mut items = Vec::new();
        for vertex in vertices {
            let at = self.living[&vertex];
            let near = |value: u32, random: &mut SplitMix64| {
                (u64::from(value) + random.below(5)).saturating_sub(2).min(side - 1) as u32
            };
            let to = match self.random.below(8) {
                0 => at,
                1 => self.random.pick(&self.places),
                _ if is_small => near(at & 0xffff, &mut self.random) | near(at >> 16, &mut self.random) << 16,
                _ => place(&mut self.random, side),
            };
            if !is_clean || to == at || places.insert(to) {
                items.push([vertex, to]);
            }
            if !is_clean && self.random.once_in(4) {
                items.push([vertex, place(&mut self.random, side)]);
            }
        }
        if is_single && self.random.once_in(3) || !is_single && self.random.once_in(3) {
            let points = u64::from(self.config.points);
            let vertex =
                [self.random.bits(32), points, self.random.below(points)][self.random.below(3) as usize] as u32;
            let to = place(&mut self.random, side);
            if !self.living.contains_key(&vertex) && (!is_clean || places.insert(to)) {
                items.push([vertex, to]);
            }
        }
        self.places.extend(items.iter().map(|item| item[1]));
        items
    }

    /// Up to this many vertices, most of them once.
    fn vertices(&mut self, most: u64) -> Vec<u32> {
        let points = u64::from(self.config.points);
        let known = points.min(2 + self.places.len() as u64);
        let is_clean = !self.random.once_in(4);
        let mut seen = BTreeSet::new();
        let mut vertices = Vec::new();
        for _ in 0..self.random.below(most + 1) {
            let vertex = match self.random.below(16) {
                0 => self.random.bits(32),
                1 => points + self.random.below(2),
                _ => self.random.below(known),
            } as u32;
            if !is_clean || seen.insert(vertex) {
                vertices.push(vertex);
            }
        }
        vertices
    }

    fn ask(&mut self, kind: RunKind, places: &[u32]) -> Result<(), Box<Mismatch>> {
        let words = [&[command_word(kind.opcode()), places.len() as u32], places].concat();
        let expected = self.expected(&words);
        let answer = self.answer(&words, expected.len())?;
        assert_eq!(answer[..2], expected[..2]);
        let outcomes = |parts: &[u32]| -> Vec<(u32, Vec<u32>)> {
            let named = |part: &Vec<u32>| {
                let mut vertices = Located::from_words(&part[1..]).vertices.to_vec();
                vertices.sort_unstable();
                (part[0] >> 24, vertices)
            };
            sorted(parts, kind.part_words()).iter().map(named).collect()
        };
        assert_eq!(outcomes(&answer[2..]), outcomes(&expected[2..]), "places {places:x?}");
        Ok(())
    }

    /// Reads the mesh, and compares its triangles with those of the model by commands.
    fn read(&mut self) -> Result<(), Box<Mismatch>> {
        if !self.stands {
            return Ok(());
        }
        let report = self.same(&[command_word(Opcode::Insert), 0])?;
        let (vertices, records) = (report[3], report[6]);
        assert_eq!(records, 2 * vertices - 2, "live records");
        let read = [command_word(Opcode::Read), 0, records];
        let answer = self.answer(&read, 2 + 3 * records as usize)?;
        assert!(answer[2..].iter().all(|word| word >> 31 == 0), "no lock is set");
        let all = [command_word(Opcode::Triangles), 0, records];
        let expected = triangles(&self.expected(&all)[2..], records);
        let answer = self.answer(&all, 2 + (3 * records as usize).div_ceil(2))?;
        let own = triangles(&answer[2..], records);
        assert_eq!((own.len() as u32, &own), (records, &expected));
        // A part of them, and one record too many.
        let first = self.random.below(u64::from(records) + 1) as u32;
        let count = self.random.below(u64::from(records - first) + 1) as u32;
        let words = (3 * count as usize).div_ceil(2);
        let part = self.answer(&[command_word(Opcode::Triangles), first, count], 2 + words)?;
        assert_eq!(ids(&part[2..], count), ids(&answer[2..], records)[3 * first as usize..][..3 * count as usize]);
        self.same(&[command_word(Opcode::Triangles), 0, records + 1]).map(drop)
    }

    /// Up to this many items with vertices that are new for the most part, and places on a grid of this side.
    fn items(&mut self, most: u64, side: u64) -> Vec<Item> {
        let is_clean = !self.random.once_in(4);
        let points = u64::from(self.config.points);
        let (mut vertices, mut places) = (BTreeSet::new(), BTreeSet::new());
        let mut items = Vec::new();
        for _ in 0..self.random.below(most + 1) {
            let vertex = match self.random.below(16) {
                0 => self.random.bits(32),
                1 => points + self.random.below(2),
                2..=5 => self.random.below(points.min(20)),
                _ => self.random.below(points),
            } as u32;
            // Often a place that has a vertex, so that items of all ends meet.
            let known = self.random.below(3 * self.places.len() as u64 + 1) as usize;
            let place = self.places.get(known).copied().unwrap_or_else(|| place(&mut self.random, side));
            if !is_clean || vertices.insert(vertex) && places.insert(place) {
                items.push([vertex, place]);
            }
        }
        self.places.extend(items.iter().map(|item| item[1]));
        items
    }

    /// A script about one mesh.
    pub fn script(&mut self, points: u64, items: u64) -> Result<(), Box<Mismatch>> {
        let side = [3, 4, 6, 11, 1 << 16][self.random.below(5) as usize];
        // Few points often have a vertex that must stay.
        let points = if self.random.once_in(4) { 5 } else { points };
        self.clear()?;
        for _ in 0..2 + self.random.below(5) {
            match self.random.below(11) {
                8..=10 => {
                    let items = self.moves(items, side);
                    self.move_to(&items)?;
                }
                0 | 1 => {
                    let points = self.random.below(points + 1);
                    let points: BTreeSet<u32> = (0..points).map(|_| place(&mut self.random, side)).collect();
                    let mut points: Vec<u32> = points.into_iter().collect();
                    self.random.shuffle(&mut points);
                    self.insert(&points)?;
                }
                2 => {
                    let kinds = [RunKind::Locate, RunKind::Interpolate, RunKind::Nearest];
                    let kind = kinds[self.random.below(3) as usize];
                    let count = self.random.below(items + 1);
                    let places: Vec<u32> = (0..count).map(|_| place(&mut self.random, side)).collect();
                    self.ask(kind, &places)?;
                }
                3 | 4 => {
                    let vertices = self.vertices(items.min(self.places.len() as u64 + 2));
                    self.delete(&vertices)?;
                }
                _ => {
                    let items = self.items(items, side);
                    self.insert_as(&items)?;
                }
            }
            if self.random.once_in(3) {
                self.read()?;
            }
        }
        self.read()
    }

    /// A script whose runs move the same four vertices again and again, by short ways. So an item often comes soon after
    /// the end of another one for its vertex.
    pub fn script_of_few(&mut self) -> Result<(), Box<Mismatch>> {
        const SIDE: u64 = 1 << 12;
        self.clear()?;
        let corners = [[0, 0], [SIDE - 1, 0], [0, SIDE - 1], [SIDE - 1, SIDE - 1]];
        let mut points: Vec<u32> = corners.iter().map(|&[x, y]| (x | y << 16) as u32).collect();
        points.extend((0..12).map(|_| place(&mut self.random, SIDE)));
        self.insert(&points)?;
        for _ in 0..4 {
            let four: Vec<u32> = self.living.keys().copied().filter(|&vertex| vertex > 3).take(4).collect();
            if four.is_empty() {
                break;
            }
            let items = (0..40).map(|_| {
                let vertex = self.random.pick(&four);
                let near = |value: u32, random: &mut SplitMix64| {
                    (u64::from(value) + random.below(601)).saturating_sub(300).min(SIDE - 1) as u32
                };
                let at = self.living[&vertex];
                let to = near(at & 0xffff, &mut self.random) | near(at >> 16, &mut self.random) << 16;
                [vertex, to]
            });
            let items: Vec<Item> = items.collect();
            self.places.extend(items.iter().map(|item| item[1]));
            self.move_to(&items)?;
        }
        self.read()
    }

    /// A script that takes vertices out of the mesh, tries to put them back where others are, and then where none is.
    /// So the ids of records that are kept for them outlive a duplicate.
    pub fn script_of_duplicates(&mut self) -> Result<(), Box<Mismatch>> {
        const SIDE: u64 = 1 << 6;
        self.clear()?;
        let points: BTreeSet<u32> = (0..24).map(|_| place(&mut self.random, SIDE)).collect();
        self.insert(&points.into_iter().collect::<Vec<u32>>())?;
        for _ in 0..3 {
            let mut vertices: Vec<u32> = self.living.keys().copied().collect();
            self.random.shuffle(&mut vertices);
            if vertices.len() < 2 * TAKEN {
                break;
            }
            let (out, others) = vertices.split_at(TAKEN);
            let taken: Vec<u32> = others.iter().take(TAKEN).map(|vertex| self.living[vertex]).collect();
            let pairs = |vertices: &[u32], places: &[u32]| -> Vec<Item> {
                vertices.iter().zip(places).map(|(&vertex, &place)| [vertex, place]).collect()
            };
            if self.random.once_in(2) {
                self.delete(out)?;
            } else {
                self.move_to(&pairs(out, &taken))?;
            }
            let out: Vec<u32> = out.iter().copied().filter(|vertex| !self.living.contains_key(vertex)).collect();
            self.insert_as(&pairs(&out, &taken))?;
            let mut free = BTreeSet::new();
            while free.len() < out.len() {
                let place = place(&mut self.random, SIDE);
                if !self.living.values().any(|&other| other == place) {
                    free.insert(place);
                }
            }
            let free: Vec<u32> = free.into_iter().collect();
            self.insert_as(&pairs(&out, &free))?;
            self.places.extend(free);
        }
        self.read()
    }
}

/// Number of vertices that leave the mesh at a time, and of places that are then taken, in
/// [`Rig::script_of_duplicates`].
const TAKEN: usize = 4;

fn place(random: &mut SplitMix64, side: u64) -> u32 {
    (random.below(side) | random.below(side) << 16) as u32
}

/// Three of these vertices that span a triangle.
fn spanning(vertices: &[u32], living: &BTreeMap<u32, u32>) -> Option<[u32; 3]> {
    let at = |vertex: u32| (i64::from(living[&vertex] & 0xffff), i64::from(living[&vertex] >> 16));
    let &[one, two, ..] = vertices else {
        return None;
    };
    let (a, b) = (at(one), at(two));
    let turns = |c: (i64, i64)| (b.0 - a.0) * (c.1 - a.1) != (b.1 - a.1) * (c.0 - a.0);
    vertices.iter().find(|&&three| turns(at(three))).map(|&three| [one, two, three])
}

/// The parts in the order of their items.
fn sorted(parts: &[u32], words: usize) -> Vec<Vec<u32>> {
    let mut parts: Vec<Vec<u32>> = parts.chunks(words).map(<[u32]>::to_vec).collect();
    parts.sort_unstable_by_key(|part| part[0] & 0xff_ffff);
    let numbers = parts.iter().map(|part| part[0] & 0xff_ffff);
    assert!(numbers.eq(0..parts.len() as u32), "each item has one part");
    parts
}

/// The vertices of records without their links.
fn ids(words: &[u32], records: u32) -> Vec<u32> {
    words.iter().flat_map(|word| [word & 0xffff, word >> 16]).take(3 * records as usize).collect()
}

/// The triangles of these records, each from its lowest vertex on.
fn triangles(words: &[u32], records: u32) -> BTreeSet<[u32; 3]> {
    let turned = |record: &[u32]| {
        let mut v = [0, 1, 2].map(|k| record[k]);
        let lowest = (0..3).min_by_key(|&k| v[k]).unwrap_or(0);
        v.rotate_left(lowest);
        v
    };
    ids(words, records).chunks(3).map(turned).collect()
}
