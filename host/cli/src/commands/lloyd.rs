//! `incircle lloyd`: points in, evenly spread points out.

use std::num::NonZeroUsize;

use incircle::lloyd::{relax, relax_weighted, Density, End, Relaxed, Stop};
use incircle::voronoi::{Clip, Corner};
use incircle::Point;
use serde_json::json;

use crate::arguments::LloydArguments;
use crate::cells::Frame;
use crate::commands::clip::{around, Border};
use crate::failure::{counted, Failure};
use crate::formats::SetFormat;
use crate::image::{self, Image};
use crate::lattice::{self, Kind, Laid, Numbers};
use crate::numbers::Double;
use crate::output::{self, Output};
use crate::path;
use crate::watch::{seconds_json, total, Watch};
use crate::{interrupt, source};

/// The most bits of a coordinate, and the bits of them that must be spare.
const MOST_BITS: u32 = 31;
const SPARE_BITS: u32 = 8;
/// The most steps of `--until-still`.
const MOST_STEPS: u32 = 100_000;

/// Reads the points, relaxes them, writes them, and prints the report.
pub fn run(arguments: &LloydArguments) -> Result<(), Failure> {
    let (format, output) = prepare(arguments)?;
    let mut watch = Watch::start();
    let table = source::read_set(&arguments.points, &arguments.read, arguments.quiet)?;
    let border = Border::read(arguments.clip.as_ref(), arguments.clip_to.as_ref(), arguments.quiet)?;
    let image = arguments.density.as_ref().map(|file| image::read(file, arguments.quiet)).transpose()?;
    watch.ended("load");
    interrupt::check()?;
    let in_file = |failure: Failure| failure.in_file(source::set_name(&arguments.points));
    let count = table.len();
    let all = match &border {
        None => table,
        Some(border) => table.into_items().append(border.corners.clone())?,
    };
    let quantize = arguments.grid.checked()?;
    let how = quantize.quantize.map(|how| (how, quantize.coord_bits.unwrap_or(MOST_BITS - SPARE_BITS)));
    let laid = lattice::lay(&all, how).map_err(in_file)?;
    let spare = spare_bits(&laid).map_err(in_file)?;
    let (Numbers::Grid(grid), Some(frame)) = (&laid.numbers, Frame::of(&all, &laid)) else { return Ok(()) };
    let fine: Vec<Point> = grid.iter().map(|point| Point::new(point.x << spare, point.y << spare)).collect();
    let (points, corners) = fine.split_at(count.min(fine.len()));
    let clip = border.map(|border| border.clip(corners)).transpose()?;
    let clip = clip.map_or_else(|| around_points(points).map_err(in_file), Ok)?;
    watch.ended("quantise");
    let relaxed = relaxed(arguments, points.to_vec(), &clip, image.as_ref())?;
    watch.ended("relax");
    let places: Vec<[f64; 2]> = relaxed.points.iter().map(|&point| place(&frame, point, spare)).collect();
    let written = output.write(|out| format.write_points(places.iter().map(|place| place.map(Double)), out))?;
    watch.ended("write");
    output::finish([written], || tell(arguments, &laid, &relaxed, image.as_ref(), &watch))
}

/// Relaxes the points, by the weights of the image if there is one.
fn relaxed(
    arguments: &LloydArguments,
    points: Vec<Point>,
    clip: &Clip,
    image: Option<&Image>,
) -> Result<Relaxed, Failure> {
    let stop = Stop { iterations: arguments.iterations.unwrap_or(MOST_STEPS), when_still: arguments.until_still };
    let threads = arguments.threads.and_then(|threads| usize::try_from(threads.get()).ok());
    let threads = threads.and_then(NonZeroUsize::new).or(std::thread::available_parallelism().ok());
    let threads = threads.unwrap_or(NonZeroUsize::MIN);
    let relaxed = match image {
        None => relax(points, clip, stop, threads),
        Some(image) => {
            let density = Density::over(clip, image.columns, &image.weights);
            let density = density.map_err(|error| Failure::input(error.to_string()))?;
            relax_weighted(points, clip, &density, stop, threads)
        }
    };
    relaxed.map_err(|error| Failure::input(error.to_string()))
}

