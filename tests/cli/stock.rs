//! Compares the picture of the stock (`view --stock`) with heights that are calculated exactly, move by move. (book: program/pictures)
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small numbers of moves and points"
)]

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

use serde_json::Value;

use crate::support::{self, Place};

type Point = [f64; 2];

/// Distance in px within which the picture may show the colour of a neighbouring point. A circle is drawn as two half circles; rounding their ends
/// and their radius to hundredths of a pixel moves their middle by up to a pixel.
const ROUNDED: f64 = 1.1;

/// Width in px of the line along the edges of cuts.
const EDGE_WIDTH: f64 = 0.7;

/// Number of steps into which the picture divides the deepest slope. A step has the height of its upper end.
const STEPS: f64 = 64.0;

/// Difference between the red components of the colours for the least and the greatest depth.
const SHADES: f64 = 115.0 - 189.0;

/// A move with the cutter and the stock under it, in the coordinates of the drawing.
struct StockMove {
    is_rapid: bool,
    from: [f64; 3],
    to: [f64; 3],
    arc: Option<TurningMove>,
    radius: f64,
    top: f64,
    through: f64,
    /// Lower left and upper right corner of the bounding box of the tool's course.
    extent: [Point; 2],
}

struct TurningMove {
    centre: Point,
    clockwise: bool,
    angle: f64,
}

/// The exact state of the stock at a point after all moves.
#[derive(Clone, Copy, Debug)]
struct Exact {
    height: f64,
    through: f64,
    /// Whether a rapid move ran through material.
    is_hit: bool,
}

impl StockMove {
    /// Reads a move of a scene; returns `None` for a probing move, or if the position is not known.
    fn of(scene: &Value, path: &Value, movement: &Value) -> Option<Self> {
        let kind = movement["kind"].as_str()?;
        let zero = point(&path["zero"])?;
        let end =
            |end: &Value| Some([end[0].as_f64()? + zero[0], end[1].as_f64()? + zero[1], end[2].as_f64()?]);
        let arc = movement["arc"].as_object().map(|arc| {
            let centre = point(&arc["centre"]).unwrap();
            TurningMove {
                centre: [centre[0] + zero[0], centre[1] + zero[1]],
                clockwise: arc["clockwise"].as_bool().unwrap(),
                angle: arc["degrees"].as_f64().unwrap().to_radians(),
            }
        });
        let element = movement["element"].as_u64().map(|element| &path["elements"][element as usize]);
        let component = element.map_or(0, |element| element["path"].as_u64().unwrap());
        let component = &path["embedded"][component as usize];
        let top = component["thickness"].as_f64().or(path["thickness"].as_f64())?;
        let raised = component["raised"].as_f64().unwrap_or(0.0);
        let through = raised + scene["through"].as_f64()?;
        let (from, to) = (end(&movement["from"])?, end(&movement["to"])?);
        (kind != "probe").then_some(Self {
            is_rapid: matches!(kind, "sweep" | "lift"),
            extent: extent([[from[0], from[1]], [to[0], to[1]]], arc.as_ref()),
            from,
            to,
            arc,
            radius: path["tool"].as_f64()? / 2.0,
            top,
            through: if top > raised { through } else { f64::NEG_INFINITY },
        })
    }

    fn is_near(&self, [x, y]: Point, reach: f64) -> bool {
        let [low, high] = self.extent;
        let reach = reach + self.radius;
        x > low[0] - reach && x < high[0] + reach && y > low[1] - reach && y < high[1] + reach
    }

    /// Returns the heights of the tip when the cutter reaches a point and when it leaves the point again.
    fn heights_over(&self, at: Point) -> Vec<[f64; 2]> {
        let shares = match &self.arc {
            Some(arc) => arc.over(self.flat(), at, self.radius),
            None => line_over(self.flat(), at, self.radius).into_iter().collect(),
        };
        let height = |share: f64| self.from[2] + (self.to[2] - self.from[2]) * share;
        shares.into_iter().map(|shares| shares.map(height)).collect()
    }

