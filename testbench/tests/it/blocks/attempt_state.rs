//! The state of attempts: the step that a visit takes it, the store it comes from, and the points. Rust, Verilog and a plain statement
//! agree on random visits.

use crate::rig::attempt_state::State;
use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{AttemptPoints, AttemptStep, AttemptStore};
use incircle_protocol::SMALL;

named_ports!(
    AttemptStep,
    [attempt, is_last, edge_was_passed, entry_bit, took, is_test, splits, repeats, gives_up, overflows],
    [after, is_over, succeeds, finds_inner, passes_root]
);
named_ports!(
    AttemptStore,
    [ring, early_owner, early_entry, owner, f_entry, opens, is_test, splits, repeats, passes_root, after],
    [attempt, is_last, is_full, edge_was_passed, entry_bit],
    clock
);
named_ports!(AttemptPoints, [takes, taker, taken_id, now, owner], [p, since], clock);

const ROUNDS: usize = 6000;

#[test]
fn attempt_step_counts_visits_entries_triangles_and_locks() {
    let mut random = SplitMix64::new(51);
    let mut block = Stepper::new("attempt_step", AttemptStep::default(), 1);
    let (mut inners, mut ends) = (0, [0; 2]);
    for _ in 0..ROUNDS {
        let before = State::random(&mut random);
        let entries = [2, 64][random.below(2) as usize];
        let y = random.below(entries);
        let case = random.below(6);
        let [no_test, splits, repeats, gives_up, overflows] = [0, 1, 2, 3, 4].map(|code| case == code);
        let is_test = !no_test;
        let took = flip(&mut random);
        block.set("attempt", before.packed());
        block.set("entry_bit", 1u64 << y);
        block.set("is_last", before.outstanding == 1);
        block.set("edge_was_passed", before.half_open >> y & 1 == 1);
        for (port, value) in [
            ("took", took),
            ("is_test", is_test),
            ("splits", splits),
            ("repeats", repeats),
            ("gives_up", gives_up),
            ("overflows", overflows),
        ] {
            block.set(port, value);
        }
        let mut after = before;
        let mut finds_inner = false;
        let passes_root = splits && y == 0 && before.half_open & 3 == 1;
        after.drains |= gives_up || overflows;
        after.logged += u64::from(took);
        after.outstanding -= 1;
        after.outstanding += if splits { 2 } else { u64::from(repeats) };
        if splits {
            after.count += 1;
            finds_inner = after.passes(y);
            after.inners += u64::from(finds_inner);
        }
        let is_over = is_test && after.outstanding == 0;
        block.settle();
        block.expect("is_over", is_over);
        block.expect("succeeds", is_over && !after.drains);
        block.expect("finds_inner", finds_inner);
        block.expect("passes_root", passes_root);
        // What is no test changes no state, or begins another.
        if is_test {
            block.expect("after", after.packed());
        }
        inners += usize::from(finds_inner);
        ends[usize::from(after.drains)] += usize::from(is_over);
    }
    assert!(inners > 200 && ends[0] > 200 && ends[1] > 200, "{inners} {ends:?}");
}

