use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::list::{ListedPath, ProgramState};

use crate::context::Context;
use crate::numbers::decimal;
use crate::table::Column;

/// A path, judged by the configuration's severities.
pub(super) struct Row {
    pub(super) path: ListedPath,
    pub(super) errors: usize,
    pub(super) warnings: usize,
}

/// What a path is, in one word: for itself, and beside the program on disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum State {
    /// It has errors.
    Errors,
    /// The program on disk is another one.
    Stale,
    /// The program on disk is the one that would be written.
    Current,
    /// It has no errors, and no program lies on disk.
    Ok,
}

impl State {
    pub(super) const ALL: [Self; 4] = [Self::Errors, Self::Stale, Self::Current, Self::Ok];

    /// As in JSON.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Errors => "errors",
            Self::Stale => "stale",
            Self::Current => "current",
            Self::Ok => "ok",
        }
    }

    pub(super) fn word(self, context: &Context) -> &'static str {
        match self {
            Self::Errors => context.choose("errors", "Fehler"),
            Self::Stale => context.choose("program not current", "Programm nicht aktuell"),
            Self::Current => context.choose("program current", "Programm aktuell"),
            Self::Ok => context.choose("ok", "in Ordnung"),
        }
    }
}

impl Row {
    pub(super) fn new(context: &Context, path: ListedPath) -> Self {
        let found = context.findings(path.diagnostics.clone());
        let errors = found.diagnostics.iter().filter(|found: &&Diagnostic| found.is_error()).count();
        Self { path, errors, warnings: found.diagnostics.len() - errors }
    }

    pub(super) fn state(&self) -> State {
        match self.path.program {
            _ if self.errors > 0 => State::Errors,
            ProgramState::Stale => State::Stale,
            ProgramState::Current => State::Current,
            ProgramState::None => State::Ok,
        }
    }

    /// Width and height of what the cutter's tip reaches while it cuts, in mm.
    pub(super) fn size(&self) -> Option<[f64; 2]> {
        let [x, y, _] = self.path.cutting_box;
        let width = |(low, high): (f64, f64)| high - low;
        Some([width(x?), width(y?)])
    }

    pub(super) fn columns(context: &Context) -> [Column<'static>; 9] {
        let heading = |en, de| context.choose(en, de);
        [
            (heading("path", "Pfad"), false),
            (heading("drawing", "Zeichnung"), false),
            ("M", false),
            ("T", true),
            ("O", true),
            (heading("size", "Größe"), true),
            (heading("length", "Länge"), true),
            ("min", true),
            (heading("state", "Zustand"), false),
        ]
    }

    pub(super) fn cells(&self, context: &Context) -> Vec<String> {
        let path = &self.path;
        let number = |number: Option<f64>, places| {
            number.map_or_else(|| "-".to_owned(), |number| decimal(number, places, context.lang()))
        };
        let size = self
            .size()
            .map(|[width, height]| format!("{} x {}", number(Some(width), 1), number(Some(height), 1)));
        vec![
            path.name.as_str().to_owned(),
            path.drawing.to_string(),
            path.material.as_deref().unwrap_or("-").to_owned(),
            number(path.thickness, 3),
            number(path.tool, 3),
            size.unwrap_or_else(|| "-".to_owned()),
            number(path.length, 0),
            number(path.minutes, 0),
            self.state_text(context),
        ]
    }

    fn state_text(&self, context: &Context) -> String {
        let counted =
            |count: usize, [one, many]: [&str; 2]| format!("{count} {}", if count == 1 { one } else { many });
        let errors = match self.state() {
            State::Errors => {
                counted(self.errors, [context.choose("error", "Fehler"), context.choose("errors", "Fehler")])
            }
            state => state.word(context).to_owned(),
        };
        if self.warnings == 0 {
            return errors;
        }
        let warnings = [context.choose("warning", "Warnung"), context.choose("warnings", "Warnungen")];
        format!("{errors}, {}", counted(self.warnings, warnings))
    }
}