    fn flat(&self) -> [Point; 2] {
        [[self.from[0], self.from[1]], [self.to[0], self.to[1]]]
    }

    fn is_vertical(&self) -> bool {
        self.arc.is_none() && self.from[..2] == self.to[..2]
    }
}

impl TurningMove {
    /// Returns the angle from one point to another, in the direction of the move.
    fn turned(&self, from: Point, to: Point) -> f64 {
        let direction = |at: Point| libm::atan2(at[1] - self.centre[1], at[0] - self.centre[0]);
        let angle = direction(to) - direction(from);
        (if self.clockwise { -angle } else { angle }).rem_euclid(TAU)
    }

    /// Returns the shares of the move, from 0 to 1, between which a cutter is over a point.
    fn over(&self, [from, _]: [Point; 2], at: Point, radius: f64) -> Vec<[f64; 2]> {
        let (own, away) = (distance(self.centre, from), distance(self.centre, at));
        if away > own + radius || away < own - radius {
            return Vec::new();
        }
        let cosine = (away * away + own * own - radius * radius) / (2.0 * away * own);
        let half = if away == 0.0 || cosine <= -1.0 { TAU / 2.0 } else { libm::acos(cosine.min(1.0)) };
        let middle = self.turned(from, at);
        let turns = [-TAU, 0.0, TAU].map(|turn| middle + turn);
        let ends = turns.map(|middle| [(middle - half).max(0.0), (middle + half).min(self.angle)]);
        let shares = ends.map(|ends| ends.map(|angle| angle / self.angle));
        shares.into_iter().filter(|[begin, end]| begin <= end).collect()
    }
}

fn extent([from, to]: [Point; 2], arc: Option<&TurningMove>) -> [Point; 2] {
    let mut all = vec![from, to];
    if let Some(arc) = arc {
        let radius = distance(arc.centre, from);
        let out = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let outermost = out.map(|[x, y]| [arc.centre[0] + x * radius, arc.centre[1] + y * radius]);
        all.extend(outermost.into_iter().filter(|at| arc.turned(from, *at) <= arc.angle));
    }
    let side =
        |axis: usize, choose: fn(f64, f64) -> f64| all.iter().map(|at| at[axis]).reduce(choose).unwrap();
    [[side(0, f64::min), side(1, f64::min)], [side(0, f64::max), side(1, f64::max)]]
}

/// Returns the shares of a line, from 0 to 1, between which a cutter is over a point.
fn line_over([from, to]: [Point; 2], at: Point, radius: f64) -> Option<[f64; 2]> {
    let length = distance(from, to);
    if length == 0.0 {
        return (distance(from, at) <= radius).then_some([0.0, 1.0]);
    }
    let way = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    let out = [at[0] - from[0], at[1] - from[1]];
    let (along, beside) = (out[0] * way[0] + out[1] * way[1], out[1] * way[0] - out[0] * way[1]);
    let half = (radius * radius - beside * beside).max(0.0).sqrt();
    let ends = [(along - half).max(0.0) / length, (along + half).min(length) / length];
    (beside.abs() <= radius && ends[0] <= ends[1]).then_some(ends)
}

/// The moves of a scene, and the stock around them.
struct ExactStock {
    moves: Vec<StockMove>,
    top: f64,
    low: f64,
    /// Lower left and upper right corner of the stock.
    blank: [Point; 2],
}

/// Height in mm of material above a rapid move that is attributed to rounding.
const RESIDUE: f64 = 0.002;

