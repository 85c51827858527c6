//! Cycles of whole batches, read-out included, through the host library and its division into groups.

use incircle::transports::ClockTransport;
use incircle::{Device, Options, Point};
use incircle_hdl::board::sizes::SIZES;
use incircle_protocol::Config;
use incircle_testkit::{generate, Distribution};

use super::parallel::in_parallel;
use super::{MeasureError, BITS, SEED};

/// The numbers of points of a job, each with the number of jobs. Each is a column of the table.
pub const JOBS: [(u32, u64); 4] = [(200, 1000), (1000, 64), (2000, 32), (4000, 16)];

/// Clocks of the core for each point of a batch of `jobs` uniform jobs of `n` points, both more than 0.
///
/// # Errors
/// No such core exists, or it cannot do the jobs.
pub fn batch(core: Config, n: u32, jobs: u64) -> Result<f64, MeasureError> {
    let points = |job| -> Result<Vec<Point>, MeasureError> {
        let points = generate(Distribution::Uniform, n as usize, BITS, SEED + job)?;
        Ok(points.into_iter().map(|[x, y]| Point::new(x, y)).collect())
    };
    let jobs = (0..jobs).map(points).collect::<Result<Vec<_>, _>>()?;
    let mut device = Device::from_transport(Box::new(ClockTransport::new(core)?));
    let mut session = device.session()?;
    let before = session.clocks().ok_or(MeasureError::NoClocks)?;
    let solutions = session.triangulate_batch(&jobs, &Options::default())?;
    let after = session.clocks().ok_or(MeasureError::NoClocks)?;
    let distinct: usize = solutions.iter().map(|solution| solution.report.distinct).sum();
    Ok((after - before) as f64 / distinct as f64)
}

/// The table of batches, with its heading.
///
/// # Errors
/// As [`batch`].
pub fn batches() -> Result<String, MeasureError> {
    let columns: String = JOBS.iter().map(|(n, jobs)| format!(" {jobs} x {n} |")).collect();
    let rule = "---:|".repeat(JOBS.len() + 3);
    let places: Vec<_> = SIZES.into_iter().flat_map(|core| JOBS.map(|(n, jobs)| (core, n, jobs))).collect();
    let cells = in_parallel(&places, |&(core, n, jobs)| {
        // A job larger than the memory of an engine is an error of the library, and has no figure.
        if n > core.points {
            Ok(" - |".to_owned())
        } else {
            Ok(format!(" {:.2} |", batch(core, n, jobs)?))
        }
    })?;
    let rows = SIZES.iter().zip(cells.chunks(JOBS.len())).map(|(core, cells)| {
        let Config { name, engines, points, contexts, .. } = core;
        let name = if *name == "custom" { "" } else { name };
        format!("| {name} | {engines} | {points} | {contexts} |{}\n", cells.concat())
    });
    let rows: String = rows.collect();
    Ok(format!("{BATCHES}\n| core | engines | points | contexts |{columns}\n|---|{rule}\n{rows}"))
}

/// The heading and the text before the table.
const BATCHES: &str = "\
## Batches

A figure is the clocks of the core or chip for each distinct point of a batch of uniform jobs, done by the host library.
The clocks run from the first word of a command to the last word of the read-out. \"64 x 1000\" is 64 jobs of 1,000
points. Coordinates have 16 bits, and the seeds of the jobs are 1, 2 and so on. Points and contexts are those of one
engine. A row without a name is a core of that size made by `export --points --contexts`. A dash says that a job does
not fit the memory of an engine. `incircle bench` counts the named ones:

    incircle bench uniform -n 1000 --batch 64 --backend clock --config quad
";
