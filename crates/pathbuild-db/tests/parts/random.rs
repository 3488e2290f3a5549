//! Tests random outlines with arcs and openings, with paths that are offset exactly, and with paths that are not.

use std::collections::HashSet;

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_path::{Xy, direction};

use crate::{PartTest, number};

/// A corner of a rounded polygon: the ends and the centre of its arc, and whether the corner points out of the part (`is_outer`).
struct Corner {
    from: Xy,
    to: Xy,
    centre: Xy,
    radius: f64,
    is_outer: bool,
}

/// A part with rounded corners and round openings.
struct RandomPart {
    corners: Vec<Corner>,
    openings: Vec<(Xy, f64)>,
    /// The outline as a polygon, with 40 sides for each arc.
    ring: Vec<Xy>,
}

struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

impl RandomPart {
    /// Creates a star-shaped polygon with rounded corners; returns `None` if the arcs do not fit between its sides.
    fn new(random: &mut Random) -> Option<Self> {
        let count = random.between(4.0, 9.0).floor();
        let point = |number: f64, random: &mut Random| {
            let angle = (number + random.between(-0.2, 0.2)) / count * 360.0;
            Xy::origin() + direction(angle) * random.between(22.0, 34.0)
        };
        let points: Vec<Xy> = (0..count as u32).map(|number| point(f64::from(number), random)).collect();
        let mut corners = Vec::new();
        let mut room = Vec::new();
        for (number, at) in points.iter().enumerate() {
            let before = (points[(number + points.len() - 1) % points.len()] - at).normalize();
            let after = (points[(number + 1) % points.len()] - at).normalize();
            let radius = random.between(2.5, 5.0);
            let half = (before + after).normalize();
            // `cosine` and `sine` of the angle between the sides give the distance from the corner to the arc's ends.
            let cosine = half.dot(&after);
            let sine = (1.0 - cosine * cosine).sqrt();
            let tangent = radius * cosine / sine;
            if cosine < 0.02 {
                return None;
            }
            corners.push(Corner {
                from: at + before * tangent,
                to: at + after * tangent,
                centre: at + half * (radius / sine),
                radius,
                is_outer: after.perp(&before) > 0.0,
            });
            room.push(tangent);
        }
        let fits = (0..points.len()).all(|number| {
            let next = (number + 1) % points.len();
            (points[next] - points[number]).norm() > room[number] + room[next] + 0.5
        });
        let openings = vec![
            (Xy::new(-6.0, 0.0), random.between(2.0, 4.0)),
            (Xy::new(7.0, 1.0), random.between(2.0, 5.0)),
        ];
        let ring = corners.iter().flat_map(Corner::points).collect();
        fits.then_some(Self { corners, openings, ring })
    }

    /// Returns the outline shifted outwards by `distance` mm, as elements of a drawing.
    fn contour(&self, distance: f64, line: &str, arc: &str) -> String {
        let shifted: Vec<[Xy; 2]> = self.corners.iter().map(|corner| corner.shifted(distance)).collect();
        let mut text = String::new();
        for (number, corner) in self.corners.iter().enumerate() {
            let ([from, to], next) = (shifted[number], shifted[(number + 1) % shifted.len()][0]);
            let clockwise = if corner.is_outer { "" } else { " cw" };
            let Corner { centre, .. } = corner;
            text += &format!(
                "{arc} {},{} {},{} centre {},{}{clockwise}\n{line} {},{} {},{}\n",
                from.x, from.y, to.x, to.y, centre.x, centre.y, to.x, to.y, next.x, next.y
            );
        }
        text
    }

