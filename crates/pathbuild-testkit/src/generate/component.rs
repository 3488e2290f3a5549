use super::features::{Tool, draw_feature};
use super::pen::Pen;
use super::plan::{PathPlan, Plan, comma};
use crate::furniture::finish;
use crate::random::Random;
use pathbuild_draw::Draft;
use pathbuild_draw::Sheet;
use pathbuild_draw::model::{Entity, LineEnds, Point, Version};

/// The start of the first path, and the vertical distance to the next.
const ORIGIN: Point = Point::new(20.0, 80.0);
const ROW: f64 = 90.0;

/// Width and height of the field for one feature.
const FIELD: Point = Point::new(34.0, 26.0);
const FIELDS_IN_ROW: usize = 4;

/// The drawing of a component, with its file name.
pub(super) fn drawing(plan: &Plan, index: usize) -> (String, Sheet) {
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
pub(super) fn finished(draft: Draft, furniture: u64) -> Sheet {
    finish(draft, Some(furniture))
        .unwrap_or_else(|errors| unreachable!("a generated drawing has a fault: {}", errors[0]))
}

/// Chooses options for writing the drawing, and returns the seed of its furniture.
pub(super) fn options(draft: &mut Draft, random: &mut Random) -> u64 {
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
pub(super) fn embedding_text(path: &PathPlan, value: &str) -> String {
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
