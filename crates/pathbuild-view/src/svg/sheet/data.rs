//! The data of a setup sheet, values derived from it, and the texts in both languages.

use pathbuild_diagnostic::{Lang, with_decimal_separator};

use crate::extent::{Corners, bounding_box, with_margin};
use crate::scene::{BilingualText, KeepOut, MoveKind, Point, Scene, SceneMove, ScenePath};
use crate::svg::canvas::mm;

/// Width and height of a page in mm.
pub(super) const PAPER: Point = [210.0, 297.0];

/// Units of a page's SVG per mm of paper. A letter size of 10 units is 9.4 pt.
pub(super) const UNITS_PER_MM: f64 = 3.0;

/// The data of a setup sheet. Lengths are in mm.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Name of the path, or the name given to several joined paths.
    pub title: String,
    /// File names of the paths' drawings, without directories.
    pub drawings: Vec<String>,
    /// The names of the programs, in the order in which the machine runs them.
    pub programs: Vec<String>,
    /// Name of the file in which the operator writes measured heights; `None` without Z-probes.
    pub values: Option<String>,
    /// Two lines of the programs' headers: the provenance, and the title.
    pub head: [String; 2],
    /// The hashes in the line of provenance that identify the program.
    pub hashes: String,
    /// The scene, in coordinates of the program.
    pub scene: Scene,
    /// The cutters in order of first use.
    pub tools: Vec<SheetTool>,
    /// For each path of the scene, the index of its cutter in `tools`.
    pub path_tools: Vec<usize>,
    /// Whether the program stops for the operator to change the cutter, whose length the control does not know.
    pub has_manual_changes: bool,
    /// Whether the program selects the work offset G54.
    pub selects_g54: bool,
    /// Whether the program starts the spindle.
    pub starts_spindle: bool,
    /// Ranges of X, Y and Z of the tool tip while cutting.
    pub cutting_box: [Option<(f64, f64)>; 3],
    /// Total length of the moves.
    pub length: f64,
    /// Duration in minutes; `None` if the rapid feed is unknown.
    pub minutes: Option<f64>,
    /// Rapid feed in mm/min.
    pub rapid: Option<f64>,
    /// Z-probes in measuring order.
    pub probes: Vec<SheetProbe>,
    /// Elements on the paths' layers that are not part of the programs.
    pub left_out: Vec<BilingualText>,
}

/// A cutter, and the settings for it.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetTool {
    /// Diameter O in mm.
    pub diameter: f64,
    /// Number T of the tool in the machine.
    pub number: Option<u32>,
    /// Name of the tool in the configuration.
    pub name: Option<String>,
    /// Spindle speed in revolutions per minute.
    pub speed: Option<f64>,
    /// Whether the spindle turns clockwise; `None` if the configuration does not state it.
    pub clockwise: Option<bool>,
    /// Number of cutting edges.
    pub flutes: Option<u32>,
    /// Radius of the corners in mm; 0 if they are sharp.
    pub corner_radius: f64,
    /// Length of the cutting edges in mm.
    pub length: Option<f64>,
    /// Names of the paths that are milled with the cutter.
    pub paths: Vec<String>,
}

/// A point that is measured before milling.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetProbe {
    /// Number of the control's parameter that stores the measured height: 51 for #51.
    pub number: usize,
    /// Text that precedes the value in the file for measured heights.
    pub name: String,
    /// Position in the coordinates of the program.
    pub at: Point,
    /// Expected height in mm.
    pub height: f64,
}

/// Returns the bounding box of the removed material seen from above; `None` if nothing is cut.
pub(super) fn removed_box(sheet: &Sheet) -> Option<Corners> {
    let cuts = |path: &ScenePath| {
        let cuts = path.moves.iter().filter(|movement| movement.kind.cuts()).filter_map(SceneMove::extent);
        Some(with_margin(bounding_box(cuts)?, path.tool.unwrap_or_default() / 2.0))
    };
    bounding_box(sheet.scene.paths.iter().filter_map(cuts))
}

