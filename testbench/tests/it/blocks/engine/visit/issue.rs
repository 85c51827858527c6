//! Runs `Issue` in Rust and in Verilog beside plain arithmetic: all three must agree in every clock.

use std::cell::RefCell;
use std::collections::VecDeque;

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::bundles::{pack, random_fields, ring_bundle, unpack, BUNDLE, VISIT};
use crate::rig::stepper::{named_ports, Expected, Stepper};
use incircle_hdl::engine::Issue;
use incircle_testkit::SplitMix64;

named_ports!([] Issue, [reset, push, read], [visit_valid, visit, vertices_id, links_id, read_valid], clock);

const CYCLES: usize = 6_000;

/// Visits that wait, each with a mark on the last of its bundle, and the issue register.
#[derive(Default)]
struct Queue {
    waiting: VecDeque<(u128, bool)>,
    issued: Expected,
    read_id: Option<u64>,
    fullest: usize,
}

impl Queue {
    fn bundles(&self) -> usize {
        self.waiting.iter().filter(|(_, is_last)| *is_last).count()
    }

    fn push(&mut self, bundle: u128) {
        let [is_pair, is_triple, context, rotates, locks, entry, after, ..] = unpack(BUNDLE, bundle);
        let [.., cavity_entry, cavity_record, record, after2, record2, record3] = unpack(BUNDLE, bundle);
        let visits = [(entry, after, record), (after, after2, record2), (after2, 0, record3)];
        let last = (is_pair + is_triple) as usize;
        for (place, (entry, after, record)) in visits.into_iter().enumerate().take(last + 1) {
            let visit = pack(VISIT, [context, rotates, locks, entry, after, cavity_entry, cavity_record, record]);
            self.waiting.push_back((visit, place == last));
        }
        self.fullest = self.fullest.max(self.bundles());
    }
}

#[test]
fn issue_makes_one_visit_a_clock_in_order() {
    const PLACES: usize = 32;
    let queue = RefCell::new((Queue::default(), SplitMix64::new(31)));
    let stimuli = (0..CYCLES).map(|cycle| {
        let (queue, numbers) = &mut *queue.borrow_mut();
        // Floods, drops and droughts take turns.
        let rate = [1, 2, 9, 40][cycle / 128 % 4];
        let has_place = queue.bundles() < PLACES;
        let push = has_place && numbers.once_in(rate);
        let read = queue.waiting.is_empty() && !push && numbers.bits(1) == 1;
        let mut bundle = random_fields(BUNDLE, numbers);
        bundle[1] &= bundle[0];
        vec![
            u128::from(cycle == 0 || numbers.once_in(200)),
            push.into(),
            pack(BUNDLE, bundle),
            read.into(),
            numbers.bits(15).into(),
        ]
    });
    let mut is_known = false;
    Stepper::new("issue_5", Issue::new(5), 1).run(
        &["reset", "push_valid", "push_bundle", "read.valid", "read_id"],
        &["visit_valid", "visit", "read_valid", "visit[40+:15]", "vertices_id", "links_id"],
        stimuli,
        |values| {
            let queue = &mut queue.borrow_mut().0;
            let visit_valid = Some(queue.issued.is_some().into());
            let read_valid = Some(queue.read_id.is_some().into());
            let read_id = queue.read_id.map(u128::from);
            let record = queue.issued.map(|visit| unpack(VISIT, visit)[7].into()).or(read_id);
            let outputs = vec![visit_valid, queue.issued, read_valid, read_id, record, record];
            if values[1] == 1 {
                queue.push(values[2]);
            }
            queue.issued = queue.waiting.pop_front().map(|(visit, _)| visit);
            queue.read_id = (values[3] == 1).then_some(values[4] as u64);
            if values[0] == 1 {
                let fullest = queue.fullest;
                *queue = Queue { fullest, ..Queue::default() };
            }
            let shown = if is_known { outputs } else { vec![None; 6] };
            is_known |= values[0] == 1;
            shown
        },
    );
    assert_eq!(queue.into_inner().0.fullest, PLACES, "the test fills every place");
}

#[test]
fn issue_shows_the_wave_of_its_header() {
    let stimuli = [
        (1, "push_valid", 1),
        (1, "push_bundle", ring_bundle(&[1, 2, 3])),
        (2, "push_valid", 1),
        (2, "push_bundle", ring_bundle(&[4])),
        (6, "read.valid", 1),
        (6, "read_id", 9),
    ];
    let lanes = [
        ("push", "push_valid", 0, 1, When::Always),
        ("bundle.entry", "push_bundle", 9, 6, When::If("push_valid")),
        ("visit_valid", "visit_valid", 0, 1, When::Always),
        ("visit.entry", "visit", 7, 6, When::If("visit_valid")),
        ("read", "read.valid", 0, 1, When::Always),
        ("read_valid", "read_valid", 0, 1, When::Always),
        ("visit.record", "visit", 40, 15, When::If("read_valid")),
    ];
    draw("issue_5", Issue::new(5), &stimuli, 9, &lanes).assert_drawn_in("issue");
}
