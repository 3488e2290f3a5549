//! Builds scenes of paths with their programs, and of G-code.

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Heights, Options, interpret_each};
use pathbuild_gcode::native::FIRST_PARAMETER;
use pathbuild_gcode::statistics::{LengthFilter, Summary, statistics};
use pathbuild_motion::{Axes, Move, Pace, Position, Step};
use pathbuild_path::{Curve, Path, Placement, SegmentKind, Shape as DrawnShape};
use pathbuild_toolpath::{Occurrence, Program, StepOrigin, Trace, axis_circle, support_bars};

use super::drawn::{DrawnSource, curve_shape, pair};
use crate::scene::{
    Bar, ElementKind, EmbeddedPath, MoveKind, NativeText, ProbeMark, SceneMove, ScenePath, Totals,
};

/// The input for the scene of a path with its program.
#[derive(Clone, Copy, Debug)]
pub struct ProgramSource<'a> {
    /// The steps of the program.
    pub program: &'a Program,
    /// Origin of each step. Paths are given as indices into `parts`.
    pub trace: &'a Trace<usize>,
    /// The path and the paths that it embeds, as drawn and with all parameters bound.
    pub parts: &'a [(DrawnSource<'a>, &'a Path)],
    /// Native text of the program, in which moves are not split for the correction of heights; `None` to omit it.
    pub native: Option<&'a str>,
    /// Text of the program as written by `emit`; `None` to omit it.
    pub emitted: Option<GcodeText<'a>>,
    /// Speed of rapid moves in mm/min (the value of `--rapid`).
    pub rapid: Option<f64>,
}

/// The text of a program.
#[derive(Clone, Copy, Debug)]
pub struct GcodeText<'a> {
    /// Path of the file that `emit` writes, if any.
    pub file: Option<&'a str>,
    /// Bytes of the text. Invalid UTF-8 is replaced when it is shown.
    pub bytes: &'a [u8],
    /// Dialect in which the text is read.
    pub dialect: Dialect,
}

/// Returns the scene of a path with its program.
pub fn program_path(source: &ProgramSource<'_>) -> ScenePath {
    let ProgramSource { program, trace, parts, native, emitted, rapid } = source;
    let mut builder = Builder { scene: ScenePath::default(), first_elements: Vec::new() };
    let drawn = |occurrence: &Occurrence<usize>| parts[occurrence.id].0.elements();
    builder.scene.elements.reserve_exact(trace.occurrences.iter().map(drawn).sum());
    for occurrence in &trace.occurrences {
        builder.occurrence(occurrence, &parts[occurrence.id]);
    }
    let native_text =
        native.map(|text| GcodeText { file: None, bytes: text.as_bytes(), dialect: Dialect::Native });
    let shown = emitted.or(native_text);
    let lines = |text: GcodeText<'_>| lines_of_moves(program, text.bytes, text.dialect);
    builder.moves(program, trace, &shown.map(lines).unwrap_or_default());
    let native = native_text.filter(|_| emitted.is_some());
    let native = native.map(|text| NativeText { gcode: plain_lines(text.bytes), lines: lines(text) });
    builder.number_elements();
    let root = parts[trace.occurrences[0].id];
    let totals = totals(program, *rapid);
    let probe = |(index, probe): (usize, &pathbuild_toolpath::ProbePoint)| ProbeMark {
        number: FIRST_PARAMETER + index,
        at: pair(probe.at),
        height: probe.height,
        feed: probe.feed,
        label: probe.label.as_deref().map(str::to_owned),
    };
    ScenePath {
        name: program.path.to_string(),
        file: root.0.file.to_owned(),
        zero: pair(root.1.start),
        tool: Some(program.tool),
        thickness: Some(program.thickness),
        sweep_height: Some(program.sweep_height),
        material: root.1.material.as_ref().map(ToString::to_string),
        probes: program.probes.iter().enumerate().map(probe).collect(),
        rapid: *rapid,
        totals: Some(totals),
        gcode: shown.map(|text| plain_lines(text.bytes)),
        written: emitted.and_then(|emitted| emitted.file).map(str::to_owned),
        native,
        ..builder.scene
    }
}

fn totals(program: &Program, rapid: Option<f64>) -> Totals {
    let statistics = statistics(program, rapid.unwrap_or(1.0));
    Totals {
        milling: statistics.milling.length,
        drilling: statistics.drilling.length,
        sweeps: statistics.sweeps.length,
        minutes: rapid.map(|_| statistics.sum().minutes()).filter(|minutes| minutes.is_finite()),
    }
}

struct Builder {
    scene: ScenePath,
    /// For each occurrence of a path in the program, the index of its first element.
    first_elements: Vec<u32>,
}

