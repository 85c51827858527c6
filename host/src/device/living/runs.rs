//! Runs of many items: their order, the contexts that they are dealt to, and where a run must end.
//!
//! Items of a run take effect in any order, so a run ends before an item that touches a vertex or a place of another
//! item of the run. Between runs a device does nothing else, so each run is made as long as possible.

use std::collections::HashSet;

use incircle_protocol::{Outcome, RunKind};

use super::exchange::{Item, Part};
use super::names::Place;
use super::session::LivingSession;
use super::LivingMesh;
use crate::error::Error;
use crate::job::deal::deal_from_start;
use incircle_geometry::living::Location;
use incircle_geometry::order::hilbert;
use incircle_geometry::Point;

/// Items of a run that have not been sent.
struct Pending {
    kind: RunKind,
    items: Vec<Item>,
    /// The place to which the device walks for each item.
    places: Vec<Point>,
}

impl Pending {
    fn new(kind: RunKind) -> Self {
        Self { kind, items: Vec::new(), places: Vec::new() }
    }

    fn push(&mut self, item: Item, place: Point) {
        self.items.push(item);
        self.places.push(place);
    }
}

/// The places of items in a run: along the Hilbert curve, or `backwards` along it, and cut into a stretch for each
/// context. Item `i` belongs to context `i` modulo their number.
fn dealt(places: &[Point], contexts: usize, backwards: bool) -> Vec<u32> {
    let mut order = hilbert(places);
    deal_from_start(&mut order, contexts);
    if !backwards {
        return order;
    }
    let mirrored = |place: usize| {
        let context = place % contexts;
        let last = (order.len() - 1 - context) / contexts;
        order[(last - place / contexts) * contexts + context]
    };
    (0..order.len()).map(mirrored).collect()
}

