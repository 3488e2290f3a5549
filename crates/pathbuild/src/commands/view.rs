//! `pathbuild view`: shows a path, a drawing or a program. (book: program/pictures)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::is_drawing;
use pathbuild_diagnostic::{Value, escaping};
use pathbuild_view::{Scene, VisibleParts, has_stock};
use pathbuild_workspace::emit::{SceneReport, ShownText};
use pathbuild_workspace::files::is_file_name_taken;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::program_view::program_scene;
use pathbuild_workspace::session::{NamedPaths, Session};
use pathbuild_workspace::verify::VerifyOptions;
use pathbuild_workspace::{Failure, program};

use super::picture_output::deliver;
use crate::args::ViewArgs;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Runs the command. A path with errors is shown with its findings in the picture.
///
/// # Errors
/// If there is nothing to show, or if it cannot be written in this format.
pub fn run(context: &Context, args: &ViewArgs) -> Result<ExitStatus, Failure> {
    let output = Output::of(context, args).map_err(Failure::Usage)?;
    let target = target_scene(context, args, output.format)?;
    let (scene, findings) = target.report.for_sharing(context, &target.file);
    context.show(&findings);
    if output.shown.stock && !has_stock(&scene) {
        let is_program = !is_drawing(Utf8Path::new(&target.file));
        return Ok(report_missing_stock(context, &findings, is_program));
    }
    Ok(deliver(context, output.file.as_deref(), output.format.bytes(scene, output.shown), &findings))
}

/// Reports that there is no stock to show: nothing is cut, or the cutter or the material is unknown. For programs, the message also names the options
/// that would help.
fn report_missing_stock(context: &Context, findings: &Findings, is_program: bool) -> ExitStatus {
    let reason = context.choose(
        "view --stock: nothing is cut, or the cutter or the height of the material is unknown",
        "view --stock: nichts wird gefräst, oder Fräser oder Materialhöhe sind unbekannt",
    );
    let advice = context.choose(": give --cutter and --surface", ": --cutter und --surface angeben");
    let status = context.usage_error(&format!("{reason}{}", if is_program { advice } else { "" }));
    if findings.error_count() > 0 { ExitStatus::Errors } else { status }
}

/// The scene of the argument, ready to be shown.
struct TargetScene {
    report: SceneReport,
    /// Name of the drawing or program that is shown.
    file: String,
}

/// Returns the scene of the argument. A file that is not a drawing is read as a program.
fn target_scene(context: &Context, args: &ViewArgs, format: Format) -> Result<TargetScene, Failure> {
    let file = Utf8Path::new(&args.what);
    if !is_drawing(file) && is_file_name_taken(file) {
        return program_file(context, file, args);
    }
    if let Some(option) = args.program_option() {
        return Err(Failure::Usage(context.phrase(
            "view: {} is only for G-code programs",
            "view: {} ist nur für G-Code-Programme",
            option,
        )));
    }
    Session::new(context).with_stable_files(|session| drawing(session, &args.what, format))
}

fn program_file(context: &Context, file: &Utf8Path, args: &ViewArgs) -> Result<TargetScene, Failure> {
    let options = VerifyOptions { reading: args.reading.options(), ..VerifyOptions::default() };
    let options = options.with_stock(args.cutter.as_deref(), args.surface.as_deref());
    let options = options.map_err(|problem| Failure::Refused(vec![*problem]))?;
    let text = program::read(&context.settings, &*context.system, file);
    let text = text.map_err(|problem| Failure::Found(vec![*problem]))?;
    let report = program_scene(&mut Session::new(context), file, text, options)?;
    Ok(TargetScene { report, file: file.to_string() })
}

