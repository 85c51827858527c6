//! Runs `PointSlot` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::PointSlot;
use incircle_testkit::SplitMix64;

named_ports!(PointSlot, [reset, clears, capacity, engine, taken], [arrival, tally], clock);

const CLOCKS: usize = 8000;

/// Points that were stored, in their order, and the number of those that were refused.
#[derive(Default)]
struct SlotReference {
    stored: Vec<u64>,
    came: bool,
    refused: u64,
    /// The last point is refused, and counted at the next edge.
    is_surplus: bool,
}

impl SlotReference {
    fn expect(&self, block: &Stepper<PointSlot>) {
        block.expect("came", self.came);
        block.expect("arrived", self.stored.len() as u64);
        block.expect("refused", self.refused);
        block.expect("some_refused", self.refused > 0);
        if let (true, Some(point)) = (self.came, self.stored.last()) {
            block.expect("arrival_id", self.stored.len() as u64 - 1);
            block.expect("point", *point);
        }
    }

    /// Passes an edge at which `word` comes and is stored or refused.
    fn edge(&mut self, word: Option<u64>, has_room: bool) {
        let stored = word.filter(|_| has_room);
        self.refused += u64::from(self.is_surplus);
        self.is_surplus = word.is_some() && !has_room;
        self.came = stored.is_some();
        self.stored.extend(stored);
    }
}

fn point_slot(capacity: u64) {
    let mut random = SplitMix64::new(32);
    let mut block = Stepper::new("point_slot", PointSlot::default(), 1);
    block.set("capacity", capacity);
    let (mut reference, mut most) = (SlotReference::default(), 0);
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(200) == 0;
        let clears = !reference.came && random.below(60) == 0;
        let [collinear, stuck] = [(); 2].map(|()| random.below(12) == 0);
        let accepts = !reference.came && !clears && random.below(2) == 0;
        let word = random.below(1 << 32);
        for (port, value) in
            [("reset", reset), ("clears", clears), ("collinear", collinear), ("stuck", stuck), ("is_point", accepts)]
        {
            block.set(port, value);
        }
        block.set("word", word);
        block.settle();
        if clock > 0 {
            reference.expect(&block);
        }
        block.edge();
        let has_room = !collinear && !stuck && (reference.stored.len() as u64) < capacity;
        reference.edge(accepts.then_some(word), has_room);
        most = most.max(reference.stored.len());
        if clears || reset {
            reference = SlotReference::default();
        }
    }
    assert!(most >= 4, "{most}");
}

#[test]
fn point_slot_hands_on_a_point_and_counts_it() {
    for capacity in [4, 8, 16384] {
        point_slot(capacity);
    }
}
