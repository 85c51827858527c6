//! Runs `ItemQueues` in Rust and in Verilog beside lists of items: all three must agree in every clock. The lists have
//! no counts and no memory with a latency.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::living::ItemQueues;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(ItemQueues, [reset, dealt, ends, launches], [taken, waits, launch, rests], clock);

/// Most items that wait for a context.
const DEPTH: usize = 32;
/// Clocks after a reset in which no item comes.
const SWEEP: usize = 33;
const FOUR_TIMES_SIX: Config = Config { contexts: 24, ..TINY };

/// Number and place of an item. Its vertex has the bits of the place turned over.
type Item = (u64, u64);

/// What the queues must do.
struct Lists {
    idle: Vec<bool>,
    waiting: Vec<VecDeque<Item>>,
    /// Items that come out of the memory in the next clock, and in the one after it.
    fetched: VecDeque<Option<(usize, Item)>>,
    /// The item on offer that joins the line in the next clock, and the line.
    joined: Option<(usize, Item)>,
    beginners: VecDeque<(usize, Item)>,
    /// Contexts whose item has begun.
    at_work: Vec<usize>,
    fullest: usize,
}

impl Lists {
    fn new(contexts: usize) -> Self {
        Self {
            idle: vec![true; contexts],
            waiting: vec![VecDeque::new(); contexts],
            fetched: VecDeque::from([None, None]),
            joined: None,
            beginners: VecDeque::new(),
            at_work: Vec::new(),
            fullest: 0,
        }
    }

    /// Runs one clock with an item on offer, the end of a context's item, and the wish to begin one. Returns the item
    /// that begins, and whether the offer was taken.
    fn clock(
        &mut self,
        block: &mut Stepper<ItemQueues>,
        dealt: Option<(usize, Item)>,
        ends: Option<usize>,
        wants: bool,
    ) -> (Option<(usize, Item)>, bool) {
        block.set("reset", false);
        block.set("dealt_valid", dealt.is_some());
        let (context, (number, place)) = dealt.unwrap_or((1, (77, 78)));
        block.set("dealt_context", context as u64);
        block.set("dealt_item_number", number);
        block.set("dealt_item_place", place);
        block.set("dealt_item_vertex", !place & 0x7fff);
        block.set("ends_valid", ends.is_some());
        block.set("ends_context", ends.unwrap_or(0) as u64);
        block.set("launches", false);
        block.settle();

        let comes = self.fetched.pop_front().flatten();
        let comes_next = self.fetched.front().is_some_and(Option::is_some);
        let begins = dealt.is_some() && self.idle[context] && !comes_next;
        let has_place = self.waiting[context].len() < DEPTH && ends != Some(context);
        let stores = dealt.is_some() && !self.idle[context] && has_place;
        self.beginners.extend(comes.or(self.joined));
        self.joined = dealt.filter(|_| begins);
        block.expect("taken", begins || stores);
        block.expect("waits", !self.beginners.is_empty());
        block.expect("rests", self.idle.iter().all(|&idle| idle));
        let first = self.beginners.front().copied();
        if let Some((context, (number, place))) = first {
            block.expect("launch_context", context as u64);
            block.expect("launch_item_number", number);
            block.expect("launch_item_place", place);
            block.expect("launch_item_vertex", !place & 0x7fff);
        }
        let launched = first.filter(|_| wants);
        block.set("launches", launched.is_some());
        block.settle();
        block.edge();

        if begins {
            self.idle[context] = false;
        }
        let next = ends.map(|context| (context, self.waiting[context].pop_front()));
        if let Some((context, None)) = next {
            self.idle[context] = true;
        }
        self.fetched.push_back(next.and_then(|(context, item)| Some((context, item?))));
        if stores {
            self.waiting[context].push_back((number, place));
            self.fullest = self.fullest.max(self.waiting[context].len());
        }
        if let Some(launched) = launched {
            self.beginners.pop_front();
            self.at_work.push(launched.0);
        }
        if let Some(context) = ends {
            self.at_work.retain(|&at_work| at_work != context);
        }
        (launched, begins || stores)
    }
}

fn reset(block: &mut Stepper<ItemQueues>) {
    for clock in 0..4 + SWEEP {
        block.set("reset", clock < 4);
        block.set("dealt_valid", false);
        block.set("ends_valid", false);
        block.set("launches", false);
        block.settle();
        block.edge();
    }
}

fn random_items(name: &str, config: Config, seed: u64) {
    let contexts = config.contexts as usize;
    let mut random = SplitMix64::new(seed);
    let mut block = Stepper::new(name, ItemQueues::new(config), 1);
    let (mut begun, mut fullest) = (0, 0);
    for run in 0..6 {
        reset(&mut block);
        let mut lists = Lists::new(contexts);
        let mut dealt = None;
        let mut last = vec![0; contexts];
        for clock in 0..3_000 {
            // Times in which items come faster than they end, and times in which they come slower.
            let pace = [1, 3, 40][(clock / 500 + run) % 3];
            if dealt.is_none() && random.once_in(pace) {
                // The first contexts get the most.
                let most = 1 + random.below(contexts as u64);
                let context = random.below(most) as usize;
                dealt = Some((context, (clock as u64, random.bits(32))));
            }
            let ends = lists.at_work.first().copied().filter(|_| random.once_in(4));
            let wants = !random.once_in(3);
            let (launched, taken) = lists.clock(&mut block, dealt, ends, wants);
            if let Some((context, (number, _))) = launched {
                assert!(number >= last[context], "the items of a context begin in their order");
                last[context] = number;
                begun += 1;
            }
            if taken {
                dealt = None;
            }
        }
        fullest = fullest.max(lists.fullest);
    }
    assert!(begun > 1_000 && fullest == DEPTH, "{begun} items began, and {fullest} waited for one context");
}

#[test]
fn item_queues_of_two_contexts_keep_the_order() {
    random_items("living_item_queues_2", TINY, 62);
}

#[test]
fn item_queues_of_24_contexts_keep_the_order() {
    random_items("living_item_queues_24", FOUR_TIMES_SIX, 63);
}

#[test]
fn item_queues_show_the_wave_of_their_header() {
    let mut block = Stepper::new("living_item_queues_2", ItemQueues::new(TINY), 2);
    reset(&mut block);
    let mut lists = Lists::new(2);
    let mut wave = Wave::default();
    for clock in 0..10 {
        let dealt = [(1, 4), (2, 5)].into_iter().find(|&(at, _)| at == clock).map(|(_, number)| (1, (number, 9)));
        let ends = (clock == 5).then_some(1);
        let wants = clock == 2 || clock == 8;
        let waits_before = lists.beginners.len();
        let (launched, taken) = lists.clock(&mut block, dealt, ends, wants);
        let shown = launched.or_else(|| lists.beginners.front().copied());
        let number =
            |item: Option<(usize, Item)>| item.map_or(Cell::Open, |(_, (number, _))| Cell::Number(number.into()));
        assert!(waits_before <= 1);
        wave.take(&[
            ("dealt", Cell::Bit(dealt.is_some())),
            ("dealt.number", number(dealt)),
            ("taken", Cell::Bit(taken)),
            ("ends", Cell::Bit(ends.is_some())),
            ("waits", Cell::Bit(shown.is_some())),
            ("launch.number", number(shown)),
            ("launches", Cell::Bit(launched.is_some())),
        ]);
    }
    wave.assert_drawn_in("item_queues");
}
