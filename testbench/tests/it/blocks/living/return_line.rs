//! Runs `ReturnLine` in Rust and in Verilog beside a list: vertices go back in the order in which they came out.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::ReturnLine;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(ReturnLine, [reset, begins, begun, puts_out, put_out_context, goes], [waits, launch], clock);

const CONTEXTS: usize = 8;

/// Number, vertex, old and new place of an item.
type Item = [u64; 4];

#[test]
fn vertices_go_back_in_the_order_in_which_they_came_out() {
    let mut random = SplitMix64::new(95);
    let mut block = Stepper::new("return_line", ReturnLine::new(Config { contexts: 8, ..TINY }), 1);
    // The item of each context, and whether its vertex is out.
    let mut items: [Option<(Item, bool)>; CONTEXTS] = [None; CONTEXTS];
    let mut line: VecDeque<(usize, Item)> = VecDeque::new();
    let (mut gone, mut longest) = (0, 0);
    for clock in 0..8_000 {
        let reset = clock < 4 || random.once_in(1_000);
        let item = [random.bits(24), random.bits(15), random.bits(32), random.bits(32)];
        let idle: Vec<usize> = (0..CONTEXTS).filter(|&context| items[context].is_none()).collect();
        let begins = Some(&idle).filter(|idle| !idle.is_empty() && flip(&mut random)).map(|idle| random.pick(idle));
        let at_work: Vec<usize> = (0..CONTEXTS).filter(|&context| matches!(items[context], Some((_, false)))).collect();
        let out = Some(&at_work).filter(|work| !work.is_empty() && !random.once_in(3)).map(|work| random.pick(work));
        block.set("reset", reset);
        block.set("begins", begins.is_some());
        block.set("begun_context", begins.unwrap_or(0) as u64);
        for (field, value) in ["number", "vertex", "place", "target"].into_iter().zip(item) {
            block.set(&format!("begun_item_{field}"), value);
        }
        block.set("puts_out", out.is_some());
        block.set("put_out_context", out.unwrap_or(0) as u64);
        let goes = !line.is_empty() && !reset && random.once_in(if clock % 400 < 200 { 6 } else { 2 });
        block.set("goes", goes);
        block.settle();
        if clock >= 4 {
            block.expect("waits", !line.is_empty());
            if let Some(&(context, [number, vertex, _, target])) = line.front() {
                block.expect("launch_context", context as u64);
                block.expect("launch_item_number", number);
                block.expect("launch_item_vertex", vertex);
                block.expect("launch_item_place", target);
                block.expect("launch_item_target", target);
                block.expect("launch_item_owns", true);
            }
        }
        block.edge();
        longest = longest.max(line.len());
        if goes {
            let (context, _) = line.pop_front().expect("an item");
            items[context] = None;
            gone += 1;
        }
        if let Some(context) = begins {
            items[context] = Some((item, false));
        }
        if let Some(context) = out {
            let (item, _) = items[context].expect("an item at work");
            items[context] = Some((item, true));
            line.push_back((context, item));
        }
        if reset {
            items = [None; CONTEXTS];
            line.clear();
        }
    }
    assert!(gone > 500 && longest == CONTEXTS, "{gone} went back, {longest} waited");
}