#[test]
fn attempt_store_has_every_state_at_hand_when_its_visit_completes() {
    let mut random = SplitMix64::new(54);
    let mut block = Stepper::new("attempt_store_small", AttemptStore::new(SMALL), 2);
    let ring = u64::from(SMALL.ring);
    // Whatever the memory holds at first, these are written before they are read.
    let mut states = [(); 4].map(|()| None::<State>);
    let (mut owner, mut f_entry, mut seen) = (0, 0, [0; 4]);
    block.set("ring", ring);
    for _ in 0..4 * ROUNDS {
        let entries = [2, ring][random.below(2) as usize];
        let (next_owner, early_entry) = (random.below(4), random.below(entries));
        let before = states[owner as usize];
        let opens = random.below(12) == 0 || before.is_none_or(|state| state.outstanding == 0);
        let splits = !opens && flip(&mut random) && before.is_some_and(|state| state.count < ring);
        let repeats = !opens && !splits && random.below(4) == 0;
        let is_test = !opens && (splits || random.below(4) > 0);
        // No other visit of a context that opens is out.
        let early_owner = if opens && next_owner == owner { (owner + 1) % 4 } else { next_owner };
        for (port, value) in
            [("early_owner", early_owner), ("early_entry", early_entry), ("owner", owner), ("f_entry", f_entry)]
        {
            block.set(port, value);
        }
        let mut after = before.unwrap_or_default();
        let passes_root = splits && f_entry == 0 && after.half_open & 3 == 1;
        if opens {
            after = State { outstanding: 3, count: 3, logged: 1, ..State::default() };
        } else {
            after.outstanding += if splits { 2 } else { u64::from(repeats) };
            after.outstanding = after.outstanding.saturating_sub(1);
            after.count += u64::from(splits);
            after.logged = random.below(64);
            if splits {
                after.passes(f_entry);
            }
        }
        block.set("after", after.packed());
        for (port, value) in [
            ("opens", opens),
            ("is_test", is_test),
            ("splits", splits),
            ("repeats", repeats),
            ("passes_root", passes_root),
        ] {
            block.set(port, value);
        }
        block.settle();
        if let Some(state) = before {
            let flags = [state.outstanding == 1, state.count == ring, state.half_open >> f_entry & 1 == 1];
            block.expect("attempt", state.packed());
            block.expect("entry_bit", 1u64 << f_entry);
            for ((port, flag), seen) in ["is_last", "is_full", "edge_was_passed"].into_iter().zip(flags).zip(&mut seen)
            {
                block.expect(port, flag);
                *seen += usize::from(flag);
            }
            seen[3] += usize::from(is_test && early_owner == owner);
        }
        block.edge();
        if is_test || opens {
            states[owner as usize] = Some(after);
        }
        (owner, f_entry) = (early_owner, early_entry);
    }
    assert!(seen.iter().all(|times| *times > 100), "{seen:?}");
}

#[test]
fn attempt_points_show_the_wave_of_their_header() {
    let mut random = SplitMix64::new(55);
    let mut block = Stepper::new("attempt_points_small", AttemptPoints::new(SMALL), 3);
    let mut points = [(); 4].map(|()| None);
    let mut wave = Wave::default();
    for clock in 0..ROUNDS {
        // The wave first, then anything.
        let takes = if clock < 4 { clock == 0 } else { flip(&mut random) };
        let [taker, taken_id, now, owner] = match clock {
            0..4 => [1, 7, 3, 1],
            _ => [random.below(4), random.below(1 << 15), random.below(1 << 22), random.below(4)],
        };
        block.set("takes", takes);
        for (port, value) in [("taker", taker), ("taken_id", taken_id), ("now", now), ("owner", owner)] {
            block.set(port, value);
        }
        block.settle();
        // What was taken at the last edge is not there yet.
        let known: Option<[u64; 2]> =
            points[owner as usize].filter(|(taken, _)| taken + 1 < clock).map(|(_, point)| point);
        if let Some([p, since]) = known {
            block.expect("p", p);
            block.expect("since", since);
        }
        let cell = |is_shown: bool, value: u64| if is_shown { Cell::Number(value.into()) } else { Cell::Open };
        if clock < 4 {
            wave.take(&[
                ("takes", Cell::Bit(takes)),
                ("taker", cell(takes, taker)),
                ("taken_id", cell(takes, taken_id)),
                ("now", cell(takes, now)),
                ("owner", cell(clock == 2, owner)),
                ("p", cell(clock == 2 && known.is_some(), 7)),
                ("since", cell(clock == 2 && known.is_some(), 3)),
            ]);
        }
        block.edge();
        if takes {
            points[taker as usize] = Some((clock, [taken_id, now]));
        }
    }
    wave.assert_drawn_in("attempt_points");
}
