//! What is known of cutter and material. (spec/90-gcode-import.md: the stock's extent is in no drawing)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Action, Step};
use pathbuild_gcode::verify::{Piece, Stock};

use super::Wishes;
use super::against::Against;
use crate::commands::program::Program;
use crate::context::Context;
use pathbuild_workspace::posting::tool_table;

/// The material that a program cuts with these steps; `None` where cutter or surface are not known.
///
/// The cutter is that of the command line, else the drawing's, else that of the tool's number. The surface is that of the command line,
/// else where a native program's plunges hand over, else the drawing's, if it has one only.
pub(super) fn stock(
    context: &Context,
    program: &Program,
    steps: &[Step],
    wishes: &Wishes,
    against: Option<&Against>,
) -> Option<Stock> {
    let cutters = match wishes.cutter.or(against.map(Against::cutter)) {
        Some(cutter) => vec![(0, cutter)],
        None => cutters(context, steps)?,
    };
    let uniform = |surface: f64| {
        let pieces = cutters.iter().map(|(line, cutter)| Piece { line: *line, surface, cutter: *cutter });
        Stock::of_pieces(pieces.collect())
    };
    match (wishes.surface, program.dialect) {
        (Some(surface), _) => Some(uniform(surface)),
        (None, Dialect::Native) => Stock::of_native_text(steps, cutters.first()?.1),
        (None, _) => against.and_then(Against::surface).map(uniform),
    }
}

/// The diameters of the tools in mm, each from a line on, by the tool table; `None` if one is not in it, or there are no tools.
fn cutters(context: &Context, steps: &[Step]) -> Option<Vec<(u32, f64)>> {
    let table = tool_table(context);
    let diameter = |number: u32| {
        table.entries.iter().find(|entry| entry.index == Some(number)).map(|entry| entry.diameter)
    };
    let cutters: Option<Vec<(u32, f64)>> =
        tools(steps).map(|(line, number)| Some((line, diameter(number)?))).collect();
    cutters.filter(|cutters| !cutters.is_empty())
}

/// The tools that a program puts in, with their lines; where it never says M6, those that it selects.
fn tools(steps: &[Step]) -> impl Iterator<Item = (u32, u32)> {
    let has_changes = steps.iter().any(|step| matches!(step.action, Action::ChangeTool(_)));
    steps.iter().filter_map(move |step| match step.action {
        Action::ChangeTool(number) => Some((step.line, number)),
        Action::SelectTool(number) if !has_changes => Some((step.line, number)),
        _ => None,
    })
}

/// Tools that the table does not have, each once; nothing where there is no table with numbers.
pub(super) fn unknown_tools(context: &Context, program: &Program) -> Vec<Diagnostic> {
    let table = tool_table(context);
    let known: Vec<u32> = table.entries.iter().filter_map(|entry| entry.index).collect();
    let is_layer = program.dialect == Dialect::Xpertmill;
    let mut unknown: Vec<(u32, u32)> = Vec::new();
    for (line, number) in tools(&program.read.steps) {
        let is_new = unknown.iter().all(|(_, met)| *met != number);
        if is_new && !known.is_empty() && !known.contains(&number) && !is_layer {
            unknown.push((line, number));
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
        "cutter or material are not known, so rapid moves into it are not looked for; --against PATH says both, --cutter and --surface one each",
        "Fräser oder Material sind nicht bekannt, Eilgang ins Material wird nicht gesucht; --against PFAD sagt beides, --cutter und --surface je eins",
    )
}
