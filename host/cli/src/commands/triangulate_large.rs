//! `incircle triangulate` for a set that is larger than the memory: in tiles over files, in one process.

use std::fs;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use incircle::{Point, MAX_POINTS};
use serde_json::json;

use crate::arguments::TriangulateArguments;
use crate::backend::Choice;
use crate::commands::tile::{check_backend, triangulate_tile};
use crate::failure::{counted, Exit, Failure};
use crate::formats::MeshFormat;
use crate::input::Input;
use crate::memory::Memory;
use crate::output::{self, Output};
use crate::progress::CountMeter;
use crate::tiles::{self, Budget, JoinMemory, Manifest, Needed, Order, Plan, Scratch, TileAt};
use crate::watch::{self, Watch};
use crate::{interrupt, path, source};

/// If `--memory` is not given, the run leaves one part in this many of the free memory to other programs.
const SPARED: u64 = 5;

/// The memory for a set that is cut into tiles, because the arguments ask for it or because the set does not fit.
/// `None` for a set that fits, and for one whose number of points is not known before all of it is read.
pub fn memory_of(arguments: &TriangulateArguments) -> Option<u64> {
    let free = Memory::free();
    let usual = free.bytes() - free.bytes() / SPARED;
    if arguments.large.is_wanted() {
        return Some(arguments.large.memory.unwrap_or(usual));
    }
    let format = source::mesh_format(&arguments.output, arguments.format).ok()?;
    let has_choices = arguments.grid.quantize.is_some() || arguments.trace.is_some() || arguments.backend.is_several();
    let has_choices = has_choices || arguments.asks_for_plan();
    if has_choices || !format.is_streamed() {
        return None;
    }
    let points = too_many(arguments, free).filter(|_| Budget::is_enough(usual))?;
    if !arguments.quiet {
        output::note(&format!(
            "{points} points do not fit the {} of free memory at once, so they are triangulated in tiles",
            tiles::told(free.bytes())
        ));
    }
    Some(usual)
}

/// The least bytes of a row of text with two numbers.
const LEAST_ROW: u64 = 4;

/// The most points of all inputs, if that is known and they do not fit the memory.
fn too_many(arguments: &TriangulateArguments, free: Memory) -> Option<u64> {
    // The number of points that an option selects is not known before they are read.
    if !arguments.read.classes.is_empty() || arguments.read.bounds.is_some() {
        return None;
    }
    let fits = |most: &Most| {
        most.text <= free.input_bytes() && most.points <= free.most_points() && most.points <= MAX_POINTS as u64
    };
    // Rows are counted only if that decides.
    if fits(&Most::of(arguments, false)?) {
        return None;
    }
    let most = Most::of(arguments, true)?;
    (!fits(&most)).then_some(most.points)
}

/// Upper bounds for what the inputs of a run hold.
struct Most {
    points: u64,
    /// The bytes of the largest text, which the reader in memory takes as a whole.
    text: u64,
}

impl Most {
    /// The bounds by headers and lengths, and by the rows of texts if these are counted. `None` if an input has none.
    fn of(arguments: &TriangulateArguments, counts_rows: bool) -> Option<Self> {
        let mut most = Self { points: 0, text: 0 };
        for path in &arguments.points {
            let format = source::format_of_points(path, &arguments.read).ok()?;
            // Opening a pipe and closing it again would end the program that writes to it.
            fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
            let input = Input::open(path, true).ok().filter(|input| input.size() > 0)?;
            let bytes = input.size();
            if format.has_rows() {
                most.text = most.text.max(bytes);
            }
            most.points = most.points.checked_add(match format.has_rows() && !counts_rows {
                true => bytes / LEAST_ROW + 1,
                false => format.most_points(input)?,
            })?;
        }
        Some(most)
    }
}

