//! Runs a chip of two engines at its AXI ports, with random stalls and clocks at all ratios: each job must get the
//! answers that the model by commands gives to it alone, and both engines must work.

use std::collections::BTreeMap;

use crate::rig::stream_rig::{Rig, Verilog, PERIODS};
use incircle_model::CommandModel;
use incircle_protocol::{
    answer_engine, answer_opcode, answer_tag, command_word, Clear, Layout, Meshes, Opcode, StreamRegister,
    CONTROL_RESET, CORE_COORD_BITS, STREAM_STATUS_BUSY, TINY,
};
use incircle_testkit::SplitMix64;

/// Clock edges that an answer may take.
const PATIENCE: usize = 1_000_000;

/// The beginning of an answer without the number of the engine, and its payload; a read-out as sorted records.
type Essence = (u32, u32, Vec<[u32; 3]>, Vec<u32>);

fn essence(answer: &[u32]) -> Essence {
    let (head, payload) = answer.split_at(2);
    let layout = Layout::of(CORE_COORD_BITS, TINY.points);
    if answer_opcode(head[0]) != Opcode::Triangles as u8 {
        return (head[0] & 0xffff_00ff, head[1], vec![], payload.to_vec());
    }
    let record = |place| {
        let mut vertices = layout.vertices_from_words(payload, place);
        let least = (0..3).min_by_key(|&corner| vertices[corner]).expect("three corners");
        vertices.rotate_left(least);
        vertices
    };
    let mut records: Vec<_> = (0..2 * payload.len() / 3).map(record).collect();
    records.sort_unstable();
    (head[0] & 0xffff_00ff, head[1], records, vec![])
}

/// The commands of a job with this tag, and the essence of the answers to it alone.
fn job(random: &mut SplitMix64, tag: u8) -> (Vec<u32>, Vec<Essence>) {
    let mut model = CommandModel::new(CORE_COORD_BITS, TINY.points, TINY.ring).expect("a sound configuration");
    let count = 3 + random.below(6) as u32;
    let mut words = vec![Clear { contexts: 0, meshes: Meshes::One, tag }.word(), command_word(Opcode::Insert), count];
    words.extend((0..count).map(|_| random.next_u64() as u32));
    model.send(&words);
    let rest = [command_word(Opcode::Triangles), 0, model.mesh().records().len() as u32];
    model.send(&rest);
    words.extend(rest);
    let answers = (0..3).map(|_| {
        let mut answer = vec![0; 2];
        assert_eq!(model.receive(&mut answer), 2);
        answer.resize(2 + answer[1] as usize, 0);
        assert_eq!(model.receive(&mut answer[2..]) + 2, answer.len());
        essence(&answer)
    });
    let answers = answers.collect();
    (words, answers)
}

#[test]
fn two_engines_behind_a_stream_link() {
    for (round, periods) in PERIODS.into_iter().enumerate() {
        let seed = round as u64;
        let mut random = SplitMix64::new(seed);
        let mut rig = Rig::new(Verilog::new("stream_dual_tiny_64", round as u32), 64, None, periods, seed);
        rig.await_core();
        assert_eq!(rig.read(StreamRegister::Contexts), 2 << 8 | 1, "two engines of one context");
        for turn in 0..3 {
            let jobs: Vec<_> = (0..12).map(|tag| job(&mut random, 20 * turn + tag)).collect();
            jobs.iter().for_each(|(words, _)| rig.bus.send(words));
            let mut came: BTreeMap<u8, Vec<Essence>> = BTreeMap::new();
            let mut used = [0; 2];
            for _ in 0..3 * jobs.len() {
                let answer = rig.answer(PATIENCE);
                used[usize::from(answer_engine(answer[0]))] += 1;
                came.entry(answer_tag(answer[0])).or_default().push(essence(&answer));
            }
            for (tag, (_, expected)) in (20 * turn..).zip(&jobs) {
                assert_eq!(came.get(&tag), Some(expected), "job {tag} of round {round}");
            }
            assert!(used.iter().all(|&answers| answers >= 9), "{used:?}");
            rig.steps(400);
            assert_eq!(rig.read(StreamRegister::Status) & STREAM_STATUS_BUSY, 0, "the device owes nothing");
            // A job in the air when the reset comes leaves nothing behind.
            rig.bus.send(&jobs[0].0);
            rig.steps(60 * turn as usize);
            rig.bus.drop_unsent();
            while rig.bus.unsent() > 0 {
                rig.step();
            }
            rig.write(StreamRegister::Control, CONTROL_RESET);
            rig.await_core();
            rig.bus.came.clear();
        }
    }
}
