//! `pathbuild import`: summarizes a G-code program. (book: program/reading)

use std::fmt::Write;

use pathbuild_diagnostic::{Diagnostic, Lang, Number, escaping, with_decimal_separator};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{self, Kinematics};
use pathbuild_gcode::statistics::{AxisRanges, MoveTotals, Summary, Tally, ToolTotals, is_guess};
use pathbuild_workspace::program::Program;
use pathbuild_workspace::program_view::describe_waits;
use serde_json::{Value, json};

use crate::args::ImportArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use crate::text::{MOVE, counted, format_count};

/// Runs the command: prints the summary and the diagnostics of each program. A program with errors is summarized as far as it could be
/// read.
pub fn run(context: &Context, args: &ImportArgs) -> ExitStatus {
    let mut diagnostics = Vec::new();
    for file in &args.files {
        match Program::open(context, file, args.reading.options()) {
            Ok(program) => {
                let facts = Facts::new(context, &program);
                match context.format {
                    Format::Json => context.row("program", json(context, &facts)),
                    _ => context.printer.result(text(context, &facts)),
                }
                diagnostics.extend(program.read.problems);
            }
            Err(problem) => diagnostics.push(*problem),
        }
    }
    context.conclude(diagnostics)
}

/// A summary of a program, with values that depend on the configuration.
struct Facts<'a> {
    program: &'a Program,
    summary: Summary,
    /// Feed of rapid moves in mm/min, if known.
    rapid: Option<f64>,
    /// Machining time in seconds, if the machine's capabilities are configured.
    machine_seconds: Option<f64>,
    /// First line with unknown moves. If there is one, lengths, times and the extent are unknown as well.
    unfollowed: Option<u32>,
    /// Diagnostics about assumptions that were made while reading.
    assumptions: Vec<&'a Diagnostic>,
}

impl<'a> Facts<'a> {
    fn new(context: &Context, program: &'a Program) -> Self {
        let steps = &program.read.steps;
        let unfollowed = program.first_line_with_unknown_moves();
        Self {
            program,
            summary: Summary::of(steps, program.dialect == Dialect::Xpertmill),
            rapid: context.settings.general.rapid.value,
            machine_seconds: kinematics(context)
                .filter(|_| unfollowed.is_none())
                .map(|machine| estimate::seconds(steps, &machine)),
            unfollowed,
            assumptions: program.read.problems.iter().filter(|problem| is_guess(problem)).collect(),
        }
    }

    /// Returns the working time in whole minutes, computed as by PathDxf2GCode (book: program/gcode). If the rapid feed is unknown, only cutting
    /// moves are included. `None` if a cutting move has no feed, or if the moves of a line are unknown.
    fn minutes(&self) -> Option<f64> {
        let total = &self.summary.total;
        let minutes = self.rapid.map_or(total.cutting(), |rapid| total.sum(rapid)).minutes();
        Some(minutes).filter(|minutes| minutes.is_finite() && self.unfollowed.is_none())
    }
}

/// Returns the speeds and accelerations in `[machine]`; `None` unless they are complete. The speed of rapid moves defaults to `rapid`.
fn kinematics(context: &Context) -> Option<Kinematics> {
    let machine = &context.settings.machine;
    let rapid = context.settings.general.rapid.value;
    Some(Kinematics {
        rates: machine.rates.value.or(rapid.map(|rapid| [rapid; 3]))?,
        accelerations: machine.accelerations.value?,
        junction_deviation: machine.junction_deviation.value,
    })
}

fn json(context: &Context, facts: &Facts<'_>) -> Value {
    let (program, summary) = (facts.program, &facts.summary);
    let assumptions = facts
        .assumptions
        .iter()
        .map(|assumption| json!({ "line": assumption.place.line, "message": assumption.text(Lang::En) }));
    let whole =
        |extent: &AxisRanges| if facts.unfollowed.is_some() { AxisRanges::default() } else { *extent };
    json!({
        "file": context.file(&program.file),
        "lines": program.lines(),
        "dialect": program.dialect.name(),
        "guessed": program.evidence.map(|evidence| json!({ "reason": evidence.reason.en, "line": evidence.line })),
        "moves": tally(&summary.total),
        "unfollowed_line": facts.unfollowed,
        "box": extent(&whole(&summary.extent)),
        "cutting_box": extent(&whole(&summary.cut)),
        "tools": summary.tools.iter().map(tool_json).collect::<Vec<_>>(),
        "minutes": facts.minutes(),
        "rapid": facts.rapid,
        "machine_seconds": facts.machine_seconds,
        "dwell_seconds": summary.dwell,
        "stops": summary.stops,
        "tool_changes": summary.tool_changes,
        "taken": assumptions.collect::<Vec<_>>(),
    })
}

