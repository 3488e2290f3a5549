//! What a scene becomes.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::Written;
use pathbuild_diagnostic::{Diagnostic, shown};
use pathbuild_view::{Scene, Shown};
use pathbuild_workspace::files::cannot_write;

use crate::context::Context;

/// Where a scene goes, and as what.
pub(super) struct Output {
    format: Format,
    file: Utf8PathBuf,
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
    const NAMES: &str = "the name must end in .svg, .png, .pdf or .json";

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
        }
    }
}

impl Output {
    /// By the file's name.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn of(file: Option<&Utf8Path>) -> Result<Self, String> {
        let Some(file) = file else { return Err(format!("view needs -o FILE: {}", Format::NAMES)) };
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        let format = Format::of(&extension);
        let format = format.ok_or_else(|| format!("-o {}: {}", shown::line(file.as_str()), Format::NAMES))?;
        Ok(Self { format, file: file.to_owned() })
    }

    /// Writes the scene.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn deliver(&self, context: &Context, scene: &Scene) -> Result<(), Box<Diagnostic>> {
        let refused = |reason: &str| Box::new(cannot_write(&self.file, reason));
        let bytes =
            self.format.bytes(scene, Shown::all(context.lang())).map_err(|reason| refused(&reason))?;
        let state = match context.system.write(&self.file, &bytes).map_err(|reason| refused(&reason))? {
            Written::Changed => context.choose("written", "geschrieben"),
            Written::Unchanged => context.choose("unchanged", "unverändert"),
        };
        context.printer.status(format_args!("{}: {state}", shown::line(self.file.as_str())));
        Ok(())
    }
}
