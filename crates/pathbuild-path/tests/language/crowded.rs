//! Tests crowded points by comparison with a walk that examines all segments in each step. (book: language/chains-and-passes)

use pathbuild_diagnostic::Code;
use pathbuild_path::{Curve, Item, Xy};
use proptest::prelude::*;

use crate::support::{compile, path};

#[derive(Clone, Copy, Debug)]
struct MilledLine {
    start: Xy,
    end: Xy,
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * (a.abs().max(b.abs()) + 0.001)
}

fn coincide(a: Xy, b: Xy) -> bool {
    near((b - a).norm_squared(), 0.0)
}

/// Returns the points of the walk, computed directly from the specification.
fn plain_walk(lines: &[MilledLine]) -> Vec<Xy> {
    let (mut left, mut at, mut points) = ((0..lines.len()).collect::<Vec<_>>(), Xy::origin(), Vec::new());
    let length = |line: usize| (lines[line].end - lines[line].start).norm();
    loop {
        let here = left
            .iter()
            .copied()
            .filter(|line| coincide(lines[*line].start, at) || coincide(lines[*line].end, at));
        let is_before = |a: usize, b: usize| !near(length(a), length(b)) && length(a) < length(b);
        let Some(next) = here.reduce(|best, other| if is_before(other, best) { other } else { best }) else {
            return points;
        };
        left.retain(|line| *line != next);
        at = if coincide(lines[next].end, at) { lines[next].start } else { lines[next].end };
        points.push(at);
    }
}

/// Generates pairs of lines between the centre and several tips, with lengths that are equal, nearly equal, or different.
fn petals() -> impl Strategy<Value = Vec<MilledLine>> {
    let noise = || prop_oneof![Just(0.0), -1e-9..1e-9, -1e-5..1e-5];
    let rest = move || (noise(), any::<bool>());
    prop::collection::vec(((0..40, 0..6, 0..2), rest(), rest()), 1..45).prop_map(|petals| {
        let drawn = |(angle, step, size): (i32, i32, i32), (noise, is_turned): (f64, bool)| {
            let angle = f64::from(angle) * 0.157;
            let length = (10.0 + 3.0 * f64::from(size)) * (1.0 + 0.45e-6 * f64::from(step));
            let (middle, tip) =
                (Xy::new(noise, -noise), Xy::new(libm::cos(angle), libm::sin(angle)) * length);
            let [start, end] = if is_turned { [tip, middle] } else { [middle, tip] };
            MilledLine { start: start.map(written), end: end.map(written) }
        };
        petals.into_iter().flat_map(|(tip, one, other)| [drawn(tip, one), drawn(tip, other)]).collect()
    })
}

/// Rounds a number as in a drawing.
fn written(number: f64) -> f64 {
    (number * 1e9).round() / 1e9
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn segments_are_taken_as_if_all_were_looked_at(lines in petals()) {
        let expected = plain_walk(&lines);
        // As many lines lead from each tip as lead to it, so the walk reaches all of them.
        prop_assert_eq!(expected.len(), lines.len());
        check(&lines, &expected);
    }
}

fn check(lines: &[MilledLine], expected: &[Xy]) {
    let line =
        |it: &MilledLine| format!("mill {:?},{:?} {:?},{:?}\n", it.start.x, it.start.y, it.end.x, it.end.y);
    let end = expected.last().copied().unwrap_or(Xy::origin());
    let drawn = lines.iter().map(line).collect::<String>() + &format!("end {:?},{:?}", end.x, end.y);
    let compiled = compile(&path("T5 O3 I1 B0", &drawn));
    // Some lines coincide.
    assert!(compiled.found.iter().all(|found| found.code() == Code::LeftoverElement), "{:?}", compiled.found);
    let (path, walked) = (compiled.path.expect("it is sound"), compiled.walked);
    let Some(Item::Chain(chain)) = walked.items.first() else { panic!() };
    let ends: Vec<Xy> = walked.members(chain).iter().map(|member| Curve::end(&member.curve(&path))).collect();
    let is_same = |(one, other): (&Xy, &Xy)| (one - other).norm() < 1e-8;
    assert!(ends.len() == expected.len() && ends.iter().zip(expected).all(is_same), "{ends:?}\n{expected:?}");
}

/// An even number of equal lines connects the centre and one tip: all are traversed, in the order drawn.
#[test]
fn lines_that_lie_on_each_other_are_taken_in_the_order_drawn() {
    let line = MilledLine { start: Xy::origin(), end: Xy::new(10.0, 0.0) };
    check(&[line; 40], &plain_walk(&[line; 40]));
}
