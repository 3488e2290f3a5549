//! `pathbuild explain`: shows the page about a code, or a list of all codes.

use pathbuild_diagnostic::{Code, Lang};

use super::refuse;
use crate::args::ExplainArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::nearest_code;

/// Prints the pages of the given codes. If one of them is unknown, nothing is printed.
pub fn run(context: &Context, args: &ExplainArgs) -> ExitStatus {
    if args.codes.is_empty() {
        context.printer.result(list(context));
        return ExitStatus::Success;
    }
    match args.codes.iter().map(|name| code(name).ok_or(name)).collect::<Result<Vec<Code>, _>>() {
        Ok(codes) => {
            let pages: Vec<&str> = codes.into_iter().map(|code| code.page(context.lang())).collect();
            context.printer.result(pages.join("\n"));
            ExitStatus::Success
        }
        Err(name) => refuse(context, &unknown_code_error(context, name)),
    }
}

/// Finds a code by its name, or by its number with or without the letters PB.
fn code(name: &str) -> Option<Code> {
    name.parse().or_else(|()| format!("PB{name}").parse()).ok()
}

fn unknown_code_error(context: &Context, name: &str) -> String {
    let unknown = context.choose("there is no diagnostic", "es gibt keine Meldung");
    let all =
        context.choose("`pathbuild explain` lists all codes", "`pathbuild explain` führt alle Codes auf");
    let near = nearest_code(name).map(|near| match context.lang() {
        Lang::En => format!("did you mean {near}? "),
        Lang::De => format!("ist {near} gemeint? "),
    });
    format!("{unknown} '{name}'\n\n  {}: {}{all}", context.choose("tip", "Tipp"), near.unwrap_or_default())
}

fn list(context: &Context) -> String {
    let width = Code::ALL.iter().map(|code| code.name().len()).max().unwrap_or_default();
    let severity = |code: &Code| code.severity().word(context.lang());
    let line = |code: &Code| format!("{code}  {:width$}  {}", code.name(), severity(code));
    Code::ALL.iter().map(line).chain([String::new()]).collect::<Vec<_>>().join("\n")
}