/// The format of the points and the output, checked before the work.
fn prepare(arguments: &LloydArguments) -> Result<(SetFormat, Output), Failure> {
    let file = &arguments.output;
    let format = arguments.format.or_else(|| SetFormat::of_extension(path::extension(file))).ok_or_else(|| {
        let shown = if path::is_standard(file) { "standard output".to_owned() } else { path::name(file) };
        Failure::usage(format!("{shown}: the name tells no format of points: add --format csv, xyz, node or npy"))
    })?;
    let inputs: Vec<_> = arguments.points.iter().chain(&arguments.clip_to).chain(&arguments.density).cloned().collect();
    let output = Output::prepare(file, &inputs)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the points and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    Ok((format, output))
}

/// The bits by which the lattice is refined. Points that leave too few are refused.
fn spare_bits(laid: &Laid<'_>) -> Result<u32, Failure> {
    let most = MOST_BITS - SPARE_BITS;
    match (laid.beyond_bits(most), laid.bits) {
        (None, Some(bits)) => Ok(MOST_BITS - bits),
        (have, _) => {
            let have = have.unwrap_or_else(|| "the points lie on no lattice".to_owned());
            let remedy = match laid.kind {
                Kind::Quantized(_) => format!("give --coord-bits {most} or fewer"),
                _ => "give --quantize fit, which rounds them".to_owned(),
            };
            Err(Failure::input(format!(
                "{have}, counted with the corners of the clip, but points that move need {SPARE_BITS} spare bits of \
                 {MOST_BITS}: {remedy}"
            )))
        }
    }
}

/// The smallest rectangle around the points.
fn around_points(points: &[Point]) -> Result<Clip, Failure> {
    around(points).ok_or_else(|| {
        Failure::input("the rectangle around the points has no area: give --clip, the region to spread them over")
    })
}

/// The coordinates of a point of the refined lattice.
fn place(frame: &Frame, point: Point, spare: u32) -> [f64; 2] {
    frame.coordinates(Corner { x: point.x.into(), y: point.y.into(), d: 1 << spare })
}

/// Prints the report.
fn tell(
    arguments: &LloydArguments,
    laid: &Laid<'_>,
    relaxed: &Relaxed,
    image: Option<&Image>,
    watch: &Watch,
) -> Result<(), Failure> {
    let Relaxed { points, iterations, moved, end } = relaxed;
    if arguments.json {
        let report = json!({
            "points": points.len(),
            "iterations": iterations,
            "moved": moved,
            "end": name_of(*end),
            "density": image.map(|image| json!({ "columns": image.columns, "rows": image.rows() })),
            "lattice": laid.to_json(),
            "quantisation": laid.quantization().map(crate::report::quantization_json),
            "seconds": seconds_json(&watch.stages),
        });
        return output::print(&format!("{report}\n"));
    }
    if !arguments.quiet {
        let (points, steps) = (counted(points.len(), "point"), counted(*iterations as usize, "step"));
        let seconds = total(&watch.stages).as_secs_f64();
        output::note(&laid.line());
        if let Some(image) = image {
            output::note(&format!("density: an image of {} by {} pixels", image.columns, image.rows()));
        }
        let still = if *end == End::Still { format!(" in step {iterations}") } else { String::new() };
        let end = name_of(*end);
        output::note(&format!("{points}, {steps}, {moved} moved in the last; ended by: {end}{still}; {seconds:.3} s"));
    }
    Ok(())
}

/// The reason of an end, in reports.
fn name_of(end: End) -> &'static str {
    match end {
        End::Still => "still",
        End::Cycle => "cycle",
        End::Iterations => "iterations",
    }
}
