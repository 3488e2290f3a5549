//! Generates realistic libraries of drawings for benchmarks and property tests: any number of components, projects that embed them, fixture
//! projects and variable projects. All of them compile without errors, and the same seed gives the same bytes.

mod plan;

use crate::draw::model::{Entity, LineEnds, Point, Version};
use crate::draw::{Draft, Sheet};
use crate::furniture::finish;
use crate::random::Random;
use plan::{PathPlan, Pen, Plan, Signature, Tool, comma, draw_feature, project_name};

/// A library: `components` component drawings, `components / 10` projects with ten embeddings each, and `components / 50` variable projects
/// with as many fixture projects. Drawings are generated on demand, on any thread.
#[derive(Clone, Copy, Debug)]
pub struct Library {
    plan: Plan,
}

/// The drawings of a library, in order: names relative to its directory, and sheets.
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

    /// A drawing with its name relative to the library's directory: first components, then projects, then fixture and variable projects
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

    /// A pathbuild.toml for the library.
    pub fn configuration(&self) -> String {
        let names: Vec<String> = self.directories().iter().map(|name| format!("{name:?}")).collect();
        let names = names.join(", ");
        format!("feed = 200\nrapid = 1000\nsweep-height = 40\nlibrary = [{names}]\nsearch = [{names}]\n")
    }
}

/// The start of the first path, and the vertical distance to the next.
const ORIGIN: Point = Point::new(20.0, 80.0);
const ROW: f64 = 90.0;

/// Width and height of the field for one feature.
const FIELD: Point = Point::new(34.0, 26.0);
const FIELDS_IN_ROW: usize = 4;

/// The drawing of a component, with its file name.
fn component_drawing(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.random(index);
    let paths = plan.paths(index);
    let mut draft = Draft::new();
    let furniture = options(&mut draft, &mut random);
    let features = if paths.len() == 1 { 4 + random.below(4) } else { 5 - paths.len() };
    for (row, path) in paths.iter().enumerate() {
        let origin = ORIGIN + Point::new(0.0, ROW * row as f64);
        draft.layer(&layer(&path.name, &mut random));
        draft.extend(draw_path(path, origin, features, &mut random));
        proxy_line(&mut draft, path, origin);
    }
    (plan.file(index), finished(draft, furniture))
}

/// Finishes a generated drawing. Its elements are far enough apart that there is room for all texts.
fn finished(draft: Draft, furniture: u64) -> Sheet {
    finish(draft, Some(furniture))
        .unwrap_or_else(|errors| unreachable!("a generated drawing has a fault: {}", errors[0]))
}

/// Chooses options for writing the drawing, and returns the seed of its furniture.
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

/// A layer name; sometimes without points, which some CAD programs do not allow.
fn layer(name: &str, random: &mut Random) -> String {
    if random.once_in(5) { name.replace('.', "_") } else { name.to_owned() }
}

/// Draws a line from start to end on a layer without a path, for copying into projects.
fn proxy_line(draft: &mut Draft, path: &PathPlan, start: Point) {
    let layer = format!("{} PROXY", path.name.split('.').next().unwrap_or_default());
    draft.layer(&layer);
    let text = embedding_text(path, &comma(0.2));
    draft.add(Entity::line(start, start + path.signature.chord).typed("DASHDOT").note(&text));
}

/// The text of a segment that embeds a path.
fn embedding_text(path: &PathPlan, value: &str) -> String {
    let signature = path.signature;
    let (t, o, m) = (comma(signature.thickness), comma(signature.cutter), signature.material);
    let variable = path.variable.map(|_| format!(" :B{value}")).unwrap_or_default();
    format!(">{} T{t} O{o} {m}{variable}", path.name)
}

/// Draws a path: features in rows above the line from start to end, with sweeps between them.
fn draw_path(path: &PathPlan, start: Point, features: usize, random: &mut Random) -> Vec<Entity> {
    let tool = Tool::of(path, random);
    let mut pen = Pen::new(random, start, &tool.start_text(path));
    for feature in 0..features {
        let (row, column) = (feature / FIELDS_IN_ROW, feature % FIELDS_IN_ROW);
        // Consecutive rows run in opposite directions.
        let column = if row % 2 == 0 { column } else { FIELDS_IN_ROW - 1 - column };
        let field = Point::new(FIELD.x * column as f64, 16.0 + FIELD.y * row as f64);
        draw_feature(&mut pen, &tool, start + field);
    }
    let end = start + path.signature.chord;
    pen.sweep(end, tool.thickness);
    pen.end(end)
}

/// Number of embeddings in a project.
const EMBEDDINGS: usize = 10;

/// Distance between the embeddings of a project.
const GRID: f64 = 170.0;

/// Path numbers of fixture and variable projects.
const FIXTURE: usize = 8;
const VARIABLE: usize = 7;

/// A project that embeds ten paths.
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

/// A random path for this cutter, or otherwise the next suitable component.
fn path_for(plan: &Plan, cutter: f64, random: &mut Random) -> PathPlan {
    let first = random.below(plan.components());
    let paths = (0..plan.components()).map(|offset| plan.paths((first + offset) % plan.components()));
    let suits = |path: &PathPlan| path.signature.cutter == cutter;
    let mut suitable = paths.map(|paths| paths.into_iter().filter(suits).collect::<Vec<_>>());
    let mut suitable = suitable.find(|paths| !paths.is_empty()).unwrap_or_default();
    suitable.swap_remove(random.below(suitable.len()))
}

/// A fixture project, with three path names as variables.
fn fixture(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.project_random(index + plan.components());
    let choices = choices(plan, &mut random);
    let definition =
        |choice: &Choice| format!("\\P:{}{},{}", choice.variable, choice.paths[0].name, choice.paths[1].name);
    let definitions: String = choices.iter().map(definition).collect();
    project(&project_name(index, FIXTURE), &segments(&choices), &definitions, &mut random)
}

/// A variable project, which embeds a fixture project and sets its variables.
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

/// Two interchangeable paths, for a given cutter if there is one.
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

/// The properties that a segment embedding this project must match.
fn signature(segments: &[(String, Signature)]) -> Signature {
    let thickness = segments.iter().map(|(_, signature)| signature.thickness).fold(0.0, f64::max);
    let rows = segments.len().div_ceil(5);
    let chord = Point::new(0.0, GRID * rows as f64 + 20.0);
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
        let at = start + Point::new(20.0 + GRID * column as f64, 80.0 + GRID * row as f64);
        pen.sweep(at, whole.thickness);
        embed(&mut pen, text, *signature);
    }
    let end = start + whole.chord;
    pen.sweep(end, whole.thickness);
    draft.layer(name).extend(pen.end(end));
    (format!("projects/{name}.dxf"), finished(draft, furniture))
}

/// Draws a subpath segment with the length of the path from the current point, in a random direction.
fn embed(pen: &mut Pen<'_>, text: &str, signature: Signature) {
    let turn = pen.random.pick(&[0.0, 15.0, 30.0, 45.0, -30.0]);
    let length = Point::default().distance(signature.chord);
    let to = pen.at.polar(length, turn);
    pen.add(Entity::line(pen.at, to).typed("DASHDOT").note(text));
    pen.at = to;
}
