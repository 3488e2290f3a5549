//! Views of programs of any origin: their moves, the findings of [`verify`](crate::verify), and the assumptions made for them.
//! (book: program/pictures, book: program/browser)

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang, Noun, counted, with_decimal_separator};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{CuttingTool, Header};
use pathbuild_gcode::statistics::Summary;
use pathbuild_gcode::verify::StockSpan;
use pathbuild_motion::Step;
use pathbuild_view::{BilingualText, ProgramRecord, Scene, ScenePath, ShownCheck, ToolSpan};
use serde::Deserialize;

use crate::config::{number, positive};
use crate::emit::SceneReport;
use crate::program::ReadingOptions;
use crate::session::Session;
use crate::verify::{CheckRecord, Outcome, RapidValues, Verifier, VerifyOptions};
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
    /// Name of the dialect; if it is `None`, the dialect is guessed.
    pub dialect: Option<String>,
    /// Diameter of the cutter in mm.
    pub cutter: Option<String>,
    /// Height of the material's upper face in mm.
    pub surface: Option<String>,
}

impl DroppedProgram {
    /// Returns the scene of the program as JSON, with its findings and the dialects in which it can be read again.
    pub fn scene(self, session: &mut Session<'_>) -> String {
        let workspace = session.workspace();
        let mut problems = Vec::new();
        let options = self.assumptions.options(&mut problems);
        let file = Utf8Path::new(&self.name);
        // Only the name of a drawing to compare with can be a usage error, and there is none here.
        let mut report = program_scene(session, file, self.text, options).unwrap_or_else(|failure| {
            let scene = Scene::new(file_name(file));
            SceneReport { scene, diagnostics: failure.into_diagnostics(), refusals: Vec::new() }
        });
        if let Some(record) = &mut report.scene.program {
            record.dialects = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
        }
        report.diagnostics.splice(..0, problems);
        report.with_findings(workspace, &self.name).0.to_json()
    }
}

/// Reads a program, and returns its scene with the findings of [`verify`](crate::verify), the checks that were made, and the cutters and the material
/// that they assumed.
///
/// # Errors
/// If the program has more steps than may be stored, or if the options cannot be used, for example because the configuration of the post-processor
/// has errors.
pub fn program_scene(
    session: &mut Session<'_>,
    file: &Utf8Path,
    text: Vec<u8>,
    options: VerifyOptions,
) -> Result<SceneReport, Failure> {
    let workspace = session.workspace();
    let (cutter, given_surface) = (options.cutter, options.surface);
    let verifier = Verifier::new(session, options)?;
    let program = &verifier.read(file, text).map_err(|problem| Failure::Found(vec![*problem]))?;
    let verified = verifier.verify_stored(program);
    let rapids = verified.checks.iter().find_map(CheckRecord::values);
    let header = program.header();
    let cutters = stated_cutters(&header);
    // The surface with which rapid moves were checked, if it is level.
    let checked_surface = rapids.filter(|values| values.is_level).map(|values| values.surface);
    let mut path = program.scene_path(workspace);
    // If a tool states no cutter, show none: with the cutter of another tool, its grooves would have a wrong width.
    let are_known = cutters.len() == header.tools.len();
    set_cutters(&mut path, cutter, if are_known { &cutters } else { &[] }, rapids);
    if let Some(stock) = verifier.stock(program, &header) {
        path.tools = stock.spans().iter().map(|span| tool_span(span, &header)).collect();
    }
    set_tools(&mut path, &program.read.steps);
    let mut scene = Scene::new(file_name(&program.file));
    scene.paths.push(path);
    let summary = Summary::of(&program.read.steps, program.dialect == Dialect::Xpertmill);
    scene.program = Some(ProgramRecord {
        dialect: program.shown.name(),
        dialects: Vec::new(),
        read_as: BilingualText::of(|lang| program.describe_reading(lang)),
        checks: verified.checks.iter().map(shown_check).collect(),
        cutters,
        surface: checked_surface.or(given_surface).or(header.surface),
        is_on_zero: match given_surface {
            Some(given) => given > 0.0,
            None => header.is_of_pathbuild || program.dialect == Dialect::Native,
        },
        waits: describe_waits(&summary, Lang::En)
            .zip(describe_waits(&summary, Lang::De))
            .map(|(en, de)| BilingualText { en, de }),
    });
    Ok(SceneReport { scene, diagnostics: verified.diagnostics, refusals: Vec::new() })
}

