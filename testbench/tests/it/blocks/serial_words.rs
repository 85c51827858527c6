//! The serial link between frames and the core: FIFO, digest, words, answers. Rust, Verilog and plain code agree.

use std::collections::VecDeque;

use crate::rig::serial_host::crc32_state;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::export::QUICK_LINK;
use incircle_hdl::serial::{AnswerPacker, CommandProgress, CommandWords, PayloadDigest, ReceiveFifo, WordNarrower};

named_ports!(ReceiveFifo, [reset, begins, push, push_data, commits, takes], [free, byte_valid, byte_data], clock);
named_ports!(PayloadDigest, [reset, begins, push, push_data, commits], [state], clock);
named_ports!(CommandWords, [reset, byte_valid, byte_data, word_ready], [takes, word_valid, word], clock);
named_ports!(CommandProgress, [reset, takes, word, offers_last, takes_answer, answer_ended], [is_busy], clock);
named_ports!(WordNarrower, [reset, pair_valid, pair, both, word_ready], [pair_ready, word_valid, word], clock);
named_ports!(
    AnswerPacker,
    [reset, word_valid, word_data, starts, takes, ended], [word_ready, is_due, is_last, answer, byte_valid, byte_data, byte_is_last, awaits],
    clock
);
#[test]
fn fifo_gives_what_was_committed_and_nothing_else() {
    let size = QUICK_LINK.fifo_bytes as usize;
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("serial_receive_fifo", ReceiveFifo::new(QUICK_LINK), 1);
    let mut committed: VecDeque<u8> = VecDeque::new();
    let mut provisional: Vec<u8> = Vec::new();
    // Clocks for which nothing has been pushed, and for which `free` can have followed.
    let (mut rests_for, mut still_for) = (0, 0);
    let (mut commits, mut windings, mut fullest) = (0, 0, 0);
    for clock in 0..150_000 {
        // Now it fills, now it empties.
        let (fills, empties) = if clock / 20_000 % 2 == 0 { (2, 40) } else { (12, 3) };
        let reset = clock == 0 || random.below(40_000) == 0;
        let has_room = committed.len() + provisional.len() < size;
        let push = clock > 0 && has_room && random.below(fills) == 0;
        let commit = !push && rests_for >= 3 && random.below(8) == 0;
        let begins = !push && !commit && random.below(1500) == 0;
        let byte = random.below(256) as u8;
        for (port, bit) in [("reset", reset), ("push", push), ("commits", commit), ("begins", begins), ("takes", false)]
        {
            block.set(port, bit);
        }
        block.set("push_data", byte);
        block.settle();
        let mut takes = false;
        if clock > 0 {
            if still_for >= 2 {
                block.expect("free", (size - committed.len()) as u64);
            }
            let is_there = block.is("byte_valid");
            assert!(!is_there || !committed.is_empty(), "a byte that was not committed");
            assert!(is_there || committed.is_empty() || still_for < 4, "no byte in clock {clock}");
            if let (true, Some(first)) = (is_there, committed.front()) {
                block.expect("byte_data", *first);
                takes = random.below(empties) == 0;
            }
        }
        block.set("takes", takes);
        block.settle();
        block.edge();
        (rests_for, still_for) = (rests_for + 1, still_for + 1);
        if takes {
            committed.pop_front();
            still_for = 0;
        }
        if push {
            provisional.push(byte);
            rests_for = 0;
        }
        if commit {
            commits += 1;
            committed.extend(provisional.drain(..));
            still_for = 0;
        }
        if begins {
            windings += usize::from(!provisional.is_empty());
            provisional.clear();
        }
        if reset {
            committed.clear();
            provisional.clear();
            (rests_for, still_for) = (0, 0);
        }
        fullest = fullest.max(committed.len());
    }
    assert!(
        commits > 300 && windings > 10 && fullest == size,
        "{commits} commits, {windings} windings, {fullest} full"
    );
}

