//! Runs `CommandQueue` in Rust and in Verilog beside a list of words: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::cluster::CommandQueue;
use incircle_protocol::ENGINE_QUEUE_WORDS;
use incircle_testkit::SplitMix64;

named_ports!(CommandQueue, [reset, push, word, command.ready], [has_room, command.valid, command.data], clock);

#[test]
fn command_queue_keeps_the_words_in_order() {
    let mut random = SplitMix64::new(41);
    let mut block = Stepper::new("command_queue", CommandQueue::default(), 1);
    // Words on offer, and the one that came at the edge before.
    let (mut words, mut came): (VecDeque<u32>, Option<u32>) = (VecDeque::new(), None);
    let mut fullest = 0;
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(3000) == 0;
        let waiting = words.len() + usize::from(came.is_some());
        let has_room = waiting < ENGINE_QUEUE_WORDS;
        // The engine is slow, quick, and slow again.
        let ready = random.below(100) < [10, 90, 40][clock / 900 % 3];
        let push = has_room && random.below(100) < 60;
        let word = random.next_u64() as u32;
        for (port, value) in [("reset", reset), ("push", push), ("command_ready", ready)] {
            block.set(port, value);
        }
        block.set("word", word);
        block.settle();
        let offered = words.front().copied().or(came);
        if clock > 0 {
            block.expect("has_room", has_room);
            block.expect("command_valid", offered.is_some());
            if let Some(word) = offered {
                block.expect("command_data", word);
            }
        }
        block.edge();
        words.extend(came);
        if offered.is_some() && ready {
            words.pop_front();
        }
        came = push.then_some(word);
        fullest = fullest.max(waiting);
        if reset {
            words.clear();
            came = None;
        }
    }
    assert_eq!(fullest, ENGINE_QUEUE_WORDS);
}
