//! A whole job on the software model: points are ordered, inserted one by one, and the mesh is put into canonical form.

use incircle_geometry::{Mesh, Point};
use incircle_model::{Counts, Mesh as ModelMesh};
use incircle_protocol::MAX_MODEL_POINTS;

use crate::assembly::canonical;
use crate::guided::{in_model, GuidedMesh, RING_CAPACITY};
use crate::order::Order;
use crate::prepare::{prepare, Prepared};

/// The mesh of a set, with the counters of the model.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The canonical mesh.
    pub mesh: Mesh,
    /// The counters of the model; all zero if the points lie on one line.
    pub counts: Counts,
}

/// Triangulates on the software model in this order, with the guides of the order if there are any. Unlike the
/// product's back end `model`, the function calls the model directly and encodes no commands.
pub fn triangulate(points: &[Point], order: Order) -> Outcome {
    let Prepared { rounds, guides, duplicates, is_collinear } = prepare(points, order);
    let order = rounds.order;
    if is_collinear {
        let mesh = Mesh::new(points.to_vec(), Vec::new(), order, duplicates);
        return Outcome { mesh, counts: Counts::default() };
    }
    let finish = |mesh: &ModelMesh| Outcome {
        mesh: canonical(mesh.records(), &order, points, duplicates),
        counts: *mesh.counts(),
    };
    let inserted = order.iter().map(|&index| points[index as usize]);
    if guides.is_empty() {
        let mut mesh = ModelMesh::new(MAX_MODEL_POINTS, RING_CAPACITY);
        mesh.reserve(order.len() as u32);
        inserted.for_each(|point| {
            mesh.insert(in_model(point));
        });
        finish(&mesh)
    } else {
        let mut mesh = GuidedMesh::default();
        inserted.zip(guides).for_each(|(point, guide)| {
            mesh.insert(point, Some(guide));
        });
        finish(mesh.mesh())
    }
}