impl Builder {
    fn occurrence(&mut self, occurrence: &Occurrence<usize>, (drawn, path): &(DrawnSource<'_>, &Path)) {
        let Occurrence { placement, raised, .. } = occurrence;
        self.scene.embedded.push(EmbeddedPath {
            name: path.name.as_str().to_owned(),
            file: drawn.file.to_owned(),
            by: occurrence.parent.and_then(|parent| self.element(parent)),
            ends: [path.start, path.end].map(|end| pair(placement.place(end))),
            raised: *raised,
            thickness: raised + path.thickness,
            sweep_height: raised + occurrence.sweep_height,
            material: path.material.as_ref().map(ToString::to_string),
        });
        let first = self.scene.draw(drawn, placement);
        self.first_elements.push(first);
        self.bars(path, placement, *raised, first);
    }

    fn element(&self, drawn: StepOrigin) -> Option<u32> {
        Some(self.first_elements.get(drawn.occurrence as usize)? + drawn.element?)
    }

    /// Adds the support bars along the segments and circles of a path.
    fn bars(&mut self, path: &Path, placement: &Placement, raised: f64, first: u32) {
        for segment in &path.segments {
            let shape = path.drawn.elements[segment.element as usize].shape;
            let found = match (&segment.kind, shape) {
                (SegmentKind::Cut(cut), DrawnShape::Curve(curve)) => {
                    let cut = &path.cuts[*cut as usize];
                    cut.bars.map(|bars| (bars, cut.bottom, curve))
                }
                (SegmentKind::Helix(helix), _) => {
                    let helix = &path.helices[*helix as usize];
                    let circle = axis_circle(helix, path.tool, placement);
                    helix.bars.map(|(bottom, bars)| (bars, bottom, circle))
                }
                _ => None,
            };
            let Some((bars, bottom, curve)) = found else { continue };
            let is_placed = matches!(segment.kind, SegmentKind::Helix(_));
            let bar = |curve: &Curve| Bar {
                element: first + segment.element,
                shape: curve_shape(&if is_placed { *curve } else { placement.place_curve(curve) }),
                top: raised + bars.top,
            };
            self.scene.bars.extend(support_bars(&bars, bottom, path.tool, &curve).iter().map(bar));
        }
    }

    fn moves(&mut self, program: &Program, trace: &Trace<usize>, lines: &[Option<u32>]) {
        self.scene.moves.reserve_exact(program.moves().count());
        for (index, (step, way)) in program.moves().enumerate() {
            let mut movement = SceneMove::new(way, lines.get(index).copied().flatten());
            let step = step as usize - 1;
            movement.element = trace.steps.get(step).and_then(|drawn| self.element(*drawn));
            let kind = movement.element.map(|element| self.scene.elements[element as usize].kind);
            if movement.kind == MoveKind::Mill && kind == Some(ElementKind::Mark) {
                movement.kind = MoveKind::Mark;
            }
            self.scene.moves.push(movement);
        }
    }

    fn number_elements(&mut self) {
        let mut next = 1;
        for movement in &self.scene.moves {
            let Some(element) = movement.element else { continue };
            let element = &mut self.scene.elements[element as usize];
            if movement.kind.cuts() && element.order.is_none() {
                element.order = Some(next);
                next += 1;
            }
        }
    }
}

/// The input for the scene of a G-code program.
#[derive(Clone, Copy, Debug)]
pub struct GcodeSource<'a> {
    /// Display name of the program's file.
    pub file: &'a str,
    /// Interpreted steps of the program.
    pub steps: &'a [Step],
    /// Bytes of the program. Invalid UTF-8 is replaced when it is shown.
    pub text: &'a [u8],
    /// Cutter diameter in mm, if known.
    pub tool: Option<f64>,
    /// Speed of rapid moves in mm/min (the value of `--rapid`).
    pub rapid: Option<f64>,
}

/// Decodes a text and converts its line ends to LF, so that line numbers agree with those of the reader.
fn plain_lines(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    if !text.contains('\r') {
        return text.into_owned();
    }
    if text.contains('\n') { text.replace("\r\n", "\n").replace('\r', " ") } else { text.replace('\r', "\n") }
}

/// Returns the scene of a program: its moves, without any elements.
pub fn gcode_path(source: &GcodeSource<'_>) -> ScenePath {
    let mut counting = LengthFilter::default();
    let scene_move = |step: &Step| {
        let is_counted = counting.includes_length(step);
        let (line, way) = step.as_move()?;
        let movement = SceneMove::new(way, Some(line));
        Some(SceneMove { length: if is_counted { movement.length } else { 0.0 }, ..movement })
    };
    let moves = source.steps.iter().filter_map(scene_move).collect();
    let summary = Summary::of(source.steps, false).total;
    ScenePath {
        name: source.file.to_owned(),
        file: source.file.to_owned(),
        tool: source.tool,
        rapid: source.rapid,
        moves,
        totals: Some(Totals {
            milling: summary.milling.total.length,
            drilling: summary.drilling.total.length,
            sweeps: summary.rapid.total.length,
            minutes: source
                .rapid
                .map(|rapid| summary.sum(rapid).minutes())
                .filter(|minutes| minutes.is_finite()),
        }),
        gcode: Some(plain_lines(source.text)),
        ..ScenePath::default()
    }
}

