//! CGAL as a contestant: a program of its own, because its licence does not allow to link it into ours.

use std::io::{BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use incircle_testkit::Compiled;

use super::contestant::{smallest_first, Block, Contestant, Run, NO_VERTEX};
use crate::orders::Failure;

const SOURCE: &str = include_str!("cgal.cpp");

/// The numbers of the commands in the program.
#[derive(Clone, Copy)]
enum Code {
    Load,
    Locate,
    Nearest,
    Insert,
    Delete,
    Triangles,
}

/// The compiled program, from which processes are started.
pub(super) struct Program(Compiled);

impl Program {
    /// Compiles the program if CGAL is installed.
    pub(super) fn new() -> Result<Self, String> {
        Compiled::new(SOURCE, &["-lmpfr", "-lgmp"]).map(Self)
    }

    /// Starts a process. Its walks begin at the last place, or at the top of CGAL's hierarchy.
    pub(super) fn start(&self, from_last: bool) -> Result<Cgal, Failure> {
        let mut command = Command::new(self.0.program());
        command.arg(if from_last { "last" } else { "hierarchy" });
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let output = child.stdout.take().ok_or("the program has no output")?;
        Ok(Cgal { input: child.stdin.take(), child, output: BufReader::new(output) })
    }
}

/// A running process.
pub(super) struct Cgal {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

impl Cgal {
    fn exchange(&mut self, code: Code, count: usize, items: &[u8]) -> Result<Run, Failure> {
        let input = self.input.as_mut().ok_or("the program has ended")?;
        input.write_all(&[code as u64, count as u64].map(u64::to_le_bytes).concat())?;
        input.write_all(items)?;
        input.flush()?;
        let mut word = [0; 8];
        self.output.read_exact(&mut word)?;
        let seconds = f64::from_le_bytes(word);
        self.output.read_exact(&mut word)?;
        let mut bytes = vec![0; 4 * usize::try_from(u64::from_le_bytes(word))?];
        self.output.read_exact(&mut bytes)?;
        let (numbers, _) = bytes.as_chunks::<4>();
        Ok(Run { seconds, answers: numbers.iter().map(|&number| u32::from_le_bytes(number)).collect() })
    }
}

impl Contestant for Cgal {
    fn name(&self) -> &'static str {
        "cgal"
    }

    fn load(&mut self, points: &[[f64; 2]], order: &[u32]) -> Result<(), Failure> {
        let item = |&number: &u32| {
            let [x, y] = points[number as usize];
            [f64::from(number), x, y]
        };
        let items: Vec<[f64; 3]> = order.iter().map(item).collect();
        self.exchange(Code::Load, items.len(), bytemuck::cast_slice(&items)).map(|_| ())
    }

    fn run(&mut self, block: Block) -> Result<Run, Failure> {
        let (code, items): (Code, &[u8]) = match block {
            Block::Locate(places) => (Code::Locate, bytemuck::cast_slice(places)),
            Block::Nearest(places) => (Code::Nearest, bytemuck::cast_slice(places)),
            Block::Insert(places) => (Code::Insert, bytemuck::cast_slice(places)),
            Block::Delete(numbers) => (Code::Delete, bytemuck::cast_slice(numbers)),
        };
        let mut run = self.exchange(code, block.len(), items)?;
        if let Block::Locate(_) = block {
            let (triangles, _) = run.answers.as_chunks_mut::<3>();
            triangles
                .iter_mut()
                .filter(|triangle| !triangle.contains(&NO_VERTEX))
                .for_each(|t| *t = smallest_first(*t));
        }
        Ok(run)
    }

    fn triangles(&mut self) -> Result<Vec<[u32; 3]>, Failure> {
        let run = self.exchange(Code::Triangles, 0, &[])?;
        let (triangles, _) = run.answers.as_chunks::<3>();
        let mut triangles: Vec<_> = triangles.iter().map(|&triangle| smallest_first(triangle)).collect();
        triangles.sort_unstable();
        Ok(triangles)
    }
}

impl Drop for Cgal {
    /// Ends the program by closing its input.
    fn drop(&mut self) {
        self.input = None;
        // The program has nothing more to report.
        let _ = self.child.wait();
    }
}
