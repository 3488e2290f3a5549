//! Implements the library, which answers requests in a thread of its own.

use std::path::Path as FilePath;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, bug, catch_bugs, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use pathbuild_workspace::check;
use pathbuild_workspace::emit::{self, SceneReport, ShownText, State, Task};
use pathbuild_workspace::list;
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::session::{NamedPaths, NotOnePath, Session, several_paths_error};
use pathbuild_workspace::{Inputs, Workspace, verify, watch};

use crate::options::Source;
use crate::watch::{ReportForwarder, with_absolute_paths};
use crate::{
    CheckReport, EmitOptions, EmitReport, Error, Finding, GraphReport, LibraryOptions, OutputFile, Path,
    PathListing, PathSummary, ProgramText, VerifyOptions, VerifyReport, WatchEnd, WatchReport,
};

/// A directory of drawings, opened with the configuration that applies there.
///
/// It can be shared between threads. It answers one request after the other, each on all cores, and caches its results: after an edit, only results
/// that depend on the edited files are computed again. Report edits with [`changed`](Self::changed).
#[derive(Debug)]
pub struct Library {
    requests: Sender<Request>,
}

/// A request, which runs on the session in the library's thread and sends the answer itself.
type Request = Box<dyn FnOnce(&mut Session<'_>) + Send>;

/// Stack size of the library's thread in bytes, as large as that of a program's main thread.
const STACK: usize = 8 << 20;

impl Library {
    /// Opens the library of a directory, without options: see [`LibraryOptions`]. The configuration is the `pathbuild.toml` in the directory
    /// or in the nearest one above it; the library that it names may be larger than the directory.
    ///
    /// # Errors
    /// If there is no such directory, or if the configuration has errors.
    pub fn open(directory: impl AsRef<FilePath>) -> Result<Self, Error> {
        LibraryOptions::new().open(directory)
    }

    /// Checks drawings, paths and directories as `pathbuild check` does. Without inputs, checks the whole library, or the directory if the
    /// configuration names no library.
    ///
    /// # Errors
    /// If the baseline has errors. Errors in the drawings are in the report.
    pub fn check(&self, inputs: &[&str]) -> Result<CheckReport, Error> {
        let inputs = to_inputs(inputs);
        self.ask(move |session| {
            let inputs = if inputs.inputs.is_empty() { whole_library(session) } else { inputs };
            let request = check::Request { inputs: &inputs, with_all_values: false, changed: None };
            let workspace = session.workspace();
            let outcome = request.run(session).map_err(|failure| Error::from_failure(workspace, failure))?;
            let coverage = request.coverage(workspace, &outcome.files);
            let (findings, accepted) = Finding::from_settled(workspace, outcome.diagnostics, coverage)?;
            Ok(CheckReport {
                findings,
                accepted,
                paths: outcome.files.iter().map(|file| file.paths.len()).sum(),
                drawings: outcome.files.len(),
            })
        })
    }

    /// Lists paths with their figures, as `pathbuild list` does. Inputs are drawings, directories, and patterns for names of paths; without any
    /// inputs, all paths of the library are listed.
    ///
    /// # Errors
    /// If a pattern is invalid.
    pub fn paths(&self, inputs: &[&str]) -> Result<PathListing, Error> {
        let inputs = to_inputs(inputs);
        self.ask(move |session| {
            let workspace = session.workspace();
            let listed = list::Request { inputs: &inputs, post: None }.run(session);
            let listed = listed.map_err(|failure| Error::from_failure(workspace, failure))?;
            let paths = listed.paths.into_iter().map(|path| PathSummary::new(workspace, path));
            Ok(PathListing {
                paths: paths.collect(),
                drawings: listed.drawings,
                findings: Finding::from_diagnostics(workspace, listed.diagnostics),
            })
        })
    }

    /// Returns a path with its elements, their parameters, and the moves of its program. The name is that of the path, or of a drawing with no other
    /// path. Variables have the first of their values, as in `pathbuild check`; a path that embeds this path may give them other values. The moves
    /// are those of the native program, whatever post-processor is configured.
    ///
    /// # Errors
    /// If there is no such path. Errors in the path are in [`Path::findings`]; a path with errors has no statistics.
    pub fn path(&self, name: &str) -> Result<Path, Error> {
        let name = name.to_owned();
        self.ask(move |session| {
            session.with_stable_files(|session| {
                let (file, name) = named_path(session, &name)?;
                path(session, file, name)
            })
        })
    }

    /// Like [`path`](Self::path), for the path of this name in a drawing. The name is written as in [`PathSummary::name`]; other drawings may have a
    /// path of that name.
    ///
    /// # Errors
    /// If the drawing has no such path.
    pub fn path_in(&self, drawing: &str, name: &str) -> Result<Path, Error> {
        let (drawing, name) = (drawing.to_owned(), name.to_owned());
        self.ask(move |session| {
            session.with_stable_files(|session| {
                let (file, name) = path_in(session, &drawing, &name)?;
                path(session, file, name)
            })
        })
    }

    /// Returns the scene of a path as JSON, as `pathbuild view -o FILE.json` writes it. (book: program/pictures)
    ///
    /// # Errors
    /// As [`path`](Self::path).
    pub fn scene(&self, name: &str) -> Result<String, Error> {
        let name = name.to_owned();
        self.ask(move |session| {
            session.with_stable_files(|session| {
                let (file, name) = named_path(session, &name)?;
                let drawing = file.path(session.db()).as_str();
                Ok(scene(session, file, name)?.with_findings(session.workspace(), drawing).0.to_json())
            })
        })
    }

    /// Returns the program of a path, as `pathbuild emit -o -` prints it.
    ///
    /// # Errors
    /// If there is no such path, if it has errors, or if its program consists of several files because it has Z-probes.
    pub fn program(&self, path: &str, options: &EmitOptions) -> Result<ProgramText, Error> {
        let (inputs, options) = (to_inputs(&[path]), options.clone());
        self.ask(move |session| {
            let emission = run_emit(session, &inputs, &options, Task::Print)?;
            let mut files = emission.delivered.into_iter().flat_map(|outcome| outcome.files);
            let found = emission.diagnostics;
            match files.next() {
                Some((file, State::Printed(text))) => Ok(ProgramText {
                    file: file.into_string(),
                    text,
                    findings: Finding::from_diagnostics(session.workspace(), found),
                }),
                _ => Err(Error::from_findings(session.workspace(), found)),
            }
        })
    }

    /// Writes the programs of drawings, paths and directories as `pathbuild emit` does. Without inputs, writes those of the paths that the
    /// configuration names.
    ///
    /// # Errors
    /// If the request is invalid, for example because a needed setting is missing. Errors in the drawings are in the report.
    pub fn emit(&self, inputs: &[&str], options: &EmitOptions) -> Result<EmitReport, Error> {
        let (inputs, options) = (to_inputs(inputs), options.clone());
        let task = if options.compare {
            Task::Compare { moves_only: false }
        } else {
            Task::Write { force: options.force }
        };
        self.ask(move |session| {
            let emission = run_emit(session, &inputs, &options, task)?;
            Ok(EmitReport {
                files: emission.delivered.into_iter().flat_map(OutputFile::from_outcome).collect(),
                findings: Finding::from_diagnostics(session.workspace(), emission.diagnostics),
            })
        })
    }

    /// Finds all paths that drawings and paths embed, directly or through others, as `pathbuild deps` does. Without inputs, searches the whole
    /// library, or the directory if the configuration names no library.
    ///
    /// # Errors
    /// If an internal error occurs. Errors in the inputs are in the report.
    pub fn embedded(&self, inputs: &[&str]) -> Result<GraphReport, Error> {
        let inputs = to_inputs(inputs);
        self.ask(move |session| {
            let inputs = if inputs.inputs.is_empty() { whole_library(session) } else { inputs };
            Ok(GraphReport::new(session.workspace(), session.embedded_paths(&inputs)))
        })
    }

    /// Finds all paths of the library that embed given drawings and paths, directly or through others, as `pathbuild rdeps` does.
    ///
    /// # Errors
    /// If an internal error occurs. Errors in the inputs are in the report.
    pub fn embedders(&self, inputs: &[&str]) -> Result<GraphReport, Error> {
        let inputs = to_inputs(inputs);
        self.ask(move |session| Ok(GraphReport::new(session.workspace(), session.embedding_paths(&inputs))))
    }

    /// Verifies G-code programs of any origin as `pathbuild verify` does. Inputs are files, patterns of files, and directories, which stand for the
    /// programs in and below them (.nc, .ngc, .gcode, .tap, .cnc, .din).
    ///
    /// # Errors
    /// If the post-processor, the path to compare with or the baseline does not exist, or has errors. Problems in the programs are in the report.
    pub fn verify(&self, programs: &[&str], options: &VerifyOptions) -> Result<VerifyReport, Error> {
        let places: Vec<Utf8PathBuf> = programs.iter().map(Utf8PathBuf::from).collect();
        let options = options.clone();
        self.ask(move |session| {
            let workspace = session.workspace();
            let request =
                verify::Request { places: &places, text: None, options: options.resolve(workspace)? };
            let verification =
                request.run(session).map_err(|failure| Error::from_failure(workspace, failure))?;
            VerifyReport::new(workspace, verification)
        })
    }

    /// Reports that a file has changed, appeared or disappeared. Its name is relative to the library's directory, or absolute.
    ///
    /// # Errors
    /// If an internal error occurs.
    pub fn changed(&self, file: &str) -> Result<(), Error> {
        let file = file.to_owned();
        self.ask(move |session| {
            let file = session.normal(Utf8Path::new(&file));
            session.touch_file(&file);
            session.touch_directory(file.parent().unwrap_or(Utf8Path::new("")));
            Ok(())
        })
    }

    /// Drops all results, because any file may have changed.
    ///
    /// # Errors
    /// If an internal error occurs.
    pub fn refresh(&self) -> Result<(), Error> {
        self.ask(|session| {
            *session = new_session(session.workspace());
            Ok(())
        })
    }

    /// Checks the library and, after each change of a drawing, everything that depends on it, until `seen` returns false. If the configuration names
    /// no library, the directory is checked. Other requests wait meanwhile. Only a library on disk can be watched.
    ///
    /// # Errors
    /// If the system cannot report changes.
    pub fn watch(&self, seen: impl FnMut(WatchReport) -> bool + Send + 'static) -> Result<WatchEnd, Error> {
        self.ask(move |session| {
            let workspace = session.workspace();
            let inputs = whole_library(session);
            let request = watch::Request { inputs: &inputs, emits: false, lists: false, polls: false };
            let end = request.run(&with_absolute_paths(workspace), &ReportForwarder::new(workspace, seen));
            // The session's results may be out of date.
            *session = new_session(workspace);
            match end {
                watch::WatchEnd::Over => Ok(WatchEnd::Stopped),
                watch::WatchEnd::ConfigurationChanged => Ok(WatchEnd::ConfigurationChanged),
                watch::WatchEnd::DirectoriesChanged => Ok(WatchEnd::DirectoriesChanged),
                watch::WatchEnd::BadPost(found) => Err(Error::from_findings(workspace, found)),
                watch::WatchEnd::CannotWatch(reason) => Err(Error::Refused(reason)),
                watch::WatchEnd::NothingNamed | watch::WatchEnd::NoTargets => {
                    let [en, de] = ["there is nothing to watch", "es gibt nichts zu überwachen"];
                    Err(Error::Refused(workspace.choose(en, de).to_owned()))
                }
            }
        })
    }

    /// Starts the library's thread. The session must stay in one thread, because it borrows its workspace, and its database works for one thread at a
    /// time.
    pub(crate) fn start(source: Source, options: LibraryOptions) -> Result<Self, Error> {
        let (requests, waiting) = channel();
        let (opened, answer) = channel();
        let serve = move || serve(source, options, &opened, waiting);
        let thread = thread::Builder::new().name("pathbuild".to_owned()).stack_size(STACK).spawn(serve);
        thread.map_err(|error| Error::Refused(error.to_string()))?;
        answer.recv().unwrap_or_else(|_| Err(thread_ended_error()))?;
        Ok(Self { requests })
    }

    /// Runs a closure on the session in the library's thread, and waits for its result.
    fn ask<R: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Session<'_>) -> Result<R, Error> + Send + 'static,
    ) -> Result<R, Error> {
        let (answer, answered) = channel();
        let request = move |session: &mut Session<'_>| {
            let result =
                catch_bugs(|| work(session)).unwrap_or_else(|problem| Err(Error::internal_error(*problem)));
            // The receiver exists, because the caller waits for the result.
            _ = answer.send(result);
        };
        self.requests.send(Box::new(request)).map_err(|_| thread_ended_error())?;
        answered.recv().unwrap_or_else(|_| Err(thread_ended_error()))
    }
}

