//! Plans and generates realistic libraries of drawings for benchmarks and property tests: any number of components, projects that embed
//! them, fixture projects and variable projects. All of them compile without errors, and the same seed gives the same bytes.

use crate::draw::model::{
    Entity, LineEnds, Point, Polyline, PolylineKind, Shape, Version, Vertex, arc_of_bulge,
};
use crate::draw::{Draft, Sheet};
use crate::random::Random;
use crate::surroundings::finish;

/// A library: `components` component drawings, `components / 10` projects with ten embeddings each, and `components / 50` variable projects
/// with as many fixture projects. Drawings are generated on demand, on any thread.
#[derive(Clone, Copy, Debug)]
pub struct Library {
    plan: Plan,
}

/// Returns the drawings of a library, in order: names relative to its directory, and sheets.
pub fn library(components: usize, seed: u64) -> impl Iterator<Item = (String, Sheet)> {
    let library = Library::new(components, seed);
    (0..library.len()).map(move |index| library.drawing(index))
}

impl Library {
    /// Creates a library with this number of components.
    pub fn new(components: usize, seed: u64) -> Self {
        Self { plan: Plan::new(components, seed) }
    }

    /// The number of drawings.
    pub fn len(&self) -> usize {
        self.plan.components() + self.projects() + 2 * self.variable_projects()
    }

    /// Whether there are no drawings.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn projects(&self) -> usize {
        self.plan.components() / 10
    }

    fn variable_projects(&self) -> usize {
        self.plan.components() / 50
    }

    /// Returns a drawing with its name relative to the library's directory: first components, then projects, then fixture and variable projects
    /// alternating. Indices beyond the end wrap around.
    pub fn drawing(&self, index: usize) -> (String, Sheet) {
        let index = index.checked_rem(self.len()).unwrap_or_default();
        let Some(behind) = index.checked_sub(self.plan.components()) else {
            return component_drawing(&self.plan, index);
        };
        match behind.checked_sub(self.projects()) {
            None => project_drawing(&self.plan, behind),
            Some(pair) if pair % 2 == 0 => fixture(&self.plan, pair / 2),
            Some(pair) => variable(&self.plan, pair / 2),
        }
    }

    /// The directories of the drawings, in search order.
    pub fn directories(&self) -> Vec<String> {
        self.plan.directories()
    }

    /// Returns the text of a pathbuild.toml for the library.
    pub fn configuration(&self) -> String {
        let names: Vec<String> = self.directories().iter().map(|name| format!("{name:?}")).collect();
        let names = names.join(", ");
        format!(
            "feed = 200\nrapid = 1000\nsweep-height = 40\npart = 'Part'\nlibrary = [{names}]\nsearch = [{names}]\n"
        )
    }
}

/// The start of the first path, and the vertical distance in mm to the next.
const ORIGIN: Point = Point::new(20.0, 80.0);
const ROW_SPACING: f64 = 90.0;

/// Width and height in mm of the field for one feature.
const FIELD_SIZE: Point = Point::new(34.0, 26.0);
const FIELDS_IN_ROW: usize = 4;

/// Draws a component. Returns its file name and its drawing.
fn component_drawing(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.random(index);
    let paths = plan.paths(index);
    let mut draft = Draft::new();
    let furniture = options(&mut draft, &mut random);
    // Features besides the plate.
    let features = if paths.len() == 1 { 3 + random.below(4) } else { 4 - paths.len() };
    for (row, path) in paths.iter().enumerate() {
        let origin = ORIGIN + Point::new(0.0, ROW_SPACING * row as f64);
        draft.layer(&layer(&path.name, &mut random));
        draft.extend(draw_path(path, origin, features, &mut random));
        draft.layer("Part").add(plate_outline(path.signature.cutter, origin + field(features)));
        proxy_line(&mut draft, path, origin);
    }
    (plan.file(index), finish_drawing(draft, furniture))
}

/// Finishes a generated drawing. Its elements are far enough apart that there is room for all texts.
fn finish_drawing(draft: Draft, furniture: u64) -> Sheet {
    finish(draft, Some(furniture))
        .unwrap_or_else(|errors| unreachable!("a generated drawing has a fault: {}", errors[0]))
}

/// Chooses options for writing the drawing, and returns the seed of its surroundings.
fn options(draft: &mut Draft, random: &mut Random) -> u64 {
    let furniture = random.next();
    if random.once_in(8) {
        draft.options.line_ends = LineEnds::Lf;
    }
    if random.once_in(8) {
        draft.options.version = Version::R2010;
    }
    furniture
}

