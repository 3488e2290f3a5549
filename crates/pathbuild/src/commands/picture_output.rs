//! Writes pictures and pages to a file, or shows them in the browser.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Text, Value, shown};
#[cfg(feature = "pictures")]
use pathbuild_diagnostic::{Sentence, reasons::reason};
use pathbuild_workspace::files::write_error;

use super::output_state;
use crate::context::Context;

/// Writes a file and reports that it was written.
///
/// # Errors
/// The content cannot be generated or written.
pub(super) fn deliver(
    context: &Context,
    file: &Utf8Path,
    bytes: Result<Vec<u8>, Value>,
) -> Result<(), Box<Diagnostic>> {
    let written = bytes.and_then(|bytes| context.system.write(file, &bytes));
    let written = written.map_err(|reason| Box::new(write_error(file, reason)))?;
    let state = output_state(context, file, written);
    context.printer.status(format_args!("{}: {state}", shown::line(file.as_str())));
    Ok(())
}

/// Shows a page in the browser.
///
/// # Errors
/// The page cannot be generated or shown.
pub(super) fn show(context: &Context, page: Result<Vec<u8>, Value>) -> Result<(), Box<Diagnostic>> {
    let shown = page.and_then(|page| open_page(context, &page));
    shown.map_err(|reason| Box::new(write_error(Utf8Path::new(BROWSER), reason)))
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
    context.printer.status(format_args!("{}", shown::line(&path.to_string_lossy())));
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