/// Opens the session and answers requests until the library is dropped.
fn serve(
    source: Source,
    options: LibraryOptions,
    opened: &Sender<Result<(), Error>>,
    requests: Receiver<Request>,
) {
    let workspace = match options.workspace(source) {
        Ok(workspace) => workspace,
        Err(error) => {
            _ = opened.send(Err(error));
            return;
        }
    };
    let mut session = new_session(&workspace);
    _ = opened.send(Ok(()));
    for request in requests {
        request(&mut session);
    }
}

/// Opens a session that caches results if the workspace does.
fn new_session(workspace: &Workspace) -> Session<'_> {
    if workspace.keeps_results() { Session::with_tracing(workspace) } else { Session::new(workspace) }
}

/// Creates the error for a thread that has ended, which only an internal error can cause.
fn thread_ended_error() -> Error {
    Error::internal_error(bug("the library's thread has ended"))
}

fn to_inputs(inputs: &[&str]) -> Inputs {
    Inputs { inputs: inputs.iter().map(|input| (*input).to_owned()).collect() }
}

/// Returns the inputs that stand for the configured library, or for the directory if none is configured.
fn whole_library(session: &Session<'_>) -> Inputs {
    let directory = (!session.has_library()).then_some(&session.workspace().working_directory);
    Inputs::places(directory)
}

