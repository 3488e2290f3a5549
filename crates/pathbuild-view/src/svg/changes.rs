//! Pictures of how a changed drawing affects the moves of a path. The old and the new picture have the same frame, so that they can be
//! overlaid.

use pathbuild_diagnostic::{Lang, Number};

use super::canvas::{Anchor, Canvas, INK_COLOUR, OTHER_COLOUR, svg_number};
use super::frame::{Frame, PageTransform};
use super::moves::path_data;
use crate::changes::{Change, ChangeKind, ComparedMove, ComparedMoves, Group, groups, moves, phrase};
use crate::extent::bounding_box;
use crate::scene::{MoveKind, SceneMove};

/// Colours of moves: added ones are blue; removed ones are vermilion, wider and dashed, so that the colour-blind can distinguish them too.
const ADDED_COLOUR: &str = "#0072b2";
const REMOVED_COLOUR: &str = "#d55e00";
const SHIFTED_COLOUR: &str = "#009e73";
const REORDERED_COLOUR: &str = "#4a5a68";
const RAPIDS_COLOUR: &str = "#946200";

/// Colours and dashes of altered moves. Each group of alterations gets the next ones.
const ALTERED_STYLES: [[&str; 2]; 8] = [
    ["#cc79a7", ""],
    ["#7b3294", " stroke-dasharray=\"12 3\""],
    ["#8c510a", " stroke-dasharray=\"2 4\""],
    ["#01665e", " stroke-dasharray=\"8 3 2 3 2 3\""],
    ["#cc79a7", " stroke-dasharray=\"5 3\""],
    ["#7b3294", ""],
    ["#8c510a", " stroke-dasharray=\"12 3 2 3\""],
    ["#01665e", ""],
];

/// Height of a line of the legend and size of its letters, in px.
const LINE_HEIGHT: f64 = 20.0;
const LETTER_SIZE: f64 = 13.0;

/// The pictures that show a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// The old and the new program in one picture, with changes in colour and a legend.
    Changes,
    /// The moves of the old program.
    Old,
    /// The moves of the new program.
    New,
}

#[derive(Clone, Copy, Debug)]
struct ChangesPicture<'a> {
    compared: &'a ComparedMoves,
    /// The groups of changes, which are the entries of the legend.
    groups: &'a [Group],
}

/// Draws a change as one of the pictures. All pictures of a change have the same size and scale.
pub fn changes_svg(compared: &ComparedMoves, picture: Picture, lang: Lang) -> String {
    let ComparedMoves { old, new, .. } = compared;
    let frame = frame(old.iter().chain(new).map(|compared| &compared.movement));
    let place = frame.of_drawing();
    let groups = groups(compared);
    let changes_picture = ChangesPicture { compared, groups: &groups };
    let legend = if picture == Picture::Changes { groups.len() as f64 * LINE_HEIGHT } else { 0.0 };
    let mut canvas = Canvas::new(Frame::WIDTH, frame.bottom() + legend);
    canvas.open("fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    match picture {
        Picture::Old => stroke_all(&mut canvas, old, &place, REMOVED_COLOUR),
        Picture::New => stroke_all(&mut canvas, new, &place, ADDED_COLOUR),
        Picture::Changes => changes_picture.draw(&mut canvas, &place),
    }
    canvas.close();
    if picture == Picture::Changes {
        for (index, group) in groups.iter().enumerate() {
            let style = changes_picture.has_line(group).then(|| Style::of(group.kind, &groups));
            draw_entry(&mut canvas, group, style, frame.bottom() + index as f64 * LINE_HEIGHT, lang);
        }
    }
    canvas.finish()
}

impl ChangesPicture<'_> {
    /// Draws unchanged moves in grey, and changed moves on top.
    fn draw(&self, canvas: &mut Canvas, place: &PageTransform) {
        let mut is_changed = vec![false; self.compared.new.len()];
        for change in &self.compared.changes {
            is_changed[change.new.clone()].fill(true);
        }
        let stays = self.compared.new.iter().zip(&is_changed).filter(|(_, is_changed)| !**is_changed);
        for (compared, _) in stays {
            stroke(canvas, &compared.movement, place, Style::plain(OTHER_COLOUR));
        }
        let is_gone =
            |change: &&Change| !matches!(change.kind, ChangeKind::Altered { .. } | ChangeKind::Reordered);
        for change in self.compared.changes.iter().filter(is_gone) {
            for ComparedMove { movement, .. } in &self.compared.old[change.old.clone()] {
                self.stroke_changed(canvas, movement, place, Some(ChangeKind::Removed));
            }
        }
        for change in &self.compared.changes {
            for ComparedMove { movement, .. } in &self.compared.new[change.new.clone()] {
                self.stroke_changed(canvas, movement, place, Some(change.kind));
            }
        }
    }

    /// Whether the moves of a group are visible in the picture. Rapid moves straight up and down are not.
    fn has_line(&self, group: &Group) -> bool {
        let is_sweep = |ComparedMove { movement, .. }: &ComparedMove| {
            movement.kind == MoveKind::Sweep && movement.is_placed()
        };
        let has_sweep = |change: &Change| {
            let (old, new) = (&self.compared.old[change.old.clone()], &self.compared.new[change.new.clone()]);
            old.iter().chain(new).any(is_sweep)
        };
        group.kind.is_some() || self.compared.changes.iter().any(has_sweep)
    }

    /// Draws a changed move in the style of its entry in the legend.
    fn stroke_changed(
        &self,
        canvas: &mut Canvas,
        movement: &SceneMove,
        place: &PageTransform,
        kind: Option<ChangeKind>,
    ) {
        let kind = kind.filter(|_| movement.kind != MoveKind::Sweep);
        stroke(canvas, movement, place, Style::of(kind, self.groups));
    }
}

