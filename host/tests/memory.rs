//! Peak memory of a large job, with the CPU triangulator and the mesh. This test has a program of its own, since the
//! peak is that of the whole process.
#![cfg(target_os = "linux")]

use incircle::Point;
use incircle_testkit::SplitMix64;

/// The peak of the resident memory of this process so far, in bytes.
fn peak_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux tells");
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB"));
    kilobytes.and_then(|text| text.trim().parse::<u64>().ok()).expect("a number of kB") * 1024
}

#[test]
fn a_million_points_take_at_most_200_bytes_each() {
    const POINTS: usize = 1_000_000;
    let points: Vec<Point> = SplitMix64::new(13).points(POINTS, 1 << 16);
    let before = peak_memory();
    let mesh = incircle::triangulate(&points).expect("a mesh");
    let per_point = (peak_memory() - before) as f64 / POINTS as f64;
    println!("{per_point:.0} bytes per point above the input, {} triangles", mesh.triangles.len());
    assert!(per_point > 24.0, "the triangles alone take 24 bytes per point, not {per_point:.0}");
    assert!(per_point <= 200.0, "{per_point:.0} bytes per point");
}