/// Returns a layer name, sometimes with underscores instead of points, which some CAD programs do not allow.
fn layer(name: &str, random: &mut Random) -> String {
    if random.once_in(5) { name.replace('.', "_") } else { name.to_owned() }
}

/// Draws a line from start to end on a layer without a path, for copying into projects.
fn proxy_line(draft: &mut Draft, path: &PathPlan, start: Point) {
    let layer = format!("{} PROXY", path.name.split('.').next().unwrap_or_default());
    draft.layer(&layer);
    let text = embedding_text(path, &comma(0.2));
    draft.add(Entity::line(start, start + path.signature.chord).with_line_type("DASHDOT").note(&text));
}

/// Returns the text of a segment that embeds a path.
fn embedding_text(path: &PathPlan, value: &str) -> String {
    let signature = path.signature;
    let (t, o, m) = (comma(signature.thickness), comma(signature.cutter), signature.material);
    let variable = path.variable.map(|_| format!(" :B{value}")).unwrap_or_default();
    format!(">{} T{t} O{o} {m}{variable}", path.name)
}

/// Returns the lower left corner of a feature's field. Consecutive rows run in opposite directions.
fn field(feature: usize) -> Point {
    let (row, column) = (feature / FIELDS_IN_ROW, feature % FIELDS_IN_ROW);
    let column = if row.is_multiple_of(2) { column } else { FIELDS_IN_ROW - 1 - column };
    Point::new(FIELD_SIZE.x * column as f64, 16.0 + FIELD_SIZE.y * row as f64)
}

/// Draws a path: features in rows above the line from start to end, with sweeps between them.
fn draw_path(path: &PathPlan, start: Point, features: usize, random: &mut Random) -> Vec<Entity> {
    let tool = Tool::of(path, random);
    let mut pen = Pen::new(random, start, &tool.start_text(path));
    for feature in 0..features {
        draw_feature(&mut pen, &tool, start + field(feature));
    }
    plate(&mut pen, &tool, start + field(features));
    let end = start + path.signature.chord;
    pen.sweep(end, tool.thickness);
    pen.end(end)
}

/// Number of embeddings in a project.
const EMBEDDINGS: usize = 10;

/// Distance in mm between the embeddings of a project.
const EMBEDDING_DISTANCE: f64 = 170.0;

/// Path numbers of fixture and variable projects.
const FIXTURE: usize = 8;
const VARIABLE: usize = 7;

/// Draws a project that embeds ten paths. Returns its file name and its drawing.
fn project_drawing(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.project_random(index);
    let cutter = any_path(plan, &mut random).signature.cutter;
    let children: Vec<PathPlan> = (0..EMBEDDINGS).map(|_| path_for(plan, cutter, &mut random)).collect();
    let segment = |child: &PathPlan| (embedding_text(child, &comma(0.1)), child.signature);
    let segments: Vec<(String, Signature)> = children.iter().map(segment).collect();
    project(&project_name(index, 1), &segments, "", &mut random)
}

fn any_path(plan: &Plan, random: &mut Random) -> PathPlan {
    let mut paths = plan.paths(random.below(plan.components()));
    paths.swap_remove(random.below(paths.len()))
}

/// Returns a random path for this cutter, of the first component at or after a random index that has any.
fn path_for(plan: &Plan, cutter: f64, random: &mut Random) -> PathPlan {
    let first = random.below(plan.components());
    let paths = (0..plan.components()).map(|offset| plan.paths((first + offset) % plan.components()));
    let suits = |path: &PathPlan| path.signature.cutter == cutter;
    let mut suitable = paths.map(|paths| paths.into_iter().filter(suits).collect::<Vec<_>>());
    let mut suitable = suitable.find(|paths| !paths.is_empty()).unwrap_or_default();
    suitable.swap_remove(random.below(suitable.len()))
}

/// Draws a fixture project, with three path names as variables. Returns its file name and its drawing.
fn fixture(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.project_random(index + plan.components());
    let choices = choices(plan, &mut random);
    let definition =
        |choice: &Choice| format!("\\P:{}{},{}", choice.variable, choice.paths[0].name, choice.paths[1].name);
    let definitions: String = choices.iter().map(definition).collect();
    project(&project_name(index, FIXTURE), &segments(&choices), &definitions, &mut random)
}