/// Triangulates the set within a memory of `memory` bytes.
pub fn run(arguments: &TriangulateArguments, memory: u64) -> Result<(), Failure> {
    let format = source::mesh_format(&arguments.output, arguments.format)?;
    check_choices(arguments, format)?;
    let choice = Choice::of(&arguments.backend, None, if arguments.job.wants_insertion() { "model" } else { "cpu" })?;
    let parent = scratch_parent(arguments)?;
    let output = Output::prepare(&arguments.output, &arguments.points)?;
    if arguments.json && output.is_standard() {
        return Err(Failure::usage(
            "the mesh and the report of --json cannot both go to standard output: give -o a file",
        ));
    }
    check_backend(&choice, &arguments.job)?;
    let scratch = Scratch::open(&parent, &arguments.output, arguments.large.resume)?;
    let budget = budget_of(memory, choice.cpu_threads(), &scratch)?;
    let threads = choice.cpu_threads().get().div_ceil(budget.workers.get());
    let choice = choice.with_cpu_threads(NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN));
    Memory::give_back_lists();
    let run = Run { arguments, budget, format, choice, scratch: &scratch };
    let mut watch = Watch::start();
    // A failure to cut the set, or to take the tiles of an earlier run, is not mended by going on.
    let manifest = run.split()?;
    watch.ended("split");
    let done = run.steps(&manifest, watch, output);
    let remedy = remedy(&scratch);
    let left = scratch.can_go_on();
    match done {
        Ok(()) => scratch
            .remove()
            .map_err(|error| Failure::input(format!("the mesh is written, but its tiles cannot be removed: {error}"))),
        Err(failure) if left && failure.exit != Exit::Interrupted => {
            Err(Failure::new(failure.exit, format!("{}; {remedy}", failure.message)))
        }
        Err(failure) => Err(failure),
    }
}

/// Divides the memory among the steps. A resumed run keeps the tiles that it has, even if another memory would give
/// other tiles.
fn budget_of(memory: u64, workers: NonZeroUsize, scratch: &Scratch) -> Result<Budget, Failure> {
    if !scratch.can_go_on() {
        return Budget::of(memory, workers);
    }
    let manifest = Manifest::read(scratch.folder())?;
    Budget::for_tiles(memory, workers, manifest.most)
}

/// The end of a message: the option that resumes a run whose tiles are there.
fn remedy(scratch: &Scratch) -> String {
    format!("--resume goes on with the tiles in {}, which may also be removed", path::name(scratch.folder()))
}

/// Refuses choices that need all points in memory.
fn check_choices(arguments: &TriangulateArguments, format: MeshFormat) -> Result<(), Failure> {
    let refused = if !format.is_streamed() {
        Some("a mesh with its points needs all of them in memory: write npy, csv or ele")
    } else if arguments.grid.quantize.is_some() || arguments.grid.coord_bits.is_some() {
        Some("--quantize needs all points in memory: leave it out, or round the points with another program")
    } else if arguments.trace.is_some() {
        Some("--trace records one job, and tiles are many: leave it out")
    } else if arguments.backend.is_several() {
        Some("tiles take one --backend: leave the others out")
    } else {
        None
    };
    refused.map_or(Ok(()), |sentence| Err(Failure::usage(sentence)))
}

/// The folder in which the folder of the tiles lies.
fn scratch_parent(arguments: &TriangulateArguments) -> Result<PathBuf, Failure> {
    let parent = match &arguments.large.scratch {
        Some(folder) => folder.clone(),
        None if path::is_standard(&arguments.output) => {
            return Err(Failure::usage("a mesh on standard output has no folder: give --scratch a folder"));
        }
        None if fs::metadata(&arguments.output).is_ok_and(|found| !found.is_file() && !found.is_dir()) => {
            return Err(Failure::usage(format!(
                "{} is no file, so the tiles have no folder beside it: give --scratch a folder",
                path::name(&arguments.output)
            )));
        }
        None => output::folder_of(&arguments.output).to_owned(),
    };
    match fs::metadata(&parent) {
        Ok(found) if found.is_dir() => Ok(parent),
        Ok(_) => Err(Failure::input(format!("{} is no folder: give --scratch a folder", path::name(&parent)))),
        Err(error) => Err(Failure::input(format!("{} cannot be used: {error}", path::name(&parent)))),
    }
}

/// A set on its way through the steps.
struct Run<'a> {
    arguments: &'a TriangulateArguments,
    budget: Budget,
    format: MeshFormat,
    choice: Choice,
    scratch: &'a Scratch,
}

