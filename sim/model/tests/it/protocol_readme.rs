//! The exchanges in `protocol/README.md` are those of the model, by commands and clock by clock, and the tables of the
//! page have the numbers of the crate.

use incircle_model::{ClockModel, CommandModel, Inputs};
use incircle_protocol::{
    answer_opcode, answer_status, latency_bucket, latency_of_bucket, Config, Counter, Layout, Opcode, Outcome, Status,
    CORE_COORD_BITS, COUNTER_WORDS, FIRST_ROUND, LATENCY_BUCKETS, PROTOCOL_VERSION, SMALL, TINY,
};
use std::collections::BTreeSet;

const README: &str = include_str!("../../../../protocol/README.md");

/// The words to send, and the words of the answer.
type Step = (Vec<u32>, Vec<u32>);

/// A fenced block of the page: a device, and an exchange with it.
struct Exchange {
    coord_bits: u32,
    capacity: u32,
    ring: u32,
    contexts: u32,
    /// Whether the device says by one bit that it takes all runs, which no core does.
    runs: bool,
    /// Whether the device takes the runs of a core with runs.
    core_runs: bool,
    steps: Vec<Step>,
}

/// The number behind `key=` in the first line of a block.
fn parameter(heading: &str, key: &str) -> u32 {
    let value = heading
        .split_whitespace()
        .find_map(|item| item.strip_prefix(key)?.strip_prefix('='))
        .unwrap_or_else(|| panic!("no {key} in {heading}"));
    value.parse().expect("a number")
}

/// The words of a line, without its direction and its comment.
fn words(line: &str) -> Vec<u32> {
    let said = line[1..].split(';').next().expect("a first part");
    said.split_whitespace().map(|word| u32::from_str_radix(word, 16).expect(line)).collect()
}

fn exchange(block: &str) -> Exchange {
    let (heading, body) = block.split_once('\n').expect("a heading");
    let body = body.split("```").next().expect("a body");
    let mut steps: Vec<Step> = Vec::new();
    for line in body.lines().filter(|line| !line.trim().is_empty()) {
        if line.starts_with('<') {
            steps.last_mut().expect("a command").1.extend(words(line));
            continue;
        }
        assert!(line.starts_with('>'), "neither > nor <: {line}");
        match steps.last_mut() {
            Some((sent, answer)) if answer.is_empty() => sent.extend(words(line)),
            _ => steps.push((words(line), Vec::new())),
        }
    }
    Exchange {
        coord_bits: parameter(heading, "coord_bits"),
        capacity: parameter(heading, "capacity"),
        ring: parameter(heading, "ring"),
        contexts: if heading.contains("contexts=") { parameter(heading, "contexts") } else { 1 },
        runs: heading.split_whitespace().any(|word| word == "runs"),
        core_runs: heading.split_whitespace().any(|word| word == "core-runs"),
        steps,
    }
}

fn exchanges() -> Vec<Exchange> {
    README.split("```exchange").skip(1).map(exchange).collect()
}

/// Words as the page writes them, for messages.
fn hex(words: &[u32]) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("{word:08x}")).collect();
    words.join(" ")
}

#[test]
fn the_model_by_commands_says_it() {
    for Exchange { coord_bits, capacity, ring, contexts, runs, core_runs, steps } in exchanges() {
        let mut model = CommandModel::new(coord_bits, capacity, ring).expect("possible").with_contexts(contexts);
        if runs {
            model = model.with_runs();
        }
        if core_runs {
            model = model.with_core_runs();
        }
        for (sent, expected) in steps {
            model.send(&sent);
            let mut said = vec![0; expected.len() + 100];
            let length = model.receive(&mut said);
            said.truncate(length);
            assert_eq!(hex(&said), hex(&expected), "answer to {}", hex(&sent));
        }
    }
}

/// The answer of the core, until the core has been silent for long.
fn answer_of(core: &mut ClockModel, sent: &[u32]) -> Vec<u32> {
    let (mut rest, mut said, mut silent) = (sent, Vec::new(), 0);
    while silent < 3000 {
        let outputs = core.outputs();
        let inputs = Inputs {
            command_valid: !rest.is_empty(),
            command_data: rest.first().copied().unwrap_or(0),
            response_ready: true,
            ..Inputs::default()
        };
        silent += 1;
        if inputs.command_valid && outputs.command_ready {
            rest = &rest[1..];
            silent = 0;
        }
        if outputs.response_valid {
            said.extend(outputs.answer_words());
            silent = 0;
        }
        core.clock(inputs);
    }
    said
}

