//! Runs `HoleMerge` in Rust and in Verilog beside a statement of its rules: all three must agree. The fields of bundles
//! that the block only passes on are tested in the whole core.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::HoleMerge;
use incircle_testkit::SplitMix64;

named_ports!(
    HoleMerge,
    [
        is_done,
        opens_star,
        attempt_is_done,
        follow,
        hole_follow,
        outcome,
        hole_outcome,
        lock,
        hole_lock,
        commits,
        attempt_release,
        hole_release,
        may_settle,
        write,
        hole_write,
        asks,
        wishes,
        ending,
        erased
    ],
    [
        merged_is_done,
        may_ask,
        merged_follow,
        merged_outcome,
        merged_lock,
        merged_release,
        merged_write,
        is_done_now,
        aborts,
        revisits,
        pushes,
        may_end,
        ends,
        granted,
        erases,
        erased_locks
    ]
);

/// The job of a release: its context and the number of its locks.
type Job = (u64, u64);

#[test]
fn an_item_ends_with_its_hole_where_nothing_else_ends() {
    let mut random = SplitMix64::new(96);
    let mut block = Stepper::new("hole_merge", HoleMerge::default(), 1);
    let (mut ended, mut flat, mut held, mut pushed) = (0, 0, [0; 4], 0);
    for _ in 0..6_000 {
        let mut set = |port: &str, once_in: u64| {
            let value = random.once_in(once_in);
            block.set(port, value);
            value
        };
        let is_done = set("is_done", 2);
        let attempt_is_done = set("attempt_is_done", 2);
        let commits = set("commits", 6);
        let duplicate = set("outcome_duplicate", 6);
        let hole_duplicate = set("hole_outcome_duplicate", 6);
        let may_settle = set("may_settle", 4);
        let releases = [set("attempt_release_valid", 6), set("hole_release_valid", 6)];
        let (ending, is_flat) = (set("ending_valid", 2), set("ending_is_flat", 3));
        let (asks, wishes) = (set("asks", 2), set("wishes", 4));
        let may_ask = [set("follow_may_ask", 4), set("hole_follow_may_ask", 4)].contains(&true);
        let erased = set("erased_valid", 3);
        let writes = [set("write_valid", 2), set("hole_write_valid", 3)];
        let mut job = |port: &str, of: &str| -> Job {
            let job = (random.below(8), random.bits(6));
            block.set(&format!("{port}_{of}context"), job.0);
            block.set(&format!("{port}_{of}locks"), job.1);
            job
        };
        let jobs = [job("attempt_release", "job_"), job("hole_release", "job_")];
        let (last, end) = (job("erased", "job_"), job("ending", ""));
        let ids = [random.bits(15), random.bits(15)];
        block.set("write_id", ids[0]);
        block.set("hole_write_id", ids[1]);
        block.set("opens_star", flip(&mut random));
        block.settle();

        let may_end = !(releases[0] || may_settle || commits || duplicate);
        let ends = ending && may_end;
        block.expect("may_end", may_end);
        block.expect("ends", ends);
        block.expect("granted_valid", ends);
        block.expect("granted_context", end.0);
        let release = match (ends && is_flat, releases) {
            (true, _) => Some(end),
            (_, [_, true]) => Some(jobs[1]),
            (_, [true, _]) => Some(jobs[0]),
            _ => None,
        };
        block.expect("merged_release_valid", release.is_some());
        if let Some((context, locks)) = release {
            block.expect("merged_release_job_context", context);
            block.expect("merged_release_job_locks", locks);
        }
        block.expect("may_ask", may_ask);
        block.expect("merged_follow_may_ask", may_ask);
        block.expect("pushes", asks && !may_ask && !wishes);
        block.expect("merged_is_done", is_done || attempt_is_done);
        block.expect("is_done_now", is_done);
        block.expect("merged_outcome_duplicate", if is_done { hole_duplicate } else { duplicate });
        block.expect("merged_write_valid", writes.contains(&true));
        if writes.contains(&true) {
            block.expect("merged_write_id", ids[usize::from(writes[1])]);
        }
        block.expect("erases", erased);
        block.expect("erased_locks_valid", erased);
        block.expect("erased_locks_job_context", last.0);
        block.expect("erased_locks_job_locks", last.1);
        ended += u32::from(ends);
        flat += u32::from(ends && is_flat);
        pushed += u32::from(asks && !may_ask && !wishes);
        for (count, holds) in held.iter_mut().zip([releases[0], may_settle, commits, duplicate]) {
            *count += u32::from(ending && holds);
        }
    }
    assert!(ended > 500 && flat > 100 && pushed > 500 && held.iter().all(|&count| count > 100));
}
