//! Runs `NextItem` in Rust and in Verilog beside a statement of its rules: all three must agree in every clock.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::NextItem;
use incircle_testkit::SplitMix64;

named_ports!(
    NextItem,
    [reset, returns, returned, waits, has_room, queued, start_record, goes],
    [takes_returned, pops, context_id, is_ready, launch, record, is_return],
    clock
);

/// The item in the register: its context, number and record, and whether its vertex goes back.
#[derive(Clone, Copy)]
struct Kept {
    context: u64,
    number: u64,
    record: u64,
    is_return: bool,
}

#[test]
fn an_item_waits_in_the_register_until_it_begins() {
    let mut random = SplitMix64::new(97);
    let mut block = Stepper::new("living_next_item", NextItem::default(), 1);
    let mut kept: Option<Kept> = None;
    // The item on offer was chosen in the clock before, and leaves the queues in this one.
    let mut leaves = false;
    // Items that began; returns chosen; items chosen; items that found no room; returns that waited for the clock after
    // an item began; items that left the queues while another one stood there.
    let mut seen = [0; 6];
    for clock in 0..6_000 {
        let reset = clock < 3 || random.once_in(300);
        let returns = random.once_in(3);
        let (waits, has_room) = (random.once_in(2), !random.once_in(4));
        let items = [(random.below(16), random.bits(24)), (random.below(16), random.bits(24))];
        let record = random.bits(15);
        let goes = kept.is_some() && flip(&mut random);
        block.set("reset", reset);
        block.set("returns", returns);
        block.set("waits", waits);
        block.set("has_room", has_room);
        for (port, (context, number)) in ["returned", "queued"].into_iter().zip(items) {
            block.set(&format!("{port}_context"), context);
            block.set(&format!("{port}_item_number"), number);
        }
        block.set("start_record", record);
        block.set("goes", goes);
        block.settle();

        let is_open = kept.is_none();
        let takes_returned = is_open && returns;
        let takes_queued = is_open && !returns && waits && has_room;
        if clock >= 3 {
            block.expect("is_ready", kept.is_some());
            block.expect("takes_returned", takes_returned);
            block.expect("pops", leaves);
            block.expect("context_id", items[usize::from(!returns)].0);
            if let Some(Kept { context, number, record, is_return }) = kept {
                block.expect("launch_context", context);
                block.expect("launch_item_number", number);
                block.expect("record", record);
                block.expect("is_return", is_return);
            }
        }
        block.edge();
        seen[0] += u32::from(goes);
        seen[1] += u32::from(takes_returned);
        seen[2] += u32::from(takes_queued);
        seen[3] += u32::from(is_open && !returns && waits && !has_room);
        seen[4] += u32::from(goes && returns);
        seen[5] += u32::from(leaves && waits);
        leaves = takes_queued && !reset;
        if goes {
            kept = None;
        }
        if takes_returned || takes_queued {
            let (context, number) = items[usize::from(!returns)];
            kept = Some(Kept { context, number, record, is_return: returns });
        }
        if reset {
            kept = None;
        }
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}
