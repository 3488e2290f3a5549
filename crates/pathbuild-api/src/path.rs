//! A path as it is drawn, and the moves of its program.

use pathbuild_motion::{Axes, MoveShape, Position};
use pathbuild_view::{self as view, SceneMove, ScenePath};

use crate::Finding;

/// A path with all paths that it embeds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Path {
    /// Name of the path, as the layer spells it.
    pub name: String,
    /// File of the drawing that contains the path.
    pub file: String,
    /// Material (M), as the drawing writes it; `None` if it states none. An embedded path may have another material: see the parameters of its
    /// elements.
    pub material: Option<String>,
    /// Upper face of the material (T), in mm.
    pub thickness: Option<f64>,
    /// Cutter diameter (O), in mm.
    pub tool: Option<f64>,
    /// Sweep height (S), in mm.
    pub sweep_height: Option<f64>,
    /// Position in the drawing, in mm, of the program's zero point (X0 Y0).
    pub zero: [f64; 2],
    /// The elements on the layers of the path and of the paths that it embeds.
    pub elements: Vec<Element>,
    /// The tool's moves, in order. Empty if errors leave them unknown. Errors about cuts into parts, support bars or clamps do not, so that these
    /// moves can be displayed.
    pub moves: Vec<Move>,
    /// Lengths and times; `None` if the path has errors, so that there is no program.
    pub statistics: Option<Statistics>,
    /// Findings about the path and the paths that it embeds.
    pub findings: Vec<Finding>,
}

/// A drawn element, a marker or a probe. (book: language/line-types)
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Element {
    /// Name of the path with the element on its layer.
    pub path: String,
    /// File of the drawing that contains that path.
    pub file: String,
    /// Type of the element in the drawing, for example `LINE`.
    pub entity: String,
    /// Layer of the element, as the drawing spells it.
    pub layer: String,
    /// Handle of the element in the drawing, in hexadecimal digits.
    pub handle: Option<String>,
    /// The line of the drawing's file at which the element begins, counted from 1.
    pub line: Option<u32>,
    /// The parameters that apply to the element.
    pub parameters: Vec<Parameter>,
}

/// A parameter that applies to an element. (book: language/letters)
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Parameter {
    /// Letter of the parameter, such as `B` or `F`.
    pub letter: char,
    /// Value of the parameter, as the drawing writes it, with variables replaced.
    pub value: String,
    /// Source of the value: `own` (a text of the element), `chain` (the text of the first segment of its chain), `path` (the text of the path),
    /// `lender` (the path named by @), `option` (the configuration or an option) or `default`.
    pub source: String,
}

/// A move of the tool tip, in coordinates of the program.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Move {
    /// Purpose of the move.
    pub kind: MoveKind,
    /// Start of the move: x, y, z in mm; `None` for a coordinate that the program does not state.
    pub from: [Option<f64>; 3],
    /// End of the move: x, y, z in mm; `None` for a coordinate that the program does not state.
    pub to: [Option<f64>; 3],
    /// Arc along which the tool moves; `None` for a straight move.
    pub arc: Option<Arc>,
    /// Feed in mm/min, as written in the program; `None` for a rapid move.
    pub feed: Option<f64>,
    /// Length of the move in mm.
    pub length: f64,
    /// The element that the move mills or plunges into, as an index into [`Path::elements`]; `None` for moves between elements.
    pub element: Option<usize>,
    /// Line of the move in the program, counted from 1.
    pub line: Option<u32>,
}

/// The purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MoveKind {
    /// A rapid move that is not straight up or down.
    Sweep,
    /// A rapid move straight up or down.
    Lift,
    /// A cut straight up or down.
    Plunge,
    /// A cut along an element that is milled to its full depth.
    Mill,
    /// A cut along an element that is only marked, that is, milled to the height D.
    Mark,
    /// A move down until the probe makes contact.
    Probe,
}

/// An arc in a plane. If its ends differ along the third axis, it is a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Arc {
    /// The axes of the plane: 0 for X, 1 for Y, 2 for Z.
    pub axes: [usize; 2],
    /// The centre along these axes, in mm.
    pub centre: [f64; 2],
    /// Whether the arc turns clockwise, as seen from the positive end of the third axis.
    pub clockwise: bool,
    /// The swept angle, in degrees.
    pub degrees: f64,
}

/// Lengths of moves in mm and time in minutes. (book: program/gcode)
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Statistics {
    /// Length of cuts along elements, in mm.
    pub milling: f64,
    /// Length of cuts straight up or down, in mm.
    pub drilling: f64,
    /// Length of rapid moves, in mm.
    pub sweeps: f64,
    /// Estimated working time, in whole minutes; `None` if the rapid feed is not set.
    pub minutes: Option<f64>,
}

impl Path {
    pub(crate) fn new(path: ScenePath, findings: Vec<Finding>) -> Self {
        let element = |element: &view::Element| {
            let owner = &path.embedded[element.path as usize];
            Element {
                path: owner.name.clone(),
                file: owner.file.clone(),
                entity: element.entity.to_owned(),
                layer: element.layer.clone(),
                handle: element.handle.clone(),
                line: element.line,
                parameters: element.parameters.iter().map(Parameter::new).collect(),
            }
        };
        Self {
            elements: path.elements.iter().map(element).collect(),
            moves: path.moves.iter().map(Move::new).collect(),
            statistics: path.totals.as_ref().map(Statistics::new),
            name: path.name,
            file: path.file,
            material: path.material,
            thickness: path.thickness,
            tool: path.tool,
            sweep_height: path.sweep_height,
            zero: path.zero,
            findings,
        }
    }
}

impl Element {
    /// Returns the parameter with this letter that applies to the element.
    pub fn parameter(&self, letter: char) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.letter == letter)
    }
}

impl Parameter {
    fn new(parameter: &view::Parameter) -> Self {
        Self { letter: parameter.letter, value: parameter.value.clone(), source: parameter.from.to_owned() }
    }
}

impl Move {
    fn new(scene_move: &SceneMove) -> Self {
        let SceneMove { kind, way, length, element, line, tool: _ } = scene_move;
        let point =
            |end: &Position| [0, 1, 2].map(|axis| end.known.has(Axes::of(axis)).then_some(end.at[axis]));
        let arc = match way.shape {
            MoveShape::Line => None,
            MoveShape::Arc(arc) => Some(Arc {
                axes: arc.plane.axes(),
                centre: arc.centre,
                clockwise: arc.clockwise,
                degrees: arc.sweep(&way.from, &way.to).to_degrees(),
            }),
        };
        Self {
            kind: MoveKind::new(*kind),
            from: point(&way.from),
            to: point(&way.to),
            arc,
            feed: way.pace.feed(),
            length: *length,
            element: element.map(|element| element as usize),
            line: *line,
        }
    }
}

impl MoveKind {
    fn new(kind: view::MoveKind) -> Self {
        match kind {
            view::MoveKind::Sweep => Self::Sweep,
            view::MoveKind::Lift => Self::Lift,
            view::MoveKind::Plunge => Self::Plunge,
            view::MoveKind::Mill => Self::Mill,
            view::MoveKind::Mark => Self::Mark,
            view::MoveKind::Probe => Self::Probe,
        }
    }

    /// Whether moves of this kind remove material: milling, marking and plunging do, probing does not.
    pub fn cuts(self) -> bool {
        matches!(self, Self::Plunge | Self::Mill | Self::Mark)
    }
}

impl Statistics {
    fn new(totals: &view::Totals) -> Self {
        let view::Totals { milling, drilling, sweeps, minutes } = *totals;
        Self { milling, drilling, sweeps, minutes }
    }
}
