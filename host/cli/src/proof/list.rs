//! The first pass over the triangles: the form of the list, and each triangle to the strip of its first corner.

use incircle::verify::local::Placed;
use incircle::VerifyError;

use super::budget::Budget;
use super::mesh::MeshFile;
use super::place::Place;
use super::points::{Duplicates, Indexed, Sites};
use super::strips::Deal;
use crate::failure::Failure;

/// The result of the pass.
pub struct List {
    /// The number of triangles.
    pub count: usize,
    /// The triangles of each strip, up to the first one that breaks the form.
    pub deal: Deal,
    /// The points that are corners.
    pub used: Used,
    /// The error of the triangle that breaks the form. All dealt triangles stand before it.
    pub error: Option<VerifyError>,
}

/// Reads the list. Only what shows without the other corners' points is certain to be found.
///
/// # Errors
/// The mesh cannot be read or has changed, or the folder cannot be written.
pub fn read(mesh: &MeshFile, sites: &Sites, place: Place<'_>, budget: &Budget) -> Result<List, Failure> {
    let buffer = budget.buffer(sites.strips(), sites.points)?;
    let mut pass = Pass {
        sites,
        indexed: sites.indexed(),
        duplicates: sites.duplicates(budget.share(16))?,
        deal: Deal::new(place.folder, sites.strips(), buffer)?,
        used: Used::new(sites.points, budget.share(4)),
        count: 0,
        before: None,
        error: None,
    };
    mesh.each_shown(2 * sites.distinct, place.quiet, &mut |triangle| pass.take(triangle))?;
    let Pass { deal, used, count, error, .. } = pass;
    Ok(List { count, deal, used, error })
}

struct Pass<'a> {
    sites: &'a Sites,
    indexed: Indexed<'a>,
    duplicates: Duplicates<'a>,
    deal: Deal,
    used: Used,
    count: usize,
    before: Option<[u32; 3]>,
    error: Option<VerifyError>,
}

impl Pass<'_> {
    fn take(&mut self, corners: [u32; 3]) -> Result<(), Failure> {
        let triangle = self.count;
        self.count += 1;
        if self.error.is_some() {
            return Ok(());
        }
        let before = self.before.replace(corners);
        let exists = corners.iter().all(|&corner| u64::from(corner) < self.sites.points);
        let is_rotated = corners[0] <= corners[1] && corners[0] <= corners[2];
        if !exists || !is_rotated || before.is_some_and(|before| before >= corners) {
            self.error = Some(self.defect(triangle, corners, before)?);
            return Ok(());
        }
        if let Some(of) = self.duplicates.lowest(corners[0])? {
            self.error = Some(VerifyError::NotLowestIndex { triangle, index: corners[0], of });
            return Ok(());
        }
        corners.into_iter().for_each(|corner| self.used.mark(corner));
        let strip = self.sites.strip_of(self.indexed.at(corners[0])?);
        self.deal.push(strip, corners)
    }

    /// The first defect of a triangle whose form is wrong.
    fn defect(&mut self, triangle: usize, corners: [u32; 3], before: Option<[u32; 3]>) -> Result<VerifyError, Failure> {
        let mut points = [incircle::Point::default(); 3];
        for (point, index) in points.iter_mut().zip(corners) {
            if u64::from(index) >= self.sites.points {
                let points = self.sites.points as usize;
                return Ok(VerifyError::IndexOutOfRange { triangle, index, points });
            }
            // The corners are in no order, so the duplicates are read from the first one on.
            if let Some(of) = self.sites.duplicates(0)?.lowest(index)? {
                return Ok(VerifyError::NotLowestIndex { triangle, index, of });
            }
            *point = self.indexed.at(index)?;
        }
        let checked = Placed { triangle, corners, points }.check(before);
        // The form is wrong, so the check cannot pass.
        Ok(checked.err().unwrap_or(VerifyError::NotSorted { triangle, corners }))
    }
}

/// The points that are corners, as far as the memory holds a bit for each.
pub struct Used {
    first: u64,
    points: u64,
    bits: Vec<u64>,
}

impl Used {
    fn new(points: u64, memory: u64) -> Self {
        let words = points.div_ceil(64).min(memory / 8).max(1);
        Self { first: 0, points, bits: vec![0; words as usize] }
    }

    fn mark(&mut self, index: u32) {
        let Some(place) = u64::from(index).checked_sub(self.first) else { return };
        if let Some(word) = self.bits.get_mut((place / 64) as usize) {
            *word |= 1 << (place % 64);
        }
    }

    /// The lowest index of a distinct point that is no corner. Reads the mesh again for each further stretch of indices.
    ///
    /// # Errors
    /// The mesh cannot be read or has changed.
    pub fn first_unused(mut self, mesh: &MeshFile, sites: &Sites, memory: u64) -> Result<Option<u32>, Failure> {
        let mut duplicates = sites.duplicates(memory)?;
        loop {
            for (place, &word) in self.bits.iter().enumerate() {
                let first = self.first + place as u64 * 64;
                let mut unused = !word;
                while unused != 0 {
                    let index = first + u64::from(unused.trailing_zeros());
                    if index >= self.points {
                        return Ok(None);
                    }
                    if duplicates.lowest(index as u32)?.is_none() {
                        return Ok(Some(index as u32));
                    }
                    unused &= unused - 1;
                }
            }
            self.first += self.bits.len() as u64 * 64;
            if self.first >= self.points {
                return Ok(None);
            }
            self.bits.fill(0);
            mesh.each(&mut |triangle| {
                triangle.into_iter().for_each(|corner| self.mark(corner));
                Ok(())
            })?;
        }
    }
}
