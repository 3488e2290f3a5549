use pathbuild_workspace::list::{Row, State};

use crate::context::Context;
use crate::numbers::{self, decimal};
use crate::table::Column;

pub(super) fn word(state: State, context: &Context) -> &'static str {
    match state {
        State::Errors => context.choose("errors", "Fehler"),
        State::Stale => context.choose("program not current", "Programm nicht aktuell"),
        State::Current => context.choose("program current", "Programm aktuell"),
        State::Ok => context.choose("ok", "in Ordnung"),
    }
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

pub(super) fn cells(row: &Row, context: &Context) -> Vec<String> {
    let path = &row.path;
    let number = |number: Option<f64>, places| {
        number.map_or_else(|| "-".to_owned(), |number| decimal(number, places, context.lang()))
    };
    let size =
        row.size().map(|[width, height]| format!("{} x {}", number(Some(width), 1), number(Some(height), 1)));
    vec![
        path.name.as_str().to_owned(),
        path.drawing.to_string(),
        path.material.as_deref().unwrap_or("-").to_owned(),
        number(path.thickness, 3),
        number(path.tool, 3),
        size.unwrap_or_else(|| "-".to_owned()),
        number(path.length, 0),
        number(path.minutes, 0),
        state_text(row, context),
    ]
}

fn state_text(row: &Row, context: &Context) -> String {
    let counted = |count, noun| numbers::counted(count, context.lang(), noun);
    let errors = match row.state() {
        State::Errors => {
            counted(row.errors, [context.choose("error", "Fehler"), context.choose("errors", "Fehler")])
        }
        state => word(state, context).to_owned(),
    };
    if row.warnings == 0 {
        return errors;
    }
    let warnings = [context.choose("warning", "Warnung"), context.choose("warnings", "Warnungen")];
    format!("{errors}, {}", counted(row.warnings, warnings))
}
