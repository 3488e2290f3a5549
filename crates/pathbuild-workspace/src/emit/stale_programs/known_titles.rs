//! The drawings and paths that may have produced a program, by the titles of programs.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_path::PathName;

use super::reason::Reason;
use super::{EarlierPrograms, file_name};
use crate::emit::plan::output_directory;
use crate::memo::{Answer, DrawingResult};
use crate::session::Session;

/// The drawings and paths that may have produced a program.
pub(super) struct KnownTitles {
    /// Titles of paths in covered drawings for which the run generates nothing, because they have errors or are not selected. Existing files may
    /// still belong to them. The number is that of the path in `paths`; `None` if several drawings define it.
    idle: BTreeMap<Title, Option<usize>>,
    /// Drawings of which the run knows all paths.
    covered: BTreeSet<Title>,
    /// Drawings that cannot be read, with their file names.
    unread: BTreeMap<Title, String>,
    /// Existing drawings of which the run does not know the paths.
    others: BTreeSet<Title>,
    /// Names of the drawings in the search directories, which `emit` finds although they may not be in the library.
    searched: BTreeSet<String>,
    /// Names of all drawings in the directories of the library, even if they are ignored, by the names normalised for comparison.
    in_library: BTreeMap<String, Box<str>>,
    /// The paths of covered drawings: the name normalised for comparison, the drawing, and the name as the drawing spells it.
    paths: Vec<(String, Utf8PathBuf, PathName)>,
    /// Whether a covered drawing has errors, which may hide paths.
    pub(super) has_broken: bool,
    /// Whether the run knows all drawings of the library, or all drawings beside the program. If so, a drawing that it does not know does not exist
    /// any more.
    knows_all: bool,
    place: OutputPlace,
}

/// The directory to which programs are written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OutputPlace {
    BesideDrawings,
    OwnDirectory,
    /// An output directory outside the configuration's directory, where other libraries may use it.
    SharedDirectory,
}

impl OutputPlace {
    fn new(session: &Session<'_>, out_dir: Option<&Utf8Path>) -> Self {
        match out_dir {
            None => Self::BesideDrawings,
            Some(directory) if is_outside(session, directory) => Self::SharedDirectory,
            Some(_) => Self::OwnDirectory,
        }
    }
}

/// Returns the title of a program, normalised for comparison.
fn title(drawing: &str, path: &str) -> String {
    plain_title(&native::title(drawing, path))
}

/// Output directory of a program, and its title or drawing, normalised for comparison (see [`plain_title`]).
type Title = (Utf8PathBuf, String);