fn tally(tally: &Tally) -> Value {
    let kind = |kind: &MoveTotals| json!({ "count": kind.moves, "length": kind.total.length });
    json!({
        "count": tally.moves(),
        "arcs": tally.arcs,
        "rapid": kind(&tally.rapid),
        "milling": kind(&tally.milling),
        "drilling": kind(&tally.drilling),
        "probing": { "count": tally.probing },
    })
}

fn extent(extent: &AxisRanges) -> Value {
    let axis = |ends: &Option<(f64, f64)>| ends.map(|(low, high)| [low, high]);
    json!({ "x": axis(&extent[0]), "y": axis(&extent[1]), "z": axis(&extent[2]) })
}

fn tool_json(totals: &ToolTotals) -> Value {
    json!({ "tool": totals.tool, "moves": tally(&totals.tally), "feeds": totals.feeds, "speeds": totals.speeds })
}

/// Formats the summary. The first line begins with the file's name.
fn text(context: &Context, facts: &Facts<'_>) -> String {
    let formatter = Formatter(context);
    let mut text = formatter.title(facts);
    for (label, line) in formatter.lines(facts) {
        _ = writeln!(text, "  {label:<10} {line}");
    }
    text
}

struct Formatter<'a>(&'a Context);

impl Formatter<'_> {
    fn choose<'t>(&self, en: &'t str, de: &'t str) -> &'t str {
        self.0.choose(en, de)
    }

    fn title(&self, facts: &Facts<'_>) -> String {
        let program = facts.program;
        let lang = self.0.lang();
        let lines = counted(program.lines(), [["line", "lines"], ["Zeile", "Zeilen"]], lang);
        format!("{}: {lines}, {}\n", escaping::line(program.file.as_str()), program.describe_reading(lang))
    }

    fn lines(&self, facts: &Facts<'_>) -> Vec<(&str, String)> {
        let summary = &facts.summary;
        let mut lines = vec![
            (self.choose("moves", "Bewegungen"), self.moves(facts)),
            (self.choose("lengths", "Längen"), self.lengths(facts)),
        ];
        if facts.unfollowed.is_none() {
            lines.extend(self.extent(&summary.extent).map(|box_| (self.choose("box", "Bereich"), box_)));
            lines.extend(self.extent(&summary.cut).map(|box_| (self.choose("cutting", "Fräsen"), box_)));
        }
        let is_layer = facts.program.dialect == Dialect::Xpertmill;
        let tools = if is_layer { self.choose("layers", "Layer") } else { self.choose("tools", "Werkzeuge") };
        for (index, totals) in summary.tools.iter().enumerate() {
            lines.push((if index == 0 { tools } else { "" }, self.tool_line(totals, is_layer, facts)));
        }
        lines.push((self.choose("time", "Zeit"), self.time(facts)));
        let waits = describe_waits(&facts.summary, self.0.lang());
        lines.extend(waits.map(|waits| (self.choose("waits", "Halte"), waits)));
        for (index, assumption) in facts.assumptions.iter().enumerate() {
            let label = if index == 0 { self.choose("assumed", "angenommen") } else { "" };
            let line = assumption.place.line.unwrap_or(0);
            lines.push((
                label,
                format!("{} {line}: {}", self.choose("line", "Zeile"), assumption.text(self.0.lang())),
            ));
        }
        lines
    }

    fn moves(&self, facts: &Facts<'_>) -> String {
        let total = &facts.summary.total;
        let grouped = |moves| format_count(moves, self.0.lang());
        let kinds = [
            (total.rapid.moves, self.choose("rapid", "Eilgang")),
            (total.milling.moves, self.choose("milling", "Fräsen")),
            (total.drilling.moves, self.choose("drilling", "Bohren")),
            (total.probing, self.choose("probing", "Antasten")),
        ];
        let kinds = kinds
            .iter()
            .filter(|(moves, _)| *moves > 0)
            .map(|(moves, kind)| format!("{} {kind}", grouped(*moves)));
        let mut moves = format!("{}: {}", grouped(total.moves()), kinds.collect::<Vec<_>>().join(", "));
        if total.arcs > 0 {
            _ = write!(moves, "; {} {}", grouped(total.arcs), self.choose("of them arcs", "davon Bögen"));
        }
        if facts.unfollowed.is_some() {
            moves += self.choose("; in the lines that are followed", "; in den ausgewerteten Zeilen");
        }
        moves
    }

    fn not_followed(&self, line: u32) -> String {
        let [begin, end] = [
            self.choose("not known: line", "unbekannt: Zeile"),
            self.choose("is not followed", "wird nicht ausgewertet"),
        ];
        format!("{begin} {line} {end}")
    }

    fn lengths(&self, facts: &Facts<'_>) -> String {
        if let Some(line) = facts.unfollowed {
            return self.not_followed(line);
        }
        let total = &facts.summary.total;
        let cutting = total.cutting().length;
        let rapid = total.rapid.total.length;
        let [cuts, sweeps] = [self.choose("cutting", "Fräsen"), self.choose("rapid", "Eilgang")];
        let [whole, cutting, rapid] = [cutting + rapid, cutting, rapid].map(|length| self.tenths(length));
        format!("{whole} mm: {cutting} mm {cuts}, {rapid} mm {sweeps}")
    }

    fn tenths(&self, number: f64) -> String {
        with_decimal_separator(format!("{number:.1}"), self.0.lang())
    }

    /// Formats an extent, such as `X 0.000 to 40.000, Y 0.000 to 20.000`; `None` if no axis moves to a known position.
    fn extent(&self, extent: &AxisRanges) -> Option<String> {
        let to = self.choose("to", "bis");
        let axis = |(axis, ends): (char, &Option<(f64, f64)>)| {
            ends.map(|(low, high)| format!("{axis} {low:.3} {to} {high:.3}"))
        };
        let axes: Vec<String> = ['X', 'Y', 'Z'].into_iter().zip(extent).filter_map(axis).collect();
        (!axes.is_empty()).then(|| axes.join(", "))
    }

    fn tool_line(&self, totals: &ToolTotals, is_layer: bool, facts: &Facts<'_>) -> String {
        let name = match totals.tool {
            Some(number) if is_layer => number.to_string(),
            Some(number) => format!("T{number}"),
            None => self.choose("none named", "keins genannt").to_owned(),
        };
        let (moves, length) = (totals.tally.moves(), totals.tally.cutting().length);
        let mut line = format!("{name}: {}", counted(moves, MOVE, self.0.lang()));
        if facts.unfollowed.is_none() {
            _ = write!(line, ", {} mm {}", self.tenths(length), self.choose("cutting", "Fräsen"));
        }
        if !totals.feeds.is_empty() {
            _ = write!(line, ", F {}", numbers(&totals.feeds));
        }
        if !totals.speeds.is_empty() {
            _ = write!(line, ", S {}", numbers(&totals.speeds));
        }
        line
    }

    fn time(&self, facts: &Facts<'_>) -> String {
        if let Some(line) = facts.unfollowed {
            return self.not_followed(line);
        }
        let mut time = match (facts.minutes(), facts.rapid) {
            (None, _) => self
                .choose(
                    "not known: a cutting move has no feed",
                    "unbekannt: einer Fräsbewegung fehlt der Vorschub",
                )
                .to_owned(),
            (Some(minutes), Some(rapid)) => format!(
                "{} {minutes:.0} min, {} {}",
                self.choose("about", "etwa"),
                self.choose("rapid at", "Eilgang mit"),
                Number(rapid).prose(self.0.lang())
            ),
            (Some(minutes), None) => format!(
                "{} {minutes:.0} min {}",
                self.choose("about", "etwa"),
                self.choose(
                    "without rapid moves (--rapid is not set)",
                    "ohne Eilgang (--rapid ist nicht gesetzt)"
                )
            ),
        };
        if let Some(seconds) = facts.machine_seconds {
            let seconds = seconds.round();
            let minutes = (seconds / 60.0).floor();
            let rest = seconds - 60.0 * minutes;
            let on = self.choose(
                "on the machine, with its accelerations",
                "auf der Maschine, mit ihren Beschleunigungen",
            );
            _ = write!(time, "; {minutes:.0}:{rest:02.0} min {on}");
        }
        time
    }
}

/// Formats a list of numbers, or only their range if there are many.
fn numbers(values: &[f64]) -> String {
    const MAX_SHOWN_VALUES: usize = 6;
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    match values.as_slice() {
        [first, .., last] if values.len() > MAX_SHOWN_VALUES => {
            format!("{} ... {}", Number(*first), Number(*last))
        }
        values => values.iter().map(|value| Number(*value).to_string()).collect::<Vec<_>>().join(", "),
    }
}
