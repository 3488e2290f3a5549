//! What `verify` checked of a program, with which values, and what it did not. (book: program/reading)

use std::fmt::Write;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Code, Diagnostic, Number, Severity, Text};
use pathbuild_gcode::verify::Machine;
use pathbuild_workspace::config::types::Requirement;
use serde_json::{Value, json};

use super::stock::{Origin, Sources};
use crate::context::Context;

/// A check of a program.
struct CheckRecord {
    requirement: Requirement,
    outcome: Outcome,
}

enum Outcome {
    /// It was made, with these values.
    Made(String),
    /// It was made with values that only the program itself states.
    Assumed(String),
    /// It was not made for a reason; the option would enable it.
    NotMade { reason: &'static Text, option: &'static Text },
}

/// The checks of the programs of a run.
#[derive(Default)]
pub(super) struct CheckReport {
    /// The summaries, each with its programs.
    lines: Vec<(String, Vec<String>)>,
    records: Vec<Value>,
}

impl CheckReport {
    /// Adds the checks of a program, and to what was found in it an error for each check that is required and was not made.
    pub(super) fn add(
        &mut self,
        context: &Context,
        sources: &Sources<'_>,
        machine: Option<&Machine>,
        found: &mut Vec<Diagnostic>,
        required: &[Requirement],
    ) {
        let mut is_limit_reached = false;
        for problem in found.iter_mut().filter(|problem| problem.code() == Code::LimitReached) {
            is_limit_reached = true;
            if sources.is_assumed() {
                // Without the comments, the check would not be made either.
                problem.severity = Severity::Warning;
            }
        }
        let records = records(context, sources, machine, is_limit_reached);
        let (file, line) = (sources.program.file.to_string(), summary(context, &records));
        let checks: Vec<Value> = records.iter().map(|record| record.json(context)).collect();
        self.records.push(json!({ "program": file, "checks": checks }));
        match self.lines.iter_mut().find(|(known, _)| *known == line) {
            Some((_, files)) => files.push(file),
            None => self.lines.push((line, vec![file])),
        }
        found.extend(records.iter().filter_map(|record| record.unmade(required)));
    }

    /// Prints the summaries, and adds the records to the document of the run.
    pub(super) fn finish(self, context: &Context) {
        for (line, files) in &self.lines {
            let programs = match &**files {
                [file] => file.clone(),
                files => context.phrase("{} programs", "{} Programme", &files.len().to_string()),
            };
            context.printer.status(format_args!("{programs}: {line}"));
        }
        context.output.figure("checks", self.records);
    }
}

fn records(
    context: &Context,
    sources: &Sources<'_>,
    machine: Option<&Machine>,
    is_limit_reached: bool,
) -> Vec<CheckRecord> {
    let made = |is_made: bool, reason, option| {
        if is_made { Outcome::Made(String::new()) } else { Outcome::NotMade { reason, option } }
    };
    let machine = machine.cloned().unwrap_or_default();
    let is_against = sources.against.is_some();
    let all = [
        (Requirement::Rapids, rapids(context, sources, is_limit_reached)),
        (Requirement::Envelope, made(machine.travel.is_some(), &NO_LIMIT, &TRAVEL)),
        (Requirement::Feeds, made(machine.feed.is_some(), &NO_LIMIT, &FEED)),
        (Requirement::Spindle, made(machine.spindle.is_some(), &NO_LIMIT, &SPEEDS)),
        (Requirement::Drawing, made(is_against, &NO_DRAWING, &AGAINST)),
        (Requirement::Clamps, made(is_against, &NO_DRAWING, &AGAINST)),
    ];
    all.map(|(requirement, outcome)| CheckRecord { requirement, outcome }).into()
}

fn rapids(context: &Context, sources: &Sources<'_>, is_limit_reached: bool) -> Outcome {
    if is_limit_reached {
        return Outcome::NotMade { reason: &TOO_LARGE, option: &LIMITS };
    }
    let cutter = sources.cutter_origin().zip(sources.cutters());
    let Some((cutter_origin, cutters)) = cutter else {
        return Outcome::NotMade { reason: &NO_CUTTER, option: &CUTTER };
    };
    let Some((surface_origin, surface)) = sources.surface() else {
        return Outcome::NotMade { reason: &NO_SURFACE, option: &SURFACE };
    };
    let mut diameters: Vec<String> = Vec::new();
    for (_, cutter) in &cutters {
        let diameter = Number(cutter.diameter).prose(context.lang());
        if !diameters.contains(&diameter) {
            diameters.push(diameter);
        }
    }
    let name = |origin: Origin, option| match origin {
        Origin::Option => option,
        Origin::Drawing => context.choose("drawing", "Zeichnung"),
        Origin::Table => "[tool]",
        Origin::Program => context.choose("header", "Kopf"),
    };
    let mut with = format!("{} mm ({})", diameters.join(", "), name(cutter_origin, "--cutter"));
    let place =
        surface.map_or(String::new(), |surface| format!(" Z {}", Number(surface).prose(context.lang())));
    let material = context.choose("and material up to", "und Material bis");
    _ = write!(with, " {material}{place} ({})", name(surface_origin, "--surface"));
    match cutter_origin.max(surface_origin) {
        Origin::Program => Outcome::Assumed(with),
        _ => Outcome::Made(with),
    }
}

