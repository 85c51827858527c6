//! Beats and words of the stream link: Rust, Verilog and plain code agree clock by clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, NamedPorts, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::stream::{AnswerBeats, AnswerPairs, AnswerWatch, BeatGate, BeatWords, Progress};
use incircle_protocol::{answer_header, Opcode, Status};

named_ports!([const K: usize] BeatGate<K>, [reset, s_axis_tvalid, s_axis_tkeep, is_full], [push, events], clock);
named_ports!([const W: usize] BeatWords<W>,
    [reset, beat_valid, beat_data, command.ready], [takes, command.valid, command.data, is_held], clock);
named_ports!([] AnswerPairs,
    [reset, response.valid, response.data, response.both, response.last, is_stalled], [response.ready, pair_valid, pair_data, pair_last, is_held], clock);
named_ports!([const W: usize] AnswerBeats<W>,
    [reset, pair_valid, pair_data, pair_last, is_full], [is_stalled, beat_valid, beat_data, beat_last, is_held], clock);
named_ports!([const W: usize] AnswerWatch<W>,
    [reset, resets, m_axis_tvalid, m_axis_tready, m_axis_tdata, m_axis_tlast], [events], clock);
named_ports!([] Progress, [reset, takes, word, offers_last, ends], [is_busy], clock);

fn set_bits<U: NamedPorts>(block: &mut Stepper<U>, bits: &[(&'static str, bool)]) {
    for (port, bit) in bits {
        block.set(port, *bit);
    }
}

fn wide(words: &[u32]) -> u128 {
    words.iter().rev().fold(0, |number, word| number << 32 | u128::from(*word))
}

#[test]
fn only_whole_beats_are_pushed() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("stream_beat_gate", BeatGate::<8>::default(), 1);
    let mut events = [false; 3];
    let mut times_dropped = 0;
    for clock in 0..4000 {
        let reset = clock == 0 || random.below(200) == 0;
        let (valid, is_full) = (random.below(3) != 0, random.below(3) == 0);
        let keep = if random.below(4) == 0 { random.below(256) } else { 255 };
        set_bits(&mut block, &[("reset", reset), ("s_axis_tvalid", valid), ("is_full", is_full)]);
        block.set("s_axis_tkeep", keep);
        block.settle();
        block.expect("push", valid && keep == 255);
        if clock > 0 {
            for (port, event) in ["took", "waited", "dropped"].into_iter().zip(events) {
                block.expect(port, event);
            }
        }
        block.edge();
        events = [valid && !is_full, valid && is_full, valid && !is_full && keep != 255].map(|event| event && !reset);
        times_dropped += usize::from(events[2]);
    }
    assert!(times_dropped > 100);
}

fn cuts<const W: usize>(name: &'static str) {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new(name, BeatWords::<W>::new(), 1);
    let mut held: VecDeque<u32> = VecDeque::new();
    let mut words = 0;
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(500) == 0;
        let valid = random.below([1, 5][clock / 600 % 2]) == 0;
        let ready = random.below([1, 4][clock / 1200 % 2]) == 0;
        let beat: Vec<u32> = (0..W / 32).map(|_| random.below(1 << 32) as u32).collect();
        set_bits(&mut block, &[("reset", reset), ("beat_valid", valid), ("command_ready", ready)]);
        block.set("beat_data", wide(&beat));
        block.settle();
        let loads = valid && (held.is_empty() || held.len() == 1 && ready);
        if clock > 0 {
            block.expect("command_valid", !held.is_empty());
            block.expect("is_held", !held.is_empty());
            block.expect("takes", loads);
            if let Some(word) = held.front() {
                block.expect("command_data", *word);
            }
        }
        block.edge();
        if ready && held.pop_front().is_some() {
            words += 1;
        }
        if loads {
            held.extend(beat);
        }
        if reset {
            held.clear();
        }
    }
    assert!(words > 2000, "{words} words");
}