#[test]
fn digest_covers_what_was_committed() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("serial_payload_digest", PayloadDigest::default(), 1);
    let (mut committed, mut provisional): (Vec<u8>, Vec<u8>) = Default::default();
    for run in 0..1500 {
        let byte = random.below(256) as u8;
        let event = if run == 0 { 0 } else { 1 + random.below(12) };
        for (port, bit) in
            [("reset", event == 0 || run == 700), ("begins", event == 1), ("commits", event == 2), ("push", event > 2)]
        {
            block.set(port, bit);
        }
        block.set("push_data", byte);
        block.settle();
        block.edge();
        match event {
            1 => provisional.clear(),
            2 => committed.append(&mut provisional),
            3.. => provisional.push(byte),
            _ => {}
        }
        if event == 0 || run == 700 {
            committed.clear();
            provisional.clear();
        }
        ["reset", "begins", "commits", "push"].into_iter().for_each(|port| block.set(port, false));
        for _ in 0..9 {
            block.settle();
            block.expect("state", crc32_state(&committed));
            block.edge();
        }
    }
}

#[test]
fn command_words_are_put_together_low_byte_first() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("serial_command_words", CommandWords::default(), 1);
    let mut bytes: Vec<u8> = Vec::new();
    let mut words = 0;
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(700) == 0;
        let (valid, ready) = (random.below([1, 4][clock / 400 % 2]) == 0, random.below([1, 9][clock / 800 % 2]) == 0);
        let byte = random.below(256) as u8;
        block.set("byte_data", byte);
        for (port, bit) in [("reset", reset), ("byte_valid", valid), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.settle();
        let is_full = bytes.len() == 4;
        if clock > 0 {
            block.expect("word_valid", is_full);
            block.expect("takes", valid && !is_full);
            if is_full {
                block.expect("word", u32::from_le_bytes(bytes[..].try_into().expect("four bytes")));
            }
        }
        block.edge();
        if is_full && ready {
            bytes.clear();
            words += 1;
        }
        if valid && !is_full {
            bytes.push(byte);
        }
        if reset {
            bytes.clear();
        }
    }
    assert!(words > 200, "{words} words");
}

#[test]
fn command_words_show_the_wave_of_their_header() {
    let mut block = Stepper::new("serial_command_words", CommandWords::default(), 1);
    let mut wave = Wave::default();
    let mut bytes = [5u8, 0, 0, 0, 7, 0].into_iter().peekable();
    for clock in 0..14 {
        let valid = clock > 0;
        block.set("reset", clock == 0);
        block.set("byte_valid", valid);
        block.set("byte_data", *bytes.peek().unwrap_or(&0));
        block.set("word_ready", clock >= 7);
        block.settle();
        let (takes, gives) = (valid && block.is("takes"), clock > 0 && block.is("word_valid"));
        wave.take(&[
            ("byte_valid", Cell::Bit(valid)),
            ("byte_data", bytes.peek().map_or(Cell::Open, |byte| Cell::Number((*byte).into()))),
            ("takes", Cell::Bit(takes)),
            ("word_valid", Cell::Bit(gives)),
            ("word_ready", Cell::Bit(clock >= 7)),
            ("word", if gives { Cell::Number(block.get("word")) } else { Cell::Open }),
        ]);
        block.edge();
        if takes {
            bytes.next();
        }
        if bytes.peek().is_none() {
            break;
        }
    }
    wave.assert_drawn_in("command_words");
}

/// A core and a link that sends its answers, as the block sees them.
#[derive(Default)]
struct Traffic {
    /// Arguments that the command at work still awaits.
    arguments: Option<u64>,
    /// Clocks until it is done.
    working: Option<u64>,
    /// The last word of an answer is offered; until it is taken.
    offers: bool,
    /// It was taken, and the frame is not over.
    is_sent: bool,
    begun: u64,
    ended: u64,
}

