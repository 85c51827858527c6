//! `plans`: compares constrained triangulation with that of other libraries, on one thread.
//!
//! Every contestant makes the mesh of the same points and constraints, from lists in its own form to a mesh in its own
//! form, and all triangles are compared with ours. The contestants take turns in random order, so that other work on the
//! machine touches all. Ratios are medians over the rounds, of times taken next to each other.

mod cgal;
mod run;
mod sets;
mod spade;

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::time::Instant;

use clap::Args;
use incircle_geometry::constraints::{self, Plan};
use incircle_geometry::{cpu, Mesh, Point};
use incircle_testkit::SplitMix64;

use crate::orders::{print, Failure};
use run::Run;
use sets::{Kind, Set};

/// Arguments of `plans`.
#[derive(Clone, Debug, Args)]
pub struct PlansArguments {
    /// Points of a set, a tenth of which have constraints
    #[arg(short, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1000..))]
    pub n: u32,
    /// Rounds: in each, every library makes every mesh once
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Leave CGAL out, also where it is installed: its program takes half a minute to compile
    #[arg(long)]
    pub without_cgal: bool,
    /// Seed; one seed gives the same sets on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// Runs the subcommand: a row for each kind of plan.
///
/// # Errors
/// Meshes differ, or a library fails.
pub fn plans(arguments: &PlansArguments) -> Result<(), Failure> {
    let program = if arguments.without_cgal { Err("left out".to_owned()) } else { cgal::Program::new() };
    if let Err(reason) = &program {
        print(&format!("cgal: {reason}\n"))?;
    }
    print(&format!("{} points on a grid of {} bits; ns a point, medians\n", arguments.n, sets::BITS))?;
    for kind in Kind::ALL {
        let set = Set::new(kind, arguments.n as usize, arguments.seed);
        print(&race(&set, kind, program.as_ref().ok(), arguments)?)?;
    }
    print("all meshes are equal; in brackets: ours by theirs\n")?;
    Ok(())
}

/// Our time without constraints, our time with them, and those of the others, for each round.
fn race(set: &Set, kind: Kind, program: Option<&cgal::Program>, arguments: &PlansArguments) -> Result<String, Failure> {
    let mut random = SplitMix64::new(arguments.seed);
    let points: Vec<Point> = set.points.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect();
    let count = if program.is_some() { 4 } else { 3 };
    let mut seconds: Vec<Vec<f64>> = vec![Vec::new(); count];
    for _ in 0..arguments.rounds {
        let mut turns: Vec<usize> = (0..count).collect();
        random.shuffle(&mut turns);
        let mut meshes: Vec<Vec<[u32; 3]>> = vec![Vec::new(); count];
        for place in turns {
            let run = match (place, program) {
                (0, _) => free(&points)?,
                (1, _) => ours(&points, &set.constraints)?,
                (2, _) => spade::run(set)?,
                (_, Some(program)) => program.run(set)?,
                (_, None) => continue,
            };
            seconds[place].push(run.seconds);
            meshes[place] = run.triangles;
        }
        if meshes[2..].iter().any(|mesh| *mesh != meshes[1]) {
            return Err(format!("a library has another mesh of {}", kind.name()).into());
        }
    }
    Ok(row(kind, &seconds, arguments.n))
}

fn row(kind: Kind, seconds: &[Vec<f64>], n: u32) -> String {
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let mut text = format!("{:8}", kind.name());
    for (place, name) in ["ours, no constraints", "ours", "spade", "cgal"].into_iter().enumerate().take(seconds.len()) {
        let time = 1e9 * median(seconds[place].clone()) / f64::from(n);
        let ratio = median(seconds[1].iter().zip(&seconds[place]).map(|(ours, theirs)| ours / theirs).collect());
        text += &format!("  {name} {time:.0}");
        if place != 1 {
            text += &format!(" ({ratio:.2})");
        }
    }
    text + "\n"
}

fn triangulated(points: &[Point]) -> Result<Mesh<Point>, Failure> {
    Ok(cpu::triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?)
}

fn free(points: &[Point]) -> Result<Run, Failure> {
    let since = Instant::now();
    let mesh = triangulated(points)?;
    Ok(Run { seconds: since.elapsed().as_secs_f64(), triangles: mesh.triangles })
}

fn ours(points: &[Point], constraints: &[[u32; 2]]) -> Result<Run, Failure> {
    let since = Instant::now();
    let plan = Plan::new(constraints);
    let mesh = constraints::triangulate(points, &plan, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
    Ok(Run { seconds: since.elapsed().as_secs_f64(), triangles: mesh.made.triangles })
}