#[test]
fn beats_are_cut_into_words() {
    cuts::<64>("stream_beat_words_64");
    cuts::<128>("stream_beat_words_128");
}

#[test]
fn beat_words_show_the_wave_of_their_header() {
    let mut block = Stepper::new("stream_beat_words_64", BeatWords::<64>::new(), 1);
    let mut wave = Wave::default();
    let mut beats: VecDeque<u32> = [1, 3].into();
    for clock in 0..9 {
        let valid = clock > 0 && !beats.is_empty();
        let ready = clock != 3;
        set_bits(&mut block, &[("reset", clock == 0), ("beat_valid", valid), ("command_ready", ready)]);
        let first = beats.front().copied().unwrap_or(0);
        block.set("beat_data", wide(&[first, first + 1]));
        block.settle();
        let takes = valid && block.is("takes");
        let gives = clock > 0 && block.is("command_valid");
        wave.take(&[
            ("beat_valid", Cell::Bit(valid)),
            ("takes", Cell::Bit(takes)),
            ("command_valid", Cell::Bit(gives)),
            ("command_ready", Cell::Bit(ready)),
            ("command_data", if gives { Cell::Number(block.get("command_data")) } else { Cell::Open }),
        ]);
        block.edge();
        if takes {
            beats.pop_front();
        }
    }
    wave.assert_drawn_in("beat_words");
}

/// Words that are offered: one or two, and whether the answer ends with them.
type Offer = (u32, Option<u32>, bool);

/// An answer of so many words, in pieces of one and two.
fn pieces(length: u64, random: &mut SplitMix64, next: &mut u32) -> Vec<Offer> {
    let mut left = length;
    let mut offers = Vec::new();
    let mut word = || {
        *next += 1;
        *next
    };
    while left > 0 {
        let both = left > 1 && random.below(2) == 0;
        left -= 1 + u64::from(both);
        offers.push((word(), both.then(&mut word), left == 0));
    }
    offers
}

fn offer(block: &mut Stepper<AnswerPairs>, offered: Option<Offer>, junk: u64) {
    let (first, second, is_last) = offered.unwrap_or((junk as u32, None, junk & 1 == 1));
    block.set("response_valid", offered.is_some());
    block.set("response_data", u128::from(first) | u128::from(second.unwrap_or((junk >> 32) as u32)) << 32);
    block.set("response_both", second.is_some());
    block.set("response_last", is_last);
}

#[test]
fn answers_become_pairs() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("stream_answer_pairs", AnswerPairs::default(), 1);
    let mut next = 0;
    let (mut offers, mut expected): (VecDeque<Offer>, VecDeque<(u128, bool)>) = Default::default();
    let mut held: Vec<u32> = Vec::new();
    let (mut passed, mut shown) = (0, None);
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(3000) == 0;
        if offers.is_empty() {
            let length = 1 + random.below(9);
            offers.extend(pieces(length, &mut random, &mut next));
        }
        let offered = (random.below([1, 3][clock / 500 % 2]) == 0).then(|| offers[0]);
        let is_stalled = random.below([1, 3][clock / 1000 % 2]) != 0;
        block.set("reset", reset);
        block.set("is_stalled", is_stalled && clock > 0);
        let junk = random.next_u64();
        offer(&mut block, offered, junk);
        block.settle();
        let takes = clock > 0 && offered.is_some() && block.is("response_ready");
        if clock > 0 {
            let valid = block.is("pair_valid");
            assert!(shown.is_none() || valid, "a pair went though it was stalled");
            if valid {
                let (pair, is_last) = expected.front().copied().expect("a pair that nobody sent");
                block.expect("pair_data", pair);
                block.expect("pair_last", is_last);
                assert!(block.is("is_held"));
            }
            block.expect("is_held", !expected.is_empty() || !held.is_empty());
            shown = (valid && is_stalled).then_some(());
            if valid && !is_stalled {
                expected.pop_front();
                passed += 1;
            }
        }
        block.edge();
        if takes {
            let (first, second, is_last) = offers.pop_front().expect("an offer");
            for word in [Some(first), second].into_iter().flatten() {
                held.push(word);
                if held.len() == 2 {
                    expected.push_back((wide(&held), false));
                    held.clear();
                }
            }
            if is_last {
                if !held.is_empty() {
                    expected.push_back((wide(&held), false));
                    held.clear();
                }
                expected.back_mut().expect("a pair").1 = true;
            }
        }
        if reset {
            (held, expected, offers, shown) = Default::default();
        }
    }
    assert!(passed > 3000, "{passed} pairs");
}

