//! `incircle generate`: writes a set of points, or a script, that is chosen by name.

use std::io::{self, Write};

use incircle::{Order, Point, MAX_POINTS};
use incircle_testkit::{generate, stream, Distribution, GenerateError, SetPoints};

use crate::arguments::GenerateArguments;
use crate::failure::{Exit, Failure};
use crate::formats::{curve, SetFormat};
use crate::numbers::doubles::DoubleSet;
use crate::numbers::{signed, Double, NumberKind, Single, SixDigits};
use crate::output::{self, Output};
use crate::path::{extension, name};
use crate::progress::CountMeter;
use crate::script::{Recipe, ScriptWriter};
use crate::values::Made;

/// Points after which the progress bar moves.
const TOLD: u64 = 1 << 16;

/// Makes the set and writes it, as points or as a drawing of an order.
pub fn run(arguments: &GenerateArguments) -> Result<(), Failure> {
    match arguments.set {
        Made::Set(distribution) => make_set(distribution, arguments),
        Made::Script(recipe) => make_script(recipe, arguments),
    }
}

fn make_set(distribution: Distribution, arguments: &GenerateArguments) -> Result<(), Failure> {
    let path = arguments.output.as_path();
    let extension = extension(path);
    if arguments.frames.is_some() || arguments.commands.is_some() {
        return Err(Failure::usage(format!(
            "--frames and --commands are for scripts, and {distribution} is a set of points: leave them out"
        )));
    }
    if arguments.format.is_none() && extension == "svg" {
        return draw(distribution, arguments);
    }
    // Outputs without an extension, such as standard output or a device, take CSV.
    let by_name = if extension.is_empty() { Some(SetFormat::Csv) } else { SetFormat::of_extension(extension) };
    let Some(format) = arguments.format.or(by_name) else {
        return Err(Failure::usage(format!(
            "{}: points are written as .csv, .xyz, .node or .npy, and their --order as .svg",
            name(path)
        )));
    };
    let bits = arguments.numbers.bits(arguments.bits)?;
    if arguments.order.is_some() {
        check_count(arguments.n)?;
    }
    let output = Output::prepare(path, &[])?;
    let points: SetPoints = match arguments.order {
        Some(order) => {
            let points = make(distribution, arguments.n, bits, arguments.seed)?;
            Box::new(ordered(&points, order).into_iter())
        }
        None => {
            let points = stream(distribution, arguments.n as usize, bits, arguments.seed);
            points.map_err(failure_of)?
        }
    };
    let meter = CountMeter::new(points.len() as u64, "writing", "points", false);
    let mut count = 0;
    let points = points.inspect(|_| {
        count += 1;
        if count % TOLD == 0 {
            meter.advance(TOLD);
        }
    });
    let written = output.write(|out| write(points, bits, distribution, arguments, format, out))?;
    output::finish([written], || Ok(()))
}

/// Writes points of the grid of `bits` bits in the numbers that the user has chosen.
fn write(
    points: impl ExactSizeIterator<Item = [u32; 2]>,
    bits: u32,
    distribution: Distribution,
    arguments: &GenerateArguments,
    format: SetFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    match arguments.numbers {
        NumberKind::Whole => format.write_points(points, out),
        NumberKind::Signed => format.write_points(points.map(|point| signed(point, bits)), out),
        NumberKind::Decimal => format.write_points(points.map(|point| signed(point, bits).map(SixDigits)), out),
        NumberKind::Double => {
            let set = DoubleSet::new(distribution, arguments.seed);
            format.write_points(points.map(|point| set.place(point).map(Double)), out)
        }
        NumberKind::F32 => {
            let single = |steps| Single::new(steps, bits);
            format.write_points(points.map(|point| signed(point, bits).map(single)), out)
        }
    }
}

/// Draws an order of insertion instead of writing points.
fn draw(distribution: Distribution, arguments: &GenerateArguments) -> Result<(), Failure> {
    let Some(order) = arguments.order else {
        return Err(Failure::usage(
            "an .svg shows an order of the points: add --order, or write .csv, .xyz, .node or .npy",
        ));
    };
    if arguments.numbers != NumberKind::Whole {
        return Err(Failure::usage(
            "an .svg shows an order of the points and no numbers: leave --numbers out, or write .csv, .xyz, .node or \
             .npy",
        ));
    }
    let bits = arguments.numbers.bits(arguments.bits)?;
    check_count(arguments.n)?;
    let output = Output::prepare(&arguments.output, &[])?;
    let points = ordered(&make(distribution, arguments.n, bits, arguments.seed)?, order);
    let title = format!("{} points, {}, in the order {}", arguments.n, distribution, order.name());
    let written = output.write(|out| curve::write(&points, &title, out))?;
    output::finish([written], || Ok(()))
}

/// Makes a script and writes it.
fn make_script(recipe: Recipe, arguments: &GenerateArguments) -> Result<(), Failure> {
    let (path, name) = (arguments.output.as_path(), recipe.name());
    let extension = extension(path);
    let is_other = extension == "svg" || SetFormat::of_extension(extension).is_some();
    if is_other || arguments.format.is_some() || arguments.order.is_some() {
        return Err(Failure::usage(format!(
            "{name} is a script, which is text: leave --format and --order out, and give -o a name such as {name}.txt"
        )));
    }
    let bits = arguments.numbers.bits(arguments.bits)?;
    check_count(arguments.n)?;
    let length = recipe.length(arguments.n, arguments.frames, arguments.commands)?;
    let output = Output::prepare(path, &[])?;
    let start = make(Distribution::Uniform, arguments.n, bits, arguments.seed)?;
    let (numbers, seed) = (arguments.numbers, arguments.seed);
    let written = output.write(|out| recipe.write(&start, length, &mut ScriptWriter::new(numbers, bits, seed, out)))?;
    output::finish([written], || Ok(()))
}

/// The points in an order of insertion.
fn ordered(points: &[[u32; 2]], order: Order) -> Vec<[u32; 2]> {
    let grid: Vec<Point> = points.iter().copied().map(Point::from).collect();
    order.order(&grid).into_iter().map(|index| points[index as usize]).collect()
}

/// Refuses more points than a job may have.
pub fn check_count(n: u32) -> Result<(), Failure> {
    if n as usize > MAX_POINTS {
        return Err(Failure::usage(format!(
            "-n {n} is more than the {MAX_POINTS} points that one job and one order may have: choose fewer"
        )));
    }
    Ok(())
}

/// The points of a set, or a failure with the reason.
pub fn make(distribution: Distribution, n: u32, bits: u32, seed: u64) -> Result<Vec<[u32; 2]>, Failure> {
    generate(distribution, n as usize, bits, seed).map_err(failure_of)
}

fn failure_of(error: GenerateError) -> Failure {
    let exit = match error {
        GenerateError::Bits(_) => Exit::Usage,
        GenerateError::Memory(_) => Exit::Capacity,
    };
    Failure::new(exit, error.to_string())
}
