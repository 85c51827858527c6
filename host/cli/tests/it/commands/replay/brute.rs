//! Random scripts on small lattices, beside plain code: the oracle makes each mesh anew.

use crate::common::Scratch;
use incircle_testkit::{delaunay, orient2d, SplitMix64};

type Place = [u32; 2];

/// The points of a script, by index, and the mesh of those that live.
#[derive(Default)]
struct Brute {
    points: Vec<Option<Place>>,
}

impl Brute {
    fn living(&self) -> Vec<u32> {
        (0u32..).zip(&self.points).filter(|(_, point)| point.is_some()).map(|(index, _)| index).collect()
    }

    fn at(&self, index: u32) -> Place {
        self.points[index as usize].expect("a living point")
    }

    /// The canonical triangles by the indices of the points.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let living = self.living();
        let points: Vec<Place> = living.iter().map(|&index| self.at(index)).collect();
        delaunay(&points).into_iter().map(|triangle| triangle.map(|rank| living[rank as usize])).collect()
    }

    fn nearest(&self, [x, y]: Place) -> String {
        let key = |index: &u32| {
            let [px, py] = self.at(*index);
            (px.abs_diff(x).pow(2) + py.abs_diff(y).pow(2), [px, py], *index)
        };
        self.living().into_iter().min_by_key(key).map_or("none".to_owned(), |index| index.to_string())
    }

    fn locate(&self, q: Place) -> String {
        let names: Vec<u32> = {
            let living = self.living();
            let is_first =
                |&&index: &&u32| !living.iter().any(|&lower| lower < index && self.at(lower) == self.at(index));
            living.iter().filter(is_first).copied().collect()
        };
        if let Some(index) = names.iter().find(|&&index| self.at(index) == q) {
            return format!("vertex {index}");
        }
        let triangles = self.triangles();
        let sides = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
        let all: Vec<[u32; 2]> = triangles.iter().flat_map(|&triangle| sides(triangle)).collect();
        let mut sorted = names.clone();
        sorted.sort_by_key(|&index| self.at(index));
        let line = if triangles.is_empty() { sorted.windows(2) } else { [].windows(2) };
        for [a, b] in all.iter().copied().chain(line.map(|pair| [pair[0], pair[1]])) {
            let (low, high) = (self.at(a).min(self.at(b)), self.at(a).max(self.at(b)));
            if orient2d(low, high, q) == 0 && low < q && q < high {
                return format!("edge {} {}", a.min(b), a.max(b));
            }
        }
        let side = |[a, b]: [u32; 2]| orient2d(self.at(a), self.at(b), q);
        if let Some([a, b, c]) = triangles.iter().find(|&&t| sides(t).into_iter().all(|edge| side(edge) > 0)) {
            return format!("triangle {a} {b} {c}");
        }
        let hull: Vec<[u32; 2]> = all.iter().copied().filter(|&[a, b]| !all.contains(&[b, a])).collect();
        let is_hidden_before = |[a, _]: [u32; 2]| hull.iter().any(|&edge| edge[1] == a && side(edge) >= 0);
        let first = hull.iter().find(|&&edge| side(edge) < 0 && is_hidden_before(edge));
        first.map_or("none".to_owned(), |[a, b]| format!("outside {a} {b}"))
    }
}

/// A random script with a question after most changes, and the answers.
fn script(random: &mut SplitMix64, side: u32) -> (String, String, Brute) {
    let (mut script, mut answers, mut brute) = (String::new(), String::new(), Brute::default());
    for _ in 0..60 {
        let q = [0, 1].map(|_| random.below_u32(side));
        let [x, y] = q;
        let living = brute.living();
        match (random.below(8), living.is_empty()) {
            (0..=2, _) | (_, true) => {
                brute.points.push(Some(q));
                script += &format!("insert {x} {y}\n");
            }
            (3, _) => {
                let index = random.pick(&living);
                brute.points[index as usize] = None;
                script += &format!("delete {index}\n");
            }
            (4, _) => {
                let index = random.pick(&living);
                brute.points[index as usize] = Some(q);
                script += &format!("move {index} {x} {y}\n");
            }
            (5, _) => {
                answers += &format!("{}\n", brute.nearest(q));
                script += &format!("nearest {x} {y}\n");
            }
            _ => {
                answers += &format!("{}\n", brute.locate(q));
                script += &format!("locate {x} {y}\n");
            }
        }
    }
    (script, answers, brute)
}

/// Replays random scripts on one of these back ends after another.
fn replay_scripts(backends: &[&str], scripts: usize) {
    let scratch = Scratch::new();
    let mut random = SplitMix64::new(24);
    for number in 0..scripts {
        let side = [2, 3, 5, 40][number % 4];
        let (text, answers, brute) = script(&mut random, side);
        scratch.write("s.txt", &text);
        let backend = backends[number / 4 % backends.len()];
        scratch.run(&format!("replay s.txt -o m.csv --answers a.txt --backend {backend} -q")).ok();
        assert_eq!(scratch.read("a.txt"), answers, "{text}");
        let triangles = brute.triangles();
        let expected: String = triangles.iter().map(|[a, b, c]| format!("{a},{b},{c}\n")).collect();
        assert_eq!(scratch.read("m.csv"), expected, "{text}");
        scratch.run("verify s.txt m.csv --script -q").ok();
    }
}

#[test]
fn random_scripts_give_the_mesh_and_the_answers_of_brute_force() {
    replay_scripts(&["cpu", "model"], 120);
}

#[test]
#[cfg(feature = "sim")]
fn random_scripts_on_a_simulated_core_give_the_mesh_and_the_answers_of_brute_force() {
    replay_scripts(&["sim?living=yes"], 24);
}

/// The mesh has the bytes of `triangulate` for the living points, if none was deleted.
#[test]
fn a_script_of_insertions_is_a_set_of_points() {
    let scratch = Scratch::new();
    for numbers in ["whole", "decimal", "double"] {
        scratch.run(&format!("generate clusters -n 500 --numbers {numbers} --seed 3 -o p.csv")).ok();
        let rows = scratch.read("p.csv");
        let script: String = rows.lines().map(|row| format!("insert {}\n", row.replace(',', " "))).collect();
        scratch.write("s.txt", script);
        for format in ["obj", "json", "ply", "npy", "svg", "vtk"] {
            scratch.run(&format!("triangulate p.csv -o p.{format} -q")).ok();
            scratch.run(&format!("replay s.txt -o s.{format} -q")).ok();
            let bytes = |name: String| std::fs::read(scratch.path(&name)).expect("a mesh");
            assert!(bytes(format!("p.{format}")) == bytes(format!("s.{format}")), "{numbers} {format}");
        }
    }
}