#[test]
fn two_words_at_every_clock_pass() {
    let mut block = Stepper::new("stream_answer_pairs", AnswerPairs::default(), 1);
    for clock in 0..300u32 {
        block.set("reset", clock == 0);
        block.set("is_stalled", false);
        // Behind the single word, every pair is put together out of two offers.
        offer(&mut block, Some((clock, (clock != 5).then_some(clock), false)), 0);
        block.settle();
        if clock > 0 {
            block.expect("response_ready", true);
        }
        if clock > 1 {
            block.expect("pair_valid", clock != 6);
        }
        block.edge();
    }
}

#[test]
fn answer_pairs_show_the_wave_of_their_header() {
    let mut block = Stepper::new("stream_answer_pairs", AnswerPairs::default(), 1);
    let mut wave = Wave::default();
    let mut offers: VecDeque<Offer> =
        [(1, Some(2), false), (3, None, true), (4, None, false), (5, Some(6), false), (7, Some(8), true)].into();
    for clock in 0..11 {
        let offered = (clock > 0).then(|| offers.front().copied()).flatten();
        block.set("reset", clock == 0);
        block.set("is_stalled", false);
        offer(&mut block, offered, 0);
        block.settle();
        let ready = clock > 0 && block.is("response_ready");
        let gives = clock > 0 && block.is("pair_valid");
        let half = |shift: u32| if gives { Cell::Number(block.get("pair_data") >> shift & 0xffff) } else { Cell::Open };
        wave.take(&[
            ("response_valid", Cell::Bit(offered.is_some())),
            ("response_ready", Cell::Bit(ready)),
            ("response_both", Cell::Bit(offered.is_some_and(|(_, second, _)| second.is_some()))),
            ("response_last", Cell::Bit(offered.is_some_and(|(.., is_last)| is_last))),
            ("pair_valid", Cell::Bit(gives)),
            ("pair_last", Cell::Bit(gives && block.is("pair_last"))),
            ("first", half(0)),
            ("second", half(32)),
        ]);
        block.edge();
        if offered.is_some() && ready {
            offers.pop_front();
        }
    }
    wave.assert_drawn_in("answer_pairs");
}

fn collects<const W: usize>(name: &'static str) {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new(name, AnswerBeats::<W>::new(), 1);
    let (mut half, mut expected): (Option<u64>, VecDeque<(u128, bool)>) = Default::default();
    let mut passed = 0;
    for clock in 0..12_000 {
        let reset = clock == 0 || random.below(1000) == 0;
        let (valid, is_last) = (random.below([1, 3][clock / 400 % 2]) == 0, random.below(4) == 0);
        let is_full = random.below([1, 3][clock / 800 % 2]) != 0;
        let pair = random.next_u64();
        set_bits(
            &mut block,
            &[("reset", reset), ("pair_valid", valid), ("pair_last", is_last), ("is_full", is_full && clock > 0)],
        );
        block.set("pair_data", pair);
        block.settle();
        let offered = expected.front().copied();
        let is_stalled = offered.is_some() && is_full;
        if clock > 0 {
            block.expect("beat_valid", offered.is_some());
            block.expect("is_stalled", is_stalled);
            block.expect("is_held", offered.is_some() || half.is_some());
            if let Some((beat, is_last)) = offered {
                block.expect("beat_data", beat);
                block.expect("beat_last", is_last);
            }
        }
        block.edge();
        if !is_stalled {
            passed += usize::from(expected.pop_front().is_some());
        }
        if valid && !is_stalled {
            let low = half.take();
            let beat = low.map_or(u128::from(pair), |low| u128::from(low) | u128::from(pair) << 64);
            if is_last || W == 64 || low.is_some() {
                expected.push_back((beat, is_last));
            } else {
                half = Some(pair);
            }
        }
        if reset {
            (half, expected) = Default::default();
        }
    }
    assert!(passed > 2000, "{passed} beats");
}

