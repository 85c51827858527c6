//! Runs `AnswerPairs` in Rust and in Verilog beside plain code: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use crate::rig::stream_bits::wide;
use incircle_hdl::stream::AnswerPairs;
use incircle_testkit::SplitMix64;

named_ports!([] AnswerPairs,
    [reset, response.valid, response.data, response.both, response.last, is_stalled],
    [response.ready, pair_valid, pair_data, pair_last, is_held],
    clock
);

/// Words on offer: one or two, and whether the answer ends with them.
type Offer = (u32, Option<u32>, bool);

/// Cuts an answer of this many words into pieces of one and two.
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
            assert!(shown.is_none() || valid, "a pair left though it was stalled");
            if valid {
                let (pair, is_last) = expected.front().copied().expect("a pair that was sent");
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
        // Behind the single word, every pair is put together from two offers.
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