#[test]
fn a_command_is_under_way_until_its_answer_has_ended() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("serial_command_progress", CommandProgress::default(), 1);
    let mut core = Traffic::default();
    let (mut rested, mut two_deep, mut paddings) = (0, 0, 0);
    for clock in 0..40_000 {
        let reset = clock == 0 || random.below(2000) == 0;
        // The core takes words of the next command once the last answer is offered to its end.
        let awaits = core.working.is_none();
        let takes = awaits && random.below([2, 20][clock / 5000 % 2]) == 0;
        let is_command = takes && core.arguments.is_none();
        let word = if random.below(3) == 0 { 0 } else { 1 + random.below(1 << 31) as u32 };
        // What is offered is taken by a link that has ended the answer before.
        let takes_answer = !core.is_sent && random.below(4) == 0;
        let ends = core.is_sent && random.below(6) == 0;
        for (port, bit) in [
            ("reset", reset),
            ("takes", takes),
            ("offers_last", core.offers),
            ("takes_answer", takes_answer),
            ("answer_ended", ends),
        ] {
            block.set(port, bit);
        }
        block.set("word", word);
        block.settle();
        let under_way = core.begun - core.ended;
        if clock > 0 {
            block.expect("is_busy", under_way > 0);
        }
        rested += u32::from(under_way == 0);
        two_deep += u32::from(core.is_sent && core.offers && core.arguments.is_some());
        block.edge();
        if reset {
            core = Traffic::default();
            continue;
        }
        core.ended += u64::from(ends);
        core.is_sent &= !ends;
        if core.offers && takes_answer {
            (core.offers, core.is_sent) = (false, true);
        }
        if is_command && word == 0 {
            paddings += 1;
        } else if is_command {
            core.begun += 1;
            core.arguments = Some(random.below(4));
        } else if takes {
            core.arguments = core.arguments.map(|left| left - 1);
        }
        if core.arguments == Some(0) {
            (core.arguments, core.working) = (None, Some(random.below(8)));
        }
        // Nothing is offered before what was offered is taken.
        match core.working {
            Some(0) if !core.offers => (core.working, core.offers) = (None, true),
            Some(left) => core.working = Some(left.saturating_sub(1)),
            None => {}
        }
    }
    assert!(rested > 500 && two_deep > 100 && paddings > 100, "{rested} at rest, {two_deep} deep, {paddings} paddings");
}

#[test]
fn narrower_gives_every_word_once() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_word_narrower", WordNarrower::default(), 1);
    let mut words: VecDeque<u32> = VecDeque::new();
    let (mut pair, mut pairs) = (None, 0);
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(500) == 0;
        if pair.is_none() && random.below([1, 3][clock / 1000 % 2]) == 0 {
            let (low, high) = (random.next_u64() as u32, random.next_u64() as u32);
            let both = random.below(2) == 0;
            pair = Some((low, high, both));
            words.push_back(low);
            words.extend(both.then_some(high));
        }
        let (low, high, both) = pair.unwrap_or((1, 2, random.below(2) == 0));
        let ready = random.below([1, 3][clock / 2000 % 2]) == 0;
        for (port, bit) in [("reset", reset), ("pair_valid", pair.is_some()), ("both", both), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.set("pair", u64::from(low) | u64::from(high) << 32);
        block.settle();
        if clock > 0 {
            block.expect("word_valid", pair.is_some());
            if let Some(word) = words.front() {
                block.expect("word", *word);
            }
            // What is offered alone is taken with its word, of two the second.
            if pair.is_some() {
                block.expect("pair_ready", ready && words.len() == 1);
            }
        }
        block.edge();
        if pair.is_some() && ready {
            words.pop_front();
            pairs += u32::from(both && words.is_empty());
        }
        if words.is_empty() || reset {
            words.clear();
            pair = None;
        }
    }
    assert!(pairs > 500, "{pairs} pairs");
}