impl ExactStock {
    /// Reads the stock of a scene; returns `None` if it has several upper faces.
    fn of(scene: &Value) -> Option<Self> {
        let mut moves = Vec::new();
        for path in scene["paths"].as_array().unwrap() {
            let all = path["moves"].as_array().unwrap().iter();
            moves.extend(all.filter_map(|movement| StockMove::of(scene, path, movement)));
        }
        let cuts = || moves.iter().filter(|movement| !movement.is_rapid);
        let top = cuts().next()?.top;
        let low = cuts().map(|cut| cut.from[2].min(cut.to[2])).reduce(f64::min)?;
        let mut blank = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let is_low = |movement: &&StockMove| movement.from[2].min(movement.to[2]) < top.min(movement.top);
        let low_rapids = moves.iter().filter(|movement| movement.is_rapid).filter(is_low);
        for movement in cuts().chain(low_rapids) {
            let [least, most] = movement.extent;
            for axis in [0, 1] {
                blank[0][axis] = blank[0][axis].min(least[axis] - 2.0 * movement.radius);
                blank[1][axis] = blank[1][axis].max(most[axis] + 2.0 * movement.radius);
            }
        }
        let has_one_top = cuts().all(|cut| cut.top == top);
        has_one_top.then_some(Self { moves, top, low, blank })
    }

    fn at(&self, at: Point) -> Exact {
        let mut exact = Exact { height: self.top, through: f64::NEG_INFINITY, is_hit: false };
        for movement in self.moves.iter().filter(|movement| movement.is_near(at, 0.0)) {
            for [from, to] in movement.heights_over(at) {
                // A sloping rapid move is taken at its highest position.
                let rapid =
                    if movement.is_vertical() { from.min(to) } else { movement.from[2].max(movement.to[2]) };
                if !movement.is_rapid && from.min(to) < exact.height {
                    (exact.height, exact.through) = (from.min(to), movement.through);
                }
                let goes_up = movement.is_vertical() && to >= from;
                exact.is_hit |= movement.is_rapid && !goes_up && rapid + RESIDUE < exact.height;
            }
        }
        exact
    }

    /// Returns the exact states at a point and at points close to it.
    fn around(&self, at: Point, away: f64) -> Vec<Exact> {
        let beside = ring(at, away).into_iter().chain(ring(at, away / 2.0));
        std::iter::once(at).chain(beside).map(|at| self.at(at)).collect()
    }
}

fn ring([x, y]: Point, away: f64) -> [Point; 16] {
    std::array::from_fn(|number| {
        let (sin, cos) = libm::sincos(TAU * number as f64 / 16.0);
        [x + away * cos, y + away * sin]
    })
}

/// A stroke of the picture along the course of a tool.
struct Stroke {
    color: String,
    radius: f64,
    pieces: Vec<StrokePiece>,
}

enum StrokePiece {
    Line([Point; 2]),
    Arc([Point; 2], TurningMove),
}

/// A picture of the stock, as its SVG paints it.
struct Still {
    strokes: Vec<Stroke>,
    /// Upper left corner of the stock in px.
    corner: Point,
    /// Scale in px per mm.
    scale: f64,
    blank: [Point; 2],
}

impl Still {
    fn of(svg: &str, blank: [Point; 2]) -> Self {
        let document = roxmltree::Document::parse(svg).unwrap();
        let clip = document
            .descendants()
            .find(|node| node.has_tag_name("clipPath") && node.attribute("id") == Some("stock"));
        let data = clip.unwrap().first_element_child().unwrap().attribute("d").unwrap();
        let [(_, corner), (_, right), ..] = &commands(data)[..] else { panic!("{data}") };
        let stock =
            document.descendants().find(|node| node.attribute("clip-path") == Some("url(#stock)")).unwrap();
        let stroke = |node: roxmltree::Node<'_, '_>| {
            assert!(node.has_tag_name("path"), "no part is wrong here: {node:?}");
            Stroke {
                color: node.attribute("stroke").unwrap().to_owned(),
                radius: node.attribute("stroke-width").unwrap().parse::<f64>().unwrap() / 2.0,
                pieces: pieces(node.attribute("d").unwrap()),
            }
        };
        Self {
            strokes: stock.children().filter(roxmltree::Node::is_element).map(stroke).collect(),
            corner: [corner[0], corner[1]],
            scale: (right[0] - corner[0]) / (blank[1][0] - blank[0][0]),
            blank,
        }
    }

