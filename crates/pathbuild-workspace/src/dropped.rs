//! Programs that a user drops on the page: their moves, the findings of [`verify`](crate::verify), and the assumptions made for them.
//! (book: program/browser)

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang, shown};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::HeaderReader;
use pathbuild_view::{BilingualText, Scene, ScenePath, ToolSpan};
use serde::{Deserialize, Serialize};

use crate::config::{number, positive};
use crate::emit::SceneReport;
use crate::program::{Program, ReadingOptions};
use crate::session::Session;
use crate::verify::{CheckRecord, Outcome, RapidValues, VerifiedProgram, Verifier, VerifyOptions};
use crate::workspace::Failure;

/// A program that was dropped on the page.
#[derive(Debug)]
pub struct DroppedProgram {
    /// Name of the program's file.
    pub name: String,
    /// Bytes of the program's text.
    pub text: Vec<u8>,
    /// Values that the user typed in on the page.
    pub assumptions: Assumptions,
}

/// Values that a user assumes for a program, as text; missing ones are taken from the program.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Assumptions {
    /// Name of the dialect; `None` guesses it.
    pub dialect: Option<String>,
    /// Diameter of the cutter in mm.
    pub cutter: Option<String>,
    /// Height of the material's upper face in mm.
    pub surface: Option<String>,
}

/// A scene with facts about its program, as it is serialized for the page.
#[derive(Serialize)]
struct ProgramScene<'s> {
    #[serde(flatten)]
    scene: &'s Scene,
    program: ProgramRecord,
}

#[derive(Serialize)]
struct ProgramRecord {
    dialect: &'static str,
    dialects: Vec<&'static str>,
    /// The dialect in which the program is read and, if it was guessed, the reason.
    read_as: BilingualText,
    checks: Vec<ShownCheck>,
    cutters: Vec<ToolSpan>,
    surface: Option<f64>,
}

#[derive(Serialize)]
struct ShownCheck {
    check: &'static str,
    outcome: &'static str,
    text: BilingualText,
}

impl DroppedProgram {
    /// Returns the scene of the program as JSON, with its findings and a field `program`.
    pub fn scene(self, session: &mut Session<'_>) -> String {
        let workspace = session.workspace();
        let mut diagnostics = Vec::new();
        let options = self.assumptions.options(&mut diagnostics);
        let (reading, cutter) = (options.reading, options.cutter);
        let file = Utf8Path::new(&self.name);
        let verified = match Verifier::new(session, options) {
            Ok(verifier) => verifier.verify(file, self.text.clone()),
            Err(Failure::Post(diagnostics) | Failure::Found(diagnostics)) => {
                VerifiedProgram { diagnostics, ..VerifiedProgram::default() }
            }
            // Only the name of a drawing to compare with can be a usage error, and there is none here.
            Err(Failure::Usage(_)) => VerifiedProgram::default(),
        };
        diagnostics.extend(verified.diagnostics);
        let mut scene = Scene::new(file.file_name().unwrap_or(&self.name));
        let program = match Program::of_text(workspace, file, self.text, reading) {
            Ok(program) => program,
            Err(problem) => {
                let report = SceneReport { scene, diagnostics: vec![*problem] };
                return report.with_findings(workspace, &self.name).0.to_json();
            }
        };
        let rapids = verified.checks.iter().find_map(CheckRecord::values);
        let (cutters, surface) = stated_cutters_and_surface(&program, rapids);
        let mut path = program.scene_path(workspace);
        set_cutters(&mut path, cutter, &cutters, rapids);
        scene.paths.push(path);
        let (scene, _) = SceneReport { scene, diagnostics }.with_findings(workspace, &self.name);
        let record = ProgramRecord {
            dialect: program.shown.name(),
            dialects: Dialect::ALL.iter().map(|dialect| dialect.name()).collect(),
            read_as: bilingual(|lang| program.describe_reading(lang)),
            checks: verified.checks.iter().map(shown_check).collect(),
            cutters,
            surface,
        };
        let scene = ProgramScene { scene: &scene, program: record };
        shown::json(&serde_json::to_string(&scene).expect("every part of a scene is plain data")).into_owned()
    }
}

impl Assumptions {
    /// Converts the assumptions to options of `verify`. Adds diagnostics of invalid texts.
    fn options(&self, problems: &mut Vec<Diagnostic>) -> VerifyOptions {
        let mut value = |text: Option<&String>, read: fn(&str) -> Result<f64, Box<Diagnostic>>| {
            read(text?).map_err(|problem| problems.push(*problem)).ok()
        };
        VerifyOptions {
            reading: ReadingOptions {
                dialect: self.dialect.as_ref().and_then(|name| name.parse().ok()),
                ..ReadingOptions::default()
            },
            cutter: value(self.cutter.as_ref(), |text| positive("cutter", text)),
            surface: value(self.surface.as_ref(), |text| number("surface", text)),
            ..VerifyOptions::default()
        }
    }
}

/// Returns the cutters that a program states, and the height of the material's upper face; `None` if it does not state that height.
fn stated_cutters_and_surface(
    program: &Program,
    rapids: Option<&RapidValues>,
) -> (Vec<ToolSpan>, Option<f64>) {
    let mut header = HeaderReader::default();
    for step in &program.read.steps {
        header.step(step);
    }
    let header = header.finish(program.inch_word());
    let span = |tool: &pathbuild_gcode::header::CuttingTool| {
        Some(ToolSpan { line: tool.line, diameter: tool.cutter?.diameter, surface: None })
    };
    let surface = rapids.filter(|values| values.is_level).map(|values| values.surface).or(header.surface);
    (header.tools.iter().filter_map(span).collect(), surface)
}

/// Sets the cutters with which a path is shown: the diameter that the user typed in, or those with which its rapid moves were checked.
fn set_cutters(path: &mut ScenePath, cutter: Option<f64>, stated: &[ToolSpan], rapids: Option<&RapidValues>) {
    let mut diameters: Vec<f64> = match (cutter, rapids) {
        (Some(cutter), _) => vec![cutter],
        (None, Some(values)) => values.cutters.clone(),
        (None, None) => stated.iter().map(|tool| tool.diameter).collect(),
    };
    diameters.dedup();
    match *diameters {
        [] => {}
        [diameter] => path.tool = Some(diameter),
        _ => path.tools = stated.to_vec(),
    }
}

fn shown_check(record: &CheckRecord) -> ShownCheck {
    let outcome = match record.outcome {
        Outcome::Made(_) => "made",
        Outcome::Assumed(..) => "assumed",
        Outcome::Incomplete(..) | Outcome::NotMade(_) => "not-made",
    };
    ShownCheck { check: record.requirement.name(), outcome, text: bilingual(|lang| record.text(lang)) }
}

fn bilingual(text: impl Fn(Lang) -> String) -> BilingualText {
    BilingualText { en: text(Lang::En), de: text(Lang::De) }
}
