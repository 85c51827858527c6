//! Compares the meshes of sets in parts and in tiles with those of the run in memory, byte for byte, and prints a table.
//!
//! ```text
//! cargo run --release -p incircle-cli --example any_size              # 200 sets
//! cargo run --release -p incircle-cli --example any_size -- 14        # another number of sets
//! ```
//!
//! Each set is cut in every way of [`WAYS`], for every size of [`SIZES`] that the way takes. A cell of the table has the
//! number of sets whose mesh file has the bytes of `triangulate --backend cpu --threads 1`, and how many meshes were
//! compared. The program ends with exit code 1 if one of them differs.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs, process};

use incircle_cli::generate::{generate, Distribution};

/// The number of sets, unless the argument names another one.
const SETS: usize = 200;
/// The most points of a part or of a tile.
const SIZES: [usize; 4] = [8, 40, 200, 1000];

/// Ways to a mesh. Each `{}` stands for the most points of a part; ways without it have one size.
const WAYS: [(&str, Way); 7] = [
    ("a device that holds so many points", Way::Backends(&["model?capacity={}"])),
    ("such a device and the processor", Way::Backends(&["model?capacity={}", "cpu?threads=1"])),
    ("two devices, one of 64 points", Way::Backends(&["model?capacity={}", "model?capacity=64"])),
    ("the core `tiny`, clock by clock", Way::Backends(&["clock?config=tiny"])),
    ("the two engines of `dual`, clock by clock", Way::Backends(&["clock?config=dual"])),
    ("tiles in files, by `cpu`", Way::Tiles("cpu")),
    ("tiles in files, by `model`", Way::Tiles("model")),
];

/// How a mesh is made.
#[derive(Clone, Copy)]
enum Way {
    /// `triangulate` with these back ends.
    Backends(&'static [&'static str]),
    /// `tile split`, `tile local` with this back end, and `tile join`.
    Tiles(&'static str),
}

impl Way {
    fn has_sizes(self) -> bool {
        match self {
            Self::Backends(addresses) => addresses.iter().any(|address| address.contains("{}")),
            Self::Tiles(_) => true,
        }
    }

    /// Writes the mesh of a file of points; `false` if a command failed.
    fn run(self, folder: &Path, size: usize) -> bool {
        match self {
            Self::Backends(addresses) => {
                let addresses = addresses.iter().map(|address| address.replace("{}", &size.to_string()));
                let backends: String = addresses.map(|address| format!(" --backend {address}")).collect();
                command(folder, &format!("triangulate @p.csv -o @m.npy -q{backends}"))
            }
            Self::Tiles(backend) => {
                let _ = fs::remove_dir_all(folder.join("tiles"));
                let is_split = command(folder, &format!("tile split @p.csv --points {size} -o @tiles -q"));
                let is_there = |tile: &usize| folder.join(format!("tiles/{tile}.points")).exists();
                let mut tiles = (0..).take_while(is_there);
                is_split
                    && tiles.all(|tile| command(folder, &format!("tile local @tiles/{tile} --backend {backend} -q")))
                    && command(folder, "tile join @tiles -o @m.npy -q")
            }
        }
    }
}

/// Runs `incircle` with these words. An `@` stands for the folder.
fn command(folder: &Path, words: &str) -> bool {
    let words = ["incircle"].into_iter().chain(words.split(' ')).map(|word| match word.strip_prefix('@') {
        Some(name) => folder.join(name).into_os_string(),
        None => OsString::from(word),
    });
    incircle_cli::run(words) == ExitCode::SUCCESS
}

/// The points of a set as CSV: every distribution in turn, one place, and a line, of 4 to 16 bits. A third of the points
/// are there twice.
fn set(number: usize) -> String {
    let (bits, count, seed) = ([16, 10, 7, 4][number / 3 % 4], 50 + number * 37 % 1500, number as u64);
    let mut points = match Distribution::ALL.get(number % (Distribution::ALL.len() + 2)) {
        // Some distributions have no room in a small grid.
        Some(&kind) => generate(kind, count, bits, seed)
            .or_else(|_| generate(Distribution::Uniform, count, bits, seed))
            .unwrap_or_default(),
        None if number.is_multiple_of(2) => vec![[5, 7]; count],
        None => (0..count as u32).map(|k| [k % 300, 2 * (k % 300)]).collect(),
    };
    points.extend_from_within(..points.len() / 3);
    points.iter().map(|[x, y]| format!("{x},{y}\n")).collect()
}

/// The number of sets whose meshes, made in one way with one size, equal those of the run in memory.
fn equal(folder: &Path, way: Way, size: usize, sets: usize) -> io::Result<usize> {
    let mut equal = 0;
    for number in 0..sets {
        fs::write(folder.join("p.csv"), set(number))?;
        let right = fs::read(folder.join(format!("{number}.npy")))?;
        let _ = fs::remove_file(folder.join("m.npy"));
        let is_equal = way.run(folder, size) && fs::read(folder.join("m.npy"))? == right;
        equal += usize::from(is_equal);
    }
    Ok(equal)
}

/// Prints the table; `false` if a mesh differs or a command failed.
fn table(folder: &Path, sets: usize) -> io::Result<bool> {
    for number in 0..sets {
        fs::write(folder.join("p.csv"), set(number))?;
        if !command(folder, &format!("triangulate @p.csv -o @{number}.npy --backend cpu --threads 1 -q")) {
            return Ok(false);
        }
    }
    let head: String = SIZES.iter().map(|size| format!(" {size} |")).collect();
    println!("| equal of all meshes, parts of at most |{head}\n|---|{}", "---:|".repeat(SIZES.len()));
    let mut is_right = true;
    for (name, way) in WAYS {
        print!("| {name} |");
        for (place, size) in SIZES.into_iter().enumerate() {
            if place > 0 && !way.has_sizes() {
                print!(" |");
                continue;
            }
            let equal = equal(folder, way, size, sets)?;
            is_right &= equal == sets;
            print!(" {equal} of {sets} |");
            io::stdout().flush()?;
        }
        println!();
    }
    Ok(is_right)
}

fn main() -> ExitCode {
    let sets = env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(SETS);
    let folder: PathBuf = env::temp_dir().join(format!("incircle-any-size-{}", process::id()));
    let done = fs::create_dir_all(&folder).and_then(|()| table(&folder, sets));
    let _ = fs::remove_dir_all(&folder);
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("a mesh differs from that of the run in memory, or a command failed");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{}: {error}", folder.display());
            ExitCode::FAILURE
        }
    }
}
