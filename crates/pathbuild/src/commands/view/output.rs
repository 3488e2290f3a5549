//! What a scene becomes.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::Written;
use pathbuild_diagnostic::{Diagnostic, shown};
use pathbuild_view::{Scene, Shown};
use pathbuild_workspace::files::cannot_write;

use crate::commands::output_row;
use crate::context::Context;

/// Where a scene goes, and as what.
pub(super) struct Output {
    format: Format,
    /// `None`: a file of its own, which the browser is given.
    file: Option<Utf8PathBuf>,
}

/// As what.
#[derive(Clone, Copy)]
enum Format {
    Svg,
    Json,
    #[cfg(feature = "pictures")]
    Png,
    #[cfg(feature = "pictures")]
    Pdf,
    #[cfg(feature = "pictures")]
    Html,
}

impl Format {
    /// By the end of a file's name.
    #[cfg(feature = "pictures")]
    fn of(extension: &str) -> Option<Self> {
        Some(match extension {
            "svg" => Self::Svg,
            "json" => Self::Json,
            "png" => Self::Png,
            "pdf" => Self::Pdf,
            "html" => Self::Html,
            _ => return None,
        })
    }

    #[cfg(not(feature = "pictures"))]
    fn of(extension: &str) -> Option<Self> {
        Some(match extension {
            "svg" => Self::Svg,
            "json" => Self::Json,
            _ => return None,
        })
    }

    #[cfg(feature = "pictures")]
    const NAMES: &str = "the name must end in .svg, .png, .pdf, .html or .json";

    #[cfg(not(feature = "pictures"))]
    const NAMES: &str =
        "the name must end in .svg or .json: this pathbuild was built without the feature `pictures`";

    fn bytes(self, scene: &Scene, shown: Shown) -> Result<Vec<u8>, String> {
        match self {
            Self::Svg => Ok(pathbuild_view::svg(scene, shown).into_bytes()),
            Self::Json => Ok((scene.to_json() + "\n").into_bytes()),
            #[cfg(feature = "pictures")]
            Self::Png => pathbuild_view::png(scene, shown),
            #[cfg(feature = "pictures")]
            Self::Pdf => pathbuild_view::pdf(scene, shown),
            #[cfg(feature = "pictures")]
            Self::Html => Ok(pathbuild_view::page(scene, shown.lang).into_bytes()),
        }
    }
}

impl Output {
    /// By the file's name.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn of(file: Option<&Utf8Path>) -> Result<Self, String> {
        let Some(file) = file else { return Self::browser() };
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        let format = Format::of(&extension);
        let format = format.ok_or_else(|| format!("-o {}: {}", shown::line(file.as_str()), Format::NAMES))?;
        Ok(Self { format, file: Some(file.to_owned()) })
    }

    #[cfg(feature = "pictures")]
    #[expect(clippy::unnecessary_wraps, reason = "without pictures there is no page")]
    fn browser() -> Result<Self, String> {
        Ok(Self { format: Format::Html, file: None })
    }

    #[cfg(not(feature = "pictures"))]
    fn browser() -> Result<Self, String> {
        Err(format!("view needs -o FILE: {}", Format::NAMES))
    }

    /// Writes the scene.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn deliver(&self, context: &Context, scene: &Scene) -> Result<(), Box<Diagnostic>> {
        let name = self.file.as_deref().unwrap_or(Utf8Path::new(BROWSER));
        let refused = |reason: &str| Box::new(cannot_write(name, reason));
        let bytes =
            self.format.bytes(scene, Shown::all(context.lang())).map_err(|reason| refused(&reason))?;
        let Some(file) = &self.file else { return show(context, &bytes).map_err(|reason| refused(&reason)) };
        let written = context.system.write(file, &bytes).map_err(|reason| refused(&reason))?;
        context.row_of_json(|| output_row(context, file, written));
        let state = match written {
            Written::Changed => context.choose("written", "geschrieben"),
            Written::Unchanged => context.choose("unchanged", "unverändert"),
        };
        context.printer.status(format_args!("{}: {state}", shown::line(file.as_str())));
        Ok(())
    }
}

/// What is at fault where the browser cannot be shown something.
const BROWSER: &str = "(browser)";

/// Gives a page to the browser, which may read it at any time later: the file stays, among the system's temporary files.
#[cfg(feature = "pictures")]
fn show(context: &Context, page: &[u8]) -> Result<(), String> {
    use std::io::Write;

    let told = |error: std::io::Error| error.to_string();
    let file = tempfile::Builder::new().prefix("pathbuild-").suffix(".html").tempfile().map_err(told)?;
    file.as_file().write_all(page).map_err(told)?;
    let (_, path) = file.keep().map_err(|error| error.to_string())?;
    context.printer.status(format_args!("{}", shown::line(&path.to_string_lossy())));
    let advice = context.choose(
        "no browser could be started: open the file named above, or give -o FILE",
        "kein Browser ließ sich starten: die oben genannte Datei öffnen oder -o DATEI angeben",
    );
    open::that_detached(&path).map_err(|error| format!("{advice} ({error})"))
}

#[cfg(not(feature = "pictures"))]
fn show(_: &Context, _: &[u8]) -> Result<(), String> {
    Err(Format::NAMES.to_owned())
}