#[test]
fn pairs_become_beats() {
    collects::<64>("stream_answer_beats_64");
    collects::<128>("stream_answer_beats_128");
}

#[test]
fn failed_answers_are_seen() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("stream_answer_watch", AnswerWatch::<64>::default(), 1);
    let (mut is_first, mut events, mut header) = (true, [false; 4], 0);
    let mut failures = 0;
    for clock in 0..6000 {
        let (reset, resets) = (clock == 0 || random.below(300) == 0, random.below(200) == 0);
        let (valid, ready, is_last) = (random.below(4) != 0, random.below(3) != 0, random.below(3) == 0);
        let status = [Status::Ok, Status::Ok, Status::Full, Status::UnknownOpcode][random.below(4) as usize];
        let word = answer_header(Opcode::Insert as u8, status);
        set_bits(
            &mut block,
            &[("reset", reset), ("resets", resets), ("m_axis_tvalid", valid), ("m_axis_tready", ready)],
        );
        block.set("m_axis_tlast", is_last);
        block.set("m_axis_tdata", u64::from(word) | random.below(1 << 32) << 32);
        block.settle();
        if clock > 0 {
            for (port, event) in ["took", "waited", "ended", "failed"].into_iter().zip(events) {
                block.expect(port, event);
            }
            if events[3] {
                block.expect("header", header);
            }
        }
        block.edge();
        let takes = valid && ready;
        let fails = takes && is_first && status != Status::Ok;
        events = [takes, valid && !ready, takes && is_last, fails].map(|event| event && !reset);
        failures += usize::from(fails);
        header = word;
        if takes {
            is_first = is_last;
        }
        is_first |= reset || resets;
    }
    assert!(failures > 300);
}

#[test]
fn a_command_is_under_way_until_its_answer_has_ended_and_padding_is_none() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("stream_progress", Progress::default(), 1);
    let clock = |block: &mut Stepper<Progress>,
                 word: Option<u32>,
                 offers_last: bool,
                 ends: bool,
                 busy: Option<bool>| {
        set_bits(block, &[("reset", false), ("takes", word.is_some()), ("offers_last", offers_last), ("ends", ends)]);
        block.set("word", word.unwrap_or(9));
        block.settle();
        if let Some(busy) = busy {
            block.expect("is_busy", busy);
        }
        block.edge();
    };
    set_bits(&mut block, &[("reset", true)]);
    block.settle();
    block.edge();
    let mut is_busy = false;
    for _ in 0..500 {
        // Padding before a command, then its words, of which some are zero.
        if !is_busy {
            for _ in 0..random.below(4) {
                clock(&mut block, Some(0), false, false, Some(false));
            }
            clock(&mut block, Some(1 << 24), false, false, Some(false));
        }
        for _ in 0..random.below(5) {
            let word = [None, Some(0), Some(7)][random.below(3) as usize];
            clock(&mut block, word, false, false, Some(true));
        }
        // The last word of its answer waits; meanwhile padding or the next command is taken.
        let mut follows = false;
        for _ in 0..random.below(4) {
            let word = [None, Some(0), Some(2 << 24)][random.below(3) as usize];
            follows |= word.is_some_and(|word| word != 0);
            clock(&mut block, word, true, false, Some(true));
        }
        let word = [None, Some(0), Some(3 << 24)][random.below(3) as usize];
        follows |= word.is_some_and(|word| word != 0);
        clock(&mut block, word, true, true, Some(true));
        clock(&mut block, None, false, false, Some(follows));
        is_busy = follows;
    }
}
