//! Runs `InnerList` in Rust and in Verilog beside plain lists: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::InnerList;
use incircle_protocol::{Config, MAX_CONTEXTS, MAX_RING, TINY};
use incircle_testkit::SplitMix64;

named_ports!(InnerList, [inner, restarts, reader, inners, steps], [is_used_up, is_awaited, inner_id], clock);

const LONGEST: Config = Config { ring: MAX_RING, contexts: MAX_CONTEXTS, ..TINY };

fn number(number: u64) -> Cell {
    Cell::Number(number.into())
}

/// The lists of inner records, and the one that is read.
struct ListRig {
    block: Stepper<InnerList>,
    lists: Vec<Vec<u64>>,
    reader: usize,
    index: usize,
    /// Clocks for which the block has looked for the next record; `None` before the first list.
    age: Option<u32>,
}

impl ListRig {
    fn new(name: &'static str, config: Config) -> Self {
        let lists = vec![Vec::new(); config.contexts as usize];
        Self { block: Stepper::new(name, InnerList::new(config), 6), lists, reader: 0, index: 0, age: None }
    }

    fn is_used_up(&self) -> bool {
        self.index == self.lists[self.reader].len()
    }

    fn is_awaited(&self) -> bool {
        self.age.is_some_and(|age| age < 3) && !self.is_used_up()
    }

    fn can_step(&self) -> bool {
        self.age.is_some() && !self.is_awaited() && !self.is_used_up()
    }

    /// Runs one clock, in which a record may join a list, and another list may be the next to be read.
    fn clock(&mut self, joins: Option<(usize, u64)>, restarts: Option<usize>, steps: bool) {
        let (is_awaited, can_step) = (self.is_awaited(), self.can_step());
        let block = &mut self.block;
        let (context, id) = joins.unwrap_or_default();
        block.set("inner_valid", joins.is_some());
        block.set("context", context as u64);
        block.set("place", self.lists[context].len() as u64 % 64);
        block.set("id", id);
        block.set("restarts", restarts.is_some());
        block.set("reader", restarts.unwrap_or_default() as u64);
        block.set("inners", restarts.map_or(1, |reader| self.lists[reader].len() as u64));
        block.set("steps", steps);
        block.settle();
        if self.age.is_some() {
            let next = self.lists[self.reader].get(self.index);
            block.expect("is_used_up", next.is_none());
            block.expect("is_awaited", is_awaited);
            if let Some(id) = next.filter(|_| can_step) {
                block.expect("inner_id", *id);
            }
        }
        block.edge();
        self.lists[context].extend(joins.map(|(_, id)| id));
        self.age = self.age.map(|age| if steps { 0 } else { age + 1 });
        self.index += usize::from(steps);
        if let Some(reader) = restarts {
            (self.reader, self.index, self.age) = (reader, 0, Some(0));
        }
    }
}

fn gives_inner_records(name: &'static str, config: Config) {
    let mut random = SplitMix64::new(11);
    let mut rig = ListRig::new(name, config);
    let mut given = 0;
    for _ in 0..5_000 {
        let context = random.below(config.contexts.into()) as usize;
        let is_read = context == rig.reader && rig.age.is_some();
        let is_full = rig.lists[context].len() == config.ring as usize;
        let restarts = random.below(20) == 0 && (rig.age.is_none() || rig.is_used_up());
        // The list that was read is over, and its context begins another.
        let after = random.below(config.contexts.into()) as usize;
        let is_closed = is_read || is_full || restarts && context == after;
        let joins = (!is_closed).then(|| (context, random.below(1 << 15)));
        let steps = rig.can_step() && random.below(3) != 0;
        let old_reader = rig.reader;
        rig.clock(joins, restarts.then_some(after), steps);
        if restarts && after != old_reader {
            rig.lists[old_reader].clear();
        }
        given += usize::from(steps);
    }
    assert!(given > 500, "{given}");
}

#[test]
fn inner_list_of_the_shortest_list() {
    gives_inner_records("inner_list_6", TINY);
}

#[test]
fn inner_list_of_the_longest_list() {
    gives_inner_records("inner_list_64", LONGEST);
}

#[test]
fn inner_list_shows_the_wave_of_its_header() {
    let mut rig = ListRig::new("inner_list_6", TINY);
    rig.clock(Some((1, 20)), None, false);
    rig.clock(Some((1, 21)), Some(0), false);
    let mut wave = Wave::default();
    for clock in 0..13 {
        let (restarts, steps) = (clock == 1, clock == 6 || clock == 10);
        let is_read = clock > 1;
        let next = rig.lists[1].get(rig.index).filter(|_| is_read && rig.can_step());
        wave.take(&[
            ("restarts", Cell::Bit(restarts)),
            ("steps", Cell::Bit(steps)),
            ("is_used_up", if is_read { Cell::Bit(rig.is_used_up()) } else { Cell::Open }),
            ("is_awaited", if is_read { Cell::Bit(rig.is_awaited()) } else { Cell::Open }),
            ("inner_id", next.map_or(Cell::Open, |id| number(*id))),
        ]);
        rig.clock(None, restarts.then_some(1), steps);
    }
    wave.assert_drawn_in("inner_list");
}
