//! What is known of cutter and material. (book: program/reading: the stock's extent is in no drawing)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Action, Step};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::{Stock, StockSpan};

use super::StockOptions;
use super::against::Against;
use crate::commands::program::Program;
use crate::context::Context;
use pathbuild_workspace::posting::tool_table;

/// The tools of a program, with their lines: it is told every step.
#[derive(Default)]
pub(super) struct Tools {
    selected: Vec<(u32, u32)>,
    inserted: Vec<(u32, u32)>,
}

impl Tools {
    /// The next step of the program.
    pub(super) fn step(&mut self, step: &Step) {
        match step.action {
            Action::ChangeTool(number) => self.inserted.push((step.line, number.unwrap_or(0))),
            Action::SelectTool(number) => self.selected.push((step.line, number)),
            _ => {}
        }
    }

    /// Those that it puts in; where it never says M6, those that it selects.
    fn used(&self) -> &[(u32, u32)] {
        if self.inserted.is_empty() { &self.selected } else { &self.inserted }
    }

    /// The diameters in mm, each from a line on, by the tool table; `None` if one is not in it, or there are no tools.
    fn cutters(&self, context: &Context) -> Option<Vec<(u32, f64)>> {
        let table = tool_table(context);
        let diameter = |number: u32| {
            table.entries.iter().find(|entry| entry.index == Some(number)).map(|entry| entry.diameter)
        };
        let cutters: Option<Vec<(u32, f64)>> =
            self.used().iter().map(|(line, number)| Some((*line, diameter(*number)?))).collect();
        cutters.filter(|cutters| !cutters.is_empty())
    }
}

/// The material that a program cuts; `None` where cutter or surface are not known.
///
/// The cutter is that of the command line, else the drawing's, else that of the tool's number, else the header's. The surface is that of
/// the command line, else the drawing's, if it has one only, else where a native program's plunges hand over, else the header's.
pub(super) fn stock(
    context: &Context,
    program: &Program,
    tools: &Tools,
    wishes: &StockOptions,
    against: Option<&Against>,
) -> Option<Stock> {
    let header = Provenance::of_head(&program.text).map(|(provenance, _)| provenance);
    let of_header = header.as_ref().and_then(|header| header.cutter);
    let cutters = match wishes.cutter.or(against.and_then(Against::cutter)) {
        Some(cutter) => vec![(0, cutter)],
        None => tools.cutters(context).or(of_header.map(|cutter| vec![(0, cutter)]))?,
    };
    let uniform = |surface: f64| {
        let pieces = cutters.iter().map(|(line, cutter)| StockSpan { line: *line, surface, cutter: *cutter });
        Stock::of_pieces(pieces.collect())
    };
    if let Some(surface) = wishes.surface.or(against.and_then(Against::surface)) {
        return Some(uniform(surface));
    }
    let is_native = program.dialect == Dialect::Native;
    let native = is_native.then(|| Stock::of_native_text(&program.drawn(), cutters.first()?.1)).flatten();
    native.or_else(|| header.and_then(|header| header.thickness).map(uniform))
}

/// Tools that the table does not have, each once; nothing where there is no table with numbers.
pub(super) fn unknown_tools(context: &Context, program: &Program, tools: &Tools) -> Vec<Diagnostic> {
    let table = tool_table(context);
    let known: Vec<u32> = table.entries.iter().filter_map(|entry| entry.index).collect();
    // Layers are no tools, and the native program always says T1.
    let is_no_tool = matches!(program.dialect, Dialect::Xpertmill | Dialect::Native);
    let mut unknown: Vec<(u32, u32)> = Vec::new();
    for (line, number) in tools.used() {
        let is_new = unknown.iter().all(|(_, met)| met != number);
        if is_new && !known.is_empty() && !known.contains(number) && !is_no_tool {
            unknown.push((*line, *number));
        }
    }
    let warning = |(line, number)| {
        Diagnostic::new(&posts::TOOL_NOT_IN_TABLE).with("index", u64::from(number)).at_line(line, None)
    };
    unknown.into_iter().map(warning).collect()
}

/// What is left out without it.
pub(super) fn not_known(context: &Context) -> &'static str {
    context.choose(
        "not checked: rapid moves into material, because cutter or material is not known (give --against PATH, or --cutter and --surface)",
        "nicht geprüft: Eilgang ins Material, weil Fräser oder Material nicht bekannt ist (--against PFAD angeben oder --cutter und --surface)",
    )
}
