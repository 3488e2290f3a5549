//! Pictures of how a changed drawing affects the moves of a path. Old and new share one frame, so that the pictures can be overlaid.

use pathbuild_diagnostic::Lang;

use super::canvas::{Anchor, BAR, Canvas, INK, OTHER, RAPID, n};
use super::frame::{Frame, PageTransform, widen};
use super::moves::data;
use crate::changes::{Change, ChangeKind, Group, groups, moves, phrase};

use crate::scene::{MoveKind, Point, SceneMove};

/// Added moves are blue, removed ones vermilion and dashed. The dashes also distinguish them for the colour-blind.
const ADDED: &str = "#0072b2";
const REMOVED: &str = "#d55e00";
const SHIFTED: &str = "#009e73";

/// Height of a line of the legend, and size of its letters, in px.
const LINE: f64 = 20.0;
const LETTERS: f64 = 13.0;

/// The available pictures of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// Old and new in one picture, with changes in colour and a legend.
    Changes,
    /// The moves of the old program.
    Old,
    /// The moves of the new program.
    New,
}

/// The programs of a path before and after a change, and the differences between them.
#[derive(Clone, Copy, Debug)]
struct Pair<'a> {
    old: &'a [SceneMove],
    new: &'a [SceneMove],
    changes: &'a [Change],
}

/// Draws a change. All pictures of a change have the same size and scale.
pub fn changes_svg(
    old: &[SceneMove],
    new: &[SceneMove],
    changes: &[Change],
    picture: Picture,
    lang: Lang,
) -> String {
    let frame = frame(old.iter().chain(new));
    let place = frame.of_drawing();
    let pair = Pair { old, new, changes };
    let groups = groups(changes, old, new);
    let legend = if picture == Picture::Changes { groups.len() as f64 * LINE } else { 0.0 };
    let mut canvas = Canvas::new(Frame::WIDTH, frame.bottom() + legend);
    canvas.open("fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    match picture {
        Picture::Old => all(&mut canvas, old, &place, REMOVED),
        Picture::New => all(&mut canvas, new, &place, ADDED),
        Picture::Changes => pair.draw(&mut canvas, &place),
    }
    canvas.close();
    if picture == Picture::Changes {
        for (index, group) in groups.iter().enumerate() {
            entry(&mut canvas, group, frame.bottom() + index as f64 * LINE, lang);
        }
    }
    canvas.finish()
}

impl Pair<'_> {
    /// Draws unchanged moves in grey, and changed ones on top.
    fn draw(&self, canvas: &mut Canvas, place: &PageTransform) {
        let mut is_changed = vec![false; self.new.len()];
        for change in self.changes {
            is_changed[change.new.clone()].fill(true);
        }
        let stays = self.new.iter().zip(&is_changed).filter(|(_, is_changed)| !**is_changed);
        for (movement, _) in stays {
            stroke(canvas, movement, place, OTHER, "");
        }
        for change in self.changes {
            let (old, new) = (&self.old[change.old.clone()], &self.new[change.new.clone()]);
            let was = if matches!(change.kind, ChangeKind::Altered { .. } | ChangeKind::Reordered) {
                &[]
            } else {
                old
            };
            for movement in was {
                stroke(canvas, movement, place, REMOVED, DASHES);
            }
            for movement in new {
                stroke(canvas, movement, place, color(Some(change.kind)), dashes(Some(change.kind)));
            }
        }
    }
}

const DASHES: &str = " stroke-dasharray=\"5 4\"";

fn all(canvas: &mut Canvas, moves: &[SceneMove], place: &PageTransform, color: &str) {
    for movement in moves {
        stroke(canvas, movement, place, color, "");
    }
}

fn stroke(canvas: &mut Canvas, movement: &SceneMove, place: &PageTransform, color: &str, dashes: &str) {
    if !movement.is_placed() || movement.kind == MoveKind::Lift {
        return;
    }
    if matches!(movement.kind, MoveKind::Plunge | MoveKind::Probe) {
        return canvas.circle(
            place.at(movement.to()),
            2.5,
            &format!("fill=\"{color}\" stroke=\"{color}\"{dashes}"),
        );
    }
    let (width, dashes) =
        if movement.kind == MoveKind::Sweep { (0.7, " stroke-dasharray=\"1 4\"") } else { (2.0, dashes) };
    canvas.path(
        &data(&movement.way, place),
        &format!("stroke=\"{color}\" stroke-width=\"{}\"{dashes}", n(width)),
    );
}

fn color(kind: Option<ChangeKind>) -> &'static str {
    match kind {
        None | Some(ChangeKind::Reordered) => RAPID,
        Some(ChangeKind::Added) => ADDED,
        Some(ChangeKind::Removed) => REMOVED,
        Some(ChangeKind::Altered { .. }) => BAR,
        Some(ChangeKind::Shifted(_)) => SHIFTED,
    }
}

fn dashes(kind: Option<ChangeKind>) -> &'static str {
    match kind {
        Some(ChangeKind::Removed) => DASHES,
        Some(ChangeKind::Reordered) => " stroke-dasharray=\"9 3 2 3\"",
        _ => "",
    }
}

/// Draws a line of the legend.
fn entry(canvas: &mut Canvas, group: &Group, top: f64, lang: Lang) {
    let middle = top + LINE / 2.0;
    let style = format!("stroke=\"{}\" stroke-width=\"2\"{}", color(group.kind), dashes(group.kind));
    canvas.line([40.0, middle], [76.0, middle], &style);
    let text = format!("{}: {}, {} mm", phrase(group, lang), moves(group, lang), n(group.length));
    canvas.text([86.0, middle + LETTERS / 3.0], LETTERS, Anchor::Start, &format!("fill=\"{INK}\""), &text);
}

fn frame<'a>(moves: impl Iterator<Item = &'a SceneMove>) -> Frame {
    let mut corners: Option<[Point; 2]> = None;
    for extent in moves.filter_map(SceneMove::extent) {
        widen(&mut corners, extent);
    }
    Frame::around(corners)
}