    /// Returns a drawing of the part and of its path, which runs `distance` mm beside the outline, with another cut.
    fn drawing(&self, tool: f64, distance: f64, other: &str) -> String {
        let start = self.corners[0].shifted(distance)[0];
        let mut text = format!("layer 1234.1P\nstart 60,60 \"T2 O{tool} I1 B-0.2 D0.8 P2 U6 A30 S5\"\n");
        let mut at = "60,60".to_owned();
        for (centre, radius) in &self.openings {
            // The drawn circle is the outer edge of the milled area.
            let diameter = 2.0 * (radius - distance) + tool;
            let to = format!("{},{}", centre.x, centre.y);
            text += &format!("sweep {at} {to}\nmill circle {to} d {diameter}\n");
            at = to;
        }
        text +=
            &format!("sweep {at} {},{}\n{}", start.x, start.y, self.contour(distance, "bars", "mill arc"));
        text += &format!("sweep {},{} 70,60\n{other}end 70,60\nlayer Part\n", start.x, start.y);
        text += &self.contour(0.0, "line", "arc");
        for (centre, radius) in &self.openings {
            text += &format!("circle {},{} r {radius}\n", centre.x, centre.y);
        }
        text
    }

    /// Returns the signed distance from a point to the part, positive outside. This calculation is independent of the code under test.
    fn signed(&self, at: Xy) -> f64 {
        let mut distance = f64::INFINITY;
        for (number, corner) in self.corners.iter().enumerate() {
            let next = self.corners[(number + 1) % self.corners.len()].from;
            let way = next - corner.to;
            let share = (way.dot(&(at - corner.to)) / way.norm_squared()).clamp(0.0, 1.0);
            distance = distance.min((corner.to + way * share - at).norm());
            let out = at - corner.centre;
            let is_beside =
                [corner.from, corner.to].map(|end| (end - corner.centre).perp(&out) * corner.sign());
            if is_beside[0] >= 0.0 && is_beside[1] <= 0.0 {
                distance = distance.min((out.norm() - corner.radius).abs());
            }
        }
        let mut signed = if is_within(&self.ring, at) { -distance } else { distance };
        for (centre, radius) in &self.openings {
            let inside = radius - (at - centre).norm();
            signed = if inside > 0.0 { inside } else { signed.max(inside) };
            if inside > 0.0 {
                return inside;
            }
        }
        signed
    }
}

/// Whether a point is within a polygon: the ray to its right crosses an odd number of sides.
fn is_within(polygon: &[Xy], at: Xy) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let is_crossed = |&(from, to): &(&Xy, &Xy)| {
        (from.y > at.y) != (to.y > at.y)
            && at.x < from.x + (to.x - from.x) * (at.y - from.y) / (to.y - from.y)
    };
    sides.filter(is_crossed).count() % 2 == 1
}

fn rotated<V>(way: V, turn: V) -> V
where
    V: std::ops::Index<usize, Output = f64> + std::ops::IndexMut<usize> + Copy,
{
    let mut turned = way;
    turned[0] = way[0] * turn[0] - way[1] * turn[1];
    turned[1] = way[0] * turn[1] + way[1] * turn[0];
    turned
}

impl Corner {
    fn sign(&self) -> f64 {
        if self.is_outer { 1.0 } else { -1.0 }
    }

    /// Returns points on the corner's arc, from end to end.
    fn points(&self) -> impl Iterator<Item = Xy> {
        const STEPS: u32 = 40;
        let angle = (self.from - self.centre).angle(&(self.to - self.centre)) * self.sign();
        (0..=STEPS).map(move |step| {
            let turn = direction((angle * f64::from(step) / f64::from(STEPS)).to_degrees());
            self.centre + rotated(self.from - self.centre, turn)
        })
    }

    /// Returns the ends of the corner's arc on a path `distance` mm outside.
    fn shifted(&self, distance: f64) -> [Xy; 2] {
        let radius = self.radius + distance * self.sign();
        [self.from, self.to].map(|at| self.centre + (at - self.centre) * (radius / self.radius))
    }
}

fn findings(drawing: &str) -> Vec<Diagnostic> {
    let found = PartTest::default().diagnostics(&[("1234.1P.dxf", drawing)]);
    // Short lines of the contour are left standing as a whole, which is intended.
    found.into_iter().filter(|found| !matches!(&*found.code().to_string(), "PB408" | "PB212")).collect()
}

