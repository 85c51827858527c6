//! CGAL as a contestant: a program of its own, because its licence does not allow to link it into ours.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use incircle_testkit::Compiled;

use super::set::Set;
use crate::orders::Failure;

/// The compiled program.
pub(super) struct Program(Compiled);

impl Program {
    /// Compiles the program if CGAL is installed.
    pub(super) fn new() -> Result<Self, String> {
        Compiled::new(include_str!("cgal.cpp"), &["-lmpfr", "-lgmp"]).map(Self)
    }

    /// The processor time of Sibson's values at all places, and the values.
    pub(super) fn run(&self, set: &Set, places: &[[f64; 2]]) -> Result<(f64, Vec<f64>), Failure> {
        let mut child = Command::new(self.0.program()).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let mut input = child.stdin.take().ok_or("the program has no input")?;
        input.write_all(&[set.points.len() as u64, places.len() as u64].map(u64::to_le_bytes).concat())?;
        input.write_all(bytemuck::cast_slice(&set.points))?;
        input.write_all(bytemuck::cast_slice(&set.heights))?;
        input.write_all(bytemuck::cast_slice(places))?;
        drop(input);
        let mut answer = Vec::new();
        child.stdout.take().ok_or("the program has no output")?.read_to_end(&mut answer)?;
        child.wait()?;
        let (words, _) = answer.as_chunks::<8>();
        let mut numbers = words.iter().map(|&word| f64::from_le_bytes(word));
        let seconds = numbers.next().ok_or("the program has no answer")?;
        let values: Vec<f64> = numbers.collect();
        match values.len() == places.len() {
            true => Ok((seconds, values)),
            false => Err(format!("the program gave {} values for {} places", values.len(), places.len()).into()),
        }
    }
}
