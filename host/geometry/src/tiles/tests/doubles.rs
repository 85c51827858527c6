//! Sets of doubles by tiles.

use incircle_testkit::SplitMix64;

use super::sets::{tie_rich, SIDE};
use super::*;

fn check(points: &[[f64; 2]], at: f64) -> usize {
    let expected = mesh_of(points);
    let mut most = 0;
    for regions in [Region::WHOLE.split_at_x(at), Region::WHOLE.split_at_y(at)] {
        let division = Division::Areas(regions.map(|region| (region, Division::Tile)).to_vec());
        let (found, unknown) = Found::mesh(points, &division);
        assert_eq!(found, expected, "{at} {points:?}");
        most = most.max(unknown);
    }
    most
}

#[test]
fn doubles_cut_at_any_line_have_the_mesh_of_all_points() {
    let mut random = SplitMix64::new(23);
    for seed in 0..2000 {
        // Tenths have no lattice, and their ties are near ties.
        let scale = random.pick(&[1.0, 0.1, 1e-200, 1e90]);
        let points: Vec<[f64; 2]> =
            tie_rich(seed).iter().map(|p| [f64::from(p.x) * scale, f64::from(p.y) * scale]).collect();
        for at in 0..=SIDE {
            check(&points, f64::from(at) * scale);
        }
    }
}

#[test]
fn random_doubles_leave_no_answer_unknown() {
    let mut random = SplitMix64::new(29);
    let points: Vec<[f64; 2]> = (0..5000).map(|_| [random.unit() - 0.5, 1e3 * random.unit()]).collect();
    assert_eq!(check(&points, 0.0), 0);
    assert_eq!(check(&points, 300.0), 0);
}