/// Sets to 0 what a core counts differently from the model: clocks, and the visits of walks, which start elsewhere.
/// Returns the sum of the removed numbers.
fn forget_clocks(said: &mut [u32]) -> u64 {
    let opcode = Opcode::from_u8(answer_opcode(said[0]));
    let payload = &mut said[2..];
    let walk_visits = Counter::WalkVisits as usize;
    let all = 0..payload.len();
    let clocked = match opcode {
        Some(Opcode::Counters) => &[
            0..Counter::Insertions as usize,
            walk_visits..walk_visits + 1,
            Counter::RootVisits as usize..COUNTER_WORDS,
        ][..],
        Some(Opcode::Latencies) => std::slice::from_ref(&all),
        _ => &[],
    };
    let mut sum = 0;
    for range in clocked {
        let words = &mut payload[range.clone()];
        sum += words.iter().copied().map(u64::from).sum::<u64>();
        words.fill(0);
    }
    sum
}

#[test]
fn a_core_with_as_many_contexts_says_it() {
    let (mut replayed, mut clocks) = (0, 0);
    for exchange in exchanges() {
        if exchange.coord_bits != CORE_COORD_BITS || exchange.runs {
            continue;
        }
        let config = Config { points: exchange.capacity, ring: exchange.ring, contexts: exchange.contexts, ..TINY };
        let mut core = ClockModel::new(config).expect("possible");
        if exchange.core_runs {
            core = core.with_core_runs();
        }
        for (sent, mut expected) in exchange.steps {
            let mut said = answer_of(&mut core, &sent);
            clocks += forget_clocks(&mut said);
            forget_clocks(&mut expected);
            assert_eq!(hex(&said), hex(&expected), "answer to {}", hex(&sent));
            replayed += 1;
        }
    }
    assert!(replayed >= 19, "only {replayed} answers are the core's");
    assert!(clocks > 100, "the core counts clocks");
}

#[test]
fn every_opcode_status_and_layout_is_shown() {
    let (mut opcodes, mut statuses, mut record_words) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    for exchange in exchanges() {
        record_words.insert(Layout::of(exchange.coord_bits, exchange.capacity).record_words);
        for (_, answer) in exchange.steps {
            opcodes.extend(Opcode::from_u8(answer_opcode(answer[0])).map(|opcode| opcode as u8));
            statuses.insert(answer_status(answer[0]));
        }
    }
    assert_eq!(opcodes, (1..=13).collect());
    assert_eq!(statuses, BTreeSet::from([0, 1, 2, 3, 4, 5, 7]));
    assert_eq!(record_words, BTreeSet::from([3, 6]));
    let small = &exchanges()[0];
    assert_eq!((small.capacity, small.ring), (SMALL.points, SMALL.ring));
}

#[test]
fn the_tables_have_the_numbers_of_the_crate() {
    let mut rows: Vec<String> = Vec::new();
    rows.extend((0..=255).filter_map(Opcode::from_u8).map(|it| format!("| {} | `{it:?}` |", it as u8)));
    rows.extend((0..=255).filter_map(Status::from_u8).map(|it| format!("| {} | `{it:?}` |", it as u8)));
    rows.extend((0..=255).filter_map(Outcome::from_u8).map(|it| format!("| {} | `{it:?}` |", it as u8)));
    use Counter::*;
    rows.extend(
        [
            InsertCycles,
            WaitCycles,
            ReadCycles,
            Insertions,
            Duplicates,
            Refused,
            WalkVisits,
            Tests,
            CavityTriangles,
            Overflows,
            Flips,
            RootVisits,
            Revisits,
            Aborts,
            RootRetries,
            PrioritiesTaken,
            IssueCycles,
            WriteCycles,
            CommitCycles,
            ReleaseCycles,
            LatencyMin,
            LatencyMax,
        ]
        .map(|it| format!("| {} | `{it:?}` |", it as usize)),
    );
    for row in rows {
        assert!(README.contains(&row), "no row starts with {row}");
    }
}

#[test]
fn the_prose_has_the_numbers_of_the_crate() {
    let last = LATENCY_BUCKETS - 1;
    let thousands = |clocks: u32| format!("{},{:03}", clocks / 1000, clocks % 1000);
    for said in [
        format!("Version {}.{}.", PROTOCOL_VERSION >> 16, PROTOCOL_VERSION & 0xffff),
        format!("counters, {COUNTER_WORDS} words"),
        format!("histogram of latencies, {LATENCY_BUCKETS} words"),
        format!("The first {FIRST_ROUND} points are inserted by"),
        format!("context `(j - {FIRST_ROUND}) mod K`"),
        format!(
            "below {} clocks, bucket {last} for all from {} on",
            latency_of_bucket(1),
            thousands(latency_of_bucket(last))
        ),
    ] {
        assert!(README.contains(&said), "not said: {said}");
    }
    for bucket in 1..last {
        let (octave, eighth) = (bucket as u32 / 8, bucket as u32 % 8);
        assert_eq!(latency_of_bucket(bucket), (8 + eighth) << (octave + 1));
        assert_eq!(latency_bucket(latency_of_bucket(bucket)), bucket);
        assert_eq!(latency_bucket(latency_of_bucket(bucket + 1) - 1), bucket);
    }
    assert_eq!((latency_bucket(0), latency_bucket(u32::MAX)), (0, last));
}
