//! CGAL as a contestant: a program of its own, because its licence does not allow to link it into ours.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use incircle_testkit::Compiled;

use super::run::{canonical, Run};
use super::sets::Set;
use crate::orders::Failure;

const SOURCE: &str = include_str!("cgal.cpp");

/// The compiled program.
pub(super) struct Program(Compiled);

impl Program {
    /// Compiles the program if CGAL is installed.
    pub(super) fn new() -> Result<Self, String> {
        Compiled::new(SOURCE, &["-lmpfr", "-lgmp"]).map(Self)
    }

    /// Makes the mesh of a set in a process of its own, which takes the time of the mesh alone.
    pub(super) fn run(&self, set: &Set) -> Result<Run, Failure> {
        let mut child = Command::new(self.0.program()).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let mut input = child.stdin.take().ok_or("the program has no input")?;
        let counts = [set.points.len() as u64, set.constraints.len() as u64];
        input.write_all(&counts.map(u64::to_le_bytes).concat())?;
        input.write_all(bytemuck::cast_slice(&set.points))?;
        input.write_all(bytemuck::cast_slice(&set.constraints))?;
        drop(input);
        let mut answer = Vec::new();
        child.stdout.take().ok_or("the program has no output")?.read_to_end(&mut answer)?;
        child.wait()?;
        let (head, numbers) = answer.split_first_chunk::<8>().ok_or("the program has no answer")?;
        let (words, _) = numbers.as_chunks::<4>();
        let numbers: Vec<u32> = words.iter().map(|&word| u32::from_le_bytes(word)).collect();
        let (triangles, _) = numbers.as_chunks::<3>();
        Ok(Run { seconds: f64::from_le_bytes(*head), triangles: canonical(triangles.to_vec()) })
    }
}