/// Returns the bounding box of everything that the picture shows.
pub(super) fn shown_box(sheet: &Sheet) -> Corners {
    let moves = sheet.scene.paths.iter().flat_map(|path| &path.moves).filter_map(SceneMove::extent);
    let clamps = sheet.scene.keep_outs.iter().filter_map(KeepOut::extent);
    let zero_and_probes = [[0.0; 2]].into_iter().chain(sheet.probes.iter().map(|probe| probe.at));
    let points = zero_and_probes.map(|at| [at; 2]);
    bounding_box(removed_box(sheet).into_iter().chain(moves).chain(clamps).chain(points)).unwrap_or_default()
}

/// Returns the feeds in mm/min of a kind of moves, in ascending order without duplicates.
pub(super) fn feeds(sheet: &Sheet, kind: MoveKind) -> Vec<f64> {
    let moves = sheet.scene.paths.iter().flat_map(|path| &path.moves);
    let mut feeds: Vec<f64> = moves
        .filter(|movement| movement.kind == kind)
        .filter_map(|movement| movement.way.pace.feed())
        .collect();
    feeds.sort_by(f64::total_cmp);
    feeds.dedup();
    feeds
}

/// The heights in mm of rapid moves.
#[derive(Debug, PartialEq)]
pub(super) struct RapidHeights {
    /// Heights of moves in the plane, in ascending order.
    pub(super) across: Vec<f64>,
    /// Number of heights in `across` that are below the upper face of the material, where moves cross areas already milled.
    pub(super) inside: usize,
    /// Lowest end of the moves straight down.
    pub(super) down: Option<f64>,
    /// Lowest end of the moves straight up.
    up: Option<f64>,
}

impl RapidHeights {
    pub(super) fn lowest(&self) -> Option<f64> {
        self.across.iter().copied().chain(self.down).chain(self.up).reduce(f64::min)
    }
}

pub(super) fn rapid_heights(sheet: &Sheet) -> RapidHeights {
    let moves = || sheet.scene.paths.iter().flat_map(|path| &path.moves);
    let sweeps = moves().filter(|movement| movement.kind == MoveKind::Sweep);
    let mut across: Vec<f64> = sweeps.filter_map(SceneMove::depth).collect();
    across.sort_by(f64::total_cmp);
    across.dedup();
    let lowest_end = |is_down: bool| {
        let lifts = moves().filter(|movement| movement.kind == MoveKind::Lift);
        let lifts = lifts.filter(|movement| (movement.way.to.z() < movement.way.from.z()) == is_down);
        lifts.map(|movement| movement.way.to.z()).reduce(f64::min)
    };
    let surface = sheet.scene.paths.iter().filter_map(|path| path.thickness).fold(f64::INFINITY, f64::min);
    let inside = if surface.is_finite() { across.partition_point(|z| *z < surface) } else { 0 };
    RapidHeights { across, inside, down: lowest_end(true), up: lowest_end(false) }
}

/// Returns the distinct values, in order of first occurrence.
pub(super) fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct = Vec::new();
    for value in values {
        if !distinct.contains(&value) {
            distinct.push(value);
        }
    }
    distinct
}

/// Formats a length for a sentence, with the language's decimal separator.
pub(super) fn localized_mm(length: f64, lang: Lang) -> String {
    with_decimal_separator(mm(length), lang)
}

/// Describes the distance of zero from the lower end of a range along X (`is_across`) or Y.
pub(super) fn distance_of_zero(low: f64, is_across: bool, lang: Lang) -> String {
    let (sides, edge) = match (is_across, lang) {
        (true, Lang::En) => (["right", "left"], "left edge"),
        (true, Lang::De) => (["rechts", "links"], "linken Rand"),
        (false, Lang::En) => (["above", "below"], "lower edge"),
        (false, Lang::De) => (["über", "unter"], "unteren Rand"),
    };
    if low.abs() < 0.0005 {
        return lang.choose(format!("on the {edge}"), format!("auf dem {edge}"));
    }
    let side = if low < 0.0 { sides[0] } else { sides[1] };
    let length = localized_mm(low.abs(), lang);
    match (lang, is_across) {
        (Lang::En, true) => format!("{length} mm {side} of the {edge}"),
        (Lang::En, false) => format!("{length} mm {side} the {edge}"),
        (Lang::De, true) => format!("{length} mm {side} vom {edge}"),
        (Lang::De, false) => format!("{length} mm {side} dem {edge}"),
    }
}
