//! Runs whole devices at their AXI ports against the model by commands, with random stalls on all channels and clocks
//! at ratios of 1:4 to 4:1.

use crate::rig::stream_rig::{Rig, Verilog, PERIODS};
use incircle_model::CommandModel;
use incircle_protocol::{
    answer_header, clear_word, command_word, Config, Opcode, Status, StreamRegister, CONTROL_RESET, CORE_COORD_BITS,
    SMALL, STREAM_STATUS_BUSY, STREAM_STATUS_RUNS, TINY,
};
use incircle_testkit::SplitMix64;

/// Clock edges that a job may take.
const PATIENCE: usize = 3_000_000;

/// A Verilated device beside the model by commands.
struct Device {
    rig: Rig<Verilog>,
    model: CommandModel,
    random: SplitMix64,
    /// Number of answers that were compared, by status.
    compared: [usize; 6],
}

fn model(config: Config) -> CommandModel {
    CommandModel::new(CORE_COORD_BITS, config.points, config.ring).expect("a sound configuration")
}

/// Vertices of records, each record from its smallest vertex on, sorted.
fn sorted(mut all: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for record in &mut all {
        let smallest = (0..3).min_by_key(|place| record[*place]).unwrap_or(0);
        record.rotate_left(smallest);
    }
    all.sort_unstable();
    all
}

/// Vertices in an answer, if the answer has records.
fn records(answer: &[u32]) -> Option<Vec<[u32; 3]>> {
    let payload = &answer[2..];
    let ids: Vec<u32> = match answer[0] {
        header if header == answer_header(Opcode::Read as u8, Status::Ok) => {
            payload.iter().map(|word| word & 0x7fff).collect()
        }
        header if header == answer_header(Opcode::Triangles as u8, Status::Ok) => {
            payload.iter().flat_map(|word| [word & 0xffff, word >> 16]).collect()
        }
        _ => return None,
    };
    // The half-word behind the last record is 0.
    let (records, rest) = ids.as_chunks::<3>();
    assert!(rest.iter().all(|id| *id == 0));
    Some(sorted(records.to_vec()))
}

impl Device {
    fn new(name: &str, beat_bits: usize, config: Config, periods: [u64; 2], seed: u64) -> Self {
        let mut rig = Rig::new(Verilog::new(name, seed as u32), beat_bits, None, periods, seed);
        rig.await_core();
        Self { rig, model: model(config), random: SplitMix64::new(seed), compared: [0; 6] }
    }

    /// Answers of the model to these words.
    fn expected(&mut self, words: &[u32]) -> Vec<Vec<u32>> {
        let mut answers = Vec::new();
        self.model.send(words);
        loop {
            let mut head = [0; 2];
            if self.model.receive(&mut head) == 0 {
                return answers;
            }
            let mut answer = head.to_vec();
            answer.resize(2 + head[1] as usize, 0);
            assert_eq!(self.model.receive(&mut answer[2..]), head[1] as usize);
            answers.push(answer);
        }
    }

    /// Sends commands, padded now and then, and compares the answers with those of the model.
    fn exchange(&mut self, commands: &[Vec<u32>]) {
        let words_of_beat = self.rig.bus.beat_bytes / 4;
        let mut words = Vec::new();
        let mut expected = Vec::new();
        for command in commands {
            words.extend(command);
            expected.extend(self.expected(command));
            if self.random.below(2) == 0 {
                words.resize(words.len().next_multiple_of(words_of_beat), 0);
            }
        }
        self.rig.bus.send(&words);
        let mesh = self.mesh();
        for expected in expected {
            let answer = self.rig.answer(PATIENCE);
            assert_eq!(answer[..2], expected[..2], "header and length");
            match records(&answer) {
                // The order of records, and the vertex with which each begins, is up to the device.
                Some(found) => {
                    assert!(
                        found.iter().all(|record| mesh.binary_search(record).is_ok()),
                        "a record is not in the model's mesh"
                    );
                    assert!(found.len() < mesh.len() || found == mesh, "a record comes twice");
                }
                None => assert_eq!(answer, expected),
            }
            self.compared[(answer[0] >> 16 & 255) as usize] += 1;
        }
    }

    /// All records of the model in the form of [`records`].
    fn mesh(&self) -> Vec<[u32; 3]> {
        sorted(self.model.mesh().records().iter().map(|record| record.v).collect())
    }

