//! Runs `LockStore` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::drawing::{draw, When};
use crate::rig::ids::id;
use crate::rig::stepper::{named_ports, Delay, Expected, Stepper};
use crate::rig::visit_model::Locks;
use incircle_hdl::mesh::LockStore;
use incircle_testkit::SplitMix64;

named_ports!([] LockStore, [id, context_id, takes, clear], [took, foreign, was_set], clock);

const CYCLES: usize = 6_000;

/// Counts of events at the locks, so that a test can check that each of them happened.
#[derive(Debug, Default)]
pub struct LockEvents {
    pub took: usize,
    pub foreign: usize,
    pub own: usize,
    pub met_clear: usize,
    /// Visits whose lock was taken by another visit one, two or three clocks before.
    pub before: [usize; 3],
}

/// Locks as a list of holders: the finding of a visit comes first, then the clear of the same edge.
pub struct LockReference {
    pub locks: Locks,
    pub last: usize,
    pub last_context: u64,
    /// Locks that the three visits before took, the latest first.
    pub taken: [Option<usize>; 3],
    pub events: LockEvents,
}

impl LockReference {
    pub fn new(id_bits: u32, context_bits: u32) -> Self {
        let last = (1 << id_bits) - 1;
        let last_context = (1 << context_bits) - 1;
        Self { locks: Locks::new(last + 1), last, last_context, taken: [None; 3], events: LockEvents::default() }
    }

    /// Passes an edge; returns `took`, `foreign` and `was_set`.
    pub fn edge(&mut self, id: u64, context: u64, takes: bool, clear: Option<u64>) -> [Expected; 3] {
        let id = id as usize & self.last;
        let context = context & self.last_context;
        let cleared = clear.map(|id| id as usize & self.last);
        let meets = cleared == Some(id);
        let was_set = self.locks.holder(id).is_some();
        let (took, foreign) = if takes { self.locks.take(id, context, meets) } else { (false, false) };
        if let Some(cleared) = cleared {
            self.locks.clear(cleared);
        }
        let events = &mut self.events;
        events.took += usize::from(took);
        events.foreign += usize::from(foreign && !meets);
        events.own += usize::from(takes && !took && !foreign);
        events.met_clear += usize::from(takes && meets);
        let finds = takes && was_set && !meets;
        for (count, taken) in events.before.iter_mut().zip(self.taken) {
            *count += usize::from(finds && taken == Some(id));
        }
        self.taken = [took.then_some(id), self.taken[0], self.taken[1]];
        let was_set = (!meets).then_some(was_set.into());
        [Some(took.into()), Some(foreign.into()), was_set]
    }

    pub fn assert_all_happened(&self) {
        let LockEvents { took, foreign, own, met_clear, before } = self.events;
        let counts = [took, foreign, own, met_clear];
        assert!(counts.iter().chain(&before).all(|count| *count > CYCLES / 100), "{:?}", self.events);
    }
}

/// Delays the finding of a visit: the lock as it was, and a clock later what became of it.
pub struct LockDelay {
    pub was_set: Delay<Expected>,
    pub became: Delay<[Expected; 2]>,
}

impl Default for LockDelay {
    fn default() -> Self {
        Self { was_set: Delay::new(LockStore::READ_LATENCY), became: Delay::new(LockStore::LATENCY) }
    }
}

impl LockDelay {
    /// Delays `took`, `foreign` and `was_set`.
    pub fn pass(&mut self, [took, foreign, was_set]: [Expected; 3]) -> [Expected; 3] {
        let [took, foreign] = self.became.pass([took, foreign]).unwrap_or([None; 2]);
        [took, foreign, self.was_set.pass(was_set).flatten()]
    }
}

fn lock_store(name: &str, id_bits: u32, context_bits: u32) {
    let mut numbers = SplitMix64::new(26);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|cycle| {
            // Visits at every clock, visits with gaps, and clears at every clock take turns.
            let (gaps, clears) = [(9, 3), (2, 3), (9, 1)][cycle / 100 % 3];
            let context = (2 * numbers.bits(1)) | (numbers.bits(5) >> context_bits << context_bits);
            let takes = u64::from(!numbers.once_in(gaps));
            let clears = u64::from(numbers.once_in(clears));
            vec![id(&mut numbers, id_bits), context, takes, id(&mut numbers, id_bits), clears]
        })
        .collect();
    let mut reference = LockReference::new(id_bits, context_bits);
    let mut delay = LockDelay::default();
    Stepper::new(name, LockStore::new(id_bits as usize, context_bits as usize), 1).run(
        &["id", "context_id", "takes", "clear_id", "clear_valid"],
        &["took", "foreign", "was_set"],
        stimuli,
        |values| {
            let found = reference.edge(values[0], values[1], values[2] == 1, (values[4] == 1).then_some(values[3]));
            delay.pass(found).to_vec()
        },
    );
    reference.assert_all_happened();
}

#[test]
fn lock_store_knows_the_holder_at_every_clock() {
    lock_store("lock_store_15_5", 15, 5);
}

#[test]
fn lock_store_ignores_what_is_above_its_shape() {
    lock_store("lock_store_4_2", 4, 2);
}

#[test]
fn lock_store_shows_the_wave_of_its_header() {
    const VISITS: [usize; 5] = [0, 1, 2, 4, 5];
    const KNOWN: [usize; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
    let mut stimuli = vec![(4, "clear_id", 5), (4, "clear_valid", 1)];
    for (clock, context) in VISITS.into_iter().zip([3, 4, 3, 4, 4]) {
        stimuli.extend([(clock, "id", 5), (clock, "context_id", context), (clock, "takes", 1)]);
    }
    let lanes = [
        ("id", "id", 0, 15, When::At(&VISITS)),
        ("context_id", "context_id", 0, 5, When::At(&VISITS)),
        ("takes", "takes", 0, 1, When::Always),
        ("clear_enable", "clear_valid", 0, 1, When::Always),
        ("took", "took", 0, 1, When::At(&KNOWN)),
        ("foreign", "foreign", 0, 1, When::At(&KNOWN)),
    ];
    draw("lock_store_15_5", LockStore::new(15, 5), &stimuli, 9, &lanes).assert_drawn_in("lock_store");
}
