//! The files beside a mesh whose constraints were snapped: its points as `.node`, and its constraints as `.poly`.

use std::io::{self, Write};
use std::path::PathBuf;

use crate::arguments::TriangulateArguments;
use crate::failure::Failure;
use crate::formats::{node, MeshFormat};
use crate::output::{Output, Written};
use crate::path::{beside, is_standard};
use crate::plan::PlannedSet;

/// The outputs `.node` and `.poly`, checked before the work; none where the mesh has its points in its own file.
pub struct PlanFiles(Option<[Output; 2]>);

impl PlanFiles {
    /// Prepares the files that a mesh in this format needs if its set has new points. None of them may be an input.
    pub fn prepare(
        (arguments, inputs): (&TriangulateArguments, &[PathBuf]),
        format: MeshFormat,
        set: &PlannedSet,
        has_new: bool,
    ) -> Result<Self, Failure> {
        if !has_new || !matches!(format, MeshFormat::Ele | MeshFormat::Csv | MeshFormat::Npy) {
            return Ok(Self(None));
        }
        let path = &arguments.output;
        if format != MeshFormat::Ele || is_standard(path) {
            return Err(Failure::usage(
                "snapped constraints have new points, which need a file: give -o a file .ele, which gets a .node and a \
                 .poly file beside it, or a format with points such as .obj or .ply",
            ));
        }
        if set.table.needs_mark() {
            return Err(Failure::usage(
                "the snapped points are doubles, which a .node file does not hold exactly: give -o a file .obj or .ply",
            ));
        }
        let prepare = |extension: &str| Output::prepare(&beside(path, extension), inputs);
        Ok(Self(Some([prepare("node")?, prepare("poly")?])))
    }

    /// Writes the points of a set, and its constraints with the places of holes and regions.
    pub fn write(self, set: &PlannedSet) -> Result<Vec<Written>, Failure> {
        let Some([node, poly]) = self.0 else { return Ok(Vec::new()) };
        let points = (0..set.points).map(|index| point(set, index));
        Ok(vec![node.write(|out| node::write_points(points, out))?, poly.write(|out| write_poly(set, out))?])
    }
}

fn point(set: &PlannedSet, index: usize) -> [String; 2] {
    [0, 1].map(|axis| set.table.coordinate(index, axis).to_string())
}

/// Writes a plan whose points stand in the file beside. The marker of a segment is the number of its constraint,
/// counted from 1.
fn write_poly(set: &PlannedSet, out: &mut dyn Write) -> io::Result<()> {
    let Some(request) = &set.request else { return Ok(()) };
    writeln!(out, "0 2 0 0\n{} 1", request.constraints().len())?;
    for (number, &[from, to]) in request.constraints().iter().enumerate() {
        writeln!(out, "{number} {from} {to} {}", u64::from(request.source(number)) + 1)?;
    }
    let holes = request.holes();
    writeln!(out, "{holes}")?;
    for number in 0..holes {
        let [x, y] = point(set, set.points + number);
        writeln!(out, "{number} {x} {y}")?;
    }
    writeln!(out, "{}", request.attributes().len())?;
    for (number, attribute) in request.attributes().iter().enumerate() {
        let [x, y] = point(set, set.points + holes + number);
        writeln!(out, "{number} {x} {y} {attribute}")?;
    }
    Ok(())
}