    /// Returns the colour at a point of the drawing; `None` where nothing is cut.
    fn color(&self, [x, y]: Point) -> Option<&str> {
        let at = [
            self.corner[0] + (x - self.blank[0][0]) * self.scale,
            self.corner[1] + (self.blank[1][1] - y) * self.scale,
        ];
        let is_over = |stroke: &&Stroke| stroke.pieces.iter().any(|piece| piece.is_over(at, stroke.radius));
        self.strokes.iter().rev().find(is_over).map(|stroke| &*stroke.color)
    }
}

impl StrokePiece {
    fn is_over(&self, at: Point, radius: f64) -> bool {
        match self {
            Self::Line(ends) => line_over(*ends, at, radius).is_some(),
            Self::Arc(ends, arc) => !arc.over(*ends, at, radius).is_empty(),
        }
    }
}

/// Splits a path's data into its commands, each with its numbers.
fn commands(data: &str) -> Vec<(char, Vec<f64>)> {
    let begins = data.char_indices().filter(|(_, letter)| letter.is_ascii_uppercase());
    let begins: Vec<(usize, char)> = begins.collect();
    let command = |(number, (begin, letter)): (usize, &(usize, char))| {
        let end = begins.get(number + 1).map_or(data.len(), |(end, _)| *end);
        let numbers = data[begin + 1..end].split_whitespace().map(|number| number.parse().unwrap());
        (*letter, numbers.collect())
    };
    begins.iter().enumerate().map(command).collect()
}

fn pieces(data: &str) -> Vec<StrokePiece> {
    let mut at = [0.0; 2];
    let mut all = Vec::new();
    for (letter, numbers) in commands(data) {
        let to = [numbers[numbers.len() - 2], numbers[numbers.len() - 1]];
        match letter {
            'M' => {}
            'L' => all.push(StrokePiece::Line([at, to])),
            'A' if at == to => {}
            'A' => all.push(half_circle([at, to], numbers[0], numbers[4] == 1.0)),
            _ => panic!("{data}"),
        }
        at = to;
    }
    all
}

/// Returns an arc of at most half a turn. Y points down on the page.
fn half_circle([from, to]: [Point; 2], radius: f64, is_clockwise: bool) -> StrokePiece {
    let chord = distance(from, to);
    let radius = radius.max(chord / 2.0);
    let high = (radius * radius - chord * chord / 4.0).max(0.0).sqrt() / chord;
    let side = if is_clockwise { high } else { -high };
    let centre = [
        f64::midpoint(from[0], to[0]) - (to[1] - from[1]) * side,
        f64::midpoint(from[1], to[1]) + (to[0] - from[0]) * side,
    ];
    let mut arc = TurningMove { centre, clockwise: !is_clockwise, angle: 0.0 };
    arc.angle = arc.turned(from, to);
    StrokePiece::Arc([from, to], arc)
}

const UNTOUCHED: &str = "#dbbd85";
const THROUGH: &str = "#ccd6e0";
const EDGE: &str = "#4a3012";
const WRONG: &str = "#e50d1a";