fn drawing(session: &Session<'_>, what: &str, format: Format) -> Result<TargetScene, Failure> {
    let Some(NamedPaths { file, names }) = session.named_paths(what).map_err(Failure::Found)? else {
        let reason = session.workspace().phrase(
            "view shows one path, drawing or program: `{}` is a directory",
            "view zeigt einen Pfad, eine Zeichnung oder ein Programm: `{}` ist ein Verzeichnis",
            &escaping::line(what),
        );
        return Err(Failure::Usage(reason));
    };
    let db = session.db();
    let post_processor = PostProcessor::for_run(session.workspace(), None, PostArguments::default());
    let post_processor = post_processor.map_err(Failure::Post)?;
    let text =
        if format.is_picture() { ShownText::Omitted } else { ShownText::Emitted(post_processor.as_ref()) };
    let mut report = session.scene(file, &names, text);
    let missing = session.no_path_error(file.path(db), &names, &report.diagnostics);
    report.diagnostics.extend(missing);
    report.diagnostics = session.with_hints(report.diagnostics);
    if names.is_empty() {
        // Refuse to write an empty picture, which could replace one that shows something.
        return Err(Failure::Found(report.diagnostics));
    }
    Ok(TargetScene { report, file: file.path(db).to_string() })
}

/// The destination of a scene, with its format.
struct Output {
    format: Format,
    /// File to write; `None` to show the scene in the browser.
    file: Option<Utf8PathBuf>,
    shown: VisibleParts,
}

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
    fn of(extension: &str) -> Option<Self> {
        Some(match extension {
            "svg" => Self::Svg,
            "json" => Self::Json,
            #[cfg(feature = "pictures")]
            "png" => Self::Png,
            #[cfg(feature = "pictures")]
            "pdf" => Self::Pdf,
            #[cfg(feature = "pictures")]
            "html" => Self::Html,
            _ => return None,
        })
    }

    fn names(context: &Context) -> &str {
        if cfg!(feature = "pictures") {
            context.choose(
                "the name must end in .svg, .png, .pdf, .html or .json",
                "der Name muss auf .svg, .png, .pdf, .html oder .json enden",
            )
        } else {
            context.choose(
                "the name must end in .svg or .json: this pathbuild was built without the feature `pictures`",
                "der Name muss auf .svg oder .json enden: dieses pathbuild ist ohne das Feature `pictures` gebaut",
            )
        }
    }

    fn is_picture(self) -> bool {
        match self {
            Self::Svg => true,
            Self::Json => false,
            #[cfg(feature = "pictures")]
            Self::Png | Self::Pdf => true,
            #[cfg(feature = "pictures")]
            Self::Html => false,
        }
    }

    fn bytes(self, scene: Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
        match self {
            Self::Svg => Ok(pathbuild_view::svg(&scene, shown).into_bytes()),
            Self::Json => Ok((scene.to_json() + "\n").into_bytes()),
            #[cfg(feature = "pictures")]
            Self::Png => pathbuild_view::png(scene, shown),
            #[cfg(feature = "pictures")]
            Self::Pdf => pathbuild_view::pdf(scene, shown),
            #[cfg(feature = "pictures")]
            Self::Html => Ok(pathbuild_view::page(&scene, shown.lang).into_bytes()),
        }
    }
}

impl Output {
    /// Chooses the destination and its format by the extension.
    ///
    /// # Errors
    /// The extension is unknown, or is not one for pictures of the stock.
    fn of(context: &Context, args: &ViewArgs) -> Result<Self, String> {
        let shown = VisibleParts { stock: args.stock, ..VisibleParts::all(context.lang()) };
        let Some(file) = &args.output else { return Self::browser(context, shown) };
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        let format = Format::of(&extension);
        let format = format
            .ok_or_else(|| format!("-o {}: {}", escaping::line(file.as_str()), Format::names(context)))?;
        if args.stock && !format.is_picture() {
            return Err(context.phrase(
                "-o {}: view --stock writes a picture: the name must end in .svg, .png or .pdf",
                "-o {}: view --stock schreibt ein Bild: der Name muss auf .svg, .png oder .pdf enden",
                &escaping::line(file.as_str()),
            ));
        }
        Ok(Self { format, file: Some(file.to_owned()), shown })
    }

    #[cfg(feature = "pictures")]
    #[expect(clippy::unnecessary_wraps, reason = "without pictures there is no page")]
    fn browser(_: &Context, shown: VisibleParts) -> Result<Self, String> {
        Ok(Self { format: Format::Html, file: None, shown })
    }

    #[cfg(not(feature = "pictures"))]
    fn browser(context: &Context, _: VisibleParts) -> Result<Self, String> {
        let needs = context.choose("view needs -o FILE", "view braucht -o DATEI");
        Err(format!("{needs}: {}", Format::names(context)))
    }
}