// A post may write other rapid moves than the native program, cycles for holes, and several lines for a move. Therefore the moves of a
// program are matched with lines of its text by the ends of moves.

/// Distance in mm up to which two ends are considered the same. It is larger than the rounding error of inches with four decimals.
const PLACE_TOLERANCE: f64 = 0.006;

/// Maximum number of moves in the text that are searched for the end of one move.
const MAX_SEARCHED_MOVES: usize = 4096;

/// Returns for each move of a program its line in the text that was written from the program; `None` if it has no line.
fn lines_of_moves(program: &Program, text: &[u8], dialect: Dialect) -> Vec<Option<u32>> {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let mut moves = program.moves().map(|(_, way)| way);
    let mut lines = Vec::new();
    let mut finder = LineFinder { written: Vec::new(), next: 0, last: None };
    let mut is_placed = false;
    interpret_each(text, dialect, &options, &mut |step| {
        let Some((line, movement)) = step.as_move() else { return };
        // Moves before the first fully known position depend on the machine and have no counterpart in the program.
        is_placed |= movement.from.known == Axes::ALL;
        if is_placed {
            finder.written.push((line, movement));
            while finder.written.len() >= finder.next + 2 * MAX_SEARCHED_MOVES
                && let Some(movement) = moves.next()
            {
                lines.push(finder.line_of_move(&movement));
            }
            finder.drop_matched_moves();
        } else {
            finder.last = Some(line);
        }
    });
    lines.extend(moves.map(|movement| finder.line_of_move(&movement)));
    lines
}

struct LineFinder {
    /// The written moves that may still be matched. Moves are read only as far as they are searched, because all moves of a long program
    /// would take more memory than its scene.
    written: Vec<(u32, Move)>,
    /// Index of the first written move that is not matched yet.
    next: usize,
    /// Line of the previous move; until a move is matched, the line of the written move that reaches the first fully known position.
    last: Option<u32>,
}

impl LineFinder {
    /// Drops the moves that are already matched, once there are many of them, to save memory.
    fn drop_matched_moves(&mut self) {
        if self.next >= MAX_SEARCHED_MOVES {
            self.written.drain(..self.next);
            self.next = 0;
        }
    }

    fn line_of_move(&mut self, movement: &Move) -> Option<u32> {
        match movement.pace {
            Pace::Rapid => self.line_of_rapid(movement),
            Pace::Feed(_) | Pace::Probe { .. } => self.line_of_cut(movement),
        }
    }

    /// Returns the first line of a cut. The post may have divided the cut into several moves, the last of which ends where the cut ends.
    fn line_of_cut(&mut self, movement: &Move) -> Option<u32> {
        let is_cut = |(_, written): &(u32, Move)| !matches!(written.pace, Pace::Rapid);
        let rest = &self.written[self.next..self.written.len().min(self.next + MAX_SEARCHED_MOVES)];
        let ends =
            |candidate: &(u32, Move)| is_cut(candidate) && is_same(&candidate.1.to, &movement.to, Axes::ALL);
        let end = rest.iter().position(ends)?;
        let first = rest[..=end].iter().find(|candidate| is_cut(candidate))?.0;
        self.next += end + 1;
        self.last = Some(first);
        Some(first)
    }

    /// Returns the line of a rapid move before the next cut: a rapid with the same start and end, or else with the same end, or else with
    /// the same end along the axes that the move changes, where the written move changes them as well. If there is none, one line of the text
    /// stands for several moves, and the line of the previous move is returned.
    fn line_of_rapid(&mut self, movement: &Move) -> Option<u32> {
        let rest = &self.written[self.next..];
        let rapids = rest.iter().take_while(|(_, written)| written.pace == Pace::Rapid);
        let rapids: Vec<&Move> = rapids.take(MAX_SEARCHED_MOVES).map(|(_, written)| written).collect();
        let moved = if movement.is_vertical() { Axes::Z } else { Axes::XY };
        let has_both = |written: &&Move| {
            is_same(&written.from, &movement.from, Axes::ALL) && is_same(&written.to, &movement.to, Axes::ALL)
        };
        let has_end = |written: &&Move| is_same(&written.to, &movement.to, Axes::ALL);
        let has_part = |written: &&Move| {
            is_same(&written.to, &movement.to, moved) && !is_same(&written.from, &written.to, moved)
        };
        let found = rapids.iter().position(has_both);
        let found = found.or_else(|| rapids.iter().position(has_end));
        let found = found.or_else(|| rapids.iter().position(has_part));
        if let Some(found) = found {
            self.last = Some(rest[found].0);
            self.next += found + 1;
        }
        self.last
    }
}

/// Whether two positions are known and, within [`PLACE_TOLERANCE`], equal along the given axes.
fn is_same(a: &Position, b: &Position, axes: Axes) -> bool {
    (0..3).filter(|axis| axes.has(Axes::of(*axis))).all(|axis| {
        a.known.and(b.known).has(Axes::of(axis)) && libm::fabs(a.at[axis] - b.at[axis]) < PLACE_TOLERANCE
    })
}
