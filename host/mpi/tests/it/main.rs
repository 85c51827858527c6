//! Runs of the program under `mpirun`, in one program. Set `MPIRUN` to a launcher of your own, with its options.

mod failures;
mod meshes;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

/// A folder for one test, which is removed at its end.
struct Scratch(PathBuf);

impl Scratch {
    pub fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-{number}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder for the test");
        Self(path)
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// The names of everything in the folder, hidden names included.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("the folder of the test");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Writes points as an array of NumPy. `descr` names the type of the numbers, whose bytes these are.
    pub fn array(&self, name: &str, descr: &str, points: usize, numbers: &[u8]) {
        let text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({points}, 2), }}");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        let length = (text.len() + 1).next_multiple_of(64) + 54;
        bytes.extend((length as u16).to_le_bytes());
        bytes.extend(format!("{text:<width$}\n", width = length - 1).bytes());
        bytes.extend(numbers);
        std::fs::write(self.path(name), bytes).expect("an array");
    }

    /// Writes points with integers of 64 bits.
    pub fn integers(&self, name: &str, points: &[[i64; 2]]) {
        let numbers: Vec<u8> = points.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
        self.array(name, "<i8", points.len(), &numbers);
    }

    /// Calls the command `incircle` with arguments, in which `@` stands for the folder of the test.
    pub fn incircle(&self, arguments: &str) {
        let words = arguments.split_whitespace().map(|word| word.replace('@', &format!("{}/", self.0.display())));
        let code = incircle_cli::run(std::iter::once("incircle".to_owned()).chain(words).map(Into::into));
        assert_eq!(format!("{code:?}"), format!("{:?}", std::process::ExitCode::SUCCESS), "incircle {arguments}");
    }

    /// The program on some processes, in the folder of the test.
    pub fn command(&self, ranks: usize, arguments: &str) -> Command {
        let usual = "mpirun --allow-run-as-root --oversubscribe".to_owned();
        let launcher = std::env::var("MPIRUN").unwrap_or(usual);
        let mut words = launcher.split_whitespace();
        let mut command = Command::new(words.next().expect("the name of the launcher"));
        command.args(words).args(["-n", &ranks.to_string(), env!("CARGO_BIN_EXE_incircle-mpi")]);
        command.args(arguments.split_whitespace()).current_dir(&self.0).stdin(Stdio::null());
        command
    }

    /// Runs the program on some processes.
    pub fn run(&self, ranks: usize, arguments: &str) -> Output {
        self.command(ranks, arguments).output().expect("mpirun is installed")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The bytes behind the header of an array.
fn data(path: &Path) -> Vec<u8> {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    bytes[10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))..].to_vec()
}

/// The sentences of the program on standard error, without those of `mpirun`.
fn sentences(output: &Output) -> Vec<String> {
    let text = String::from_utf8_lossy(&output.stderr);
    text.lines().filter_map(|line| line.strip_prefix("incircle-mpi: ")).map(str::to_owned).collect()
}
