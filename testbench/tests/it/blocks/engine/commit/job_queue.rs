//! Runs `JobQueue` in Rust and in Verilog beside a list of all jobs in their order: all three must agree in every
//! clock. The list has no pointers.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::JobQueue;
use incircle_testkit::SplitMix64;

named_ports!([] JobQueue<6>, [reset, enable, job, takes], [waits, head], clock);

/// Runs one clock of a queue of up to four jobs and of its list. A job is listed a clock after it came.
fn queue_clock(block: &mut Stepper<JobQueue<6>>, list: &mut VecDeque<u64>, reset: bool, job: Option<u64>, takes: bool) {
    block.set("reset", reset);
    block.set("enable", job.is_some());
    block.set("job", job.unwrap_or(0x15));
    block.set("takes", takes);
    block.settle();
    if block.clocks() > 0 {
        block.expect("waits", !list.is_empty());
    }
    if let Some(job) = list.front() {
        block.expect("head", *job);
    }
    block.edge();
    if takes {
        list.pop_front();
    }
    list.extend(job);
    if reset {
        list.clear();
    }
}

#[test]
fn job_queue_keeps_the_order() {
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("job_queue_2x6", JobQueue::new(2), 3);
    let mut list = VecDeque::new();
    let (mut full, mut empty) = (0, 0);
    for clock in 0..5_000 {
        let comes = list.len() < 4 && random.below(3) != 0;
        let takes = random.below(1 + clock / 100 % 4) == 0;
        let job = comes.then(|| random.below(64));
        queue_clock(&mut block, &mut list, clock == 0 || random.below(300) == 0, job, takes);
        full += usize::from(list.len() == 4);
        empty += usize::from(list.is_empty());
    }
    assert!(full > 200 && empty > 200, "{full} {empty}");
}

#[test]
fn job_queue_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("job_queue_2x6", JobQueue::new(2), 3);
    let mut list = VecDeque::new();
    let mut wave = Wave::default();
    queue_clock(&mut block, &mut list, true, None, false);
    for clock in 0..10 {
        let job = [(1, 5), (3, 6), (4, 7)].into_iter().find(|(at, _)| *at == clock).map(|(_, job)| job);
        let takes = clock < 4 || clock == 6;
        let head = list.front().copied();
        queue_clock(&mut block, &mut list, false, job, takes);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        wave.take(&[
            ("enable", Cell::Bit(job.is_some())),
            ("job", number(job)),
            ("takes", Cell::Bit(takes)),
            ("waits", Cell::Bit(head.is_some())),
            ("head", number(head)),
        ]);
    }
    wave.assert_drawn_in("job_queue");
}