/// Describes what is wrong with the colour of a point; `None` if nothing is.
fn fault(still: &Still, exact: &ExactStock, at: Point) -> Option<String> {
    let step = ((exact.top - exact.low) / STEPS).max(1e-3);
    let shade = (exact.top - exact.low) / SHADES.abs();
    let color = still.color(at).unwrap_or(UNTOUCHED);
    let is_surely_hit = || exact.at(at).is_hit && exact.around(at, WIDE).iter().all(|there| there.is_hit);
    if color == WRONG {
        return (!is_hit_near(exact, at)).then(|| "no rapid move comes near".to_owned());
    }
    if is_surely_hit() {
        return Some("a rapid move through material is not shown".to_owned());
    }
    if color == EDGE {
        let around = exact.around(at, (EDGE_WIDTH + ROUNDED) / still.scale);
        let heights = || around.iter().map(|there| there.height);
        let is_flat = heights().fold(f64::INFINITY, f64::min) == heights().fold(f64::NEG_INFINITY, f64::max);
        return is_flat.then(|| "there is no edge".to_owned());
    }
    let is_right = |there: &Exact| {
        let is_through = |height: f64| height <= there.through;
        match color {
            UNTOUCHED => there.height + step >= exact.top,
            THROUGH => is_through(there.height),
            _ => {
                let red = f64::from(u8::from_str_radix(&color[1..3], 16).unwrap());
                let shown = exact.top + (189.0 - red) / SHADES * (exact.top - exact.low);
                let is_cut = there.height < exact.top && !is_through(there.height + step);
                let is_step = there.height < exact.top && !is_through(there.height);
                (is_cut || is_step || is_through(there.height) && !is_through(there.height + step))
                    && shown > there.height - shade
                    && shown < there.height.max(there.through) + step + shade
            }
        }
    };
    let around = exact.around(at, ROUNDED / still.scale);
    (!around.iter().any(is_right)).then(|| format!("{color} at {:?}", around[0]))
}

/// Distance in mm from the edge of a collision within which the picture may be wrong, because rapid moves into material are found on a coarse map.
const WIDE: f64 = 0.4;

/// Whether a rapid move hits material near a point. A piece of such a move is drawn red as a whole.
fn is_hit_near(exact: &ExactStock, [x, y]: Point) -> bool {
    let reach = exact.moves.iter().map(|movement| movement.radius).fold(0.0, f64::max) * 2.5;
    let grid = || (-20..=20).map(|step| reach * f64::from(step) / 20.0);
    grid().any(|dx| grid().any(|dy| exact.at([x + dx, y + dy]).is_hit))
}

/// Random points of the stock: some anywhere, some near the cuts.
struct Points {
    state: u64,
}