    /// Runs a job with random points on a grid of `places` by `places`, and reads parts of the result.
    fn job(&mut self, points: usize, places: u64) {
        let inserts = |points: &[u32]| [&[command_word(Opcode::Insert), points.len() as u32], points].concat();
        let mut point = || self.random.below(places) as u32 | (self.random.below(places) as u32) << 16;
        let points: Vec<u32> = (0..points).map(|_| point()).collect();
        let (first, second) = points.split_at(points.len() / 2);
        let mut commands = vec![vec![clear_word(0)], inserts(first), inserts(second)];
        for _ in 0..4 {
            let opcode = [Opcode::Read, Opcode::Triangles][self.random.below(2) as usize];
            let (first, count) = (self.random.below(14) as u32, self.random.below(9) as u32);
            commands.push(vec![command_word(opcode), first, count]);
        }
        commands.push(vec![42 << 24]);
        self.exchange(&commands);
        // Reads all records, once by each kind of read-out.
        let records = self.model.mesh().records().len() as u32;
        let all = |opcode| vec![command_word(opcode), 0, records];
        self.exchange(&[all(Opcode::Triangles), all(Opcode::Read)]);
    }
}

const ONE_CONTEXT_TINY: Config = Config { contexts: 1, ..TINY };
const ONE_CONTEXT_SMALL: Config = Config { contexts: 1, ..SMALL };

#[test]
fn jobs_are_answered_as_by_the_model() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        let mut device = Device::new("stream_tiny_64", 64, ONE_CONTEXT_TINY, periods, round as u64);
        for job in 0..12 {
            device.rig.bus.pace = [1, 2, 6][job % 3];
            device.job(3 + job % 8, [3, 9, 60_000][job / 3 % 3]);
        }
        assert!(device.rig.bus.came.is_empty());
        let compared = device.compared;
        let [ok, unknown, bad_range, ..] = compared;
        assert!(ok > 60 && unknown == 12 && bad_range > 0, "{compared:?}");
        assert!(compared[Status::Full as usize] > 0, "{compared:?}");
        assert_eq!(device.rig.read(StreamRegister::Answers) as usize, compared.iter().sum::<usize>());
    }
}

#[test]
fn a_large_job_at_wide_beats_is_answered_as_by_the_model() {
    for periods in [PERIODS[0], PERIODS[3]] {
        let mut device = Device::new("stream_small_128", 128, ONE_CONTEXT_SMALL, periods, 5);
        device.job(1024, 1 << 16);
        device.rig.bus.pace = 3;
        device.job(300, 40);
    }
}

#[test]
fn the_registers_say_what_hello_says() {
    for (name, beat_bits, config) in
        [("stream_tiny_64", 64, ONE_CONTEXT_TINY), ("stream_small_128", 128, ONE_CONTEXT_SMALL)]
    {
        let mut device = Device::new(name, beat_bits, config, PERIODS[4], 1);
        device.exchange(&[vec![command_word(Opcode::Hello)]]);
        device.rig.bus.send(&[command_word(Opcode::Hello)]);
        let answer = device.rig.answer(PATIENCE);
        use StreamRegister::{Capacity, Contexts, CoordBits, CoreVersion, Magic, ProtocolVersion, Ring};
        let registers = [Magic, ProtocolVersion, CoreVersion, CoordBits, Capacity, Contexts, Ring];
        assert_eq!(registers.map(|register| device.rig.read(register))[..], answer[2..]);
    }
}

/// The page of the protocol. A row of its table begins with the offset in three hexadecimal digits.
const PAGE: &str = include_str!("../../../../protocol/STREAM.md");

#[test]
fn the_example_of_the_page_is_true() {
    let (_, rest) = PAGE.split_once("```beats\n").expect("an example");
    let (example, _) = rest.split_once("```").expect("its end");
    let mut device = Device::new("stream_tiny_64", 64, ONE_CONTEXT_TINY, PERIODS[4], 1);
    let mut beats = Vec::new();
    for line in example.lines() {
        let words: Vec<u32> =
            line[2..].split_whitespace().map_while(|word| u32::from_str_radix(word, 16).ok()).take(2).collect();
        let [low, high] = words[..] else { panic!("a beat of two words: {line}") };
        match &line[..1] {
            ">" => device.rig.bus.send(&[low, high]),
            _ => beats.push((u128::from(high) << 32 | u128::from(low), line[19..].starts_with(" +"))),
        }
    }
    while device.rig.bus.came.len() < beats.len() {
        device.rig.step();
    }
    assert_eq!(device.rig.bus.came, beats);
}

