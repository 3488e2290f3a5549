//! G-code that was written earlier and that nothing would write now. (PB520, spec/05-command-line.md)
//!
//! It is looked for only where the run knows everything that could have written it: beside drawings of directories that were named, or in the
//! output directory. A program says itself which path of which drawing it was made from.

use std::cell::LazyCell;
use std::collections::{BTreeSet, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, SourceFile};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{files, outputs as messages};
use pathbuild_gcode::native::{self, Charset, comment};

use super::asked::Asked;
use super::job::{Job, output_directory};
use crate::posting::Poster;
use crate::session::{HEAD, OutputKind, Provenance, Session};

/// Reports what is stale, or removes it; what was removed.
pub(super) fn deal_with(
    session: &Session<'_>,
    stale: Vec<Utf8PathBuf>,
    is_removed: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Utf8PathBuf> {
    let mut removed = Vec::new();
    for path in stale {
        let name = path.file_name().unwrap_or_default();
        if !is_removed {
            diagnostics.push(Diagnostic::new(&messages::STALE).with("name", name).in_file(&path));
            continue;
        }
        match session.db().system().remove(&path) {
            Ok(()) => removed.push(path),
            Err(reason) => {
                let problem = Diagnostic::new(&files::CANNOT_REMOVE).with("name", name);
                diagnostics.push(problem.with("reason", &*reason).in_file(&path));
            }
        }
    }
    removed
}

/// The programs that nothing would write now.
pub(super) fn stale(
    session: &Session<'_>,
    asked: &Asked,
    jobs: &[Job],
    poster: Option<&Poster>,
) -> Vec<Utf8PathBuf> {
    if asked.covered.is_empty() && asked.directories.is_empty() {
        return Vec::new();
    }
    let outputs: HashSet<Utf8PathBuf> = jobs.iter().flat_map(|job| outputs(job, poster.is_none())).collect();
    let writers = LazyCell::new(|| Writers::new(session, asked, jobs));
    let out_dir = session
        .workspace()
        .settings
        .general
        .out_dir
        .value
        .as_ref()
        .map(|directory| session.normal(directory));
    let system = session.db().system();
    let mut stale = Vec::new();
    for directory in out_dir.as_ref().map_or(&*asked.directories, std::slice::from_ref) {
        let listing = system.list(directory).unwrap_or_default();
        let mut programs: Vec<Utf8PathBuf> = listing
            .files
            .iter()
            .filter(|name| is_gcode(name, poster))
            .map(|name| directory.join(name))
            .filter(|path| !outputs.contains(path))
            .collect();
        programs.sort_unstable();
        for path in programs {
            let head = system.head(&path, HEAD).unwrap_or_default();
            let title = Provenance::of_program(&head).map(|(_, title)| title);
            if title.is_some_and(|title| writers.have_left(directory, &title, listing.files.iter())) {
                stale.push(path);
            }
        }
    }
    stale
}

pub(super) fn is_gcode(name: &str, poster: Option<&Poster>) -> bool {
    let is_like = |extension: &str, other: &str| extension.eq_ignore_ascii_case(other);
    Utf8Path::new(name).extension().is_some_and(|extension| {
        is_like(extension, "gcode") || poster.is_some_and(|poster| is_like(extension, poster.extension()))
    })
}

/// What writes files.
struct Writers {
    /// Paths of covered drawings that the run makes nothing of, because they are wrong or no targets: what they became earlier may be
    /// theirs still.
    idle: BTreeSet<Title>,
    /// Drawings of which every path is known.
    covered: BTreeSet<Title>,
    /// Other drawings that there are.
    others: BTreeSet<Title>,
    /// Whether drawings of all of the library, or beside the program, are known: one that is not among them is gone.
    knows_all: bool,
}

/// What a program says that it was made from, in ASCII and without case.
fn title(drawing: &str, path: &str) -> String {
    without_case(&comment(&native::title(drawing, path), Charset::Ascii))
}

/// Whether a program's title is this one.
pub(super) fn same_title(of_program: &str, title: &str) -> bool {
    let shown = |title: &str| without_case(&comment(title, Charset::Ascii));
    shown(of_program) == shown(title)
}

/// Some posts write capitals only.
fn without_case(title: &str) -> String {
    title.to_lowercase()
}

/// Where programs are written, and what they say they are made from, without case.
type Title = (Utf8PathBuf, String);

impl Writers {
    fn new(session: &Session<'_>, asked: &Asked, jobs: &[Job]) -> Self {
        let db = session.db();
        let place = |file: SourceFile| output_directory(session, file);
        let name = |file: SourceFile| file.path(db).file_name().unwrap_or_default();
        let drawing = |file: SourceFile| (place(file), without_case(&comment(name(file), Charset::Ascii)));
        let made: BTreeSet<Title> = jobs
            .iter()
            .map(|job| (place(job.drawing(db)), title(name(job.drawing(db)), &job.path)))
            .collect();
        let of_covered = asked.covered.iter().flat_map(|file| {
            asked
                .drawings
                .names(session, *file)
                .iter()
                .map(|path| (place(*file), title(name(*file), path.as_str())))
        });
        let covered: HashSet<SourceFile> = asked.covered.iter().copied().collect();
        let has_library = session.has_library();
        let library = if has_library { session.everything() } else { Vec::new() };
        Self {
            idle: of_covered.filter(|title| !made.contains(title)).collect(),
            covered: asked.covered.iter().map(|file| drawing(*file)).collect(),
            others: library.into_iter().filter(|file| !covered.contains(file)).map(drawing).collect(),
            knows_all: has_library || session.workspace().settings.general.out_dir.value.is_none(),
        }
    }

    /// Whether nothing would write a program now that no path of the run becomes. `beside`: what lies in its directory.
    fn have_left<'n>(
        &self,
        directory: &Utf8Path,
        title: &str,
        mut beside: impl Iterator<Item = &'n str>,
    ) -> bool {
        let title = without_case(&comment(title, Charset::Ascii));
        let Some(drawing) = native::drawing_of_title(&title[1..title.len() - 1]) else { return false };
        let named = |text: String| (directory.to_owned(), text);
        let drawing = named(format!("({drawing})"));
        let is_beside = beside.any(|name| without_case(&comment(name, Charset::Ascii)) == drawing.1);
        if self.idle.contains(&named(title.clone())) || self.others.contains(&drawing) {
            return false;
        }
        // A drawing that is there, but that the run does not know (an ignored one), is left alone.
        self.covered.contains(&drawing) || (self.knows_all && !is_beside)
    }
}

/// The files of a job, and what `adjust` makes of native ones.
fn outputs(job: &Job, is_native: bool) -> Vec<Utf8PathBuf> {
    let mut outputs: Vec<Utf8PathBuf> = job.files.iter().map(|(_, path)| path.clone()).collect();
    if is_native {
        outputs.push(format!("{}{}", job.stem, OutputKind::Milling.suffix()).into());
    }
    outputs
}
