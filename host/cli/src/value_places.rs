//! The places at which values are wanted: those of a file, or the nodes of a grid, of which only the coordinates of
//! rows and columns are kept.

use crate::failure::Failure;
use crate::grid::Grid;
use crate::lattice::{Laid, Numbers};
use crate::number::Coordinate;
use crate::points::PointTable;

/// Nodes of a grid that are made and asked about at once.
const AT_ONCE: usize = 1 << 18;

/// The places at which values are wanted.
pub struct ValuePlaces {
    /// All places, or the first nodes of the rows and columns of a grid, in the numbers of the file.
    table: PointTable,
    /// The grid whose nodes the places are.
    pub grid: Option<Grid>,
}

impl ValuePlaces {
    /// The places of a table.
    pub fn of_table(table: PointTable) -> Self {
        Self { table, grid: None }
    }

    /// The nodes of a grid.
    pub fn of_grid(grid: Grid) -> Result<Self, Failure> {
        Ok(Self { table: grid.edge_nodes()?, grid: Some(grid) })
    }

    /// The places whose coordinates are all those of the places here.
    pub fn table(&self) -> &PointTable {
        &self.table
    }

    /// The number of places.
    pub fn len(&self) -> usize {
        self.grid.as_ref().map_or(self.table.len(), Grid::len)
    }

    /// A coordinate of a place in the numbers of the file.
    pub fn coordinate(&self, place: usize, axis: usize) -> Coordinate {
        self.table.coordinate(self.sources(place)[axis], axis)
    }

    fn sources(&self, place: usize) -> [usize; 2] {
        self.grid.as_ref().map_or([place; 2], |grid| grid.sources(place))
    }

    /// Calls `work` with all places in their order: those of a file at once, and of a grid some at a time. `of_table`
    /// has the coordinates of the table.
    pub fn each<T: Copy, E>(
        &self,
        of_table: &[[T; 2]],
        mut work: impl FnMut(&[[T; 2]]) -> Result<(), E>,
    ) -> Result<(), E> {
        let Some(grid) = &self.grid else { return work(of_table) };
        let mut some = Vec::with_capacity(AT_ONCE.min(grid.len()));
        for first in (0..grid.len()).step_by(AT_ONCE) {
            some.clear();
            some.extend((first..grid.len().min(first + AT_ONCE)).map(|node| {
                let [x, y] = grid.sources(node);
                [of_table[x][0], of_table[y][1]]
            }));
            work(&some)?;
        }
        Ok(())
    }
}

/// The coordinates in which values are worked out: those of the lattice, which doubles hold exactly, or else the
/// nearest doubles.
pub fn coordinates(laid: &Laid<'_>, all: &PointTable) -> Vec<[f64; 2]> {
    match &laid.numbers {
        Numbers::Grid(grid) => grid.iter().map(|point| [point.x.into(), point.y.into()]).collect(),
        Numbers::Doubles(doubles) => doubles.to_vec(),
        Numbers::Whole(_) => all.doubles().into_owned(),
    }
}