fn parts(count: usize) -> impl Iterator<Item = (RandomPart, Random)> {
    let mut random = Random(2025);
    let all = std::iter::from_fn(move || {
        let part = RandomPart::new(&mut random);
        Some(part.map(|part| (part, Random(random.0 ^ 0x5555))))
    });
    all.flatten().take(count)
}

const TOOL: f64 = 2.0;

#[test]
fn paths_with_the_right_offset_have_no_findings() {
    for (number, (part, _)) in parts(60).enumerate() {
        let drawing = part.drawing(TOOL, TOOL / 2.0, "");
        let found: Vec<String> = findings(&drawing).iter().map(|found| found.text(Lang::En)).collect();
        assert_eq!(found, [""; 0], "{number}:\n{drawing}");
    }
}

#[test]
fn paths_with_a_wrong_offset_are_found_all_round() {
    for (number, (part, mut random)) in parts(50).enumerate() {
        let wrong = random.between(0.03, 0.9);
        let inside = findings(&part.drawing(TOOL, TOOL / 2.0 - wrong, ""));
        // There must be a finding for each opening, each corner and each side.
        let gouges: Vec<&Diagnostic> =
            inside.iter().filter(|found| found.code().to_string() == "PB213").collect();
        assert!(gouges.len() >= 2 * part.corners.len() + 2, "{number}: {inside:?}");
        for gouge in gouges {
            assert!(
                (number_of(gouge, "depth") - wrong).abs() < 0.01,
                "{number}: {wrong} {}",
                gouge.text(Lang::En)
            );
        }
        let outside = findings(&part.drawing(TOOL, TOOL / 2.0 + wrong, ""));
        let left: Vec<&Diagnostic> =
            outside.iter().filter(|found| found.code().to_string() == "PB215").collect();
        assert!(left.len() > part.corners.len() / 2, "{number}: {wrong} {outside:?}");
        for found in left {
            assert!(
                (number_of(found, "thickness") - wrong).abs() < 0.01,
                "{number}: {wrong} {}",
                found.text(Lang::En)
            );
        }
    }
}

/// A line enters the part from outside: position and depth of the finding agree with sampled distances. Support bars make no difference.
#[test]
fn a_stray_cut_is_found_where_it_is_deepest() {
    for (number, (part, mut random)) in parts(50).enumerate() {
        let away = direction(random.between(0.0, 360.0));
        let aside = direction(random.between(0.0, 360.0));
        let (begin, wrong) = (Xy::origin() + away * 45.0, random.between(0.03, 2.0));
        // The cut ends where its distance from the part is too small by `wrong`.
        let mut reach = 45.0;
        while part.signed(Xy::origin() + away * reach) > TOOL / 2.0 - wrong {
            reach -= 0.1;
        }
        let deep = Xy::origin() + away * reach;
        let end = deep + aside * 3.0;
        let way = |share: f64| {
            if share < 0.5 {
                begin + (deep - begin) * (2.0 * share)
            } else {
                deep + (end - deep) * (2.0 * share - 1.0)
            }
        };
        let depth = |at: Xy| TOOL / 2.0 - part.signed(at);
        let deepest_of = |from: f64, to: f64, samples: u32| {
            let shares =
                (0..=samples).map(|sample| from + (to - from) * f64::from(sample) / f64::from(samples));
            let depths = shares.map(|share| (depth(way(share)), share));
            depths.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
        };
        let (_, coarse) = deepest_of(0.0, 1.0, 600);
        let step = 1.0 / 600.0;
        let (deepest, share) = deepest_of((coarse - step).max(0.0), (coarse + step).min(1.0), 120);
        let place = way(share);
        let verb = ["mill", "bars"][number % 2];
        let other = format!(
            "sweep 70,60 {},{}\n{verb} {},{} {},{} {},{}\nsweep {},{} 70,60\n",
            begin.x, begin.y, begin.x, begin.y, deep.x, deep.y, end.x, end.y, end.x, end.y
        )
        .replace("sweep 70,60", "sweep 75,60");
        let drawing =
            part.drawing(TOOL, TOOL / 2.0, &other).replace(" 70,60\nsweep 75,60", " 75,60\nsweep 75,60");
        let found = findings(&drawing);
        let gouges: Vec<&Diagnostic> =
            found.iter().filter(|found| found.code().to_string() == "PB213").collect();
        let point = |gouge: &Diagnostic| {
            let point = gouge.arguments.iter().find(|(name, _)| *name == "point").map(|(_, value)| value);
            let Some(pathbuild_diagnostic::Value::Point(point)) = point else { panic!("{gouge:?}") };
            Xy::new(point.x.0, point.y.0)
        };
        let best =
            gouges.iter().max_by(|a, b| number_of(a, "depth").total_cmp(&number_of(b, "depth"))).unwrap();
        assert!((number_of(best, "depth") - deepest).abs() < 0.01, "{number}: {deepest} {found:?}");
        let is_as_deep = (depth(point(best)) - deepest).abs() < 1e-5;
        assert!((point(best) - place).norm() < 0.01 || is_as_deep, "{number}: {place} {best:?}");
        for gouge in gouges {
            let own = depth(point(gouge));
            assert!((own - number_of(gouge, "depth")).abs() < 0.01, "{number}: {own} {gouge:?}");
        }
    }
}

