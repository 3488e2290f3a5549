use super::component::{embedding_text, finished, options};
use super::pen::Pen;
use super::plan::{PathPlan, Plan, Signature, comma, project_name};
use crate::random::Random;
use pathbuild_draw::Draft;
use pathbuild_draw::Sheet;
use pathbuild_draw::model::{Entity, Point};

/// Number of embeddings in a project.
const EMBEDDINGS: usize = 10;

/// Distance between the embeddings of a project.
const GRID: f64 = 170.0;

/// Path numbers of fixture and variable projects.
const FIXTURE: usize = 8;
const VARIABLE: usize = 7;

/// A project that embeds ten paths.
pub(super) fn drawing(plan: &Plan, index: usize) -> (String, Sheet) {
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
pub(super) fn fixture(plan: &Plan, index: usize) -> (String, Sheet) {
    let mut random = plan.project_random(index + plan.components());
    let choices = choices(plan, &mut random);
    let definition =
        |choice: &Choice| format!("\\P:{}{},{}", choice.variable, choice.paths[0].name, choice.paths[1].name);
    let definitions: String = choices.iter().map(definition).collect();
    project(&project_name(index, FIXTURE), &segments(&choices), &definitions, &mut random)
}

/// A variable project, which embeds a fixture project and sets its variables.
pub(super) fn variable(plan: &Plan, index: usize) -> (String, Sheet) {
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
