//! Compares triangulators: the time that each takes for the same points, in one run, in
//! turns, with fresh points each time.
//!
//! A time is that of the whole call, from a list of points to a mesh in the form of the library, and each contestant
//! should find as many triangles as ours. Just before its timed run each contestant triangulates other points of the
//! set, untimed (for the airports, the same points in another order). The cost of fresh memory says much about a
//! machine and little about an algorithm: without the untimed run four million points take about 10 ns longer each, and
//! more than 200 ns where a virtual machine has lent its free memory to others.
//!
//! Ratios are medians, over the repetitions, of times taken next to each other, so that other work on
//! the machine touches both. The JSON objects also have the processor's time on the calling thread
//! ("busy"), which other work disturbs less.

mod arguments;
mod contestant;
mod error;
mod field;
mod outcome;
mod points;
mod process;
mod table;

use std::io::Write;

use incircle_testkit::SplitMix64;

use contestant::Contestant;
use outcome::Outcome;

pub use arguments::Arguments;
pub use error::PeerError;
pub use points::Set;

/// Number of timed points in all repetitions together, unless the number of repetitions is given.
const POINTS: usize = 6_000_000;
/// Turns a seed into one for the untimed points, which no repetition has.
const OTHERS: u64 = 1 << 63;
/// Fewest and most repetitions unless their number is given.
const REPETITIONS: std::ops::RangeInclusive<usize> = 3..=101;

/// Runs the comparison and prints it, one row or object for each set and number of points.
///
/// # Errors
/// A set cannot be made, or a contestant fails.
pub fn compare(arguments: &Arguments) -> Result<(), PeerError> {
    let (mut contestants, missing) = field::all(arguments.bits)?;
    let names: Vec<_> = contestants.iter().map(|contestant| contestant.name()).collect();
    let mut out = std::io::stdout().lock();
    if !arguments.json {
        out.write_all(table::header(arguments, &names, &missing).as_bytes())?;
    }
    let sets = if arguments.dist.is_empty() { Set::usual() } else { arguments.dist.clone() };
    for &n in &arguments.n {
        for &set in &sets {
            let outcome = measure(&mut contestants, set, n as usize, arguments)?;
            let text = if arguments.json { table::json(&outcome, &missing) } else { table::row(&outcome) };
            out.write_all(text.as_bytes())?;
            out.flush()?;
        }
    }
    Ok(())
}

/// Runs all repetitions of one set.
fn measure(
    contestants: &mut [Box<dyn Contestant>],
    set: Set,
    n: usize,
    arguments: &Arguments,
) -> Result<Outcome, PeerError> {
    let usual = (POINTS / n.max(1)).clamp(*REPETITIONS.start(), *REPETITIONS.end());
    let mut outcome = Outcome {
        set,
        bits: arguments.bits,
        cold: arguments.cold,
        points: 0,
        distinct: 0,
        order_share: Vec::new(),
        names: contestants.iter().map(|contestant| contestant.name()).collect(),
        runs: vec![Vec::new(); contestants.len()],
    };
    for repetition in 0..arguments.repetitions.unwrap_or(usual).max(1) {
        let seed = arguments.seed.wrapping_add(repetition as u64);
        let points = set.points(n, arguments.bits, seed)?;
        let before = if arguments.cold { None } else { Some(set.points(n, arguments.bits, seed ^ OTHERS)?) };
        // The turns are random. A contestant that always follows a program which has just freed its memory would wait
        // for the system each time, above all with `--cold`.
        let mut random = SplitMix64::new(seed);
        let mut turns: Vec<usize> = (0..contestants.len()).collect();
        turns.sort_by_cached_key(|_| random.next_u64());
        for place in turns {
            if let Some(before) = &before {
                contestants[place].run(before)?;
            }
            let run = contestants[place].run(&points)?;
            outcome.points = points.len();
            if place == 0 {
                outcome.distinct = run.distinct.unwrap_or(points.len());
                outcome.order_share.extend(run.order_share);
            }
            outcome.runs[place].push(run);
        }
    }
    Ok(outcome)
}

#[cfg(test)]
mod tests {
    use super::contestant::Run;
    use super::*;
    use clap::Parser;
    use incircle::Point;
    use std::cell::RefCell;
    use std::rc::Rc;

    /// A contestant that keeps the points it is given.
    struct Listener(Rc<RefCell<Vec<Vec<Point>>>>);

    impl Contestant for Listener {
        fn name(&self) -> &'static str {
            "listener"
        }

        fn run(&mut self, points: &[Point]) -> Result<Run, PeerError> {
            let mut heard = self.0.borrow_mut();
            heard.push(points.to_vec());
            Ok(Run { seconds: heard.len() as f64, busy: 0.0, triangles: 0, distinct: None, order_share: None })
        }
    }

    #[test]
    fn each_run_follows_an_untimed_one_of_other_points_unless_it_is_cold() {
        for (option, kept) in [(None, [2.0, 4.0, 6.0].as_slice()), (Some("--cold"), &[1.0, 2.0, 3.0])] {
            let arguments = Arguments::parse_from(
                ["peers", "--repetitions", "3", "--seed", "18446744073709551615"].into_iter().chain(option),
            );
            let heard = Rc::new(RefCell::new(Vec::new()));
            // Our back end takes part twice in a comparison, so two listeners stand for it.
            let mut field: Vec<Box<dyn Contestant>> =
                vec![Box::new(Listener(heard.clone())), Box::new(Listener(Rc::default()))];
            let outcome = measure(&mut field, Set::usual()[0], 50, &arguments).expect("a set");
            let seconds: Vec<f64> = outcome.runs[0].iter().map(|run| run.seconds).collect();
            assert_eq!(seconds, kept);
            let heard = heard.take();
            let mut distinct = heard.clone();
            distinct.sort();
            distinct.dedup();
            assert_eq!(distinct.len(), heard.len(), "points come again");
            let header = table::header(&arguments, &["listener"], &[]);
            assert_eq!(header.contains("as the system gives it"), option.is_some(), "{header}");
            let object: serde_json::Value = serde_json::from_str(&table::json(&outcome, &[])).expect("an object");
            assert_eq!(object["cold"], option.is_some());
        }
    }
}
