//! C++ libraries as contestants: each is a program of its own. The licence of CGAL does not allow to link it into ours.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use incircle_testkit::Compiled;

use super::run::{canonical, Run};
use super::sets::Set;
use crate::orders::Failure;

/// A library, and the compiled program that calls it.
pub(super) struct Program {
    pub(super) name: &'static str,
    /// Whether the library may leave out triangles at the hull.
    pub(super) may_lose_hull: bool,
    compiled: Compiled,
}

impl Program {
    /// Compiles the program of CGAL if that is installed.
    pub(super) fn cgal() -> Result<Self, String> {
        let compiled = Compiled::new(include_str!("cgal.cpp"), &["-lmpfr", "-lgmp"])?;
        Ok(Self { name: "cgal", may_lose_hull: false, compiled })
    }

    /// Compiles the program of CDT if its headers are where the compiler looks. CDT triangulates inside a triangle
    /// around all points, which it takes away in the end, and points on the hull may have been joined to that triangle.
    pub(super) fn cdt() -> Result<Self, String> {
        Ok(Self { name: "cdt", may_lose_hull: true, compiled: Compiled::new(include_str!("cdt.cpp"), &[])? })
    }

    /// Makes the mesh of a set in a process of its own, which takes the time of the mesh alone.
    pub(super) fn run(&self, set: &Set) -> Result<Run, Failure> {
        let mut child = Command::new(self.compiled.program()).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
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
