//! Scenes from programs, drawings and G-code.

mod corners;
mod drawn;
mod program;

use std::collections::HashMap;

use pathbuild_diagnostic::messages::part;
use pathbuild_diagnostic::{Code, Diagnostic, Message, Value, escaping};
use pathbuild_motion::Axes;

use crate::scene::{BilingualText, Finding, Label, Point, Scene, SceneMove, ScenePath, Shape};

pub use drawn::{DrawnSource, drawn_path, finished_part, keep_out, other_layers, outline};
pub use program::{GcodeSource, GcodeText, ProgramSource, gcode_path, program_path};

impl Scene {
    /// Sets the findings of a scene. `file` is the drawing shown. A finding about a parameter text is placed at that text; one about a finished part
    /// at the defect of the part; one about an element at the middle of the element; one about a line of a program at the end of a move in that line.
    pub fn set_findings(&mut self, diagnostics: &[Diagnostic], file: &str) {
        let mut findings = findings(diagnostics, file);
        let places = self.places(file);
        for (finding, diagnostic) in findings.iter_mut().zip(diagnostics) {
            let line = finding.line.filter(|_| diagnostic.file.as_ref().is_some_and(|found| found == file));
            finding.at = places.of(diagnostic).or(finding.at).or_else(|| self.end_in_line(line?));
        }
        self.findings = findings;
    }

    /// Returns the end of the first move in a line of a program that was read; `None` for a drawing, whose lines are those of DXF.
    fn end_in_line(&self, line: u32) -> Option<Point> {
        self.program.as_ref()?;
        let mut moves = self.paths.iter().flat_map(|path| &path.moves);
        let is_end = |found: &&SceneMove| found.line == Some(line) && found.way.to.known.has(Axes::XY);
        moves.find(is_end).map(SceneMove::to)
    }

    /// Returns an index of the parameter texts and elements that findings refer to. `file` is the drawing shown.
    pub fn places<'s>(&'s self, file: &'s str) -> Places<'s> {
        let mut elements = HashMap::new();
        for path in &self.paths {
            let own =
                path.elements.iter().filter(|element| path.embedded[element.path as usize].file == file);
            for (element, line) in own.filter_map(|element| Some((element, element.line?))) {
                elements.entry(line).or_insert((element.shape, path.zero));
            }
        }
        Places { file, paths: &self.paths, elements }
    }
}

/// An index of the places in a drawing that findings refer to.
#[derive(Debug)]
pub struct Places<'s> {
    file: &'s str,
    paths: &'s [ScenePath],
    /// For each line of the file at which an element begins, the element's shape and the zero point of its path.
    elements: HashMap<u32, (Shape, Point)>,
}

impl Places<'_> {
    /// Returns the place of the parameter text, of the damage to a part, or of the element that a finding is about.
    pub fn of(&self, diagnostic: &Diagnostic) -> Option<Point> {
        text_at(self.paths, diagnostic, self.file)
            .or_else(|| self.damage(diagnostic))
            .or_else(|| self.middle_of_element(diagnostic))
    }

    /// Returns the place at which a part, or a support bar of it, is not as drawn. The finding's own place is the element that cuts there, which may
    /// be far away: the element of a project embeds a whole path. `None` for a finding about an embedded drawing, whose coordinates are those of
    /// another program.
    fn damage(&self, diagnostic: &Diagnostic) -> Option<Point> {
        diagnostic.file.as_ref().filter(|found| *found == self.file && diagnostic.trace.is_empty())?;
        let name = match diagnostic.code() {
            Code::GougedPart
            | Code::GougedNeighbour
            | Code::UnreachableCorner
            | Code::BarCutAway
            | Code::DisplacedPath => "point",
            Code::LeftoverAtPart => "from",
            _ => return None,
        };
        let Value::Point(at) = diagnostic.argument(name)? else { return None };
        let zero = if MESSAGES_IN_PROGRAM_COORDINATES.contains(&diagnostic.message) {
            let name = diagnostic.path.as_deref();
            self.paths.iter().find(|path| Some(&*path.name) == name)?.zero
        } else {
            [0.0, 0.0]
        };
        Some([at.x.0 + zero[0], at.y.0 + zero[1]])
    }

    /// Returns the middle of the element that a finding is about, if the finding's own place is only the start of the element.
    fn middle_of_element(&self, diagnostic: &Diagnostic) -> Option<Point> {
        diagnostic
            .file
            .as_ref()
            .filter(|found| *found == self.file && is_about_element(diagnostic.code()))?;
        let (at, line) = (diagnostic.place.point?, diagnostic.place.line?);
        let (shape, zero) = self.elements.get(&line)?;
        let in_drawing = |[x, y]: Point| [x + zero[0], y + zero[1]];
        let [x, y] = in_drawing(shape.start());
        let is_start = (x - at.x.0).abs() < POINT_TOLERANCE && (y - at.y.0).abs() < POINT_TOLERANCE;
        is_start.then(|| in_drawing(shape.middle()))
    }
}

