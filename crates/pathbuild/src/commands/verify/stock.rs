//! Determines cutter and material. (book: program/reading: the stock's extent is in no drawing)

use pathbuild_diagnostic::messages::{gcode as say, posts};
use pathbuild_diagnostic::{Diagnostic, Severity, Text};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::{Stock, StockSpan};
use pathbuild_motion::{Action, Step, WordEffect};

use super::StockOptions;
use super::against::ReferenceProgram;
use crate::commands::program::Program;
use crate::context::Context;
use pathbuild_workspace::posting::tool_table;

/// The tools of a program with their lines, collected step by step.
#[derive(Default)]
pub(super) struct Tools {
    selected: Vec<(u32, u32)>,
    inserted: Vec<(u32, u32)>,
    /// Whether lines are executed out of order.
    has_calls: bool,
}

impl Tools {
    /// Processes the next step.
    pub(super) fn step(&mut self, step: &Step) {
        match step.action {
            Action::ChangeTool(number) => self.inserted.push((step.line, number.unwrap_or(0))),
            Action::SelectTool(number) => self.selected.push((step.line, number)),
            Action::Word(word) => self.has_calls |= word.effect == WordEffect::Call,
            _ => {}
        }
    }

    /// The tools inserted by M6; without any M6, the selected ones.
    fn used(&self) -> &[(u32, u32)] {
        if self.inserted.is_empty() { &self.selected } else { &self.inserted }
    }

    /// Warns about tools whose diameter in the table differs from the header's. Layers are not tools.
    fn other_than_header(&self, context: &Context, dialect: Dialect, header: Option<f64>) -> Vec<Diagnostic> {
        let table = tool_table(context);
        let mut found: Vec<(u32, u32, f64, f64)> = Vec::new();
        for (line, number) in self.used().iter().filter(|_| dialect != Dialect::Xpertmill) {
            let entry = table.entries.iter().find(|entry| entry.index == Some(*number));
            let other = different(header, entry.map(|entry| entry.diameter));
            if let Some((header, table)) = other.filter(|_| found.iter().all(|(_, met, ..)| met != number)) {
                found.push((*line, *number, header, table));
            }
        }
        let warning = |(line, number, header, table)| {
            let problem = Diagnostic::new(&say::OTHER_CUTTER_IN_TABLE).with("index", u64::from(number));
            problem.with("header", header).with("table", table).at_line(line, None)
        };
        found.into_iter().map(warning).collect()
    }

    /// Diameters in mm from the tool table, each with the line from which it applies; `None` if a tool is not in the table, or if there are
    /// no tools.
    fn cutters(&self, context: &Context) -> Option<Vec<(u32, f64)>> {
        let table = tool_table(context);
        let diameter = |number: u32| {
            table.entries.iter().find(|entry| entry.index == Some(number)).map(|entry| entry.diameter)
        };
        let cutters: Option<Vec<(u32, f64)>> =
            self.used().iter().map(|(line, number)| Some((*line, diameter(*number)?))).collect();
        // The tool of a subprogram's lines depends on who calls it.
        let is_one = |cutters: &Vec<(u32, f64)>| cutters.iter().all(|(_, cutter)| *cutter == cutters[0].1);
        cutters.filter(|cutters| !cutters.is_empty() && (!self.has_calls || is_one(cutters)))
    }
}

/// The material that a program cuts; `None` if cutter or surface is unknown.
///
/// The cutter is taken from the command line, else from the drawing, else from the tool table, else from the header. A native program
/// always selects `T1`, so its header decides. The surface is taken from the command line, else from the drawing if it has only one, else
/// from the heights at which a native program's plunges begin to cut, else from the header.
pub(super) fn stock(
    context: &Context,
    program: &Program,
    tools: &Tools,
    stock_options: &StockOptions,
    against: Option<&ReferenceProgram>,
) -> Option<Stock> {
    let header = Provenance::of_head(&program.text).map(|(provenance, _)| provenance);
    let of_header = header.as_ref().and_then(|header| header.cutter);
    let is_native = program.dialect == Dialect::Native;
    let cutters = match stock_options.cutter.or(against.and_then(ReferenceProgram::cutter)) {
        Some(cutter) => vec![(0, cutter)],
        None if is_native => vec![(0, of_header?)],
        None => tools.cutters(context).or(of_header.map(|cutter| vec![(0, cutter)]))?,
    };
    let uniform = |surface: f64| {
        let pieces = cutters.iter().map(|(line, cutter)| StockSpan { line: *line, surface, cutter: *cutter });
        Stock::of_pieces(pieces.collect())
    };
    if let Some(surface) = stock_options.surface.or(against.and_then(ReferenceProgram::surface)) {
        return Some(uniform(surface));
    }
    let native = is_native.then(|| Stock::of_native_text(&program.drawn(), cutters.first()?.1)).flatten();
    native.or_else(|| header.and_then(|header| header.thickness).map(uniform))
}

