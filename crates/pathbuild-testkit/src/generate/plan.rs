//! What a library consists of, and the features of a component.

use crate::draw::model::{Entity, Point, Shape, bulged};
use crate::random::Random;

/// The composition of a library. Every drawing follows from it independently of the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    components: usize,
    seed: u64,
}

/// Properties of a path that matter for embedding it.
#[derive(Clone, Debug)]
pub(super) struct PathPlan {
    pub(super) name: String,
    pub(super) signature: Signature,
    /// The range of its variable B, if it has one.
    pub(super) variable: Option<(f64, f64)>,
}

/// Properties of a path that the embedding segment must match.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signature {
    pub(super) thickness: f64,
    pub(super) cutter: f64,
    pub(super) material: &'static str,
    /// The vector from the start to the end of the path.
    pub(super) chord: Point,
}

/// First number of component drawings; projects have the numbers 8000 to 8999.
const FIRST: usize = 1000;
const NUMBERS: usize = 7000;
const PROJECTS: usize = 1000;

/// Offsets of the random number streams.
const SIGNATURE: u64 = 1 << 32;
const SHAPE: u64 = 2 << 32;
const PROJECT: u64 = 3 << 32;

impl Plan {
    pub(super) fn new(components: usize, seed: u64) -> Self {
        Self { components, seed }
    }

    /// The random numbers for the paths of a component.
    pub(super) fn random(&self, index: usize) -> Random {
        Random::new(self.seed, SHAPE + index as u64)
    }

    /// The random numbers for a project.
    pub(super) fn project_random(&self, index: usize) -> Random {
        Random::new(self.seed, PROJECT + index as u64)
    }

    pub(super) fn components(&self) -> usize {
        self.components
    }

    /// The paths of a component drawing: one, or in some drawings three or four.
    pub(super) fn paths(&self, index: usize) -> Vec<PathPlan> {
        let mut random = self.random(index);
        let count = if random.once_in(10) { 3 + random.below(2) } else { 1 };
        let first = 1 + 10 * (index / NUMBERS);
        let has_variable = count == 1 && random.once_in(12);
        let path = |offset: usize| PathPlan {
            name: format!("{}.{}P", number(index), first + offset),
            signature: self.signature(index, offset),
            variable: has_variable.then_some((-0.2, 0.5)),
        };
        (0..count).map(path).collect()
    }

    /// The signature of a path. Pairs of neighbours share it, so that a fixture project can embed either of them.
    fn signature(&self, index: usize, path: usize) -> Signature {
        let mut random = Random::new(self.seed, SIGNATURE + (index / 2 * 8 + path) as u64);
        Signature {
            thickness: random.pick(&[2.0, 3.0, 4.0, 5.0, 6.5, 8.0]),
            cutter: random.pick(&[1.0, 1.5, 2.0, 3.0, 4.0]),
            material: random.pick(&["M20x2", "MPappel", "MPVC", "MAl5", "MMs2"]),
            chord: Point::new(random.between(60.0, 140.0, 2.5), random.between(-10.0, 10.0, 0.5)),
        }
    }

    /// The file name of a component, derived from the paths it contains.
    pub(super) fn file(&self, index: usize) -> String {
        let paths = self.paths(index);
        let (first, last) = (&paths[0].name, &paths[paths.len() - 1].name);
        let directory = number(index) / 1000 * 1000;
        if first == last {
            format!("components/{directory}/{first}.dxf")
        } else {
            let from = first.strip_suffix('P').unwrap_or(first);
            format!("components/{directory}/{from}-{last}.dxf")
        }
    }

    pub(super) fn directories(&self) -> Vec<String> {
        let last = FIRST + self.components.clamp(1, NUMBERS) - 1;
        let directory = |thousand: usize| format!("components/{}", thousand * 1000);
        let mut directories: Vec<String> = (1..=last / 1000).map(directory).collect();
        directories.push("projects".to_owned());
        directories
    }
}

fn number(index: usize) -> usize {
    FIRST + index % NUMBERS
}