fn number_of(found: &Diagnostic, name: &str) -> f64 {
    number(found, name)
}

/// A straight cut.
type Line = [Xy; 2];

/// Returns the sides of a contour 1 mm outside a part of 20 x 12 mm, each whole or with a gap.
fn contour_with_gaps(random: &mut Random) -> Vec<Line> {
    let corners = [[-1.0, -1.0], [21.0, -1.0], [21.0, 13.0], [-1.0, 13.0]].map(Xy::from);
    let mut lines = Vec::new();
    for side in 0..4 {
        let (from, to) = (corners[side], corners[(side + 1) % 4]);
        let (length, way) = ((to - from).norm(), (to - from).normalize());
        let (gap, width) = (random.between(2.0, length - 8.0), random.between(3.0, 6.0));
        if random.between(0.0, 1.0) < 0.3 {
            lines.extend([[from, from + way * gap], [from + way * (gap + width), to]]);
        } else {
            lines.push([from, to]);
        }
    }
    lines
}

/// Returns a line beside a side of the part, from 1.2 to 3.4 mm away.
fn line_beside(random: &mut Random) -> Line {
    let (away, from) = (random.between(1.2, 3.4), random.between(-4.0, 2.0));
    let to = from + random.between(14.0, 26.0);
    let points = match random.between(0.0, 4.0) as u32 {
        0 => [[from, -away], [to, -away]],
        1 => [[from, 12.0 + away], [to, 12.0 + away]],
        2 => [[-away, from], [-away, to]],
        _ => [[20.0 + away, from], [20.0 + away, to]],
    };
    points.map(Xy::from)
}

/// Whether the middle of the part is cut off from the border of a grid by cuts of this radius.
fn is_cut_off(cuts: &[Line], radius: f64) -> bool {
    const STEP: f64 = 0.5;
    const MIDDLE: (i32, i32) = (36, 28);
    let place = |column: i32, row: i32| Xy::new(f64::from(column) * STEP - 8.0, f64::from(row) * STEP - 8.0);
    let is_cut = |at: Xy| {
        cuts.iter().any(|[from, to]| {
            let way = to - from;
            let share = (way.dot(&(at - from)) / way.norm_squared()).clamp(0.0, 1.0);
            (from + way * share - at).norm() < radius
        })
    };
    let mut seen = HashSet::from([MIDDLE]);
    let mut open = vec![MIDDLE];
    while let Some((column, row)) = open.pop() {
        if column == 0 || row == 0 || column == 2 * MIDDLE.0 || row == 2 * MIDDLE.1 {
            return false;
        }
        for next in [(column - 1, row), (column + 1, row), (column, row - 1), (column, row + 1)] {
            if !seen.contains(&next) && !is_cut(place(next.0, next.1)) {
                seen.insert(next);
                open.push(next);
            }
        }
    }
    true
}