/// Reports contradictory values for cutter or surface in the header, the command line, the tool table and the drawing.
pub(super) fn disagreements(
    context: &Context,
    program: &Program,
    tools: &Tools,
    stock_options: &StockOptions,
    against: Option<&ReferenceProgram>,
) -> Vec<Diagnostic> {
    let header = Provenance::of_head(&program.text).map(|(provenance, _)| provenance);
    let of_header = header.as_ref().and_then(|header| header.cutter);
    let drawn = against.and_then(ReferenceProgram::cutter);
    let mut found = Vec::new();
    if let Some((header, given)) = different(of_header, stock_options.cutter) {
        found.push(Diagnostic::new(&say::OTHER_CUTTER_GIVEN).with("header", header).with("given", given));
    }
    let compared = |message, place, values: Option<(f64, f64)>| {
        let problem = |(found, drawn)| {
            let problem = Diagnostic::new(message).with("place", place);
            problem.with("found", found).with("drawn", drawn)
        };
        values.map(problem)
    };
    // The operator reads the header, and inserts the tool that it names.
    let of_program = compared(&say::OTHER_CUTTER_DRAWN, &HEADER, different(of_header, drawn));
    found.extend(of_program.map(|problem| Diagnostic { severity: Severity::Error, ..problem }));
    found.extend(compared(&say::OTHER_CUTTER_DRAWN, &CUTTER, different(stock_options.cutter, drawn)));
    let surface = against.and_then(ReferenceProgram::surface);
    let of_header_surface = header.and_then(|header| header.thickness);
    found.extend(compared(&say::OTHER_SURFACE_DRAWN, &HEADER, different(of_header_surface, surface)));
    found.extend(compared(&say::OTHER_SURFACE_DRAWN, &SURFACE, different(stock_options.surface, surface)));
    found.extend(tools.other_than_header(context, program.dialect, of_header));
    found
}

/// Both values, if they differ.
fn different(one: Option<f64>, other: Option<f64>) -> Option<(f64, f64)> {
    one.zip(other).filter(|(one, other)| (one - other).abs() > SAME)
}

/// Tolerance in mm within which diameters and heights are equal.
const SAME: f64 = 1e-6;

static HEADER: Text = Text { en: "the header", de: "der Kopf" };
static CUTTER: Text = Text { en: "--cutter", de: "--cutter" };
static SURFACE: Text = Text { en: "--surface", de: "--surface" };

/// Warns about tools that are not in the table, unless the table has no numbers at all.
pub(super) fn unknown_tools(context: &Context, program: &Program, tools: &Tools) -> Vec<Diagnostic> {
    let table = tool_table(context);
    let table_numbers: Vec<u32> = table.entries.iter().filter_map(|entry| entry.index).collect();
    // Layers are not tools, and native programs always say T1.
    let is_no_tool = matches!(program.dialect, Dialect::Xpertmill | Dialect::Native);
    let mut unknown: Vec<(u32, u32)> = Vec::new();
    for (line, number) in tools.used() {
        let is_new = unknown.iter().all(|(_, met)| met != number);
        if is_new && !table_numbers.is_empty() && !table_numbers.contains(number) && !is_no_tool {
            unknown.push((*line, *number));
        }
    }
    let warning = |(line, number)| {
        Diagnostic::new(&posts::TOOL_NOT_IN_TABLE).with("index", u64::from(number)).at_line(line, None)
    };
    unknown.into_iter().map(warning).collect()
}

/// Explains what is not checked if cutter or material is unknown.
pub(super) fn not_known(context: &Context) -> &'static str {
    context.choose(
        "not checked: rapid moves into material, because cutter or material is not known (give --against PATH, or --cutter and --surface)",
        "nicht geprüft: Eilgang ins Material, weil Fräser oder Material nicht bekannt ist (--against PFAD angeben oder --cutter und --surface)",
    )
}