/// Draws a variable project, which embeds a fixture project and sets its variables. Returns its file name and its drawing.
fn variable(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.project_random(index + plan.components());
    let choices = choices(plan, &mut random);
    let mut value = |choice: &Choice| format!(" :{}{}", choice.variable, choice.paths[random.below(2)].name);
    let values: String = choices.iter().map(&mut value).collect();
    let name = project_name(index, FIXTURE);
    let embedded = PathPlan { name, signature: signature(&segments(&choices)), variable: None };
    let segment = (format!("{}{values}", embedding_text(&embedded, "")), embedded.signature);
    project(&project_name(index, VARIABLE), &[segment], "", &mut random)
}

/// A variable with its two permitted paths.
struct Choice {
    variable: char,
    paths: [PathPlan; 2],
}

fn choices(plan: &Plan, random: &mut Random) -> Vec<Choice> {
    let cutter = neighbours(plan, None, random)[0].signature.cutter;
    let choice = |variable| Choice { variable, paths: neighbours(plan, Some(cutter), random) };
    ['X', 'Y', 'Z'].into_iter().map(choice).collect()
}

fn segments(choices: &[Choice]) -> Vec<(String, Signature)> {
    let segment = |choice: &Choice| {
        let [one, _] = &choice.paths;
        let by_name = PathPlan { name: format!("={}", choice.variable), ..one.clone() };
        (embedding_text(&by_name, ""), one.signature)
    };
    choices.iter().map(segment).collect()
}

/// Returns two interchangeable paths without variables, for this cutter if one is given; any pair if there are none.
fn neighbours(plan: &Plan, cutter: Option<f64>, random: &mut Random) -> [PathPlan; 2] {
    let pairs = plan.components() / 2;
    let begin = random.below(pairs);
    let first = |index: usize| plan.paths(index).swap_remove(0);
    let pair = |offset: usize| {
        let even = (begin + offset) % pairs * 2;
        [first(even), first(even + 1)]
    };
    let suits = |path: &PathPlan| cutter.is_none_or(|cutter| path.signature.cutter == cutter);
    let is_plain = |path: &PathPlan| path.variable.is_none() && suits(path);
    (0..pairs).map(pair).find(|pair| pair.iter().all(is_plain)).unwrap_or_else(|| pair(0))
}

/// Returns the properties that a segment embedding this project must match.
fn signature(segments: &[(String, Signature)]) -> Signature {
    let thickness = segments.iter().map(|(_, signature)| signature.thickness).fold(0.0, f64::max);
    let rows = segments.len().div_ceil(5);
    let chord = Point::new(0.0, EMBEDDING_DISTANCE * rows as f64 + 20.0);
    let cutter = segments.first().map_or(3.0, |(_, signature)| signature.cutter);
    Signature { thickness, cutter, material: "MProjekt", chord }
}

fn project(
    name: &str,
    segments: &[(String, Signature)],
    definitions: &str,
    random: &mut Random,
) -> (String, Sheet) {
    let mut draft = Draft::new();
    let furniture = options(&mut draft, random);
    let whole = signature(segments);
    let start = Point::new(10.0, 10.0);
    let text =
        format!("{}\\PT{}\\PO{}{definitions}", whole.material, comma(whole.thickness), comma(whole.cutter));
    let mut pen = Pen::new(random, start, &text);
    for (index, (text, signature)) in segments.iter().enumerate() {
        let (row, column) = (index / 5, index % 5);
        let at = start
            + Point::new(20.0 + EMBEDDING_DISTANCE * column as f64, 80.0 + EMBEDDING_DISTANCE * row as f64);
        pen.sweep(at, whole.thickness);
        embed(&mut pen, text, *signature);
    }
    let end = start + whole.chord;
    pen.sweep(end, whole.thickness);
    draft.layer(name).extend(pen.end(end));
    (format!("projects/{name}.dxf"), finish_drawing(draft, furniture))
}

/// Draws a subpath segment from the current point in a random direction, as long as the embedded path.
fn embed(pen: &mut Pen<'_>, text: &str, signature: Signature) {
    let turn = pen.random.pick(&[0.0, 5.0, 10.0, 15.0, -10.0]);
    let length = Point::default().distance(signature.chord);
    let to = pen.at.polar(length, turn);
    pen.add(Entity::line(pen.at, to).with_line_type("DASHDOT").note(text));
    pen.at = to;
}

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
    /// The range of the path's variable B, if it has one.
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
const SIGNATURE_STREAM: u64 = 1 << 32;
const SHAPE_STREAM: u64 = 2 << 32;
const PROJECT_STREAM: u64 = 3 << 32;

