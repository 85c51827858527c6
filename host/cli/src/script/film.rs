//! The frames of a film of a script.

use incircle::{Error, LivingMesh, PlanePoint};

use super::{Command, Script};
use crate::failure::Failure;

/// The most points that may live at one time in a film. More would be too small to be seen.
pub const MOST_POINTS: usize = 2_000;
/// The most triangles of all frames of a film together, at about 25 bytes each: a viewer holds them all.
pub const MOST_TRIANGLES: usize = 400_000;
/// The most frames of a film, and the number without a choice.
pub const MOST_FRAMES: u32 = 600;
const USUAL_FRAMES: u32 = 120;
/// The most questions that a frame shows, which are the last ones before it.
const MOST_ASKED: usize = 200;

/// The frames of a film. Points stand for the numbers of their places in the script.
pub struct Film {
    /// The number of commands between two frames.
    pub every: usize,
    /// The frames so far.
    pub frames: Vec<Frame>,
    commands: usize,
    /// The place of each point, by index.
    place_of: Vec<u32>,
    /// The places of the last questions since the last frame.
    asked: Vec<u32>,
}

/// A frame of a film: the mesh after some commands.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// The number of commands before the frame.
    pub commands: usize,
    /// The number of living points.
    pub living: usize,
    /// The triangles, each by the places of its corners.
    pub triangles: Vec<[u32; 3]>,
    /// The places of the hull, counter-clockwise; without triangles those of all points, along their line.
    pub hull: Vec<u32>,
    /// The places of the points.
    pub points: Vec<u32>,
    /// The places of the questions since the frame before.
    pub asked: Vec<u32>,
}

impl Film {
    /// Plans a film of at most `frames` frames. There are fewer if the script has fewer commands, or if its triangles
    /// would exceed [`MOST_TRIANGLES`]. More than [`MOST_POINTS`] points at one time are refused.
    pub fn plan(script: &Script, frames: Option<u32>) -> Result<Self, Failure> {
        let living = script.most_living;
        if living > MOST_POINTS {
            return Err(Failure::usage(format!(
                "a film shows up to {MOST_POINTS} points at one time, and in this script {living} live: leave --film \
                 out, or take a script of fewer points"
            )));
        }
        let commands = script.commands.len();
        // A mesh has fewer than twice as many triangles as points.
        let fitting = MOST_TRIANGLES / (2 * living.max(1));
        let frames = fitting.min(frames.unwrap_or(USUAL_FRAMES) as usize).max(1);
        let every = commands.div_ceil(frames).max(1);
        // A script without commands is shown as an empty picture.
        let first = if commands == 0 { vec![Frame::default()] } else { Vec::new() };
        Ok(Self { every, frames: first, commands, place_of: Vec::new(), asked: Vec::new() })
    }

    /// Notes what a command changes; `place` is the number of its place, if it has one.
    pub fn note(&mut self, command: Command, place: u32) {
        match command {
            Command::Insert => self.place_of.push(place),
            Command::Move(index) => self.place_of[index as usize] = place,
            Command::Locate | Command::Nearest => self.asked.push(place),
            Command::Delete(_) | Command::Constrain(_) | Command::Unconstrain(_) => {}
        }
    }

    /// Whether a frame follows after the first `done` commands.
    pub fn is_due(&self, done: usize) -> bool {
        done.is_multiple_of(self.every) || done == self.commands
    }

    /// Adds the frame after the first `done` commands.
    pub fn take<P: PlanePoint>(&mut self, mesh: &mut impl LivingMesh<P>, done: usize) -> Result<(), Error> {
        let (indices, mesh) = (mesh.indices(), mesh.mesh()?);
        let place = |rank: u32| self.place_of[indices[rank as usize] as usize];
        let mut is_vertex = vec![true; indices.len()];
        mesh.duplicates.iter().for_each(|duplicate| is_vertex[duplicate.index as usize] = false);
        let skipped = self.asked.len().saturating_sub(MOST_ASKED);
        let frame = Frame {
            commands: done,
            living: indices.len(),
            triangles: mesh.triangles.iter().map(|triangle| triangle.map(place)).collect(),
            hull: mesh.hull.iter().copied().map(place).collect(),
            points: (0u32..).zip(is_vertex).filter(|vertex| vertex.1).map(|vertex| place(vertex.0)).collect(),
            asked: self.asked[skipped..].to_vec(),
        };
        self.asked.clear();
        self.frames.push(frame);
        Ok(())
    }
}
