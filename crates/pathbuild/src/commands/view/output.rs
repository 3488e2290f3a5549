//! Writes or shows a scene.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Value, shown};
use pathbuild_view::{Scene, VisibleParts};

use crate::commands::picture_output::{deliver, show};
use crate::context::Context;

/// Destination of a scene, with its format.
pub(super) struct Output {
    format: Format,
    /// The file; `None` shows the scene in the browser.
    file: Option<Utf8PathBuf>,
}

/// Format of a picture.
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
    /// Chooses the format by the extension.
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
    fn names(context: &Context) -> &str {
        context.choose(
            "the name must end in .svg, .png, .pdf, .html or .json",
            "der Name muss auf .svg, .png, .pdf, .html oder .json enden",
        )
    }

    #[cfg(not(feature = "pictures"))]
    fn names(context: &Context) -> &str {
        context.choose(
            "the name must end in .svg or .json: this pathbuild was built without the feature `pictures`",
            "der Name muss auf .svg oder .json enden: dieses pathbuild ist ohne das Feature `pictures` gebaut",
        )
    }

    fn bytes(self, scene: &Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
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
    /// Chooses the format by the extension.
    ///
    /// # Errors
    /// If the extension is unknown.
    pub(super) fn of(context: &Context, file: Option<&Utf8Path>) -> Result<Self, String> {
        let Some(file) = file else { return Self::browser(context) };
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        let format = Format::of(&extension);
        let format =
            format.ok_or_else(|| format!("-o {}: {}", shown::line(file.as_str()), Format::names(context)))?;
        Ok(Self { format, file: Some(file.to_owned()) })
    }

    #[cfg(feature = "pictures")]
    #[expect(clippy::unnecessary_wraps, reason = "without pictures there is no page")]
    fn browser(_: &Context) -> Result<Self, String> {
        Ok(Self { format: Format::Html, file: None })
    }

    #[cfg(not(feature = "pictures"))]
    fn browser(context: &Context) -> Result<Self, String> {
        let needs = context.choose("view needs -o FILE", "view braucht -o DATEI");
        Err(format!("{needs}: {}", Format::names(context)))
    }

    /// Writes or shows the scene.
    ///
    /// # Errors
    /// If it cannot be written or shown.
    pub(super) fn deliver(&self, context: &Context, scene: &Scene) -> Result<(), Box<Diagnostic>> {
        let bytes = self.format.bytes(scene, VisibleParts::all(context.lang()));
        match &self.file {
            Some(file) => deliver(context, file, bytes),
            None => show(context, bytes),
        }
    }
}
