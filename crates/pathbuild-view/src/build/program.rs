//! Scenes of paths with their programs.

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::statistics::statistics;
use pathbuild_motion as motion;
use pathbuild_path::{Arc, Curve, Path, Placement, SegmentKind, Shape as DrawnShape, Xy};
use pathbuild_toolpath::{Occurrence, Program, StepOrigin, Trace, support_bars};

use super::drawn::{DrawnSource, curve_shape, pair};
use super::gcode::plain_lines;
use super::lines::lines_of_moves;
use crate::scene::{
    Bar, ElementKind, EmbeddedPath, Move, MoveKind, NativeText, ProbeMark, ScenePath, Totals,
};

/// The number of the parameter for the first probe.
const FIRST_PARAMETER: usize = 51;

/// A program with the origin of its steps.
#[derive(Clone, Copy, Debug)]
pub struct ProgramSource<'a> {
    /// The program.
    pub program: &'a Program,
    /// The origin of its steps; paths are indices into `parts`.
    pub trace: &'a Trace<usize>,
    /// Its paths, as drawn and with all parameters bound.
    pub parts: &'a [(DrawnSource<'a>, &'a Path)],
    /// Its native text, written without splitting moves.
    pub text: &'a str,
    /// Its text as written by `emit`; `None` to show only the native text.
    pub emitted: Option<EmittedText<'a>>,
    /// The value of `--rapid` in mm/min.
    pub rapid: Option<f64>,
}

/// The emitted text of a program.
#[derive(Clone, Copy, Debug)]
pub struct EmittedText<'a> {
    /// The file that `emit` writes, if any.
    pub file: Option<&'a str>,
    /// Its text; invalid UTF-8 is replaced.
    pub bytes: &'a [u8],
    /// The dialect for reading it.
    pub dialect: Dialect,
    /// Whether a post wrote it, so that it differs from the native text.
    pub is_posted: bool,
}

/// The scene of a path with its program.
pub fn program_path(source: &ProgramSource<'_>) -> ScenePath {
    let ProgramSource { program, trace, parts, text, emitted, rapid } = source;
    let mut builder = Builder { scene: ScenePath::default(), first_elements: Vec::new() };
    for occurrence in &trace.occurrences {
        builder.occurrence(occurrence, &parts[occurrence.id]);
    }
    let (bytes, dialect) =
        emitted.map_or((text.as_bytes(), Dialect::Native), |emitted| (emitted.bytes, emitted.dialect));
    let ways: Vec<_> = program.moves().collect();
    let of_text = |bytes, dialect| {
        let moves: Vec<_> = ways.iter().map(|(_, way)| *way).collect();
        lines_of_moves(&moves, bytes, dialect)
    };
    builder.moves(&ways, trace, &of_text(bytes, dialect));
    let native = emitted.filter(|emitted| emitted.is_posted).map(|_| NativeText {
        gcode: plain_lines(text.as_bytes()),
        lines: of_text(text.as_bytes(), Dialect::Native),
    });
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
        totals: Some(totals),
        gcode: Some(plain_lines(bytes)),
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
    /// Index of the first element of each occurrence.
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
        });
        let first = self.scene.draw(drawn, placement);
        self.first_elements.push(first);
        self.bars(path, placement, *raised, first);
    }

    fn element(&self, drawn: StepOrigin) -> Option<u32> {
        Some(self.first_elements.get(drawn.occurrence as usize)? + drawn.element?)
    }

    /// The support bars along the segments and circles of a path.
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
                    let radius = helix.axis_radius(path.tool);
                    helix
                        .bars
                        .map(|(bottom, bars)| (bars, bottom, circle(placement.place(helix.centre), radius)))
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

    fn moves(&mut self, ways: &[(u32, motion::Move)], trace: &Trace<usize>, lines: &[Option<u32>]) {
        for ((step, way), line) in ways.iter().zip(lines) {
            let mut movement = Move::new(*way, *line);
            let step = *step as usize - 1;
            movement.element = trace.steps.get(step).and_then(|drawn| self.element(*drawn));
            let kind = movement.element.map(|element| self.scene.elements[element as usize].kind);
            if movement.kind == MoveKind::Mill && kind == Some(ElementKind::Mark) {
                movement.kind = MoveKind::Mark;
            }
            self.scene.moves.push(movement);
        }
    }

    /// Numbers the elements in cutting order.
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

/// The circle of a cutter's centre, clockwise from its lowest point.
fn circle(centre: Xy, radius: f64) -> Curve {
    let low = Xy::new(centre.x, centre.y - radius);
    Curve::Arc(Arc { centre, radius, start: low, end: low, clockwise: true, degrees: 360.0 })
}
