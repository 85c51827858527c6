//! `incircle interpolate`: points with values in, values at other places out.

use std::num::NonZeroUsize;
use std::time::Duration;

use clap::ValueEnum;
use incircle::interpolate::Surface;
use serde_json::json;

use crate::arguments::{InterpolateArguments, ReadArguments, ValueFormat};
use crate::commands::interpolate_device;
use crate::failure::{counted, failure_of, Failure};
use crate::grid::Grid;
use crate::lattice::{self, Laid};
use crate::lines::Lines;
use crate::memory::Memory;
use crate::output::{self, Output};
use crate::path;
use crate::points::PointTable;
use crate::value_places::{coordinates, ValuePlaces};
use crate::watch::{seconds_json, total, Watch};
use crate::{geotiff, interrupt, source, value_writer};

/// Bytes that the value of a node takes, and those that it takes again in a file that is made in memory.
const VALUE_BYTES: u64 = 8;

/// Reads points and places, works out the values, writes them, and prints the report.
pub fn run(arguments: &InterpolateArguments) -> Result<(), Failure> {
    let (format, output) = prepare(arguments)?;
    let device = interpolate_device::choose(arguments)?;
    let mut watch = Watch::start();
    let name = path::name(&arguments.points);
    let in_file = |failure: Failure| failure.in_file(&name);
    let (read, quiet) = (&arguments.read, arguments.quiet);
    let table = source::read_valued_points(&arguments.points, read, arguments.value.as_deref(), quiet)?;
    let values = table.heights().to_vec();
    check_values(&table, &values).map_err(in_file)?;
    let places = places(arguments, format, &table)?;
    watch.ended("load");
    interrupt::check()?;
    let all = table.into_items().append(places.table().clone())?;
    let laid = lattice::lay(&all, None).map_err(in_file)?;
    watch.ended("quantise");
    let wanted = Wanted { places: &places, points: values.len() };
    if let Some(choice) = device {
        let found = interpolate_device::values(&choice, &laid, &values, &places).map_err(in_file)?;
        watch.ended("interpolate");
        return wanted.write(arguments, &found, format, output, &laid, &mut watch);
    }
    let coordinates = coordinates(&laid, &all);
    let (points, at) = coordinates.split_at(values.len());
    let mesh = interrupt::working(|| incircle::triangulate(points));
    interrupt::check()?;
    let mesh = mesh.map_err(|error| failure_of(&error))?;
    watch.ended("triangulate");
    let surface = Surface::new(points, &mesh.triangles, &values);
    let surface = surface.map_err(|error| in_file(Failure::input(error.to_string())))?;
    if let Some(step) = &arguments.contours {
        let doubles = all.doubles();
        let lines = Lines { surface: &surface, points: &doubles[..values.len()], values: &values };
        return write_lines(arguments, &lines, step, output, &laid, &mut watch);
    }
    let threads = arguments.threads.and_then(|threads| usize::try_from(threads.get()).ok());
    let threads = threads.and_then(NonZeroUsize::new).or(std::thread::available_parallelism().ok());
    let (method, outside) = (arguments.method.method(), arguments.outside.outside());
    let mut found = Vec::with_capacity(places.len());
    places.each(at, |some| {
        found.extend(surface.values(method, outside, some, threads.unwrap_or(NonZeroUsize::MIN)));
        interrupt::check()
    })?;
    watch.ended("interpolate");
    wanted.write(arguments, &found, format, output, &laid, &mut watch)
}

/// The places at which values are wanted, and the number of points with values.
struct Wanted<'a> {
    places: &'a ValuePlaces,
    points: usize,
}

impl Wanted<'_> {
    /// Writes the values and prints the report.
    fn write(
        &self,
        arguments: &InterpolateArguments,
        found: &[f64],
        format: ValueFormat,
        output: Output,
        laid: &Laid<'_>,
        watch: &mut Watch,
    ) -> Result<(), Failure> {
        let grid = self.places.grid.as_ref();
        let no_data = if format == ValueFormat::Asc { value_writer::no_data(found)? } else { 0 };
        let written = output.write(|out| match (format, grid) {
            (ValueFormat::Csv, _) => value_writer::write_csv(self.places, found, out),
            (ValueFormat::Npy, grid) => value_writer::write_npy(found, grid, out),
            (ValueFormat::Asc, Some(grid)) => value_writer::write_asc(found, grid, no_data, out),
            (ValueFormat::Tif, Some(grid)) => geotiff::write(found, grid, out),
            (ValueFormat::Asc | ValueFormat::Tif | ValueFormat::Geojson, _) => Ok(()),
        })?;
        watch.ended("write");
        let name = arguments.method.to_possible_value();
        let told = Told {
            laid,
            points: self.points,
            places: found.len(),
            without: found.iter().filter(|value| value.is_nan()).count(),
            method: name.map_or_else(String::new, |name| name.get_name().to_owned()),
        };
        output::finish([written], || told.tell(arguments, &watch.stages))
    }
}