/// The name of the project's path with this index: 8000.1P, 8001.1P, ... 8999.1P, 8000.11P, ...
pub(super) fn project_name(index: usize, path: usize) -> String {
    format!("{}.{}P", 8000 + index % PROJECTS, path + 10 * (index / PROJECTS))
}

/// A number with a decimal comma, as common in these drawings.
pub(super) fn comma(number: f64) -> String {
    number.to_string().replace('.', ",")
}

/// Parameters that the texts of a path depend on.
pub(super) struct Tool {
    pub(super) thickness: f64,
    cutter: f64,
    infeed: f64,
    /// The value of B: a number or the path's variable.
    bottom: String,
    /// Whether the text at the start gives B, so that elements need not.
    bottom_is_inherited: bool,
}

impl Tool {
    pub(super) fn of(path: &PathPlan, random: &mut Random) -> Self {
        let bottom = random.pick(&[0.0, -0.1, -0.3, 0.4]);
        Self {
            thickness: path.signature.thickness,
            cutter: path.signature.cutter,
            infeed: random.pick(&[0.5, 0.8, 1.0, 1.5]),
            bottom: if path.variable.is_some() { "=B".to_owned() } else { comma(bottom) },
            bottom_is_inherited: random.once_in(3),
        }
    }

    pub(super) fn start_text(&self, path: &PathPlan) -> String {
        let (t, o, i) = (comma(self.thickness), comma(self.cutter), comma(self.infeed));
        let bottom = if self.bottom_is_inherited { format!("\\PB{}", self.bottom) } else { String::new() };
        let range = |(low, high)| format!("\\P:B{}~{}", comma(low), comma(high));
        let variable = path.variable.map(range).unwrap_or_default();
        format!("{}\\PO{o}\\PT{t}\\PI{i}{bottom}{variable}", path.signature.material)
    }

    /// The text of an element milled to B.
    fn bottom_text(&self, more: &str) -> String {
        let own = if self.bottom_is_inherited { String::new() } else { format!("B{}", self.bottom) };
        format!("{own} {more}").trim().to_owned()
    }

    /// A marking depth, above every B.
    fn mark(&self) -> String {
        comma(self.thickness - 0.4)
    }
}

/// Draws a random feature in the field with this lower left corner.
pub(super) fn draw_feature(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    match pen.random.below(6) {
        0 => contour(pen, tool, field),
        1 => groove(pen, tool, field),
        2 => bars(pen, tool, field),
        3 => marks(pen, tool, field),
        4 => holes(pen, tool, field),
        _ => helixes(pen, tool, field),
    }
}

fn corner(field: Point, x: f64, y: f64) -> Point {
    field + Point::new(x, y)
}

/// Draws a closed contour with rounded corners.
fn contour(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    let width = pen.random.between(14.0, 26.0, 0.5);
    let height = pen.random.between(10.0, 18.0, 0.5);
    pen.sweep(corner(field, 3.0, 0.0), tool.thickness);
    let text = tool.bottom_text("");
    pen.line(corner(field, width, 0.0), "CONTINUOUS", &tool.bottom_text("F180"));
    pen.line(corner(field, width, height - 3.0), "CONTINUOUS", &text);
    pen.arc(corner(field, width - 3.0, height), 0.414_213_562_373, "CONTINUOUS", &text);
    pen.line(corner(field, 0.0, height), "CONTINUOUS", &text);
    pen.line(corner(field, 0.0, 3.0), "CONTINUOUS", &text);
    pen.arc(corner(field, 3.0, 0.0), 0.414_213_562_373, "CONTINUOUS", &text);
}

/// Draws an open chain of lines and arcs with increasing depth.
fn groove(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let steps = 3 + pen.random.below(4);
    for step in 0..steps {
        let to = corner(field, 4.5 * (step + 1) as f64, pen.random.between(0.0, 12.0, 0.25));
        let text = tool.bottom_text(if step == 0 { "Q(Nut)" } else { "" });
        if pen.random.once_in(3) {
            let bulge = pen.random.pick(&[-0.5, -0.25, 0.25, 0.5]);
            pen.arc(to, bulge, "CONTINUOUS", &text);
        } else {
            pen.line(to, "CONTINUOUS", &text);
        }
    }
}