impl Points {
    fn share(&mut self) -> f64 {
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn anywhere(&mut self, [low, high]: [Point; 2]) -> Point {
        [0, 1].map(|axis| low[axis] + (high[axis] - low[axis]) * self.share())
    }

    fn near(&mut self, exact: &ExactStock) -> Point {
        let chosen = (self.share() * exact.moves.len() as f64) as usize;
        let movement = &exact.moves[chosen];
        let [low, high] = movement.extent;
        let reach = 1.5 * movement.radius;
        let at = self.anywhere([low.map(|side| side - reach), high.map(|side| side + reach)]);
        let [low, high] = exact.blank;
        [0, 1].map(|axis| at[axis].clamp(low[axis], high[axis]))
    }
}

/// Cutter and surface for a program of other origin.
#[derive(Clone, Copy)]
struct Given {
    cutter: f64,
    surface: f64,
}

/// Compares the picture of a program with its exact heights. Returns the numbers of points that are cut through, cut, untouched and hit, or `None`
/// for a program with several upper faces.
fn compare(place: &Place, name: &str, given: Option<Given>, points: &mut Points) -> Option<[usize; 4]> {
    let options = given.map(|Given { cutter, surface }| format!("--cutter {cutter} --surface {surface} "));
    for more in ["-o stock.json".to_owned(), format!("--stock {}-o stock.svg", options.unwrap_or_default())] {
        let run = place.run(&format!("view {name} {more}"));
        // A random program may have rapid moves through material.
        assert!(run.status == Some(0) || given.is_some() && run.status == Some(1), "{run}");
    }
    let mut scene: Value = serde_json::from_str(&place.read("stock.json")).unwrap();
    if let Some(Given { cutter, surface }) = given {
        scene["paths"][0]["tool"] = cutter.into();
        scene["paths"][0]["thickness"] = surface.into();
    }
    let exact = ExactStock::of(&scene)?;
    let still = Still::of(&place.read("stock.svg"), exact.blank);
    let mut counts = [0; 4];
    for number in 0..POINTS {
        let at = if number % 4 == 0 { points.anywhere(exact.blank) } else { points.near(&exact) };
        let fault = fault(&still, &exact, at);
        assert_eq!(fault, None, "{name} at {at:?}, {} px per mm", still.scale);
        let Exact { height, through, is_hit } = exact.at(at);
        let class = if is_hit {
            3
        } else if height <= through {
            0
        } else if height < exact.top {
            1
        } else {
            2
        };
        counts[class] += 1;
    }
    Some(counts)
}

const POINTS: u32 = 120;

fn point(value: &Value) -> Option<Point> {
    Some([value[0].as_f64()?, value[1].as_f64()?])
}

fn distance(one: Point, other: Point) -> f64 {
    libm::hypot(other[0] - one[0], other[1] - one[1])
}

/// Returns a program with cuts at all heights, slopes, arcs and rapid moves, some of which run through material.
fn random_program(points: &mut Points) -> String {
    let mut text = String::from("G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\n");
    let mut at: Point = [0.0; 2];
    for _ in 0..40 {
        let kind = (points.share() * 8.0) as u32;
        let mut round =
            |low: f64, high: f64| ((low + (high - low) * points.share()) * 1000.0).round() / 1000.0;
        let ([x, y], z) = ([round(0.0, 60.0), round(0.0, 40.0)], round(-4.0, 0.5));
        match kind {
            0..3 => _ = writeln!(text, "G1 X{x} Y{y}"),
            3 => _ = writeln!(text, "G1 X{x} Y{y} Z{z}"),
            4 => {
                let (i, j) = (round(-8.0, 8.0), round(2.0, 8.0));
                _ = writeln!(text, "G2 X{} Y{} I{i} J{j}", at[0], at[1]);
                continue;
            }
            5 => {
                // The arc is half a turn.
                let (i, j) = (round(-6.0, 6.0), round(1.0, 6.0));
                let to = [at[0] + 2.0 * i, at[1] + 2.0 * j];
                _ = writeln!(text, "G3 X{:.3} Y{:.3} I{i} J{j} Z{z}", to[0], to[1]);
                at = to.map(|side| (side * 1000.0).round() / 1000.0);
                continue;
            }
            6 => _ = writeln!(text, "G0 Z3\nG0 X{x} Y{y}\nG1 Z{z}"),
            _ => _ = writeln!(text, "G0 X{x} Y{y}"),
        }
        at = [x, y];
    }
    text + "G0 Z5\nM30\n"
}

#[test]
fn the_still_shows_the_exact_heights() {
    let library = support::project().join("fixtures/library");
    let place = Place::new();
    for folder in ["components", "projects"] {
        copy(&library.join(folder), &place.path().join(folder));
    }
    let place = place.file("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\nprobe-feed = 40\nlibrary = [\"components\", \"projects\"]\nsearch = [\"components\"]\npart = 'Part'\n");
    let mut points = Points { state: 34 };
    let mut all = Vec::new();
    for name in ["8001.1P", "8002.1P", "8003.1P", "8102.1P", "8103.1P", "8104.1P"] {
        all.extend(compare(&place, name, None, &mut points));
    }
    for name in (2050..=2070).map(|number| format!("{number}.1P")) {
        all.extend(compare(&place, &name, None, &mut points));
    }
    for number in 0..12 {
        let place = Place::new().file("a.nc", random_program(&mut points));
        // Cuts at or below Z0 go through if the upper face lies above it.
        let given = Given { cutter: 3.0, surface: f64::from(number % 2) };
        all.extend(compare(&place, "a.nc", Some(given), &mut points));
    }
    assert!(all.len() >= 30, "{} programs", all.len());
    let sums = all.iter().fold([0; 4], |sum, next| std::array::from_fn(|class| sum[class] + next[class]));
    assert!(sums.iter().all(|count| *count > 100), "{sums:?} points");
}

/// Copies the drawings of a folder.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let file = entry.unwrap().path();
        std::fs::copy(&file, to.join(file.file_name().unwrap())).unwrap();
    }
}