impl Plan {
    pub(super) fn new(components: usize, seed: u64) -> Self {
        Self { components, seed }
    }

    /// Returns the random numbers for the paths of a component.
    pub(super) fn random(&self, index: usize) -> Random {
        Random::new(self.seed, SHAPE_STREAM + index as u64)
    }

    pub(super) fn project_random(&self, index: usize) -> Random {
        Random::new(self.seed, PROJECT_STREAM + index as u64)
    }

    pub(super) fn components(&self) -> usize {
        self.components
    }

    /// Returns the paths of a component drawing: one, or in some drawings three or four.
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

    /// Returns the signature of a path. Pairs of neighbours share it, so that a fixture project can embed either of them.
    fn signature(&self, index: usize, path: usize) -> Signature {
        let mut random = Random::new(self.seed, SIGNATURE_STREAM + (index / 2 * 8 + path) as u64);
        Signature {
            thickness: random.pick(&[2.0, 3.0, 4.0, 5.0, 6.5, 8.0]),
            cutter: random.pick(&[1.0, 1.5, 2.0, 3.0, 4.0]),
            material: random.pick(&["M20x2", "MPappel", "MPVC", "MAl5", "MMs2"]),
            chord: Point::new(random.between(60.0, 140.0, 2.5), random.between(-10.0, 10.0, 0.5)),
        }
    }

    /// Returns the file name of a component, derived from the paths it contains.
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

/// Returns the name of the project's path with this index: 8000.1P, 8001.1P, ... 8999.1P, 8000.11P, ...
pub(super) fn project_name(index: usize, path: usize) -> String {
    format!("{}.{}P", 8000 + index % PROJECTS, path + 10 * (index / PROJECTS))
}

/// Returns a number with a decimal comma, as common in these drawings.
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

    /// Returns the text of an element milled to B.
    fn bottom_text(&self, more: &str) -> String {
        let own = if self.bottom_is_inherited { String::new() } else { format!("B{}", self.bottom) };
        format!("{own} {more}").trim().to_owned()
    }

    /// Returns a marking depth, above every B.
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

/// Draws the contour of a rectangular plate with support bars. Its outline, on a layer of its own, comes from [`plate_outline`].
fn plate(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    let [left, low, right, high] = PLATE;
    pen.sweep(corner(field, left, low), tool.thickness);
    let text = format!("B0 D{} P2 U{}", tool.mark(), comma(tool.cutter + 3.0));
    for (x, y) in [(right, low), (right, high), (left, high), (left, low)] {
        pen.line(corner(field, x, y), "BORDER", &text);
    }
}

/// Returns the outline of the plate with the contour that [`plate`] draws. The outline lies half of O inside the contour.
fn plate_outline(cutter: f64, field: Point) -> Entity {
    let [left, low, right, high] = PLATE;
    let inset = cutter / 2.0;
    let corners = [
        (left + inset, low + inset),
        (right - inset, low + inset),
        (right - inset, high - inset),
        (left + inset, high - inset),
    ];
    let vertices = corners.map(|(x, y)| Vertex { point: corner(field, x, y), bulge: 0.0 });
    let outline = Polyline { kind: PolylineKind::Light, vertices: vertices.into(), closed: true };
    Entity::new(Shape::Polyline(outline))
}

/// The left, lower, right and upper edges of a plate's contour in its field.
const PLATE: [f64; 4] = [2.0, 1.0, 28.0, 17.0];

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

/// A pen that draws a path element by element.
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

    pub(super) fn line(&mut self, to: Point, line_type: &str, text: &str) {
        // One line in four is drawn from its end, as happens when users copy and mirror.
        let (from, end) = if self.random.once_in(4) { (to, self.at) } else { (self.at, to) };
        self.add(Entity::line(from, end).with_line_type(line_type).note(text));
        self.at = to;
    }

    pub(super) fn arc(&mut self, to: Point, bulge: f64, line_type: &str, text: &str) {
        match arc_of_bulge(self.at, to, bulge) {
            Some(arc) => self.add(Entity::new(Shape::Arc(arc)).with_line_type(line_type).note(text)),
            None => self.add(Entity::line(self.at, to).with_line_type(line_type).note(text)),
        }
        self.at = to;
    }

    /// Draws a circle around the current point.
    pub(super) fn circle(&mut self, diameter: f64, line_type: &str, text: &str) {
        self.add(Entity::circle(self.at, diameter).with_line_type(line_type).note(text));
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