/// Draws lines with support bars that leave room for the cutter.
fn bars(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let length = pen.random.between(20.0, 28.0, 0.5);
    let (bar, distance) = (pen.random.pick(&[1.0, 2.0]), tool.cutter + pen.random.pick(&[3.0, 5.0]));
    let text = format!("B{} D{} P{} U{}", tool.bottom, tool.mark(), comma(bar), comma(distance));
    pen.line(corner(field, length, 0.0), "BORDER", &text);
    pen.line(corner(field, length, 15.0), "CENTER", &text);
}

/// Draws marks, some of them on a layer with a suffix.
fn marks(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let text = format!("D{}", tool.mark());
    pen.line(corner(field, 8.0, 6.0), "DIVIDE", &text);
    pen.arc(corner(field, 18.0, 6.0), -0.5, "DIVIDE", &text);
    pen.line(corner(field, 24.0, 0.0), "DIVIDE", &text);
}

/// Draws a row of drilled holes; the last one is only marked.
fn holes(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    let count = 2 + pen.random.below(3);
    for hole in 0..count {
        pen.sweep(corner(field, 7.5 * hole as f64, 3.0), tool.thickness);
        if hole + 1 == count {
            pen.circle(tool.cutter, "DIVIDE", &format!("D{}", tool.mark()));
        } else {
            pen.circle(tool.cutter, "CONTINUOUS", &tool.bottom_text(""));
        }
    }
}

/// Draws two helical circles, one of them for marking.
fn helixes(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(corner(field, 6.0, 8.0), tool.thickness);
    let diameter = tool.cutter * pen.random.pick(&[1.5, 2.0, 3.0]);
    pen.circle(diameter, "CONTINUOUS", &tool.bottom_text("I0,4"));
    pen.sweep(corner(field, 24.0, 8.0), tool.thickness);
    pen.circle(diameter, "DIVIDE", &format!("D{} I0,2", tool.mark()));
}

/// Draws a path element by element.
#[derive(Debug)]
pub(super) struct Pen<'a> {
    pub(super) random: &'a mut Random,
    pub(super) at: Point,
    entities: Vec<Entity>,
}

impl<'a> Pen<'a> {
    pub(super) fn new(random: &'a mut Random, start: Point, text: &str) -> Self {
        Self { random, at: start, entities: vec![Entity::start(start).note(text)] }
    }

    pub(super) fn add(&mut self, entity: Entity) {
        self.entities.push(entity);
    }

    /// Draws a line from the current point.
    pub(super) fn line(&mut self, to: Point, line_type: &str, text: &str) {
        // One line in four is drawn from its end, as happens when users copy and mirror.
        let (from, end) = if self.random.once_in(4) { (to, self.at) } else { (self.at, to) };
        self.add(Entity::line(from, end).typed(line_type).note(text));
        self.at = to;
    }

    /// Draws an arc with this bulge from the current point.
    pub(super) fn arc(&mut self, to: Point, bulge: f64, line_type: &str, text: &str) {
        match bulged(self.at, to, bulge) {
            Some(arc) => self.add(Entity::new(Shape::Arc(arc)).typed(line_type).note(text)),
            None => self.add(Entity::line(self.at, to).typed(line_type).note(text)),
        }
        self.at = to;
    }

    /// Draws a circle around the current point.
    pub(super) fn circle(&mut self, diameter: f64, line_type: &str, text: &str) {
        self.add(Entity::circle(self.at, diameter).typed(line_type).note(text));
    }

    /// Draws a rapid move, sometimes with its own sweep height.
    pub(super) fn sweep(&mut self, to: Point, thickness: f64) {
        if self.random.once_in(6) {
            let height = thickness + self.random.between(1.0, 6.0, 0.5);
            self.line(to, "DASHED", &format!("S{}", comma(height)));
        } else {
            self.line(to, "HIDDEN", "");
        }
    }

    /// Draws the end marker and returns the path.
    pub(super) fn end(mut self, at: Point) -> Vec<Entity> {
        self.add(Entity::end(at));
        self.entities
    }
}