/// The second path cuts off bridges that the first one leaves. Cases in which cuts barely meet are not counted.
#[test]
fn parts_are_loose_where_a_grid_is_cut_off() {
    let statements = |lines: &[Line], start: &str| {
        let mut text = String::new();
        let mut at = start.to_owned();
        for [from, to] in lines {
            let (from, to) = (format!("{},{}", from.x, from.y), format!("{},{}", to.x, to.y));
            if at != from {
                text += &format!("sweep {at} {from}\n");
            }
            text += &format!("mill {from} {to}\n");
            at = to;
        }
        format!("{text}sweep {at} 60,-30\nend 60,-30\n")
    };
    let mut random = Random(77);
    let (mut loose, mut held, mut severed) = (0, 0, 0);
    while loose + held < 80 {
        let contour = contour_with_gaps(&mut random);
        let beside = [0; 3].map(|_| line_beside(&mut random));
        let all = [&contour[..], &beside].concat();
        let expected = is_cut_off(&all, 0.65);
        if expected != is_cut_off(&all, 1.35) {
            continue;
        }
        severed += u32::from(expected && !is_cut_off(&contour, 1.35));
        if expected {
            loose += 1;
        } else {
            held += 1;
        }
        let drawing = format!(
            "layer 1234.1P\nstart -30,-30 \"T2 O2 I1 B0 S5\"\n{}layer 1234.2P\nstart -30,-30 \"T2 O2 I1 B0 S5\"\n{}\
             layer Part\npolyline 0,0 20,0 20,12 0,12 closed\n",
            statements(&contour, "-30,-30"),
            statements(&beside, "-30,-30")
        );
        let found = PartTest::default().diagnostics(&[("1234.dxf", &drawing)]);
        let is_loose = found.iter().any(|found| found.code().to_string() == "PB217");
        assert_eq!(is_loose, expected, "{found:?}\n{drawing}");
    }
    assert!(severed >= 5 && held >= 20, "{loose} loose, {severed} of them by the second path, {held} held");
}

/// A window with rounded corners, milled from inside. One side of its path is `short` mm too far from the outline.
struct Window {
    size: Xy,
    radius: f64,
    /// The side that is too far: 0 to 3, counterclockwise from below.
    side: usize,
    short: f64,
}

impl Window {
    fn new(random: &mut Random) -> Self {
        let size = Xy::new(random.between(12.0, 30.0), random.between(12.0, 30.0));
        let side = random.between(0.0, 4.0) as usize;
        let length = if side.is_multiple_of(2) { size.y } else { size.x };
        let radius = random.between(TOOL / 2.0 + 0.05, 4.0);
        Self { size, radius, side, short: random.between(0.1, length - 2.5 * TOOL - 2.0 * radius) }
    }

    /// Returns the lower left and the upper right corner of the path's ring.
    fn ring(&self, short: f64) -> [Xy; 2] {
        let mut low = Xy::new(TOOL / 2.0, TOOL / 2.0);
        let mut high = Xy::new(self.size.x - TOOL / 2.0, self.size.y - TOOL / 2.0);
        match self.side {
            0 => low.y += short,
            1 => high.x -= short,
            2 => high.y -= short,
            _ => low.x += short,
        }
        [low, high]
    }

    /// Returns the drawing of a plate with the window. `roughing`: whether the path mills a short line in the middle of its ring first.
    fn drawing(&self, short: f64, roughing: bool) -> String {
        let [low, high] = self.ring(short);
        let radius = self.radius - TOOL / 2.0;
        let window = rounded("line", "arc", [Xy::origin(), self.size], self.radius);
        let ring = rounded("mill", "mill arc", [low, high], radius);
        let (x, y) = (f64::midpoint(low.x, high.x), f64::midpoint(low.y, high.y));
        let (start, to) = (format!("{},{}", low.x + radius, low.y), format!("{},{y}", x + 0.5));
        let roughing =
            if roughing { format!("mill {x},{y} {to}\nsweep {to}") } else { format!("sweep {x},{y}") };
        format!(
            "layer 1234.1P\nstart {x},{y} \"T2 O{TOOL} I1 B-0.2 S5\"\n{roughing} {start}\n{ring}sweep {start} 60,60\nend 60,60\n\
             layer Part\npolyline -5,-5 40,-5 40,40 -5,40 closed\n{window}"
        )
    }