#[test]
fn the_table_of_the_page_is_the_registers() {
    let name = |register: StreamRegister| {
        let name = format!("{register:?}");
        name.chars().fold(String::new(), |name, letter| {
            let begins = letter.is_uppercase() && !name.is_empty();
            name + if begins { "_" } else { "" } + &letter.to_uppercase().to_string()
        })
    };
    let expected: Vec<String> = StreamRegister::ALL
        .into_iter()
        .map(|register| {
            let access = if matches!(register, StreamRegister::Control | StreamRegister::Errors) { "rw" } else { "r" };
            format!("| {:03x} | `{}` | {access} |", register.offset(), name(register))
        })
        .collect();
    let is_row = |line: &&str| line.len() > 5 && line[2..5].chars().all(|digit| digit.is_ascii_hexdigit());
    let rows: Vec<&str> = PAGE.lines().filter(|line| line.starts_with("| ")).filter(is_row).collect();
    assert_eq!(rows.len(), expected.len());
    for (row, expected) in rows.into_iter().zip(expected) {
        assert!(row.starts_with(&expected), "{row} does not begin with {expected}");
    }
}

#[test]
fn triangles_leave_the_link_as_fast_as_the_core_gives_them() {
    // With equal clocks, and a host that takes everything, the read-out takes a clock for each of
    // the two records of a point.
    let mut device = Device::new("stream_small_128", 128, ONE_CONTEXT_SMALL, [8000, 8000], 2);
    device.job(1000, 1 << 16);
    let records = device.model.mesh().records().len() as u32;
    device.rig.steps(200);
    let start = device.rig.edges[0];
    device.exchange(&[vec![command_word(Opcode::Triangles), 0, records]]);
    let clocks = device.rig.edges[0] - start;
    println!("{clocks} clocks for {records} records");
    assert!(clocks < u64::from(records) * 11 / 10 + 60, "{clocks} clocks for {records} records");
}

#[test]
fn a_device_is_busy_until_it_owes_nothing() {
    let mut device = Device::new("stream_tiny_64", 64, ONE_CONTEXT_TINY, PERIODS[5], 3);
    let is_busy = |device: &mut Device| device.rig.read(StreamRegister::Status) & STREAM_STATUS_BUSY != 0;
    for round in 0..6 {
        device.rig.bus.pace = 1 + round % 3;
        device.job(7, 50);
        device.rig.steps(200);
        assert!(!is_busy(&mut device), "the device is busy though it owes nothing");
        // Padding alone is no command, so the device stays idle.
        device.rig.bus.send(&[0; 12]);
        device.rig.steps(400);
        assert!(!is_busy(&mut device) && device.rig.bus.came.is_empty());
        // All but the last point, and nothing for a while: a command that lacks words keeps the device busy.
        device.rig.bus.send(&[command_word(Opcode::Insert), 3, 0, 9]);
        device.rig.steps(3000);
        assert!(is_busy(&mut device) && device.rig.bus.came.is_empty());
        device.rig.bus.send(&[7 << 16, 0]);
        assert_eq!(device.rig.answer(PATIENCE)[0] >> 24, Opcode::Insert as u32);
    }
}

#[test]
fn a_reset_in_the_middle_of_a_job_leaves_a_fresh_device() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        let mut device = Device::new("stream_tiny_64", 64, ONE_CONTEXT_TINY, periods, round as u64);
        for _ in 0..10 {
            let points: Vec<u32> = (0..200).map(|_| device.random.next_u64() as u32).collect();
            device.rig.bus.send(&[&[command_word(Opcode::Insert), points.len() as u32], &points[..]].concat());
            let steps = device.random.below(2500) as usize;
            device.rig.steps(steps);
            device.rig.bus.drop_unsent();
            while device.rig.bus.unsent() > 0 {
                device.rig.step();
            }
            device.rig.write(StreamRegister::Control, CONTROL_RESET);
            device.rig.await_core();
            device.rig.bus.came.clear();
            device.model = model(ONE_CONTEXT_TINY);
            let status = device.rig.read(StreamRegister::Status);
            assert_eq!(status & STREAM_STATUS_RUNS, STREAM_STATUS_RUNS);
            device.job(7, 100);
        }
    }
}