fn stroke_all(canvas: &mut Canvas, moves: &[ComparedMove], place: &PageTransform, color: &'static str) {
    for ComparedMove { movement, .. } in moves {
        stroke(canvas, movement, place, Style::plain(color));
    }
}

fn stroke(canvas: &mut Canvas, movement: &SceneMove, place: &PageTransform, style: Style) {
    let Style { color, dashes, width } = style;
    if !movement.is_placed() || movement.kind == MoveKind::Lift {
        return;
    }
    if matches!(movement.kind, MoveKind::Plunge | MoveKind::Probe) {
        return canvas.circle(
            place.to_page(movement.to()),
            width + 0.5,
            &format!("fill=\"{color}\" stroke=\"{color}\"{dashes}"),
        );
    }
    let (width, dashes) = if movement.kind == MoveKind::Sweep { (0.7, DOT_PATTERN) } else { (width, dashes) };
    canvas.path(
        &path_data(&movement.way, place),
        &format!("stroke=\"{color}\" stroke-width=\"{}\"{dashes}", svg_number(width)),
    );
}

/// Dash pattern of rapid moves.
const DOT_PATTERN: &str = " stroke-dasharray=\"1 4\"";

/// Width of lines in px, except for removed moves.
const LINE_WIDTH: f64 = 2.0;
/// Width of removed moves in px: they are wider, so that they remain visible beneath the moves that replace them.
const REMOVED_WIDTH: f64 = 6.0;

/// The stroke of an entry of the legend and its moves.
#[derive(Clone, Copy)]
struct Style {
    color: &'static str,
    dashes: &'static str,
    width: f64,
}

impl Style {
    fn plain(color: &'static str) -> Self {
        Self { color, dashes: "", width: LINE_WIDTH }
    }

    /// Returns the style of the moves in a group. For rapid moves, `kind` is `None`.
    fn of(kind: Option<ChangeKind>, groups: &[Group]) -> Self {
        let [color, dashes] = match kind {
            None => [RAPIDS_COLOUR, DOT_PATTERN],
            Some(ChangeKind::Reordered) => [REORDERED_COLOUR, " stroke-dasharray=\"9 3 2 3\""],
            Some(ChangeKind::Added) => [ADDED_COLOUR, ""],
            Some(ChangeKind::Removed) => {
                [REMOVED_COLOUR, " stroke-dasharray=\"5 4\" stroke-linecap=\"butt\""]
            }
            Some(ChangeKind::Shifted(_)) => [SHIFTED_COLOUR, ""],
            Some(ChangeKind::Altered { .. }) => {
                let is_altered = |group: &&Group| matches!(group.kind, Some(ChangeKind::Altered { .. }));
                let place = groups.iter().filter(is_altered).position(|group| group.kind == kind);
                ALTERED_STYLES[place.unwrap_or_default() % ALTERED_STYLES.len()]
            }
        };
        let width = if kind == Some(ChangeKind::Removed) { REMOVED_WIDTH } else { LINE_WIDTH };
        Self { color, dashes, width }
    }
}

/// Draws an entry of the legend.
fn draw_entry(canvas: &mut Canvas, group: &Group, style: Option<Style>, top: f64, lang: Lang) {
    let middle = top + LINE_HEIGHT / 2.0;
    if let Some(Style { color, dashes, width }) = style {
        let style = format!("stroke=\"{color}\" stroke-width=\"{}\"{dashes}", svg_number(width));
        canvas.line([40.0, middle], [76.0, middle], &style);
    }
    let length = Number((group.length * 100.0).round() / 100.0).prose(lang);
    let text = format!("{}: {}, {length} mm", phrase(group, lang), moves(group, lang));
    canvas.text(
        [86.0, middle + LETTER_SIZE / 3.0],
        LETTER_SIZE,
        Anchor::Start,
        &format!("fill=\"{INK_COLOUR}\""),
        &text,
    );
}

fn frame<'a>(moves: impl Iterator<Item = &'a SceneMove>) -> Frame {
    Frame::around(bounding_box(moves.filter_map(SceneMove::extent)))
}