/// Describes the dwells, stops and tool changes of a program; `None` if it has none.
pub fn describe_waits(summary: &Summary, lang: Lang) -> Option<String> {
    let mut waits = Vec::new();
    if summary.dwell > 0.0 {
        let seconds = with_decimal_separator(format!("{:.1}", summary.dwell), lang);
        waits.push(format!("{seconds} s {}", lang.choose("dwelling", "Wartezeit")));
    }
    if summary.stops > 0 {
        waits.push(counted(summary.stops, STOP, lang));
    }
    if summary.tool_changes > 0 {
        waits.push(counted(summary.tool_changes, TOOL_CHANGE, lang));
    }
    (!waits.is_empty()).then(|| waits.join(", "))
}

const STOP: Noun = [
    ["stop for the operator", "stops for the operator"],
    ["Halt für den Bediener", "Halte für den Bediener"],
];
const TOOL_CHANGE: Noun = [["tool change", "tool changes"], ["Werkzeugwechsel", "Werkzeugwechsel"]];

fn file_name(file: &Utf8Path) -> &str {
    file.file_name().unwrap_or(file.as_str())
}

fn tool_span(span: &StockSpan, header: &Header) -> ToolSpan {
    let StockSpan { order, surface, cutter } = *span;
    let tool = header.tools.binary_search_by_key(&order, |tool| tool.order);
    let line = tool.map_or(order, |index| header.tools[index].line);
    ToolSpan { line, order, diameter: cutter.diameter, tip: cutter.into(), surface: Some(surface) }
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

/// Returns the cutters that the header of a program states.
fn stated_cutters(header: &Header) -> Vec<ToolSpan> {
    let span = |tool: &CuttingTool| {
        let (CuttingTool { line, order, .. }, cutter) = (*tool, tool.cutter?.widths());
        Some(ToolSpan { line, order, diameter: cutter.diameter, tip: cutter.into(), surface: None })
    };
    header.tools.iter().filter_map(span).collect()
}

/// Sets the cutters with which a path is shown: the diameter that the user typed in, else those with which its rapid moves were checked, else those
/// that the program states.
fn set_cutters(path: &mut ScenePath, cutter: Option<f64>, stated: &[ToolSpan], rapids: Option<&RapidValues>) {
    let mut diameters: Vec<f64> = match (cutter, rapids) {
        (Some(cutter), _) => vec![cutter],
        (None, Some(values)) => values.cutters.clone(),
        (None, None) => stated.iter().map(|tool| tool.diameter).collect(),
    };
    diameters.dedup();
    match *diameters {
        [] => {}
        [diameter] => {
            path.tool = Some(diameter);
            path.tip = stated.first().filter(|_| cutter.is_none()).map(|tool| tool.tip).unwrap_or_default();
        }
        _ => path.tools = stated.to_vec(),
    }
}

/// Sets the tool of each move of a program to the one that is in the spindle when the move is executed.
fn set_tools(path: &mut ScenePath, steps: &[Step]) {
    let moves = steps.iter().filter(|step| step.as_move().is_some());
    for (step, movement) in moves.zip(&mut path.moves) {
        let later = path.tools.partition_point(|tool| tool.order <= step.order);
        movement.tool = later.checked_sub(1).and_then(|index| u32::try_from(index).ok());
    }
}

fn shown_check(record: &CheckRecord) -> ShownCheck {
    let outcome = match record.outcome {
        Outcome::Made(_) => "made",
        Outcome::Assumed(..) => "assumed",
        Outcome::Incomplete(..) | Outcome::NotMade(_) => "not-made",
    };
    ShownCheck {
        check: record.requirement.name(),
        outcome,
        text: BilingualText::of(|lang| record.text(lang)),
    }
}