impl Run<'_> {
    /// Triangulates the tiles, joins them and writes the mesh.
    fn steps(&self, manifest: &Manifest, mut watch: Watch, output: Output) -> Result<(), Failure> {
        interrupt::set_remedy(format!("interrupted: no mesh was written; {}", remedy(self.scratch)));
        self.solve(manifest)?;
        watch.ended("local");
        let (folder, quiet) = (self.scratch.folder(), self.arguments.quiet);
        let memory = JoinMemory { sort: self.budget.sort, bound: Some(self.budget.memory) };
        let joined = tiles::join(folder, manifest, memory, false, quiet)?;
        watch.ended("join");
        let counts = [manifest.points(), joined.duplicates, joined.triangles, joined.hull_points];
        let written = tiles::write_triangles(
            joined,
            (folder, manifest),
            (self.order(), self.budget.sort),
            self.format,
            output,
            quiet,
        )?;
        watch.ended("write");
        output::finish([written], || self.tell(manifest, counts, &watch))
    }

    fn order(&self) -> Order {
        match self.arguments.large.unordered {
            true => Order::Unordered,
            false => Order::Canonical,
        }
    }

    /// Cuts the set into tiles, or finds those of an earlier run.
    fn split(&self) -> Result<Manifest, Failure> {
        let folder = self.scratch.folder();
        let mut manifest = None;
        let plan = Plan {
            inputs: &self.arguments.points,
            read: &self.arguments.read,
            most: self.budget.most,
            folder,
            sample: self.budget.sample,
            buffers: self.budget.buffers,
            check: &|points| self.check_disk(points),
            quiet: self.arguments.quiet,
        };
        tiles::split(&plan, |summary| {
            manifest = Some(summary.manifest.clone());
            Ok(())
        })?;
        manifest.ok_or_else(|| Failure::input("the set was not split"))
    }

    fn check_disk(&self, points: u64) -> Result<(), Failure> {
        let needed = Needed::of(points, self.format);
        let (folder, out) = (self.scratch.folder(), &self.arguments.output);
        let mesh = (!path::is_standard(out)).then(|| output::folder_of(out));
        needed.check(folder, mesh, tiles::bytes_in(folder))?;
        if !self.arguments.quiet {
            output::note(&format!(
                "{} in tiles of up to {}: up to {} in {}, and up to {} for the mesh",
                counted(points as usize, "point"),
                self.budget.most,
                tiles::told(needed.scratch),
                path::name(folder),
                tiles::told(needed.mesh)
            ));
        }
        Ok(())
    }

    /// Triangulates all tiles that are not triangulated yet, as many at once as the memory has room for. The file of
    /// the points of a tile is removed when the tile is triangulated.
    fn solve(&self, manifest: &Manifest) -> Result<(), Failure> {
        let tiles: Vec<u64> = manifest.tiles().map(|(_, points)| points).collect();
        let (next, is_over) = (AtomicUsize::new(0), AtomicBool::new(false));
        let meter = CountMeter::new(manifest.points(), "triangulating", "points", self.arguments.quiet);
        std::thread::scope(|scope| {
            let (sender, done) = mpsc::channel();
            for _ in 0..self.budget.workers.get() {
                let (sender, tiles, next, is_over) = (sender.clone(), &tiles, &next, &is_over);
                scope.spawn(move || {
                    while !is_over.load(Ordering::Relaxed) {
                        let tile = next.fetch_add(1, Ordering::Relaxed);
                        let Some(&points) = tiles.get(tile) else { return };
                        // Nobody listens after a failure.
                        let _ = sender.send(self.solve_tile(tile as u32).map(|()| points));
                    }
                });
            }
            drop(sender);
            done.into_iter().try_for_each(|result: Result<u64, Failure>| {
                meter.advance(result.inspect_err(|_| is_over.store(true, Ordering::Relaxed))?);
                Ok(())
            })
        })
    }

    /// Triangulates a tile, and removes the file of its points.
    fn solve_tile(&self, tile: u32) -> Result<(), Failure> {
        let folder = self.scratch.folder();
        let at = TileAt { folder: folder.to_owned(), tile };
        let mut triangulate =
            |points: &[Point], bits: u32| triangulate_tile(points, bits, &self.choice, &self.arguments.job, true);
        tiles::local(&at, &mut triangulate, |_| Ok(()))?;
        let _ = fs::remove_file(tiles::points_path(folder, tile));
        Ok(())
    }

    fn tell(&self, manifest: &Manifest, counts: [u64; 4], watch: &Watch) -> Result<(), Failure> {
        let [points, duplicates, triangles, hull] = counts;
        let tiles = manifest.tiles().count();
        if self.arguments.json {
            let report = json!({
                "points": points, "distinct": points - duplicates, "duplicates": duplicates, "triangles": triangles,
                "hull": hull, "collinear": triangles == 0, "backend": self.choice.address.to_string(), "tiles": tiles,
                "tile_points": manifest.most, "unordered": self.arguments.large.unordered,
                "memory": self.budget.memory, "peak_memory": Memory::peak(),
                "seconds": watch::seconds_json(&watch.stages),
            });
            return output::print(&format!("{report}\n"));
        }
        if !self.arguments.quiet {
            output::note(&format!(
                "{} in {}, {}, {} on the hull; {:.1} s{}",
                counted(points as usize, "point"),
                counted(tiles, "tile"),
                counted(triangles as usize, "triangle"),
                counted(hull as usize, "point"),
                watch::total(&watch.stages).as_secs_f64(),
                Memory::peak().map_or_else(String::new, |peak| format!(", {} of memory", tiles::told(peak)))
            ));
        }
        Ok(())
    }
}
