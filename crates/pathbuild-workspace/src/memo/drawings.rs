//! Facts about drawings by themselves, of an earlier run or read now.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{SourceFile, Trace, check_file, path_names};
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_path::PathName;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Memo;
use super::store::{Answer, Inputs};
use crate::session::{MOST_UNKNOWN, Session};

/// The result of checking a drawing, or only of reading it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DrawingResult {
    /// Names of its paths.
    #[serde(serialize_with = "serialize_names", deserialize_with = "deserialize_names")]
    pub names: Vec<PathName>,
    /// Diagnostics of the drawing, of its paths, and of what they embed.
    pub diagnostics: Vec<Diagnostic>,
}

impl DrawingResult {
    /// Both fields as slices.
    pub fn parts(&self) -> (&[PathName], &[Diagnostic]) {
        (&self.names, &self.diagnostics)
    }

    /// This result with what it was computed from.
    pub fn with_inputs(self, traces: Vec<Trace>) -> (Self, Inputs) {
        let is_transient = self.diagnostics.iter().any(is_transient);
        (self, Inputs { traces, is_transient, ..Inputs::default() })
    }
}

impl Answer<DrawingResult> {
    /// The drawing that the result is about.
    pub fn drawing(&self) -> &Utf8Path {
        Utf8Path::new(self.subject.split('\0').next().unwrap_or_default())
    }
}

/// Cache subject of a drawing's result, or of the result of some of its paths.
pub(crate) fn subject(drawing: &Utf8Path, paths: Option<&[PathName]>) -> Box<str> {
    let Some(paths) = paths else { return drawing.as_str().into() };
    let names: String = paths.iter().flat_map(|path| ["\0", path.as_str()]).collect();
    format!("{drawing}\0{names}").into()
}

/// Names and own diagnostics of drawings, sorted by path. Those that no earlier run knows are read now.
pub(crate) fn read_drawings(
    session: &Session<'_>,
    memo: &Memo,
    paths: &[Utf8PathBuf],
    subject: impl Fn(&Utf8PathBuf) -> Box<str>,
) -> Vec<Answer<DrawingResult>> {
    let db = session.db();
    let read = |open: &[&Utf8PathBuf]| {
        let files = db.files(open.iter().map(|path| (*path).clone()).collect());
        session.parse_ahead(&files);
        let read = |file: SourceFile| {
            let (names, diagnostics) = (path_names(db, file).to_vec(), check_file(db, file).to_vec());
            let trace = Trace { files: vec![file], lookups: Vec::new() };
            DrawingResult { names, diagnostics }.with_inputs(vec![trace])
        };
        files.into_iter().map(read).collect()
    };
    memo.get_or(paths, subject, |_, result| Some(result), read)
}

impl Session<'_> {
    /// Names of all paths in the library, or below the working directory if there is no library; sorted, without duplicates.
    pub fn names_of_library(&self) -> Vec<PathName> {
        let paths = self.paths_of_library(MOST_UNKNOWN);
        let mut names: Vec<PathName> = paths.into_iter().map(|(name, _)| name).collect();
        names.dedup();
        names
    }

    /// The same with the drawings that define them. A drawing that the last `check` of the library knows is not read again. Of the others
    /// only the first `most_unknown` are read, and the rest are left out.
    pub(crate) fn paths_of_library(&self, most_unknown: usize) -> Vec<(PathName, SourceFile)> {
        let (files, _) = self.all_drawings();
        let memo = Memo::of_checks(self.workspace()).unwrap_or_default();
        let read = |open: &[&SourceFile]| {
            let open: Vec<SourceFile> = open.iter().take(most_unknown).map(|file| **file).collect();
            self.parse_ahead(&open);
            let read = |file: SourceFile| {
                let names = path_names(self.db(), file).to_vec();
                (DrawingResult { names, diagnostics: Vec::new() }, Inputs::default())
            };
            open.into_iter().map(read).collect()
        };
        let path = |file: &SourceFile| file.path(self.db()).as_str().into();
        let drawings = memo.get_or(&files, path, |_, result| Some(result), read);
        let paths = drawings.into_iter().flat_map(|answer| {
            let file = self.file(answer.drawing());
            answer.value.names.into_iter().map(move |name| (name, file))
        });
        let mut paths: Vec<(PathName, SourceFile)> = paths.collect();
        paths.sort_by(|(a, one), (b, other)| {
            a.cmp(b).then_with(|| one.path(self.db()).cmp(other.path(self.db())))
        });
        paths
    }
}

/// Finds a drawing in answers that are sorted by path.
pub(crate) fn find<'a>(
    answers: &'a [Answer<DrawingResult>],
    drawing: &Utf8Path,
) -> Option<&'a Answer<DrawingResult>> {
    let place = answers.binary_search_by(|answer| answer.drawing().as_str().cmp(drawing.as_str()));
    place.ok().map(|place| &answers[place])
}

/// Whether a diagnostic may disappear although no input changes: a file that another process had locked, a busy machine, a bug.
pub fn is_transient(diagnostic: &Diagnostic) -> bool {
    match diagnostic.code() {
        Code::UnreadableFile | Code::InternalError => true,
        Code::LimitReached => {
            let seconds = ("key", Value::quoted("seconds-per-path"));
            diagnostic.arguments.contains(&seconds)
        }
        _ => false,
    }
}

fn serialize_names<S: Serializer>(names: &[PathName], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(names.iter().map(PathName::as_str))
}

fn deserialize_names<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PathName>, D::Error> {
    Ok(<Vec<&str>>::deserialize(deserializer)?.into_iter().map(PathName::new).collect())
}