#[test]
fn narrower_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("serial_word_narrower", WordNarrower::default(), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    let mut pairs = VecDeque::from([(5u64 | 6 << 32, true), (7, false)]);
    for clock in 0..5 {
        let (pair, both) = pairs.front().copied().unwrap_or_default();
        let (valid, ready) = (!pairs.is_empty(), clock != 1);
        block.set("pair", pair);
        for (port, bit) in [("pair_valid", valid), ("both", both), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.settle();
        let is_taken = block.is("pair_ready");
        wave.take(&[
            ("pair_valid", Cell::Bit(valid)),
            ("both", Cell::Bit(both)),
            ("pair_ready", Cell::Bit(is_taken)),
            ("word", if valid { Cell::Number(block.get("word")) } else { Cell::Open }),
            ("word_ready", Cell::Bit(ready)),
        ]);
        block.edge();
        if is_taken {
            pairs.pop_front();
        }
    }
    wave.assert_drawn_in("word_narrower");
}

/// Sends the parts of answers as frames would, and compares every byte.
#[test]
fn packer_cuts_answers_into_parts() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("serial_answer_packer", AnswerPacker::default(), 1);
    let lengths = [0, 1, 253, 254, 255, 256, 510, 511, 3, 1030];
    let mut pending: VecDeque<u32> = VecDeque::new();
    let (mut offered, mut number, mut clock) = (None, 0u64, 0);
    // Inputs of one clock, before its edge.
    let mut step =
        |block: &mut Stepper<AnswerPacker>, inputs: [bool; 4], random: &mut SplitMix64, more: Option<Vec<u32>>| {
            pending.extend(more.into_iter().flatten());
            for (port, bit) in ["reset", "starts", "takes", "ended"].into_iter().zip(inputs) {
                block.set(port, bit);
            }
            if offered.is_none() && random.below([1, 5][clock / 3000 % 2]) == 0 {
                offered = pending.pop_front();
            }
            clock += 1;
            block.set("word_valid", offered.is_some());
            block.set("word_data", offered.unwrap_or(0xffff_ffff));
            block.settle();
            if !inputs[0] && block.is("word_ready") {
                offered = None;
            }
            if inputs[0] {
                offered = None;
                pending.clear();
            }
        };
    step(&mut block, [true, false, false, false], &mut random, None);
    block.edge();
    for run in 0..40 {
        let length = lengths[run % lengths.len()];
        let mut words = vec![random.below(1 << 32) as u32, length];
        words.extend((0..length).map(|_| random.below(1 << 32) as u32));
        let mut more = Some(words.clone());
        let is_dropped = run % 13 == 12;
        let mut sent: Vec<u8> = Vec::new();
        let mut part = 0u64;
        'answer: loop {
            // Until a part is due.
            loop {
                step(&mut block, [false; 4], &mut random, more.take());
                let is_due = block.is("is_due");
                block.edge();
                if is_due {
                    break;
                }
            }
            for _ in 0..random.below(5) {
                step(&mut block, [false; 4], &mut random, None);
                assert!(block.is("is_due"));
                block.edge();
            }
            let left = words.len() - sent.len() / 4;
            step(&mut block, [false, true, false, false], &mut random, None);
            block.expect("is_last", left <= 256);
            block.expect("number", number % 256);
            block.expect("part", part % 256);
            block.edge();
            part += 1;
            for byte in 0..4 * left.min(256) {
                if is_dropped && sent.len() == 40.min(4 * words.len() - 1) {
                    step(&mut block, [true, false, false, false], &mut random, None);
                    block.edge();
                    number = 0;
                    break 'answer;
                }
                let mut waits = random.below([1, 4][run % 2]);
                loop {
                    // `takes` follows the byte within the clock.
                    step(&mut block, [false; 4], &mut random, None);
                    let takes = block.is("byte_valid") && waits == 0;
                    waits = waits.saturating_sub(1);
                    if takes {
                        block.set("takes", true);
                        block.settle();
                        sent.push(block.get("byte_data") as u8);
                        block.expect("byte_is_last", byte + 1 == 4 * left.min(256));
                    }
                    block.edge();
                    if takes {
                        break;
                    }
                }
            }
            if left <= 256 {
                break;
            }
        }
        if is_dropped {
            continue;
        }
        let expected: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        assert!(sent == expected, "an answer of {length} words");
        for _ in 0..3 + random.below(9) {
            step(&mut block, [false; 4], &mut random, None);
            assert!(!block.is("byte_valid") && !block.is("is_due") && !block.is("awaits"));
            block.edge();
        }
        step(&mut block, [false, false, false, true], &mut random, None);
        block.edge();
        number += 1;
        step(&mut block, [false; 4], &mut random, None);
        assert!(block.is("awaits"));
        block.expect("number", number % 256);
        block.edge();
    }
}
