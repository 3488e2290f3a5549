//! The reasons why a program on disk is stale, with their diagnostics.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Target;
use pathbuild_db::system::or_current_directory;
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};

use super::UnselectedMoves;
use crate::session::OutputName;

/// A program on disk that must not be run on the machine.
#[derive(Debug)]
pub(in crate::emit) struct StaleProgram {
    pub(super) path: Utf8PathBuf,
    pub(super) reason: Reason,
}

/// The reason why a program is stale.
#[derive(Debug)]
pub(super) enum Reason {
    /// No path yields the program any more.
    Left,
    /// No path yields the program any more, and `emit` would give it another name, so a person may have copied it.
    Copied,
    /// The file contains the current program of `path` under a name that `emit` does not give it.
    CurrentCopy { path: String },
    /// The run does not write the program of `path`. The program is stale only if its moves differ from those that the target has now.
    Unselected { path: String, target: Target, moves: Box<str> },
    /// The run does not write the program of `path`, which has errors now.
    Broken { path: String },
    /// The program's drawing cannot be read, so it is unknown whether its path still yields the program.
    Unread { drawing: String },
    /// The program lies beside its drawing, but programs are written into `directory` now.
    Beside { directory: Utf8PathBuf },
    /// The drawing is in another directory now, where its current `program` is.
    Elsewhere { program: Utf8PathBuf },
    /// The program's drawing exists, but an ignore file or its hidden name excludes it from the search.
    Ignored { drawing: String },
    /// The program's drawing is not in this library, but may be in another library that shares the output directory.
    OfOthers,
    /// The program was adjusted from the program `clean`, which has changed since.
    Adjusted { clean: Utf8PathBuf },
    /// The program is not the result of adjusting `clean` with the measured heights that it states.
    Edited { clean: Utf8PathBuf },
    /// The program was adjusted with heights other than those in the file `values`.
    OtherValues { values: Utf8PathBuf },
    /// The program was converted from the adjusted `program`, which states other measured heights now.
    OtherHeights { program: Utf8PathBuf },
    /// The program joins paths that yield another program now.
    OtherJoined { paths: Vec<String> },
    /// The program joins paths, of which `path` cannot be written now.
    Unwritten { path: String },
    /// The program was written through another post-processor, and its moves differ from those of the current `program`.
    OtherMoves { program: Utf8PathBuf },
}

impl StaleProgram {
    /// Returns the target whose program this is, if the run did not select it.
    pub(super) fn unselected_target(&self) -> Option<Target> {
        if let Reason::Unselected { target, .. } = self.reason { Some(target) } else { None }
    }

    /// Returns the finding about a program of a path that the run did not select; `None` if it is current, or if the moves of the path are unknown.
    pub(super) fn finding_if_unselected(&self, known: &UnselectedMoves) -> Option<Diagnostic> {
        let Reason::Unselected { path, target, moves } = &self.reason else { return None };
        match known.get(target)? {
            Some(now) if now == moves => None,
            Some(_) => Some(self.diagnostic()),
            None => {
                let reason = Reason::Broken { path: path.clone() };
                Some(Self { path: self.path.clone(), reason }.diagnostic())
            }
        }
    }

    pub(super) fn diagnostic(&self) -> Diagnostic {
        let name = |path: &Utf8Path| path.file_name().unwrap_or_default().to_owned();
        let problem = match &self.reason {
            Reason::Left => Diagnostic::new(&messages::STALE),
            Reason::Copied => Diagnostic::new(&messages::STALE_COPY),
            Reason::CurrentCopy { path } => {
                Diagnostic::new(&messages::CURRENT_COPY).quoting("path", path.as_str())
            }
            Reason::Unselected { path, .. } => {
                Diagnostic::new(&messages::STALE_UNSELECTED).quoting("path", path.as_str())
            }
            Reason::Broken { path } => {
                Diagnostic::new(&messages::STALE_BROKEN).quoting("path", path.as_str())
            }
            Reason::Unread { drawing } => {
                Diagnostic::new(&messages::OUTPUT_OF_UNREAD).quoting("drawing", drawing.as_str())
            }
            Reason::Beside { directory } => {
                let directory = or_current_directory(directory).as_str();
                Diagnostic::new(&messages::STALE_BESIDE).quoting("directory", directory)
            }
            Reason::Elsewhere { program } => {
                Diagnostic::new(&messages::STALE_ELSEWHERE).quoting("program", program.as_str())
            }
            Reason::Ignored { drawing } => {
                Diagnostic::new(&messages::STALE_OF_IGNORED).quoting("drawing", drawing.as_str())
            }
            Reason::OfOthers => Diagnostic::new(&messages::STALE_OR_OF_OTHERS),
            Reason::Adjusted { clean } => {
                Diagnostic::new(&messages::STALE_ADJUSTED).quoting("clean", name(clean))
            }
            Reason::Edited { clean } => {
                Diagnostic::new(&messages::STALE_EDITED).quoting("clean", name(clean))
            }
            Reason::OtherValues { values } => {
                Diagnostic::new(&messages::STALE_VALUES).quoting("values", name(values))
            }
            Reason::OtherMoves { program } => {
                Diagnostic::new(&messages::STALE_OTHER_MOVES).quoting("program", name(program))
            }
            Reason::OtherHeights { program } => {
                Diagnostic::new(&messages::STALE_CONVERTED).quoting("program", name(program))
            }
            Reason::OtherJoined { paths } => {
                let own = OutputName::parse(self.path.file_name().unwrap_or_default());
                let join = own.map_or(self.path.file_stem().unwrap_or_default(), |name| name.stem);
                let command = format!("emit {} --join {join}", paths.join(" "));
                let problem = Diagnostic::new(&messages::STALE_JOINED).quoting("command", command);
                problem.with("paths", paths.iter().map(String::as_str).collect::<Value>())
            }
            Reason::Unwritten { path } => {
                Diagnostic::new(&messages::OLDER_OUTPUT).quoting("path", path.as_str())
            }
        };
        problem.quoting("name", name(&self.path)).in_file(&self.path)
    }
}
