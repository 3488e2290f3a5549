//! Writes pictures and pages to a file, or shows them in the browser.

use camino::Utf8Path;
#[cfg(feature = "pictures")]
use pathbuild_diagnostic::{Sentence, reasons::reason};
use pathbuild_diagnostic::{Text, Value, escaping};
use pathbuild_workspace::files::write_error;
use pathbuild_workspace::findings::Findings;

use super::report_output;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Writes a picture or page to a file, or without a file shows it in the browser. Returns the exit status, which also depends on the findings.
pub(super) fn deliver(
    context: &Context,
    file: Option<&Utf8Path>,
    bytes: Result<Vec<u8>, Value>,
    findings: &Findings,
) -> ExitStatus {
    let delivered = bytes.and_then(|bytes| match file {
        Some(file) => write(context, file, &bytes),
        None => open_page(context, &bytes),
    });
    match delivered {
        Ok(()) => ExitStatus::of(findings),
        Err(reason) => context.fail(vec![write_error(file.unwrap_or(Utf8Path::new(BROWSER)), reason)]),
    }
}

fn write(context: &Context, file: &Utf8Path, bytes: &[u8]) -> Result<(), Value> {
    let written = context.system.write(file, bytes)?;
    let state = report_output(context, file, written);
    context.printer.status(format_args!("{}: {state}", escaping::line(file.as_str())));
    Ok(())
}

/// Text that replaces the file name in errors about the browser.
const BROWSER: &str = "(browser)";

/// Writes a page to a temporary file and opens it in the browser. The file is not removed, because the browser may read it later.
#[cfg(feature = "pictures")]
fn open_page(context: &Context, page: &[u8]) -> Result<(), Value> {
    use std::io::Write;

    let file = tempfile::Builder::new().prefix("pathbuild-").suffix(".html").tempfile();
    let file = file.map_err(|error| reason(&error))?;
    file.as_file().write_all(page).map_err(|error| reason(&error))?;
    let (_, path) = file.keep().map_err(|error| reason(&error.error))?;
    context.printer.status(format_args!("{}", escaping::line(&path.to_string_lossy())));
    open::that_detached(&path)
        .map_err(|error| Sentence::new(&NO_BROWSER).with("error", Value::foreign(error)).into())
}

#[cfg(not(feature = "pictures"))]
fn open_page(_: &Context, _: &[u8]) -> Result<(), Value> {
    Err((&NO_PAGES).into())
}

#[cfg(feature = "pictures")]
static NO_BROWSER: Text = Text {
    en: "no browser could be started: open the file named above, or give -o FILE ({error})",
    de: "kein Browser ließ sich starten: die oben genannte Datei öffnen oder -o DATEI angeben ({error})",
};

#[cfg(not(feature = "pictures"))]
static NO_PAGES: Text = Text {
    en: "this pathbuild was built without the feature `pictures` and cannot open a page: write a file with -o FILE",
    de: "dieses pathbuild ist ohne das Feature `pictures` gebaut und kann keine Seite öffnen: mit -o DATEI eine Datei schreiben",
};