impl KnownTitles {
    pub(super) fn new(run: &EarlierPrograms<'_>) -> Self {
        let EarlierPrograms { session, jobs, .. } = run;
        let out_dir = session.out_dir();
        let all_covered = (run.covered)();
        let db = session.db();
        let place = |drawing: &Utf8Path| output_directory(out_dir.as_deref(), drawing);
        let written = |drawing: &Utf8Path| (place(drawing), plain_title(file_name(drawing)));
        let path = |drawing: &Utf8Path, path: &str| (place(drawing), title(file_name(drawing), path));
        let generated: BTreeSet<Title> =
            jobs.iter().map(|job| path(job.drawing(db).path(db), &job.path)).collect();
        let names = |drawing: &'_ Answer<DrawingResult>| {
            let file = drawing.drawing().to_owned();
            let named = |name: &PathName| (plain_title(name.as_str()), file.clone(), name.clone());
            drawing.value.names.iter().map(named).collect::<Vec<_>>()
        };
        let paths: Vec<_> = all_covered.iter().flat_map(names).collect();
        let mut idle = BTreeMap::new();
        for (number, (_, drawing, name)) in paths.iter().enumerate() {
            let title = path(drawing, name.as_str());
            if !generated.contains(&title) {
                idle.entry(title).and_modify(|known| *known = None).or_insert(Some(number));
            }
        }
        let is_broken =
            |drawing: &&Answer<DrawingResult>| drawing.value.diagnostics.iter().any(Diagnostic::is_error);
        let (broken, sound): (Vec<_>, Vec<_>) = all_covered.iter().partition(is_broken);
        let unread =
            broken.iter().filter(|drawing| drawing.value.is_unread() && drawing.value.names.is_empty());
        let unread =
            unread.map(|drawing| (written(drawing.drawing()), file_name(drawing.drawing()).to_owned()));
        let covered: HashSet<&Utf8Path> = sound.iter().map(|drawing| drawing.drawing()).collect();
        let has_library = session.has_library();
        let library = if has_library { session.library() } else { Default::default() };
        let others = library.0.iter().filter(|drawing| !covered.contains(&***drawing));
        let others = others.map(|drawing| &**drawing).chain(broken.iter().map(|drawing| drawing.drawing()));
        Self {
            idle,
            covered: covered.iter().map(|drawing| written(drawing)).collect(),
            unread: unread.collect(),
            others: others.map(written).collect(),
            searched: searched_drawings(session),
            in_library: session.names_in_library().map(|name| (plain_title(&name), name)).collect(),
            has_broken: !broken.is_empty(),
            paths,
            knows_all: if has_library { session.is_whole_library(&library) } else { out_dir.is_none() },
            place: OutputPlace::new(session, out_dir.as_deref()),
        }
    }

    /// Returns the reason why a program that no path of the run yields is stale; `None` if a path that the run does not generate may yield it.
    /// `beside` lists the files in its directory.
    pub(super) fn stale_reason<'n>(
        &self,
        directory: &Utf8Path,
        title: &str,
        mut beside: impl Iterator<Item = &'n str>,
    ) -> Option<Reason> {
        let title = plain_title(title);
        let named = |text: &str| (directory.to_owned(), text.to_owned());
        let drawing = named(native::drawing_of_title(&title)?);
        if let Some(drawing) = self.unread.get(&drawing) {
            return Some(Reason::Unread { drawing: drawing.clone() });
        }
        let beside = beside.find(|name| plain_title(name) == drawing.1);
        if self.idle.contains_key(&named(&title)) || self.others.contains(&drawing) {
            return None;
        }
        if self.covered.contains(&drawing) {
            return Some(Reason::Left);
        }
        // A drawing beside the program or in the library that the run does not know is excluded by an ignore file or by its hidden name. In a shared
        // output directory, the program may also be that of another library.
        let in_library = self.in_library.get(&drawing.1).map(|name| &**name);
        let ignored = match self.place {
            OutputPlace::BesideDrawings => beside,
            OutputPlace::OwnDirectory => in_library,
            OutputPlace::SharedDirectory => None,
        };
        if let Some(drawing) = ignored {
            return Some(Reason::Ignored { drawing: drawing.to_owned() });
        }
        let is_there = beside.is_some() || in_library.is_some() || self.searched.contains(&drawing.1);
        if is_there { None } else { self.reason_if_gone() }
    }

    /// Returns the drawing and the path in the title of a program, if the run generates nothing for this path.
    pub(super) fn path_without_output(
        &self,
        directory: &Utf8Path,
        title: &str,
    ) -> Option<(&Utf8Path, &PathName)> {
        let number = *self.idle.get(&(directory.to_owned(), plain_title(title)))?;
        let (_, drawing, name) = &self.paths[number?];
        Some((drawing, name))
    }

    /// Returns the reason why a program is stale if its drawing was not found.
    pub(super) fn reason_if_gone(&self) -> Option<Reason> {
        let is_shared = self.place == OutputPlace::SharedDirectory;
        self.knows_all.then_some(if is_shared { Reason::OfOthers } else { Reason::Left })
    }

    /// Returns the drawings that define a path, among those of the run, those beside the program and those where paths are looked up, with the path's
    /// name as spelled there. `name` is normalised for comparison.
    pub(super) fn drawings_of(
        &self,
        session: &Session<'_>,
        name: &str,
        directory: &Utf8Path,
    ) -> Vec<(SourceFile, PathName)> {
        let covered = self.paths.iter().filter(|(plain, ..)| plain == name);
        let covered: Vec<_> =
            covered.map(|(_, drawing, spelled)| (session.file(drawing), spelled.clone())).collect();
        if !covered.is_empty() {
            return covered;
        }
        let mut directories = session.name_directories();
        directories.push(directory.to_owned());
        let name = PathName::new(name);
        let files = session.definitions(&name, &directories);
        files.into_iter().map(|file| (file, name.clone())).collect()
    }
}

/// Returns the names of the files in the search directories, normalised for comparison.
fn searched_drawings(session: &Session<'_>) -> BTreeSet<String> {
    let directories = session.workspace().settings.general.search.value.iter();
    let listed =
        directories.filter_map(|directory| session.file_names_in(&session.normalize(directory)).ok());
    listed.flat_map(|names| names.iter().map(plain_title).collect::<Vec<_>>()).collect()
}

/// Whether a directory lies outside the directory of the configuration.
fn is_outside(session: &Session<'_>, directory: &Utf8Path) -> bool {
    let workspace = session.workspace();
    let own = session.normalize(workspace.settings.directory().unwrap_or(&workspace.working_directory));
    let rest = directory.strip_prefix(own);
    !rest.is_ok_and(|rest| rest.is_relative() && !rest.starts_with(".."))
}