/// The checks in a line.
fn summary(context: &Context, records: &[CheckRecord]) -> String {
    let mut made = vec![context.choose("words", "Wörter").to_owned()];
    let mut unmade = Vec::new();
    for CheckRecord { requirement, outcome } in records {
        let name = shown(*requirement).in_lang(context.lang());
        match outcome {
            Outcome::Made(with) | Outcome::Assumed(with) if with.is_empty() => made.push(name.to_owned()),
            Outcome::Made(with) | Outcome::Assumed(with) => {
                let against = context.choose("against a cutter of", "mit einem Fräser von");
                made.push(format!("{name} {against} {with}"));
            }
            Outcome::NotMade { reason, option } if *requirement == Requirement::Rapids => {
                let (reason, option) = (reason.in_lang(context.lang()), option.in_lang(context.lang()));
                unmade.push(format!("{name} ({reason}: {option})"));
            }
            Outcome::NotMade { option, .. } => {
                unmade.push(format!("{name} ({})", option.in_lang(context.lang())));
            }
        }
    }
    let mut line = format!("{}: {}", context.choose("checked", "geprüft"), made.join(", "));
    if !unmade.is_empty() {
        _ = write!(line, "; {}: {}", context.choose("not checked", "nicht geprüft"), unmade.join(", "));
    }
    line
}

impl CheckRecord {
    fn json(&self, context: &Context) -> Value {
        let check = self.requirement.name();
        match &self.outcome {
            Outcome::Made(with) => json!({ "check": check, "outcome": "made", "with": with }),
            Outcome::Assumed(with) => json!({ "check": check, "outcome": "assumed", "with": with }),
            Outcome::NotMade { reason, option } => json!({
                "check": check,
                "outcome": "not-made",
                "reason": reason.in_lang(context.lang()),
                "option": option.in_lang(context.lang()),
            }),
        }
    }

    /// The error if the check is required and was not made.
    fn unmade(&self, required: &[Requirement]) -> Option<Diagnostic> {
        let may_be_assumed = required.contains(&Requirement::AssumedRapids);
        let is_rapids = self.requirement == Requirement::Rapids;
        let is_required = required.contains(&self.requirement) || (is_rapids && may_be_assumed);
        if !is_required {
            return None;
        }
        let (reason, option) = match &self.outcome {
            Outcome::Made(_) => return None,
            Outcome::Assumed(_) if may_be_assumed => return None,
            Outcome::Assumed(_) => (&ONLY_COMMENTS, &GIVEN),
            Outcome::NotMade { reason, option } => (*reason, *option),
        };
        let problem = Diagnostic::new(&say::CHECK_NOT_MADE).quoting("check", self.requirement.name());
        Some(problem.with("reason", reason).with("option", option))
    }
}

/// The name of a check for readers.
fn shown(requirement: Requirement) -> Text {
    match requirement {
        Requirement::Rapids | Requirement::AssumedRapids => Text { en: "rapid moves", de: "Eilgänge" },
        Requirement::Envelope => Text { en: "travel", de: "Verfahrwege" },
        Requirement::Feeds => Text { en: "largest feed", de: "größter Vorschub" },
        Requirement::Spindle => Text { en: "spindle speeds", de: "Drehzahlen" },
        Requirement::Drawing => Text { en: "moves of the drawing", de: "Bewegungen der Zeichnung" },
        Requirement::Clamps => Text { en: "clamps", de: "Spannmittel" },
    }
}

static NO_LIMIT: Text =
    Text { en: "the machine's limits are not known", de: "die Grenzen der Maschine sind nicht bekannt" };
static NO_DRAWING: Text =
    Text { en: "there is no drawing to compare with", de: "es fehlt die Zeichnung zum Vergleich" };
static NO_CUTTER: Text = Text { en: "the cutter is not known", de: "der Fräser ist nicht bekannt" };
static NO_SURFACE: Text = Text {
    en: "the height of the material is not known, only those at cutting depth were examined",
    de: "die Höhe des Materials ist nicht bekannt, nur die in Frästiefe wurden untersucht",
};
static TOO_LARGE: Text = Text { en: "the program is too large", de: "das Programm ist zu groß" };
static ONLY_COMMENTS: Text = Text {
    en: "only the program itself states cutter or material",
    de: "nur das Programm selbst nennt Fräser oder Material",
};
static TRAVEL: Text = Text { en: "[machine] travel", de: "[machine] travel" };
static FEED: Text = Text { en: "[machine] maximum-feed", de: "[machine] maximum-feed" };
static SPEEDS: Text = Text { en: "[machine] spindle-speeds", de: "[machine] spindle-speeds" };
static AGAINST: Text = Text { en: "--against PATH", de: "--against PFAD" };
static CUTTER: Text = Text { en: "--cutter or --against PATH", de: "--cutter oder --against PFAD" };
static SURFACE: Text = Text { en: "--surface or --against PATH", de: "--surface oder --against PFAD" };
static LIMITS: Text =
    Text { en: "[limits] verify-cells and verify-pieces", de: "[limits] verify-cells und verify-pieces" };
static GIVEN: Text = Text {
    en: "--cutter and --surface, --against PATH, or rapids=assumed",
    de: "--cutter und --surface, --against PFAD oder rapids=assumed",
};