/// Finds a path by its name, or by the name of a drawing with no other path.
fn named_path(session: &Session<'_>, argument: &str) -> Result<(SourceFile, PathName), Error> {
    let (workspace, db) = (session.workspace(), session.db());
    match session.one_path(argument, Role::Checked) {
        Ok(target) => Ok((target.file(db), PathName::new(target.name(db)))),
        Err(NotOnePath::Wrong(found)) => Err(Error::from_findings(workspace, found)),
        Err(NotOnePath::Several(NamedPaths { file, names })) => {
            Err(Error::from_findings(workspace, vec![several_paths_error(file.path(db), &names)]))
        }
        Err(NotOnePath::Directory) => {
            let [en, de] = ["`{}` is a directory, not a path", "`{}` ist ein Verzeichnis, kein Pfad"];
            Err(Error::Refused(workspace.phrase(en, de, argument)))
        }
    }
}

fn path_in(session: &Session<'_>, drawing: &str, name: &str) -> Result<(SourceFile, PathName), Error> {
    let file = session.file(Utf8Path::new(drawing));
    if let Some(name) = path_names(session.db(), file).iter().find(|known| known.as_str() == name) {
        return Ok((file, name.clone()));
    }
    let problems = check_file(session.db(), file);
    if problems.iter().any(Diagnostic::is_error) {
        return Err(Error::from_findings(session.workspace(), problems.to_vec()));
    }
    let [en, de] = ["{} has no path of this name", "{} hat keinen Pfad dieses Namens"];
    Err(Error::Refused(format!("{name}: {}", session.workspace().phrase(en, de, drawing))))
}

