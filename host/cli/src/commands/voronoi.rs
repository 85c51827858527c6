//! `incircle voronoi`: points in, Voronoi cells out.

use std::time::Duration;

use clap::ValueEnum;
use incircle::voronoi::{Clip, Voronoi};
use incircle::{Mesh, Point};
use serde_json::{json, Value};

use crate::arguments::VoronoiArguments;
use crate::cells::{self, CellFormat, CellView, Frame};
use crate::commands::clip::{around, Border};
use crate::failure::{counted, failure_of, Failure};
use crate::lattice::{self, Kind, Laid, Numbers};
use crate::output::{self, Output};
use crate::path;
use crate::points::PointTable;
use crate::watch::{seconds_json, total, Watch};
use crate::{interrupt, source};

/// The most bits of a coordinate.
const MOST_BITS: u32 = 31;

/// Reads the points and the clip, makes the cells, writes them, and prints the report.
pub fn run(arguments: &VoronoiArguments) -> Result<(), Failure> {
    let (format, output) = prepare(arguments)?;
    let mut watch = Watch::start();
    let table = source::read_set(&arguments.points, &arguments.read, arguments.quiet)?;
    let border = Border::read(arguments.clip.as_ref(), arguments.clip_to.as_ref(), arguments.quiet)?;
    watch.ended("load");
    interrupt::check()?;
    let in_file = |failure: Failure| failure.in_file(source::set_name(&arguments.points));
    let count = table.len();
    let all = with_clip(&table, border.as_ref())?;
    let quantize = arguments.grid.checked()?;
    let how = quantize.quantize.map(|how| (how, quantize.coord_bits.unwrap_or(MOST_BITS)));
    let laid = lattice::lay(&all, how).map_err(in_file)?;
    check_bits(&laid).map_err(in_file)?;
    let (Numbers::Grid(grid), Some(frame)) = (&laid.numbers, Frame::of(&all, &laid)) else { return Ok(()) };
    let (points, corners) = grid.split_at(count.min(grid.len()));
    let clip = border.map(|border| border.clip(corners)).transpose()?;
    let (clip, is_asked) = (clip_or_box(clip, points, format)?, !corners.is_empty());
    watch.ended("quantise");
    let mesh = interrupt::working(|| incircle::triangulate(points));
    interrupt::check()?;
    let mesh = mesh.map_err(|error| failure_of(&error))?;
    watch.ended("triangulate");
    let voronoi = Voronoi::of(&mesh).map_err(|error| Failure::input(error.to_string()))?;
    watch.ended("cells");
    let view = CellView { voronoi: &voronoi, clip: clip.as_ref(), frame: &frame };
    let written = output.write(|out| match format {
        CellFormat::Geojson => cells::write_geojson(view, out),
        CellFormat::Json => cells::write_json(view, out),
        CellFormat::Svg => cells::write_picture(view, &table.doubles(), out),
    })?;
    watch.ended("write");
    let clip = clip.as_ref().map(|clip| (clip, is_asked));
    let told = Told { laid: &laid, mesh: &mesh, voronoi: &voronoi, clip, stages: &watch.stages };
    output::finish([written], || told.tell(arguments))
}

/// The format of the cells and the output, checked before the work.
fn prepare(arguments: &VoronoiArguments) -> Result<(CellFormat, Output), Failure> {
    let file = &arguments.output;
    let format = arguments.format.or_else(|| CellFormat::of_extension(path::extension(file))).ok_or_else(|| {
        let names: Vec<String> = CellFormat::value_variants()
            .iter()
            .filter_map(|format| Some(format.to_possible_value()?.get_name().to_owned()))
            .collect();
        let shown = if path::is_standard(file) { "standard output".to_owned() } else { path::name(file) };
        Failure::usage(format!("{shown}: the name tells no format of cells: add --format {}", names.join(" or ")))
    })?;
    let inputs: Vec<_> = arguments.points.iter().chain(&arguments.clip_to).cloned().collect();
    let output = Output::prepare(file, &inputs)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the cells and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    Ok((format, output))
}

/// The points, followed by the corners of the clip, so that one lattice holds both.
fn with_clip(table: &PointTable, border: Option<&Border>) -> Result<PointTable, Failure> {
    match border {
        None => Ok(table.clone()),
        Some(border) => table.clone().into_items().append(border.corners.clone()),
    }
}

/// Refuses points that lie on no lattice of 31 bits.
fn check_bits(laid: &Laid<'_>) -> Result<(), Failure> {
    let Some(have) = laid.beyond_bits(MOST_BITS) else { return Ok(()) };
    let remedy = match laid.kind {
        Kind::Quantized(_) => "give a smaller scale",
        _ => "give --quantize fit, which rounds them",
    };
    Err(Failure::input(format!(
        "{have}, counted with the corners of the clip, but cells are exact on a lattice of up to {MOST_BITS} bits: \
         {remedy}"
    )))
}

/// The clip, or the rectangle around the points where a format has no unbounded cells.
fn clip_or_box(clip: Option<Clip>, points: &[Point], format: CellFormat) -> Result<Option<Clip>, Failure> {
    if clip.is_some() || format == CellFormat::Json {
        return Ok(clip);
    }
    let around = around(points);
    if around.is_none() && !points.is_empty() {
        return Err(Failure::input(
            "the rectangle around the points has no area, and this format has no unbounded cells: give --clip, or \
             write .json",
        ));
    }
    Ok(around)
}

/// The content of the report of a run.
struct Told<'a> {
    laid: &'a Laid<'a>,
    mesh: &'a Mesh<Point>,
    voronoi: &'a Voronoi<'a>,
    /// The clip, and whether the user gave it.
    clip: Option<(&'a Clip, bool)>,
    stages: &'a [(&'static str, Duration)],
}

impl Told<'_> {
    fn tell(&self, arguments: &VoronoiArguments) -> Result<(), Failure> {
        if arguments.json {
            return output::print(&format!("{}\n", self.to_json()));
        }
        if !arguments.quiet {
            self.lines().iter().for_each(|line| output::note(line));
        }
        Ok(())
    }

    fn to_json(&self) -> Value {
        json!({
            "points": self.mesh.points.len(),
            "cells": self.cells(),
            "duplicates": self.mesh.duplicates.len(),
            "vertices": self.voronoi.vertex_count(),
            "unbounded": self.voronoi.cells().filter(|cell| cell.is_unbounded()).count(),
            "clip": self.clip.map(|(_, is_asked)| if is_asked { "given" } else { "around" }),
            "clip_corners": self.clip.map(|(clip, _)| clip.corners().len()),
            "lattice": self.laid.to_json(),
            "quantisation": self.laid.quantization().map(crate::report::quantization_json),
            "seconds": seconds_json(self.stages),
        })
    }

    fn cells(&self) -> usize {
        self.mesh.points.len() - self.mesh.duplicates.len()
    }

    fn lines(&self) -> Vec<String> {
        let vertices = match self.voronoi.vertex_count() {
            1 => "1 Voronoi vertex".to_owned(),
            count => format!("{count} Voronoi vertices"),
        };
        let clip = match self.clip {
            None => "not clipped".to_owned(),
            Some((_, false)) => "clipped to the rectangle around the points".to_owned(),
            Some((clip, true)) => format!("clipped to a polygon of {}", counted(clip.corners().len(), "corner")),
        };
        let (points, cells) = (counted(self.mesh.points.len(), "point"), counted(self.cells(), "cell"));
        let seconds = total(self.stages).as_secs_f64();
        vec![self.laid.line(), format!("{points}, {cells}, {vertices}, {clip}; {seconds:.3} s")]
    }
}
