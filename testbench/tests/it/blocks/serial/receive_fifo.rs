//! Runs `ReceiveFifo` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_blocks::QUICK_LINK;
use incircle_hdl::serial::ReceiveFifo;
use incircle_testkit::SplitMix64;

named_ports!(ReceiveFifo<8>, [reset, begins, push, push_data, commits, takes], [room, entry_valid, entry_data], clock);

#[test]
fn fifo_gives_what_was_committed_and_nothing_else() {
    let size = QUICK_LINK.fifo_bytes as usize;
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("serial_receive_fifo", ReceiveFifo::new(QUICK_LINK.fifo_bytes), 1);
    let mut committed: VecDeque<u8> = VecDeque::new();
    let mut provisional: Vec<u8> = Vec::new();
    // Clocks for which nothing was pushed, and for which `free` can have followed.
    let (mut rests_for, mut still_for) = (0, 0);
    let mut began = 0;
    let (mut commits, mut windings, mut fullest) = (0, 0, 0);
    for clock in 0..150_000 {
        // The FIFO fills and empties in turn.
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
                block.expect("room.free", (size - committed.len()) as u64);
            }
            if still_for >= 2 && rests_for >= 2 && began != clock - 1 {
                block.expect("room.is_full", committed.len() + provisional.len() == size);
            }
            let is_there = block.is("entry_valid");
            assert!(!is_there || !committed.is_empty(), "a byte came that was not committed");
            assert!(is_there || committed.is_empty() || still_for < 4, "no byte in clock {clock}");
            if let (true, Some(first)) = (is_there, committed.front()) {
                block.expect("entry_data", *first);
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
            began = clock;
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