/// Writes contour lines and prints the report.
fn write_lines(
    arguments: &InterpolateArguments,
    lines: &Lines<'_>,
    step: &str,
    output: Output,
    laid: &Laid<'_>,
    watch: &mut Watch,
) -> Result<(), Failure> {
    let levels = lines.levels(step)?;
    let mut count = 0;
    let written = output.write(|out| {
        count = lines.write(&levels, out)?;
        Ok(())
    })?;
    watch.ended("write");
    let stages = &watch.stages;
    output::finish([written], || {
        if arguments.json {
            let report = json!({
                "points": lines.points.len(),
                "levels": levels.len(),
                "lines": count,
                "lattice": laid.to_json(),
                "seconds": seconds_json(stages),
            });
            return output::print(&format!("{report}\n"));
        }
        if !arguments.quiet {
            let (points, levels) = (counted(lines.points.len(), "point"), counted(levels.len(), "level"));
            let seconds = total(stages).as_secs_f64();
            output::note(&laid.line());
            output::note(&format!("{points}, {} at {levels}; {seconds:.3} s", counted(count, "contour line")));
        }
        Ok(())
    })
}

/// The format of the values and the output, checked before the work.
fn prepare(arguments: &InterpolateArguments) -> Result<(ValueFormat, Output), Failure> {
    let file = &arguments.output;
    let format = arguments.format.or_else(|| ValueFormat::of_extension(path::extension(file))).ok_or_else(|| {
        let names: Vec<String> = ValueFormat::value_variants()
            .iter()
            .filter_map(|format| Some(format.to_possible_value()?.get_name().to_owned()))
            .collect();
        let shown = if path::is_standard(file) { "standard output".to_owned() } else { path::name(file) };
        Failure::usage(format!("{shown}: the name tells no format of values: add --format {}", names.join(" or ")))
    })?;
    let name = match format {
        ValueFormat::Asc => Some("an ASCII grid"),
        ValueFormat::Tif => Some("a GeoTIFF"),
        _ => None,
    };
    if let (Some(name), None) = (name, &arguments.grid) {
        return Err(Failure::usage(format!("{name} has the values of a grid: give --grid, or write .csv or .npy")));
    }
    if (format == ValueFormat::Geojson) != arguments.contours.is_some() {
        return Err(Failure::usage("contours are written as GeoJSON, and nothing else is: give -o a name in .geojson"));
    }
    let inputs: Vec<_> = [&arguments.points].into_iter().chain(&arguments.at).cloned().collect();
    let output = Output::prepare(file, &inputs)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the values and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    Ok((format, output))
}

/// Refuses points without values.
fn check_values(table: &PointTable, values: &[f64]) -> Result<(), Failure> {
    if let Some(left_out) = table.left_out() {
        return Err(Failure::input(format!("{left_out}, but every point needs a value")));
    }
    if values.len() == table.len() {
        return Ok(());
    }
    Err(Failure::input("the points have no values: give a file with z, or name a column of CSV with --value"))
}

/// The places at which values are wanted.
fn places(arguments: &InterpolateArguments, format: ValueFormat, table: &PointTable) -> Result<ValuePlaces, Failure> {
    if let Some(step) = &arguments.grid {
        let copies = if format == ValueFormat::Tif { 2 } else { 1 };
        let grid = Grid::of(step, table, copies * VALUE_BYTES, Memory::free())?;
        if matches!(format, ValueFormat::Asc | ValueFormat::Tif) {
            grid.check_nodes()?;
        }
        return ValuePlaces::of_grid(grid);
    }
    Ok(ValuePlaces::of_table(match &arguments.at {
        Some(file) => source::read_points(file, &ReadArguments::of_whole_file(), arguments.quiet)?,
        None => PointTable::of_items("place"),
    }))
}

/// The content of the report of values.
struct Told<'a> {
    laid: &'a Laid<'a>,
    points: usize,
    places: usize,
    /// Places without a value.
    without: usize,
    method: String,
}

impl Told<'_> {
    fn tell(&self, arguments: &InterpolateArguments, stages: &[(&'static str, Duration)]) -> Result<(), Failure> {
        let Self { points, places, without, method, .. } = self;
        if arguments.json {
            let report = json!({
                "points": points,
                "places": places,
                "without_value": without,
                "method": method,
                "lattice": self.laid.to_json(),
                "seconds": seconds_json(stages),
            });
            return output::print(&format!("{report}\n"));
        }
        if !arguments.quiet {
            let (points, places) = (counted(*points, "point"), counted(*places, "place"));
            let seconds = total(stages).as_secs_f64();
            output::note(&self.laid.line());
            output::note(&format!(
                "{points}, values at {places} by {method}, {without} without a value; {seconds:.3} s"
            ));
        }
        Ok(())
    }
}