fn path(session: &Session<'_>, file: SourceFile, name: PathName) -> Result<Path, Error> {
    let report = scene(session, file, name)?;
    let findings = Finding::from_diagnostics(session.workspace(), report.diagnostics);
    match report.scene.paths.into_iter().next() {
        Some(scene) => Ok(Path::new(scene, findings)),
        None => Err(Error::Findings(findings)),
    }
}

fn scene(session: &Session<'_>, file: SourceFile, name: PathName) -> Result<SceneReport, Error> {
    let workspace = session.workspace();
    let post_processor = PostProcessor::for_run(workspace, None, PostArguments::default())
        .map_err(|found| Error::from_findings(workspace, found))?;
    let report = session.scene(file, &[name], ShownText::Emitted(post_processor.as_ref()));
    Ok(SceneReport { diagnostics: session.with_hints(report.diagnostics), ..report })
}

fn run_emit(
    session: &mut Session<'_>,
    inputs: &Inputs,
    options: &EmitOptions,
    task: Task,
) -> Result<emit::Emission, Error> {
    let request = emit::Request {
        inputs,
        task,
        post: options.post.as_deref(),
        post_arguments: PostArguments::default(),
        join: None,
        deps: None,
        removes_stale: false,
    };
    request.run(session).map_err(|failure| Error::from_failure(session.workspace(), failure))
}
