//! Runs `JobRouter` in Rust and in Verilog among engines that the test plays: all words of a job must reach one engine
//! that may get it, each word once and in order, whatever the engines do meanwhile.

use std::collections::VecDeque;

use super::word_place::command;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::cluster::JobRouter;
use incircle_testkit::SplitMix64;

named_ports!(
    JobRouter,
    [reset, command.valid, command.data, free, stuck, room],
    [command.ready, push, routed, is_busy],
    clock
);

/// An engine as the router sees it.
#[derive(Clone, Copy, Debug, Default)]
struct Engine {
    /// Number of commands that are not answered.
    owed: u32,
    is_stuck: bool,
    has_room: bool,
}

fn bits(engines: &[Engine; 4], flag: impl Fn(&Engine) -> bool) -> u32 {
    engines.iter().enumerate().map(|(place, engine)| u32::from(flag(engine)) << place).sum()
}

/// Runs the router with this share of clocks, in a hundred, in which an engine has room and an answer ends.
fn run(seed: u64, pace: u64) {
    let mut random = SplitMix64::new(seed);
    let mut block = Stepper::new("job_router", JobRouter::default(), seed as u32);
    // Words that the host has to send, and words that went into the router, each with its place in its command.
    let mut words = VecDeque::<(u32, usize)>::new();
    let mut inside = VecDeque::<(u32, usize)>::new();
    let mut engines = [Engine::default(); 4];
    // The choice of an engine is made in the clock before its job goes there.
    let mut stuck_before = [false; 4];
    let mut current = 0;
    let mut used = [0; 4];
    let mut sent_to_stuck = 0;
    for clock in 0..60_000 {
        let reset = clock == 0 || random.below(2000) == 0;
        if words.is_empty() {
            words.extend(command(&mut random).into_iter().enumerate().map(|(place, word)| (word, place)));
        }
        for engine in &mut engines {
            engine.has_room = random.below(100) < pace;
            engine.owed -= u32::from(engine.owed > 0 && random.below(100) < pace);
            engine.is_stuck |= random.below(4000) == 0;
        }
        let valid = random.below(100) < 80;
        let (stuck, free) = (bits(&engines, |it| it.is_stuck), bits(&engines, |it| it.owed == 0));
        block.set("reset", reset);
        block.set("command_valid", valid);
        block.set("command_data", words[0].0);
        block.set("free", free);
        block.set("stuck", stuck);
        block.set("room", bits(&engines, |it| it.has_room));
        block.settle();
        if clock == 0 {
            block.edge();
            continue;
        }
        let push = block.get("push") as u32;
        let ready = block.is("command_ready");
        assert_eq!(ready, inside.is_empty(), "one word at a time");
        block.expect("is_busy", !inside.is_empty() || words[0].1 > 0);
        assert!(push.count_ones() <= 1, "{push:b}");
        let is_padding = inside.front() == Some(&(0, 0));
        if push > 0 {
            let (word, place) = inside.pop_front().expect("a word that came");
            let engine = push.trailing_zeros() as usize;
            block.expect("word", word);
            block.expect("begins", place == 0);
            assert!(!is_padding, "padding goes nowhere");
            if place == 0 && word >> 24 == 2 {
                let it = engines[engine];
                assert!(it.owed == 0, "{it:?}");
                let all_are_stuck = stuck_before.iter().all(|&is_stuck| is_stuck);
                assert!(!stuck_before[engine] || all_are_stuck, "engine {engine} of {stuck_before:?}");
                sent_to_stuck += u32::from(all_are_stuck);
                used[engine] += u32::from(engine != current);
                current = engine;
            } else {
                assert!(engine == current && engines[engine].has_room, "engine {engine} and {current}");
            }
            engines[engine].owed += u32::from(place == 0);
        } else if let Some(&(word, place)) = inside.front().filter(|_| !is_padding) {
            let begins_job = place == 0 && word >> 24 == 2;
            assert!(begins_job || !engines[current].has_room, "a word goes when it can");
        }
        if is_padding {
            inside.pop_front();
        }
        block.edge();
        stuck_before = engines.map(|engine| engine.is_stuck);
        if valid && ready {
            inside.extend(words.pop_front());
        }
        if reset {
            (current, engines, stuck_before) = (0, [Engine::default(); 4], [false; 4]);
            words.clear();
            inside.clear();
        }
    }
    assert!(used.iter().all(|&jobs| jobs > 50) && sent_to_stuck > 10, "{used:?} {sent_to_stuck}");
}

#[test]
fn job_router_gives_each_job_to_one_engine() {
    run(44, 50);
}

#[test]
fn job_router_waits_for_slow_engines() {
    run(45, 15);
}