    /// Returns the largest distance in mm between the outline and the edge of the cuts, from samples. This is independent of the code under test.
    fn thickness(&self, short: f64) -> f64 {
        let outline = rounded_points([Xy::origin(), self.size], self.radius);
        let ring = rounded_points(self.ring(short), self.radius - TOOL / 2.0);
        let nearest = |at: &Xy| ring.iter().map(|cut| (cut - at).norm()).fold(f64::INFINITY, f64::min);
        outline.iter().map(nearest).fold(0.0, f64::max) - TOOL / 2.0
    }
}

/// Returns the corners of a rectangle's arcs, counterclockwise from the lower left: centre, and the angle at which the arc begins.
fn corner_arcs([low, high]: [Xy; 2], radius: f64) -> [(Xy, f64); 4] {
    let (left, right, below, above) = (low.x + radius, high.x - radius, low.y + radius, high.y - radius);
    [(left, below, 180.0), (right, below, 270.0), (right, above, 0.0), (left, above, 90.0)]
        .map(|(x, y, angle)| (Xy::new(x, y), angle))
}

/// Returns the statements of a rectangle with rounded corners, which begins at the lower left.
fn rounded(line: &str, arc: &str, extent: [Xy; 2], radius: f64) -> String {
    let corners = corner_arcs(extent, radius);
    let mut text = String::new();
    for number in 0..4 {
        let ((from, angle), (to, next)) = (corners[number], corners[(number + 1) % 4]);
        let from = from + direction(angle + 90.0) * radius;
        let (begin, end) = (to + direction(next) * radius, to + direction(next + 90.0) * radius);
        text += &format!("{line} {},{} {},{}\n", from.x, from.y, begin.x, begin.y);
        text += &format!("{arc} {},{} {},{} centre {},{}\n", begin.x, begin.y, end.x, end.y, to.x, to.y);
    }
    text
}

/// Returns points at most 0.5 mm apart on a rectangle with rounded corners.
fn rounded_points(extent: [Xy; 2], radius: f64) -> Vec<Xy> {
    let corners = corner_arcs(extent, radius);
    let mut points = Vec::new();
    for number in 0..4 {
        let ((from, angle), (to, next)) = (corners[number], corners[(number + 1) % 4]);
        let (from, to_begin) = (from + direction(angle + 90.0) * radius, to + direction(next) * radius);
        points.extend((0..=60).map(|step| from + (to_begin - from) * (f64::from(step) / 60.0)));
        points.extend((0..=15).map(|step| to + direction(next + 6.0 * f64::from(step)) * radius));
    }
    points
}

/// A side of a window that its path passes is left, however far away the path is. Roughing lines within the ring make no difference.
#[test]
fn a_side_of_a_window_that_the_path_passes_is_left() {
    let mut random = Random(4711);
    for number in 0..60 {
        let window = Window::new(&mut random);
        let left = |short: f64| {
            let mut found = findings(&window.drawing(short, number % 2 == 0));
            // The rim of the plate is not cut.
            found.retain(|found| found.code().to_string() != "PB220");
            found
        };
        assert_eq!(left(0.0), [], "{number}");
        let (found, thickness) = (left(window.short), window.thickness(window.short));
        assert!(
            found.iter().all(|found| found.code().to_string() == "PB215") && !found.is_empty(),
            "{number}: {found:?}"
        );
        let thickest = found.iter().map(|found| number_of(found, "thickness")).fold(0.0, f64::max);
        assert!((thickest - thickness).abs() < 0.1, "{number}: {} {thickness} {found:?}", window.short);
    }
}
