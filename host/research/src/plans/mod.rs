//! `plans`: compares constrained triangulation with that of other libraries, on one thread.
//!
//! Every contestant makes the mesh of the same points and constraints, from lists in its own form to a mesh in its own
//! form, and all triangles are compared with ours. The contestants take turns in random order, so that other work on
//! the machine touches all. Ratios are medians over the rounds, of times taken next to each other.

mod program;
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
use program::Program;
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
    let cgal = if arguments.without_cgal { Err("left out".to_owned()) } else { Program::cgal() };
    let mut programs = Vec::new();
    for (name, program) in [("cgal", cgal), ("cdt", Program::cdt())] {
        match program {
            Ok(program) => programs.push(program),
            Err(reason) => print(&format!("{name}: {reason}\n"))?,
        }
    }
    print(&format!("{} points on a grid of {} bits; ns a point, medians\n", arguments.n, sets::BITS))?;
    for kind in Kind::ALL {
        let set = Set::new(kind, arguments.n as usize, arguments.seed);
        print(&race(&set, kind, &programs, arguments)?)?;
    }
    print("all meshes are equal, except for triangles at the hull that a row names; in brackets: ours by theirs\n")?;
    Ok(())
}

/// Our time without constraints, our time with them, and those of the others, for each round.
fn race(set: &Set, kind: Kind, programs: &[Program], arguments: &PlansArguments) -> Result<String, Failure> {
    let mut random = SplitMix64::new(arguments.seed);
    let points: Vec<Point> = set.points.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect();
    let count = 3 + programs.len();
    let mut missing = vec![0; count];
    let mut seconds: Vec<Vec<f64>> = vec![Vec::new(); count];
    for _ in 0..arguments.rounds {
        let mut turns: Vec<usize> = (0..count).collect();
        random.shuffle(&mut turns);
        let mut meshes: Vec<Vec<[u32; 3]>> = vec![Vec::new(); count];
        for place in turns {
            let run = match place {
                0 => free(&points)?,
                1 => ours(&points, &set.constraints)?,
                2 => spade::run(set)?,
                _ => programs[place - 3].run(set)?,
            };
            seconds[place].push(run.seconds);
            meshes[place] = run.triangles;
        }
        for place in 2..count {
            let may_lose = place > 2 && programs[place - 3].may_lose_hull;
            let found = lost(&meshes[1], &meshes[place]).filter(|&lost| lost == 0 || may_lose);
            missing[place] = found.ok_or_else(|| format!("a library has another mesh of {}", kind.name()))?;
        }
    }
    let names: Vec<&str> = programs.iter().map(|program| program.name).collect();
    let mut text = row(kind, &seconds, &names, arguments.n);
    for (name, lost) in names.iter().zip(&missing[3..]).filter(|(_, lost)| **lost > 0) {
        text += &format!("          {name} leaves out {lost} triangles at the hull\n");
    }
    Ok(text)
}

/// The number of triangles of a mesh that another one lacks; both are sorted. `None` if the other one has triangles of
/// its own.
fn lost(mesh: &[[u32; 3]], other: &[[u32; 3]]) -> Option<usize> {
    let mut rest = mesh.iter();
    let has_all = other.iter().all(|triangle| rest.any(|own| own == triangle));
    has_all.then(|| mesh.len() - other.len())
}

fn row(kind: Kind, seconds: &[Vec<f64>], programs: &[&str], n: u32) -> String {
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let mut text = format!("{:8}", kind.name());
    let names = ["ours, no constraints", "ours", "spade"].iter().chain(programs);
    for (place, name) in names.enumerate() {
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
