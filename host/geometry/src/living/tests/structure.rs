//! The invariants of a triangulation's lists.

use crate::living::level::Level;
use crate::living::plane::{Side, INFINITE};
use crate::living::triangulation::Triangulation;
use crate::plane_point::PlanePoint;

/// Panics if a list does not agree with the others.
pub fn check<P: PlanePoint>(mesh: &Triangulation<P>) {
    for (number, level) in mesh.levels.iter().enumerate() {
        check_level(level);
        let chosen = vertices(mesh.base()).into_iter().filter(|&vertex| Triangulation::<P>::top_of(vertex) >= number);
        assert_eq!(level.count, chosen.count(), "level {number}");
        for vertex in vertices(level) {
            let name = level.vertices[vertex as usize].name;
            if number > 0 {
                let below = &mesh.levels[number - 1];
                assert!(below.is_vertex(name) && below.site(name) == level.site(vertex), "level {number}");
            } else {
                assert_eq!(mesh.names.get(name), Some(vertex));
                assert!(Triangulation::<P>::top_of(vertex) < mesh.levels.len(), "a level is missing");
            }
        }
    }
    if let Some(own) = &mesh.constraints {
        check_level(&own.mesh.level);
        assert_eq!(vertices(&own.mesh.level), vertices(mesh.base()));
        for (edge, constraint) in own.mesh.parts.iter() {
            assert!(mesh.constraints().any(|(number, _)| number == constraint));
            assert!(own.mesh.level.adjacent(edge[0]).any(|other| other == edge[1]), "{edge:?} is no edge");
        }
    }
    assert_eq!(mesh.names.len(), mesh.base().count + mesh.duplicates.len());
    assert!(mesh
        .duplicates
        .iter()
        .all(|&(vertex, index)| mesh.name(vertex) < index && mesh.names.get(index) == Some(vertex)));
}

fn vertices<P: PlanePoint>(level: &Level<P>) -> Vec<u32> {
    (0..level.vertices.len() as u32).filter(|&vertex| level.is_vertex(vertex)).collect()
}

fn check_level<P: PlanePoint>(level: &Level<P>) {
    let vertices = vertices(level);
    assert_eq!(vertices.len(), level.count);
    if !level.is_plane() {
        let line: Vec<u32> = level.line.values().copied().collect();
        assert_eq!(line.len(), level.count);
        assert!(level.line.iter().all(|(&site, &vertex)| level.is_vertex(vertex) && level.site(vertex) == site));
        return;
    }
    assert!(level.line.is_empty());
    assert_eq!((level.plane.len(), level.plane.iter().count()), (2 * level.count - 2, 2 * level.count - 2));
    assert!(level.plane.get(level.plane.ghost).infinite_slot().is_some());
    for vertex in vertices {
        assert_eq!(level.plane.apex(level.side_opposite(vertex)), vertex);
    }
    for (triangle, _) in level.plane.iter() {
        for side in (0..3).map(|slot| Side::new(triangle, slot)) {
            let other = level.plane.across(side);
            let [from, to] = level.plane.ends(other);
            assert_eq!((level.plane.across(other), level.plane.ends(side)), (side, [to, from]));
            assert!(level.plane.apex(side) == INFINITE || level.is_vertex(level.plane.apex(side)));
        }
    }
}
