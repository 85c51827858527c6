//! Checks that the tests of blocks mirror `hdl/src`: the file `engine/visit/issue.rs`
//! there has its test in `blocks/engine/visit/issue.rs`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Blocks without a test file of their own: the test that runs the block, by its path from `tests/it`,
/// and why that test is enough.
const ELSEWHERE: [(&str, &str, &str); 69] = [
    ("cluster/dual", "cores/chip", "wires between router, slots and collector"),
    ("cluster/engine_slot", "cores/chip", "a core with its queue and a count, at every clock"),
    ("cluster/quad", "cores/chip", "wires between router, slots and collector"),
    (
        "engine/attempt/aftermath",
        "blocks/engine/attempt/attempts",
        "what becomes of a context, at the ports of attempts",
    ),
    ("engine/attempt/context_address", "blocks/engine/commit/ring_reader", "one line, the address of a ring's entry"),
    ("engine/commit/commit_path", "cores/lockstep", "wires between ring reader, commit and release"),
    ("engine/commit/commit_steps", "blocks/engine/commit/commit", "the states of the commit, which alone uses them"),
    ("engine/commit/kept_ids", "cores/changes", "the ids of vertices that come back, at every clock"),
    ("engine/commit/ring_list", "blocks/engine/commit/ring_reader", "the memory behind the reader"),
    ("engine/count/cycle_counters", "blocks/engine/count/counters", "a part of the counters, at their ports"),
    ("engine/count/visit_counters", "blocks/engine/count/counters", "a part of the counters, at their ports"),
    ("engine/dispatch/change_view", "cores/changes", "the events of a core with changes, at every clock"),
    ("engine/dispatch/dispatcher", "cores/lockstep", "wires between the blocks of the room"),
    ("engine/dispatch/due_check", "blocks/engine/dispatch/starter", "a question that only the starter asks"),
    ("engine/dispatch/fill_flags", "cores/changes", "the flags of a core with deletions, at every clock"),
    ("engine/dispatch/fill_priority", "cores/changes", "the priority in a core with deletions, at every clock"),
    ("engine/dispatch/open_teams", "blocks/engine/dispatch/starter", "a table that only the starter asks"),
    ("engine/dispatch/start_pointer", "blocks/engine/dispatch/starter", "the pointer that only the starter follows"),
    ("engine/holes/first_challenge", "blocks/engine/holes/hole_fill", "the first test, at the ports of the fill"),
    ("engine/holes/hole_ring", "cores/changes", "the memory behind tests and writer"),
    ("engine/holes/hole_step", "cores/changes", "the apexes of triangles in holes, at every clock"),
    ("engine/holes/hole_writer", "cores/changes", "the records that fill holes, at every clock"),
    ("engine/holes/holes", "cores/changes", "wires between the blocks of the room"),
    ("engine/holes/named_vertex", "cores/changes", "the ends of walks to vertices, at every clock"),
    ("engine/holes/next_interval", "blocks/engine/holes/hole_fill", "the order of intervals, at the ports of the fill"),
    ("engine/holes/next_place", "cores/changes", "one line, the order of places in a ring"),
    ("engine/holes/star_case", "cores/changes", "the kinds of visits of stars, at every clock"),
    ("engine/holes/star_outcome", "cores/changes", "the consequences of visits of stars, at every clock"),
    ("engine/holes/star_step", "cores/changes", "the chains round stars, at every clock"),
    ("engine/holes/star_store", "cores/changes", "the memory of stars"),
    ("engine/holes/star_visits", "cores/changes", "the visits of stars, at every clock"),
    ("engine/holes/test_visit", "cores/changes", "the first test of each interval, at every clock"),
    ("engine/insertion_engine", "cores/lockstep", "wires between the rooms"),
    ("engine/insertions", "cores/lockstep", "wires between the rooms"),
    ("engine/solo/solo_star", "blocks/engine/solo/solo", "a part of solo that only solo's states drive"),
    ("engine/solo/solo_steps", "blocks/engine/solo/solo", "the states of solo, which alone uses them"),
    ("engine/visit/test_corners", "cores/changes", "the vertices of tests in holes, at every clock"),
    ("commands/kept_halves", "blocks/commands/record_packer", "the states of the packer, which alone uses them"),
    ("commands/living_reads", "cores/changes", "read-outs of meshes with free records, at every clock"),
    ("commands/living_tally", "cores/changes", "the counts of reports after deletions"),
    ("commands/read_range", "blocks/commands/answer_head", "ranges of every kind, inside and outside the mesh"),
    ("commands/record_group", "blocks/commands/record_packer", "payloads of every length in every form"),
    ("commands/payload_words", "blocks/commands/responder", "the payload that only the responder asks for"),
    ("leaf/spill_ring", "blocks/leaf/deep_fifo", "the memory behind the deep buffer"),
    ("leaf/unpack", "blocks/engine/visit/issue", "the fields of a structure as wires, in most blocks"),
    ("living/changes", "cores/changes", "wires between check, ends and late points"),
    ("living/checked_item", "blocks/living/vertex_check", "the item that the check offers"),
    (
        "living/item_dealer",
        "blocks/living/run_port",
        "the items of a run, at the ports of the block that takes its words",
    ),
    ("living/late_events", "cores/changes", "the events that end items, a clock later, at every clock"),
    ("living/named_vertices", "blocks/living/question_step", "the finding in a triangle, at the ports of the step"),
    ("living/part_beat", "blocks/living/part_queue", "the words of each part, two at a time"),
    ("living/queue_counts", "blocks/living/item_queues", "the counts of the queues, which alone use them"),
    ("living/run_answer", "blocks/living/run_port", "the head of every answer, also of a run that is refused"),
    ("living/vertex_bits", "blocks/living/vertex_check", "the bits that the check alone reads and writes"),
    ("predicate/apex_side", "cores/changes", "one sign, on which tests in holes depend"),
    ("serial/link_receiver", "blocks/serial/serial_link", "the receiving half of the link, at its pins"),
    ("serial/link_transmitter", "blocks/serial/serial_link", "the sending half of the link, at its pins"),
    ("stream/bus_side", "blocks/stream/stream_link", "the half of the link in the clock of the bus"),
    ("stream/core_side", "blocks/stream/stream_link", "the half of the link in the clock of the core"),
    ("stream/device_identity", "blocks/stream/register_block", "constants of registers, read through the port"),
    ("stream/traffic", "blocks/stream/register_block", "counters, read through the port"),
    ("udp/udp_device", "links/ether", "wires between port and link, at the pins of a board"),
    ("udp/udp_receiver", "blocks/udp/udp_link", "the receiving half of the link, at its ports"),
    ("udp/udp_transmitter", "blocks/udp/udp_link", "the sending half of the link, at its ports"),
    ("top/udp_top", "links/ether", "the device at its pins"),
    ("top/core", "cores/lockstep", "every root port at every clock"),
    ("top/living_core", "cores/questions", "every root port at every clock"),
    ("top/serial_top", "links/page", "the device at its pins"),
    ("top/stream_top", "links/stream_top", "the device at its ports"),
];

