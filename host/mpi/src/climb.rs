//! The fourth and the fifth step: tiles are triangulated where their points are, and borders climb the tree of joins.

use std::collections::BTreeMap;

use incircle::tiles::{self, Border, Region, Tile, Union};
use incircle::{Mesh, Point, Triangulator};
use incircle_cli::{Exit, Failure};

use crate::exchange::Tiles;
use crate::nodes::{shared_levels, Node};
use crate::world::World;

/// The counts of all regions of a level of the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Level {
    /// The number of regions: tiles at level 0, and joins above.
    pub regions: u64,
    /// The number of points in their borders.
    pub border: u64,
    /// The number of open triangles in their borders.
    pub open: u64,
    /// The number of bytes of borders that were sent to the process of a join of this level.
    pub bytes: u64,
}

/// The part of the mesh that one process has found.
#[derive(Default)]
pub struct Climb {
    /// The final triangles, in no particular sequence.
    pub finals: Vec<[u32; 3]>,
    /// The number of points with the place of an earlier one.
    pub duplicates: u64,
    /// The number of points on the hull of the set, in the process of the last step, and 0 in all others.
    pub hull: u64,
    /// The counts of this process for each level of the tree.
    pub levels: Vec<Level>,
    borders: BTreeMap<usize, Border<Point, u32>>,
    triangulator: Triangulator,
    mesh: Mesh,
}

impl Climb {
    /// Does all steps that need no other process.
    pub fn alone(rank: usize, nodes: &[Node], mut points: Tiles) -> Result<Self, Failure> {
        let height = nodes.iter().map(|node| node.level + 1).max().unwrap_or(0);
        let mut climb = Self { levels: vec![Level::default(); height], ..Self::default() };
        for (place, node) in nodes.iter().enumerate() {
            if node.rank != rank || node.is_shared {
                continue;
            }
            let tile = match node.children.as_slice() {
                [] => climb.tile(node.region, &mut points),
                children => {
                    let borders = children.iter().filter_map(|child| climb.borders.remove(child)).collect();
                    climb.join(node.region, borders)
                }
            };
            climb.keep(place, nodes, tile?);
        }
        Ok(climb)
    }

    /// Does the joins that several processes share. A failure ends all processes.
    pub fn together(&mut self, world: &World, nodes: &[Node]) {
        for level in shared_levels(nodes) {
            let messages = self.messages(world, nodes, &level);
            let done = world.while_sending(&messages, || {
                let mut own = level.iter().filter(|&&place| nodes[place].rank == world.rank());
                own.try_for_each(|&place| self.shared_join(world, nodes, place))
            });
            if let Err(failure) = done {
                world.abort(&failure);
            }
        }
    }

    /// The borders that this process sends for joins of other processes.
    fn messages(&mut self, world: &World, nodes: &[Node], level: &[usize]) -> Vec<(usize, Vec<u32>)> {
        let mut messages = Vec::new();
        for join in level.iter().map(|&place| &nodes[place]).filter(|join| join.rank != world.rank()) {
            for child in &join.children {
                if let Some(border) = self.borders.remove(child) {
                    let message = words_of(&border);
                    self.levels[join.level].bytes += message.len() as u64 * 4;
                    messages.push((join.rank, message));
                }
            }
        }
        messages
    }

    fn shared_join(&mut self, world: &World, nodes: &[Node], place: usize) -> Result<(), Failure> {
        let join = &nodes[place];
        let mut borders = Vec::with_capacity(join.children.len());
        for child in &join.children {
            let Node { region, rank, .. } = nodes[*child];
            borders.push(match self.borders.remove(child) {
                Some(border) => border,
                None => border_of(&world.receive(rank), region).ok_or_else(|| lost(rank))?,
            });
        }
        let tile = self.join(join.region, borders)?;
        self.keep(place, nodes, tile);
        Ok(())
    }

    fn tile(&mut self, region: Region, points: &mut Tiles) -> Result<Tile<Point, u32>, Failure> {
        let (ids, own) = points.next();
        self.triangulator
            .triangulate_into(&own, &mut self.mesh)
            .map_err(|error| Failure::new(Exit::Capacity, format!("a tile is too large: {error}")))?;
        self.duplicates += self.mesh.duplicates.len() as u64;
        tiles::local(&self.mesh, &ids, region).map_err(|error| misfit(&error))
    }

    fn join(&mut self, region: Region, borders: Vec<Border<Point, u32>>) -> Result<Tile<Point, u32>, Failure> {
        let union = Union::of(region, borders).map_err(|error| misfit(&error))?;
        self.triangulator
            .triangulate_into(union.points(), &mut self.mesh)
            .map_err(|error| Failure::new(Exit::Capacity, format!("a join is too large: {error}")))?;
        union.settle(&self.mesh).map_err(|error| misfit(&error))
    }

    fn keep(&mut self, place: usize, nodes: &[Node], tile: Tile<Point, u32>) {
        let level = &mut self.levels[nodes[place].level];
        level.regions += 1;
        level.border += tile.border.points.len() as u64;
        level.open += tile.border.open.len() as u64;
        self.finals.extend(tile.finals);
        if place + 1 == nodes.len() {
            self.hull = tile.hull.len() as u64;
        }
        self.borders.insert(place, tile.border);
    }
}

fn misfit(error: &tiles::Error) -> Failure {
    Failure::new(Exit::Device, format!("the borders of the tiles do not fit together: {error}"))
}

fn lost(rank: usize) -> Failure {
    Failure::new(Exit::Link, format!("a border of process {rank} did not arrive whole: run the program again"))
}

/// A border as numbers of 32 bits: its counts of points and of open triangles, then index, x and y of each point, then
/// the triangles. The receiver knows the region.
fn words_of(border: &Border<Point, u32>) -> Vec<u32> {
    let mut words = Vec::with_capacity(2 + 3 * (border.points.len() + border.open.len()));
    words.extend([border.points.len() as u32, border.open.len() as u32]);
    for (point, &id) in border.points.iter().zip(&border.ids) {
        words.extend([id, point.x, point.y]);
    }
    words.extend(border.open.as_flattened());
    words
}

/// The border in a message; `None` if the message has another length than its counts say.
fn border_of(words: &[u32], region: Region) -> Option<Border<Point, u32>> {
    let (&[points, open], rest) = words.split_first_chunk()?;
    let (rows, rest) = rest.as_chunks::<3>();
    if !rest.is_empty() || rows.len() as u64 != u64::from(points) + u64::from(open) {
        return None;
    }
    let (rows, open) = rows.split_at(points as usize);
    Some(Border {
        region,
        points: rows.iter().map(|row| Point::new(row[1], row[2])).collect(),
        ids: rows.iter().map(|row| row[0]).collect(),
        open: open.to_vec(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_border_comes_back_from_its_message() {
        let border = Border {
            region: Region::WHOLE,
            points: vec![Point::new(1, 2), Point::new(u32::MAX, 0), Point::new(5, 6)],
            ids: vec![7, 8, 9],
            open: vec![[0, 1, 2]],
        };
        let words = words_of(&border);
        assert_eq!(border_of(&words, Region::WHOLE), Some(border));
        for cut in 0..words.len() {
            assert_eq!(border_of(&words[..cut], Region::WHOLE), None, "{cut} words");
        }
    }
}
