//! Runs `LatePoint` in Rust and in Verilog beside a point that waits: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::LatePoint;
use incircle_testkit::SplitMix64;

named_ports!(LatePoint, [reset, comes, fetches], [waits, writes, arrival], clock);

/// Number of clocks in which a point may be held up.
const MOST: u32 = 4;

#[test]
fn a_point_is_written_in_the_first_free_clock_or_the_last() {
    let mut random = SplitMix64::new(95);
    let mut block = Stepper::new("late_point", LatePoint::default(), 1);
    // The point that waits, with the number of clocks that it has waited.
    let mut late: Option<(u64, u64, u32)> = None;
    // The point that has come in the clock before.
    let mut coming: Option<(u64, u64)> = None;
    let (mut at_once, mut at_last, mut for_the_next, mut forgotten) = (0, 0, 0, 0);
    for _ in 0..8_000 {
        let is_last = late.is_some_and(|(.., waited)| waited == MOST);
        // Points come while another waits, and most clocks have a fetch, so that some points take their last chance.
        let comes = random.once_in(6).then(|| (random.bits(15), random.bits(32)));
        let fetches = !random.once_in(4);
        let resets = random.once_in(40);
        block.set("reset", resets);
        block.set("comes_came", comes.is_some());
        if let Some((id, point)) = comes {
            block.set("comes_id", id);
            block.set("comes_point", point);
        }
        block.set("fetches", fetches);
        block.settle();
        let writes = late.is_some() && (!fetches || coming.is_some() || is_last);
        block.expect("waits", late.is_some() || coming.is_some());
        block.expect("writes", writes);
        block.expect("arrival_came", writes);
        if let Some((id, point, waited)) = late.filter(|_| writes) {
            block.expect("arrival_id", id);
            block.expect("arrival_point", point);
            at_once += u32::from(waited == 0);
            at_last += u32::from(is_last && fetches);
            for_the_next += u32::from(coming.is_some() && fetches && !is_last);
        }
        block.edge();
        forgotten += u32::from(resets && late.is_some() && !writes);
        let waits = late.filter(|_| !writes).map(|(id, point, waited)| (id, point, waited + 1));
        late = coming.map(|(id, point)| (id, point, 0)).or(waits).filter(|_| !resets);
        coming = comes.filter(|_| !resets);
    }
    assert!(at_once > 300 && at_last > 50 && for_the_next > 50 && forgotten > 10, "{at_once} {at_last} {for_the_next}");
}
