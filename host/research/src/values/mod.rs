//! `values`: queries a second of each way to give values between points, beside CGAL.
//!
//! The contestants take turns in random order, and each is given the same points and places in every round. Their times
//! are those of the queries alone. On a machine with other work the wall clock says little, so the processor time of
//! all threads stands beside it.

mod cgal;
mod set;

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::time::Instant;

use clap::Args;
use incircle_geometry::cpu;
use incircle_geometry::interpolate::{Method, Outside, Surface};
use incircle_testkit::SplitMix64;

use crate::orders::{print, Failure};
use set::Set;

/// Arguments of `values`.
#[derive(Clone, Debug, Args)]
pub struct ValuesArguments {
    /// Points of the surface
    #[arg(short, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(3..))]
    pub n: u32,
    /// Places at which values are asked
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub places: u32,
    /// Threads of this library; CGAL has one
    #[arg(long, value_name = "N", default_value = "2")]
    pub threads: NonZeroUsize,
    /// Rounds, of which the best counts: in each, every contestant answers all places once
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Leave CGAL out, also where it is installed; it is asked for sorted places only
    #[arg(long)]
    pub without_cgal: bool,
    /// Seed; one seed gives the same set on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// The ways of this library; CGAL comes behind them.
const METHODS: [(&str, Method); 3] =
    [("linear", Method::Linear), ("laplace", Method::Laplace), ("sibson", Method::Sibson)];

/// The best of the rounds of one contestant: the least seconds by the wall and of processor time, and the values.
struct Best {
    wall: f64,
    processor: f64,
    values: Vec<f64>,
}

/// Runs the subcommand: a row for each way and each order of the places.
///
/// # Errors
/// The points have no surface, CGAL has values that are not near ours, or a library fails.
pub fn values(arguments: &ValuesArguments) -> Result<(), Failure> {
    let program = if arguments.without_cgal { Err("left out".to_owned()) } else { cgal::Program::new() };
    if let Err(reason) = &program {
        print(&format!("cgal: {reason}\n"))?;
    }
    let set = Set::new(arguments.n as usize, arguments.places as usize, arguments.seed);
    let mesh = cpu::triangulate(set.points.clone(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
    let surface = Surface::new(&set.points, &mesh.triangles, &set.heights)?;
    print(&format!(
        "{} points on a grid of {} bits, {} places, {} threads, best of {}; million values a second\n",
        arguments.n,
        set::BITS,
        arguments.places,
        arguments.threads,
        arguments.rounds
    ))?;
    for (name, places) in [("sorted", &set.sorted), ("random", &set.random)] {
        // CGAL walks to each place from the one before, across the whole mesh if places are scattered.
        let peer = program.as_ref().ok().filter(|_| name == "sorted");
        let best = race(&set, &surface, places, peer, arguments)?;
        print(&rows(name, &best, arguments))?;
        if let [_, _, sibson, cgal] = &best[..] {
            print(&agreement(&sibson.values, &cgal.values)?)?;
        }
    }
    Ok(())
}

/// Lets all contestants answer all places in every round.
fn race(
    set: &Set,
    surface: &Surface,
    places: &[[f64; 2]],
    program: Option<&cgal::Program>,
    arguments: &ValuesArguments,
) -> Result<Vec<Best>, Failure> {
    let mut random = SplitMix64::new(arguments.seed);
    let count = METHODS.len() + usize::from(program.is_some());
    let unknown = || Best { wall: f64::INFINITY, processor: f64::INFINITY, values: Vec::new() };
    let mut best: Vec<Best> = (0..count).map(|_| unknown()).collect();
    for _ in 0..arguments.rounds {
        let mut turns: Vec<usize> = (0..count).collect();
        random.shuffle(&mut turns);
        for turn in turns {
            let (since, begin) = (Instant::now(), processor_seconds());
            let (wall, processor, values) = match (METHODS.get(turn), program) {
                (Some(&(_, method)), _) => {
                    let values = surface.values(method, Outside::Nan, places, arguments.threads);
                    (since.elapsed().as_secs_f64(), processor_seconds() - begin, values)
                }
                (None, Some(program)) => {
                    let (seconds, values) = program.run(set, places)?;
                    (f64::INFINITY, seconds, values)
                }
                (None, None) => continue,
            };
            let own = &mut best[turn];
            *own = Best { wall: own.wall.min(wall), processor: own.processor.min(processor), values };
        }
    }
    Ok(best)
}

/// The processor time of all threads of this process so far, in seconds, in steps of a hundredth. 0 where the system
/// does not tell.
fn processor_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program, in brackets, may have spaces.
    let behind = text.rsplit(')').next().unwrap_or_default();
    let ticks = behind.split_whitespace().skip(11).take(2).filter_map(|number| number.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}

fn rows(order: &str, best: &[Best], arguments: &ValuesArguments) -> String {
    let rate = |seconds: f64| f64::from(arguments.places) / seconds / 1e6;
    let names = METHODS.iter().map(|(name, _)| *name).chain(["sibson of cgal"]);
    let row = |(name, own): (&str, &Best)| {
        let each = rate(own.processor);
        if own.wall.is_infinite() {
            return format!("{order}  {name}: {each:.2} a second of processor time\n");
        }
        let wall = rate(own.wall);
        format!("{order}  {name}: {wall:.2} by the wall clock, {each:.2} a second of processor time\n")
    };
    names.zip(best).map(row).collect()
}

/// Compares values of the same places; their differences come from rounding.
fn agreement(ours: &[f64], theirs: &[f64]) -> Result<String, Failure> {
    let inside: Vec<(f64, f64)> =
        ours.iter().copied().zip(theirs.iter().copied()).filter(|(a, b)| !a.is_nan() && !b.is_nan()).collect();
    let largest = inside.iter().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let undecided = ours.len() - inside.len();
    let outside = ours.iter().filter(|value| value.is_nan()).count();
    if inside.is_empty() && outside < ours.len() {
        return Err("cgal has no value at any place that is inside for us".into());
    }
    let text = format!(
        "        ours and cgal's differ by {largest:.1e} at most; {outside} places are outside for us, and {undecided} \
         for us or cgal\n"
    );
    match largest < 1e-6 {
        true => Ok(text),
        false => Err(format!("values differ by {largest:e}, but heights only by 4").into()),
    }
}