/// Messages about parts whose points have the coordinates of the program, not those of the drawing.
pub const MESSAGES_IN_PROGRAM_COORDINATES: [&Message; 8] = [
    &part::GOUGED_NEIGHBOUR,
    &part::GOUGED_BY_PATH_WITHOUT_PART,
    &part::SEVERED_NEIGHBOUR,
    &part::SEVERED_BY_TURNING,
    &part::NEIGHBOURS_BAR_CUT_AWAY,
    &part::BAR_LOST_BY_TURNING,
    &part::DISPLACED_PATH,
    &part::CUT_IN_LOOSE_WASTE,
];

/// Distance in mm up to which two points are considered the same.
const POINT_TOLERANCE: f64 = 1e-6;

/// Whether findings with this code are about an element as a whole. Other findings about elements have a place of their own, such as the
/// point where the path breaks off or where the cutter enters something.
fn is_about_element(code: Code) -> bool {
    matches!(code.number(), 100..=211 | 500..=599)
}

/// Returns the centre of the parameter text that a diagnostic quotes, if it is in the drawing shown.
fn text_at(paths: &[ScenePath], diagnostic: &Diagnostic, file: &str) -> Option<Point> {
    let (fault, line) = (diagnostic.text.as_ref()?, diagnostic.place.line?);
    diagnostic.file.as_ref().filter(|found| *found == file)?;
    paths.iter().find_map(|path| {
        let is_faulty = |index: u32| {
            let element = &path.elements[index as usize];
            element.line == Some(line) && path.embedded[element.path as usize].file == file
        };
        let is_quoted = |label: &&Label| {
            label.text.contains(fault.text.trim()) && label.elements.iter().any(|index| is_faulty(*index))
        };
        let [x, y] = path.texts.iter().find(is_quoted)?.at;
        Some([x + path.zero[0], y + path.zero[1]])
    })
}

/// Converts diagnostics to findings, numbered from 1. `file` is the drawing shown: a finding in another drawing is placed where that
/// drawing is embedded.
pub fn findings(diagnostics: &[Diagnostic], file: &str) -> Vec<Finding> {
    (1..).zip(diagnostics).map(|(number, diagnostic)| finding(number, diagnostic, file)).collect()
}

fn finding(number: usize, diagnostic: &Diagnostic, file: &str) -> Finding {
    let is_here = diagnostic.file.as_ref().is_some_and(|found| found == file);
    let outermost = diagnostic.trace.first().filter(|step| step.file == file).map(|step| step.point);
    let own = diagnostic.place.point.filter(|_| is_here);
    Finding {
        number,
        code: diagnostic.code().to_string(),
        is_error: diagnostic.is_error(),
        message: BilingualText::of(|lang| diagnostic.text(lang)),
        help: BilingualText::of(|lang| diagnostic.help(lang).unwrap_or_default()),
        notes: diagnostic.notes.iter().map(|note| BilingualText::of(|lang| note.text(lang))).collect(),
        file: diagnostic.file.as_ref().map(|file| escaping::line(file.as_str()).into_owned()),
        path: diagnostic.path.as_deref().map(str::to_owned),
        line: diagnostic.place.line,
        at: own.or(outermost).map(|point| [point.x.0, point.y.0]),
    }
}