/// Test files of more than one block.
const MORE: [&str; 2] = ["leaf/cells", "serial/serial_link_faults"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Rust files below a folder for whose text `counts` holds, as paths from that folder without their ending.
fn files(folder: &Path, counts: fn(&str) -> bool) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap_or_else(|error| panic!("{}: {error}", next.display())) {
            let path = entry.expect("an entry of a folder").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") && counts(&text(&path)) {
                let name = path.strip_prefix(folder).expect("a file below").with_extension("");
                found.insert(name.to_str().expect("a name in ASCII").to_string());
            }
        }
    }
    found
}

fn has_a_test(text: &str) -> bool {
    text.contains("#[test]")
}

fn has_a_block(text: &str) -> bool {
    // Blocks that only tests use stand behind this mark.
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let derives = text.split("derive(").skip(1).filter_map(|rest| rest.split(')').next());
    derives.flat_map(|traits| traits.split(',')).any(|name| name.trim() == "LogicBlock")
}

#[test]
fn each_block_has_a_test_in_the_file_of_its_name() {
    let blocks = files(&root().join("hdl/src"), has_a_block);
    let tests = root().join("testbench/tests/it");
    let tested = files(&tests.join("blocks"), has_a_test);
    assert!(blocks.len() >= 100, "only {} blocks found", blocks.len());
    let elsewhere: BTreeSet<String> = ELSEWHERE.iter().map(|row| row.0.to_string()).collect();
    for block in &blocks {
        let places = [tested.contains(block), elsewhere.contains(block)].map(usize::from).iter().sum::<usize>();
        assert_eq!(places, 1, "{block} needs a test in blocks/{block}.rs, or else a row of ELSEWHERE, and not both");
    }
    for (block, test, _) in ELSEWHERE {
        assert!(blocks.contains(block), "ELSEWHERE names {block}, which is no block");
        assert!(
            has_a_test(&text(&tests.join(test).with_extension("rs"))),
            "{test}, which is to hold {block}, has no test"
        );
    }
    let known = |name: &String| blocks.contains(name) || MORE.contains(&name.as_str());
    let strays: Vec<_> = tested.iter().filter(|name| !known(name)).collect();
    assert!(strays.is_empty(), "tests of blocks that are not in hdl/src: {strays:?}");
}