/// Returns the number of moves and pieces of moves that the picture of an arc in the plane G18 shows, and of different colours. The arc begins and
/// ends 1 mm below the surface, 20 mm apart.
fn shown_of_an_upright_arc(word: &str) -> [usize; 2] {
    let program = format!(
        "G17 G21 G90 G94\nS9000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG18\n{word} X20 Z-1 I10 K0\nG17\nG0 Z5\nM5\nM30\n"
    );
    let place = Place::new().file("a.nc", program);
    let run = place.run("view a.nc --dialect linuxcnc --stock --cutter 3 --surface 0 -o a.svg");
    assert!(matches!(run.status, Some(0 | 1)), "{run}");
    let svg = place.read("a.svg");
    let cuts = svg.split_once("clip-path=\"url(#stock)\"").unwrap().1.split_once("</g>").unwrap().0;
    let lines: Vec<&str> = cuts.lines().filter(|line| line.contains("stroke=\"#")).collect();
    let color = |line: &&str| line.split_once("stroke=\"").unwrap().1[..7].to_owned();
    let colors: BTreeSet<String> = lines.iter().map(color).collect();
    [lines.iter().map(|line| line.matches('M').count()).sum(), colors.len()]
}

#[test]
fn an_arc_in_an_upright_plane_is_as_deep_as_it_dips() {
    let [pieces, colors] = shown_of_an_upright_arc("G2");
    assert!(pieces >= 64 && colors > 20, "the arc dips: {pieces} {colors}");
    let [pieces, colors] = shown_of_an_upright_arc("G3");
    assert!(
        pieces < 8 && colors < 8,
        "the arc leaves the material at once, and only its ends cut: {pieces} {colors}"
    );
}

/// Returns whether the picture has an edge between each pass and the one before, for parallel passes of a cutter of 3 mm, 1 mm apart, each of which
/// is deeper than the one before by one of the steps.
fn edges_between_passes(steps: &[f64]) -> Vec<bool> {
    let mut program = String::from("G21 G90 G17 G94\nS9000 M3\nG0 Z5\n");
    let mut z = 0.0;
    for (y, step) in steps.iter().enumerate() {
        z -= step;
        _ = writeln!(program, "G0 X0 Y{y}\nG1 Z{z:.3} F100\nG1 X20\nG0 Z5");
    }
    let place = Place::new().file("a.nc", program + "M5\nM30\n");
    let run = place.run("view a.nc --stock --cutter 3 --surface 0 -o a.svg");
    assert_eq!(run.status, Some(0), "{run}");
    let last = (steps.len() - 1) as f64;
    let still = Still::of(&place.read("a.svg"), [[-3.0, -3.0], [23.0, last + 3.0]]);
    let edge = |pass: usize| [10.0, pass as f64 - 1.5 - 0.5 * EDGE_WIDTH / still.scale];
    (1..steps.len()).map(|pass| still.color(edge(pass)) == Some(EDGE)).collect()
}

/// Where the passes of a relief follow a surface, their edges would cover it.
#[test]
fn only_steps_have_an_edge() {
    let all =
        |steps: &[f64], is_edge| assert_eq!(edges_between_passes(steps), vec![is_edge; steps.len() - 1]);
    all(&[1.0, 0.0, 0.0, 0.0], false);
    all(&[1.0, 0.02, 0.02], false);
    all(&[1.0, 0.021, 0.021], true);
    all(&[0.1; 16], true);
    all(&[0.1; 17], false);
    let mut steps = [0.1; 17];
    steps[9] = 0.5;
    let edges = edges_between_passes(&steps);
    assert!((1..17).all(|pass| edges[pass - 1] == (pass == 9)), "{edges:?}");
}
