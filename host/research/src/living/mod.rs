//! `living`: compares the triangulation that lives with those of other libraries, on one thread.
//!
//! Every contestant gets the same points and the same commands, and every answer is compared with ours: the triangle
//! that holds a place, the nearest point, and all triangles after the insertions and after the deletions. The
//! contestants take turns after each block of commands, in random order, so that other work on the machine touches all.
//! Ratios are medians over the blocks, of times taken next to each other.
//!
//! In random order walks begin at the top of a hierarchy, in all libraries. In Hilbert order they begin at the last
//! place, in all libraries. Times are those of the calls alone: each library may answer with handles of its own, which
//! become numbers of points after the clock has stopped.

mod arguments;
mod cgal;
mod contestant;
mod ours;
mod script;
mod spade;
mod table;

use ::spade::{HierarchyHintGenerator, LastUsedVertexHintGenerator};
use incircle_geometry::Point;
use incircle_testkit::SplitMix64;

use crate::orders::{print, Failure};
pub use arguments::LivingArguments;
use contestant::Contestant;
use ours::Ours;
use script::{Script, Stage, SIDE};
use spade::Spade;
use table::Times;

/// Runs the subcommand: a row for each operation and order.
///
/// # Errors
/// Answers differ, or a library fails.
pub fn living(arguments: &LivingArguments) -> Result<(), Failure> {
    let program = if arguments.without_cgal { Err("left out".to_owned()) } else { cgal::Program::new() };
    print(&table::header(arguments))?;
    if let Err(reason) = &program {
        print(&format!("cgal: {reason}\n"))?;
    }
    for along_curve in [false, true] {
        let script = Script::new(arguments, along_curve);
        let mut contestants: Vec<Box<dyn Contestant>> = Vec::new();
        contestants.push(if arguments.grid {
            Box::new(Ours::new(|[x, y]| Point::new(x as u32, y as u32)))
        } else {
            Box::new(Ours::new(|place| place))
        });
        contestants.push(if along_curve {
            Box::new(Spade::<LastUsedVertexHintGenerator>::new())
        } else {
            Box::new(Spade::<HierarchyHintGenerator<f64>>::new())
        });
        if let Ok(program) = &program {
            contestants.push(Box::new(program.start(along_curve)?));
        }
        for contestant in &mut contestants {
            contestant.load(&script.points, &script.order)?;
        }
        for stage in Stage::ALL {
            let times = race(&mut contestants, &script, stage, arguments)?;
            print(&times.row(stage, along_curve))?;
        }
    }
    print(&format!("all answers are equal, and so are all meshes; coordinates below {SIDE}\n"))?;
    Ok(())
}

/// Has all contestants carry out one stage of the script, block by block.
fn race(
    contestants: &mut [Box<dyn Contestant>],
    script: &Script,
    stage: Stage,
    arguments: &LivingArguments,
) -> Result<Times, Failure> {
    let mut random = SplitMix64::new(arguments.seed ^ stage as u64);
    let mut times = Times::new(contestants.iter().map(|contestant| contestant.name()).collect());
    for (number, block) in script.blocks(stage, arguments.block as usize).enumerate() {
        let mut turns: Vec<usize> = (0..contestants.len()).collect();
        random.shuffle(&mut turns);
        let mut runs = vec![contestant::Run::default(); contestants.len()];
        for place in turns {
            runs[place] = contestants[place].run(block)?;
        }
        for (place, run) in runs.iter().enumerate() {
            let name = contestants[place].name();
            if run.answers != runs[0].answers {
                return Err(format!("{name} answers otherwise in block {number} of {}", stage.name()).into());
            }
            times.note(place, run.seconds / block.len() as f64);
        }
    }
    if stage.is_change() {
        compare_meshes(contestants, stage)?;
    }
    Ok(times)
}

fn compare_meshes(contestants: &mut [Box<dyn Contestant>], stage: Stage) -> Result<(), Failure> {
    let Some((ours, others)) = contestants.split_first_mut() else { return Ok(()) };
    let triangles = ours.triangles()?;
    for other in others {
        let theirs = other.triangles()?;
        if theirs != triangles {
            let (name, stage) = (other.name(), stage.name());
            let (own, count) = (triangles.len(), theirs.len());
            return Err(format!("{name} has another mesh after {stage}: {count} triangles beside our {own}").into());
        }
    }
    Ok(())
}
