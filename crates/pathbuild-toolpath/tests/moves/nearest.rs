//! Tests the choice of the next edge in long chains against a scan over all edges. (book: program/gcode)

use pathbuild_path::approx::above;

use crate::support::{moves, path, short};

type Point = (f64, f64);

/// An edge that remains to be milled: its ends in walking order, and its height.
struct Edge {
    start: Point,
    end: Point,
    z: f64,
    /// Index of the edge above this one, which must be milled first.
    above: Option<usize>,
    is_done: bool,
}

/// Returns the points of a reproducible random walk on a grid, which gives many ties.
fn wander(steps: usize, scale: f64) -> Vec<Point> {
    let mut state = 0x9e37_79b9_u32;
    let mut random = |below: u32| {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state % below
    };
    let mut points = vec![(0.0, 0.0)];
    while points.len() <= steps {
        let (x, y) = points[points.len() - 1];
        let along = scale * (f64::from(random(3)) - 1.0);
        let next = if random(2) == 0 { (x + along, y) } else { (x, y + along) };
        if next != (x, y) {
            points.push(next);
        }
    }
    points
}

/// Returns the moves found by a scan: from the nearer end of the nearest edge to its other end, and so on.
fn scanned(points: &[Point], depths: &[f64]) -> Vec<String> {
    let pairs = points.windows(2);
    let mut edges: Vec<Edge> = pairs
        .flat_map(|pair| depths.iter().map(|z| (pair[0], pair[1], *z)).collect::<Vec<_>>())
        .enumerate()
        .map(|(index, (start, end, z))| {
            let above = (index % depths.len() > 0).then(|| index - 1);
            Edge { start, end, z, above, is_done: false }
        })
        .collect();
    let (mut at, mut height) = (points[0], depths[0]);
    let mut lines = Vec::new();
    while let Some((index, is_backwards)) = nearest(&edges, at, height) {
        edges[index].is_done = true;
        let edge = &edges[index];
        (at, height) = (if is_backwards { edge.start } else { edge.end }, edge.z);
        lines.push(format!("M {},{} {}", short(at.0), short(at.1), short(height)));
    }
    lines
}

fn nearest(edges: &[Edge], at: Point, height: f64) -> Option<(usize, bool)> {
    let mut best: Option<(f64, usize, bool)> = None;
    for (index, edge) in edges.iter().enumerate() {
        if edge.is_done || edge.above.is_some_and(|above| !edges[above].is_done) {
            continue;
        }
        let to = |point: Point| {
            let (x, y, z) = (point.0 - at.0, point.1 - at.1, edge.z - height);
            libm::sqrt(x * x + y * y + z * z)
        };
        let is_backwards = !above(to(edge.end), to(edge.start));
        let least = if is_backwards { to(edge.end) } else { to(edge.start) };
        if best.is_none_or(|(nearest, ..)| above(nearest, least)) {
            best = Some((least, index, is_backwards));
        }
    }
    best.map(|(_, index, is_backwards)| (index, is_backwards))
}

#[track_caller]
fn assert_scanned(scale: f64, points: &[Point]) {
    let way: Vec<String> = points.iter().map(|(x, y)| format!("{},{}", short(*x), short(*y))).collect();
    let drawing = path("T5 O3 I2 B0", &format!("mill {}\nend {}", way.join(" "), way[way.len() - 1]));
    let milled: Vec<String> = moves(&drawing).into_iter().filter(|line| line.starts_with('M')).collect();
    assert_eq!(milled, scanned(points, &[3.0, 1.0, 0.0]), "grid of {scale} mm");
}

#[test]
fn the_nearest_edge_of_a_long_chain_is_that_of_a_scan() {
    // The distances are much greater than, equal to, and less than the infeed.
    for scale in [10.0, 2.0, 0.5] {
        // Each point occurs once, so that the walk follows the drawing.
        let mut points = wander(400, scale);
        let mut seen = Vec::new();
        points.retain(|point| {
            let is_new = !seen.contains(point);
            seen.push(*point);
            is_new
        });
        assert!(points.len() > 20);
        assert_scanned(scale, &points);
    }
}
