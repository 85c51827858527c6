//! The parts of the commit: the id rule, the count of records, and the lists of inner triangles. Rust, Verilog and plain lists
//! agree clock by clock.

use crate::rig::record_count::{Count, Event};
use crate::rig::stepper::bundles::Edge;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{FreshIds, InnerList, StarId};
use incircle_protocol::{Config, MAX_CONTEXTS, MAX_RING, TINY};

named_ports!(
    StarId,
    [head, head_shares, first, current_is_last, inner_id, inner_is_used_up, fresh],
    [ahead, id, is_inner, is_fresh]
);
named_ports!(FreshIds, [reset, takes, ends, solo_inserts, seeds, clears], [fresh, records], clock);
named_ports!(
    InnerList,
    [enable, owner, place, id, restarts, reader, inners, steps],
    [is_used_up, is_awaited, inner_id],
    clock
);

const LONGEST: Config = Config { ring: MAX_RING, contexts: MAX_CONTEXTS, ..TINY };

fn number(number: u64) -> Cell {
    Cell::Number(number.into())
}

#[test]
fn star_id_takes_an_id_that_nobody_has() {
    let mut random = SplitMix64::new(20);
    let mut block = Stepper::new("star_id", StarId::default(), 1);
    for _ in 0..4_000 {
        let [head, first] = [(); 2].map(|()| Edge {
            a: random.below(1 << 15),
            u: random.below(1 << 15),
            slot: random.below(3),
            f: random.below(1 << 15),
            after: random.below(64),
        });
        let [closes, has_gone, used_up] = [(); 3].map(|()| random.below(2) == 1);
        let (inner, fresh) = (random.below(1 << 15), random.below(1 << 15));
        for (port, edge) in [("head", head), ("first", first)] {
            block.set(port, edge.entry());
        }
        block.set("head_shares", has_gone);
        block.set("current_is_last", closes);
        block.set("inner_id", inner);
        block.set("inner_is_used_up", used_up);
        block.set("fresh", fresh);
        let (ahead, id) = match (closes, has_gone, used_up) {
            (true, _, _) => (first, first.f),
            (false, false, _) => (head, head.f),
            (false, true, false) => (head, inner),
            (false, true, true) => (head, fresh),
        };
        block.settle();
        block.expect("ahead", ahead.entry());
        block.expect("id", id);
        block.expect("is_inner", !closes && has_gone && !used_up);
        block.expect("is_fresh", !closes && has_gone && used_up);
    }
}

/// One clock of the count; nothing is compared in the first one.
fn count_clock(block: &mut Stepper<FreshIds>, count: &mut Count, event: Event) {
    for (port, value) in [
        ("reset", event.reset),
        ("takes", event.takes),
        ("ends", event.ends),
        ("solo_inserts", event.solo_inserts),
        ("seeds", event.seeds),
        ("clears", event.clears),
    ] {
        block.set(port, value);
    }
    block.settle();
    if block.clocks() > 0 {
        block.expect("fresh", count.fresh);
        block.expect("records", count.records);
    }
    block.edge();
    count.edge(event);
}

#[test]
fn fresh_ids_count_records() {
    let mut random = SplitMix64::new(10);
    let mut block = Stepper::new("fresh_ids", FreshIds::default(), 4);
    let mut count = Count::default();
    let (mut since_end, mut ends) = (0, 0);
    for clock in 0..6_000 {
        let choice = random.below(40);
        let is_settled = count.is_settled();
        let event = Event {
            reset: clock == 0 || random.below(500) == 0,
            takes: choice < 20 && !(is_settled && choice < 3) && count.fresh < 0x7f00,
            ends: choice > 34 && since_end >= 2,
            solo_inserts: choice == 0 && is_settled,
            seeds: choice == 1 && is_settled,
            clears: choice == 2 && is_settled,
        };
        since_end = if event.ends { 0 } else { since_end + 1 };
        ends += usize::from(event.ends);
        count_clock(&mut block, &mut count, event);
    }
    assert!(ends > 300, "{ends}");
}

#[test]
fn fresh_ids_show_the_wave_of_their_header() {
    let mut block = Stepper::new("fresh_ids", FreshIds::default(), 4);
    let mut count = Count::default();
    count_clock(&mut block, &mut count, Event { reset: true, ..Event::default() });
    let mut wave = Wave::default();
    for clock in 0..11 {
        let event = Event { seeds: clock == 1, takes: clock == 4 || clock == 5, ends: clock == 7, ..Event::default() };
        wave.take(&[
            ("seeds", Cell::Bit(event.seeds)),
            ("takes", Cell::Bit(event.takes)),
            ("ends", Cell::Bit(event.ends)),
            ("fresh", number(count.fresh)),
            ("records", number(count.records)),
        ]);
        count_clock(&mut block, &mut count, event);
    }
    wave.assert_drawn_in("fresh_ids");
}

/// The lists of inner triangles, and the one that is read.
struct ListRig {
    block: Stepper<InnerList>,
    lists: Vec<Vec<u64>>,
    reader: usize,
    index: usize,
    /// Clocks that the next triangle has been looked for; none before the first list.
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

    /// One clock, in which a triangle may join a list, and another list may be the next to be read.
    fn clock(&mut self, joins: Option<(usize, u64)>, restarts: Option<usize>, steps: bool) {
        let (is_awaited, can_step) = (self.is_awaited(), self.can_step());
        let block = &mut self.block;
        let (owner, id) = joins.unwrap_or_default();
        block.set("enable", joins.is_some());
        block.set("owner", owner as u64);
        block.set("place", self.lists[owner].len() as u64 % 64);
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
        self.lists[owner].extend(joins.map(|(_, id)| id));
        self.age = self.age.map(|age| if steps { 0 } else { age + 1 });
        self.index += usize::from(steps);
        if let Some(reader) = restarts {
            (self.reader, self.index, self.age) = (reader, 0, Some(0));
        }
    }
}

fn gives_inner_triangles(name: &'static str, config: Config) {
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
    gives_inner_triangles("inner_list_6", TINY);
}

#[test]
fn inner_list_of_the_longest_list() {
    gives_inner_triangles("inner_list_64", LONGEST);
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
