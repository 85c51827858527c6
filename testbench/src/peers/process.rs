//! Peers that are programs of their own. A program reads points from standard input and answers with its seconds, those
//! of the processor, and the number of triangles.
//!
//! A request is the number of points in 64 bits and then as many pairs of doubles, all
//! little-endian; the answer is a line.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use incircle::Point;
use incircle_testkit::Compiled;

use super::contestant::{Contestant, Missing, Run};
use super::error::PeerError;

const CGAL_SOURCE: &str = include_str!("cgal.cpp");
const TRIANGLE_SOURCE: &str = include_str!("triangle.py");

/// A peer that runs as a program.
pub(super) struct Process {
    name: &'static str,
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

/// Starts CGAL if the compiler finds its headers: a small program, compiled on the spot.
pub(super) fn cgal() -> Result<Process, Missing> {
    let absent = |reason: String| Missing { name: "cgal", reason };
    let compiled = Compiled::new(CGAL_SOURCE, &["-lmpfr", "-lgmp"]).map_err(absent)?;
    Process::start("cgal", Command::new(compiled.program()))
}

/// Starts Triangle if the Python in `PYTHON`, or else `python3`, has the package `triangle`.
pub(super) fn triangle() -> Result<Process, Missing> {
    let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let has_it = Command::new(&python).args(["-c", "import triangle"]).output();
    if !has_it.is_ok_and(|output| output.status.success()) {
        let reason = format!("not installed: {} has no package triangle", python.to_string_lossy());
        return Err(Missing { name: "triangle", reason });
    }
    let mut command = Command::new(python);
    command.args(["-c", TRIANGLE_SOURCE]);
    Process::start("triangle", command)
}

impl Process {
    /// Starts the program and lets it triangulate three points.
    fn start(name: &'static str, mut command: Command) -> Result<Self, Missing> {
        let absent = |reason: String| Missing { name, reason };
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut child = spawned.map_err(|error| absent(error.to_string()))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(absent("it has no standard streams".to_owned()));
        };
        let mut process = Self { name, child, input: Some(input), output: BufReader::new(output) };
        let run = process.run(&[Point::new(0, 0), Point::new(3, 0), Point::new(0, 3)]);
        match run {
            Ok(Run { triangles: 1, .. }) => Ok(process),
            Ok(Run { triangles, .. }) => Err(absent(format!("it finds {triangles} triangles in one"))),
            Err(error) => Err(absent(error.to_string())),
        }
    }

    fn exchange(&mut self, request: &[u8]) -> std::io::Result<String> {
        if let Some(input) = &mut self.input {
            input.write_all(request)?;
            input.flush()?;
        }
        let mut line = String::new();
        self.output.read_line(&mut line)?;
        Ok(line)
    }
}

impl Contestant for Process {
    fn name(&self) -> &'static str {
        self.name
    }

    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError> {
        let peer = self.name;
        let failed = |reason: String| PeerError::Peer { peer, reason };
        let mut request = Vec::with_capacity(8 + 16 * points.len());
        request.extend((points.len() as u64).to_le_bytes());
        for point in points {
            request.extend(f64::from(point.x).to_le_bytes());
            request.extend(f64::from(point.y).to_le_bytes());
        }
        let line = self.exchange(&request).map_err(|error| failed(error.to_string()))?;
        let mut words = line.split_whitespace();
        let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
        let (seconds, busy) = (number(), number());
        let triangles = words.next().and_then(|word| word.parse::<usize>().ok());
        match (seconds, busy, triangles) {
            (Some(seconds), Some(busy), Some(triangles)) => {
                Ok(Run { seconds, busy, triangles, distinct: None, order_share: None })
            }
            _ => Err(failed(format!("it answers \"{}\"", line.trim()))),
        }
    }
}

impl Drop for Process {
    /// Ends the program by closing its input.
    fn drop(&mut self) {
        self.input = None;
        // The program has nothing more to report.
        let _ = self.child.wait();
    }
}