impl LivingSession<'_> {
    /// Sends items, and returns the part of each in the order in which they were put together.
    fn send(&mut self, pending: &mut Pending) -> Result<Vec<Part>, Error> {
        let (items, places) = (std::mem::take(&mut pending.items), std::mem::take(&mut pending.places));
        let contexts = (self.choices.contexts as usize).max(1);
        let mut parts = Vec::with_capacity(items.len());
        let most = self.device.most_items(pending.kind);
        for (items, places) in items.chunks(most).zip(places.chunks(most)) {
            let order = dealt(places, contexts, self.runs_backwards);
            // A context begins to walk where its last item was, which is near the first of the next run then.
            self.runs_backwards = !self.runs_backwards;
            let run: Vec<Item> = order.iter().map(|&index| items[index as usize]).collect();
            let answers = self.device.ask_all(pending.kind, &run)?;
            let mut sorted: Vec<(u32, Part)> = order.into_iter().zip(answers).collect();
            sorted.sort_unstable_by_key(|&(index, _)| index);
            parts.extend(sorted.into_iter().map(|(_, part)| part));
        }
        Ok(parts)
    }

    /// Asks about places. All are on the grid, and the device has the mesh.
    fn ask_about(&mut self, kind: RunKind, places: &[Point]) -> Result<Vec<Part>, Error> {
        let mut pending = Pending::new(kind);
        places.iter().for_each(|&point| pending.push(Item { vertex: 0, point }, point));
        self.send(&mut pending)
    }

    pub(super) fn locate_in_runs(&mut self, places: &[Point]) -> Result<Vec<Location>, Error> {
        places.iter().try_for_each(|&place| self.check_grid(place))?;
        if !self.refresh()? {
            return places.iter().map(|&place| self.locate(place)).collect();
        }
        let parts = self.ask_about(RunKind::Locate, places)?;
        parts.into_iter().map(|part| self.location(part)).collect()
    }

    pub(super) fn nearest_in_runs(&mut self, places: &[Point]) -> Result<Vec<Option<u32>>, Error> {
        places.iter().try_for_each(|&place| self.check_grid(place))?;
        if !self.refresh()? {
            return places.iter().map(|&place| self.nearest(place)).collect();
        }
        let parts = self.ask_about(RunKind::Nearest, places)?;
        parts.into_iter().map(|part| self.nearest_name(part).map(Some)).collect()
    }

    /// The answer to a `Locate`.
    pub(super) fn location(&mut self, (outcome, located): Part) -> Result<Location, Error> {
        let mut name = |k: usize| self.name(RunKind::Locate, located.vertices[k]);
        Ok(match outcome {
            Outcome::Vertex => Location::Vertex(name(0)?),
            Outcome::Edge => {
                let [one, other] = [name(0)?, name(1)?];
                Location::Edge([one.min(other), one.max(other)])
            }
            Outcome::Triangle => {
                let mut corners = [name(0)?, name(1)?, name(2)?];
                let lowest = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
                corners.rotate_left(lowest);
                Location::Triangle(corners)
            }
            Outcome::Outside => Location::Outside([name(0)?, name(1)?]),
            other => return Err(self.unexpected(RunKind::Locate, other)),
        })
    }

    /// The answer to a `Nearest`.
    pub(super) fn nearest_name(&mut self, (outcome, located): Part) -> Result<u32, Error> {
        match outcome {
            Outcome::Vertex => self.name(RunKind::Nearest, located.vertices[0]),
            other => Err(self.unexpected(RunKind::Nearest, other)),
        }
    }

    /// Sends the changes of a run. The host has taken note of them, so a vertex that the device refuses to change is
    /// changed when the next question makes the mesh anew.
    fn make(&mut self, pending: &mut Pending) -> Result<(), Error> {
        let kind = pending.kind;
        for (outcome, _) in self.send(pending)? {
            match (kind, outcome) {
                (_, Outcome::Done) => {}
                (RunKind::Delete | RunKind::Move, Outcome::Flat | Outcome::ManyNeighbors) => self.fall_behind(),
                (_, other) => return Err(self.unexpected(kind, other)),
            }
        }
        Ok(())
    }

    pub(super) fn insert_in_runs(&mut self, points: &[Point]) -> Result<(), Error> {
        let mut pending = Pending::new(RunKind::InsertAs);
        let mut refused = Ok(());
        for &point in points {
            let index = match self.check_new(point) {
                Ok(index) => index,
                Err(error) => {
                    refused = Err(error);
                    break;
                }
            };
            let mut vertex = 0;
            if self.names.place(point).is_none() {
                vertex = self.free.pop().unwrap_or(self.vertices.len() as u32);
                if vertex as usize == self.vertices.len() {
                    self.vertices.push(None);
                }
                self.vertices[vertex as usize] = Some(point);
                pending.push(Item { vertex, point }, point);
            }
            self.names.put(index, point, vertex);
        }
        self.make(&mut pending).and(refused)
    }

    pub(super) fn delete_in_runs(&mut self, indices: &[u32]) -> Result<(), Error> {
        let mut pending = Pending::new(RunKind::Delete);
        let mut refused = Ok(());
        for &index in indices {
            let point = match self.names.point(index) {
                Ok(point) => point,
                Err(refusal) => {
                    refused = Err(refusal.into());
                    break;
                }
            };
            let is_shared = self.names.place(point).is_some_and(Place::is_shared);
            match self.vertex_for(RunKind::Delete, point) {
                _ if is_shared => {}
                Some(vertex) => {
                    pending.push(Item { vertex, point }, point);
                    self.vertices[vertex as usize] = None;
                    self.free.push(vertex);
                }
                None => self.fall_behind(),
            }
            self.names.take(index);
        }
        self.make(&mut pending).and(refused)
    }

    pub(super) fn move_in_runs(&mut self, moves: &[(u32, Point)]) -> Result<(), Error> {
        let mut pending = Pending::new(RunKind::Move);
        let mut touched: HashSet<Point> = HashSet::new();
        for &(index, to) in moves {
            let from = match self.names.point(index).map_err(Error::from).and_then(|from| {
                self.check_grid(to)?;
                Ok(from)
            }) {
                Ok(from) => from,
                Err(error) => return self.make(&mut pending).and(Err(error)),
            };
            if from == to {
                continue;
            }
            let is_shared = self.names.place(from).is_some_and(Place::is_shared);
            let alone = self.vertex_for(RunKind::Move, from).filter(|_| !is_shared);
            let is_plain = self.names.place(to).is_none();
            let is_apart = !touched.contains(&from) && !touched.contains(&to);
            match alone.filter(|_| is_plain && is_apart) {
                Some(vertex) => {
                    pending.push(Item { vertex, point: to }, from);
                    touched.extend([from, to]);
                    self.names.take(index);
                    self.names.put(index, to, vertex);
                    self.vertices[vertex as usize] = Some(to);
                }
                None => {
                    // The run ends, and what it has changed counts for this move.
                    self.make(&mut pending)?;
                    touched.clear();
                    self.move_to(index, to)?;
                }
            }
        }
        self.make(&mut pending)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_context_gets_a_stretch_of_the_curve() {
        let places: Vec<Point> = (0..10).map(|x| Point::new(x, 0)).collect();
        let of = |run: &[u32], context: usize| run.iter().copied().skip(context).step_by(4).collect::<Vec<_>>();
        let stretches = |run: Vec<u32>| [0, 1, 2, 3].map(|context| of(&run, context));
        let (there, back) = (dealt(&places, 4, false), dealt(&places, 4, true));
        assert_eq!(stretches(there), [vec![0, 1, 2], vec![3, 4, 5], vec![6, 7], vec![8, 9]]);
        assert_eq!(stretches(back), [vec![2, 1, 0], vec![5, 4, 3], vec![7, 6], vec![9, 8]]);
        assert_eq!(dealt(&places[..1], 4, true), [0]);
    }
}
