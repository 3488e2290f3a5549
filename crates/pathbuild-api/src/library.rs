//! Implements the library, which answers requests in a thread of its own.

use std::path::Path as FilePath;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, bug, catch_bugs, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use pathbuild_workspace::check::{self, EarlierFiles};
use pathbuild_workspace::emit::{SceneReport, ShownText};
use pathbuild_workspace::list;
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::revision::RevisionFiles;
use pathbuild_workspace::session::{NamedPaths, NotOnePath, Session, several_paths_error};
use pathbuild_workspace::{Inputs, Workspace, verify, watch};

use crate::baseline::SettledFindings;
use crate::options::date;
use crate::watch::{ReportForwarder, with_absolute_paths};
use crate::{
    CheckOptions, CheckReport, EmitOptions, EmitReport, Error, Finding, GraphReport, LibraryOptions,
    ListOptions, Path, PathListing, PathSummary, ProgramText, VerifyOptions, VerifyReport, WatchEnd,
    WatchReport,
};

/// A directory of drawings, opened with the configuration that applies there.
///
/// It can be shared between threads. It answers one request after the other, each on all cores, and caches its results: after an edit, only results
/// that depend on the edited files are computed again. Report edits with [`changed`](Self::changed).
#[derive(Debug)]
pub struct Library {
    workspace: Arc<Workspace>,
    requests: Sender<Request>,
}

/// A request, which runs on the session in the library's thread and sends the answer itself.
type Request = Box<dyn FnOnce(&mut OpenSession<'_>) + Send>;

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
        self.check_with(inputs, &CheckOptions::new())
    }

    /// Like [`check`](Self::check), with options.
    ///
    /// # Errors
    /// If the baseline has errors or cannot be written, or if there is no revision to compare with.
    pub fn check_with(&self, inputs: &[&str], options: &CheckOptions) -> Result<CheckReport, Error> {
        let (inputs, options) = (to_inputs(inputs), options.clone());
        let baseline = options.baseline.clone().resolve(&self.workspace)?;
        let is_traced = self.workspace.caches_results() || options.changed_since.is_some();
        self.work(move |open| {
            let session = open.session(is_traced);
            let workspace = session.workspace();
            let inputs = if inputs.inputs.is_empty() { whole_library(workspace) } else { inputs };
            let file = baseline.file.as_deref();
            let revision = |name: &String| revision_files(workspace, &inputs, file, name);
            let revision = options.changed_since.as_ref().map(revision).transpose()?;
            let changed = revision.as_ref().map(|revision| revision as &dyn EarlierFiles);
            let request =
                check::Request { inputs: &inputs, with_all_values: options.has_all_values, changed };
            if options.has_timings {
                session.timings.switch_on();
            }
            let check::CheckOutcome { diagnostics, files, covered } =
                request.run(session).map_err(Error::from_failure)?;
            let coverage = || request.coverage(workspace, covered);
            let settled = SettledFindings::new(workspace, diagnostics, &baseline, coverage)?;
            let timings =
                if options.has_timings { session.timings.lines(workspace.lang()) } else { Vec::new() };
            Ok(CheckReport::new(settled, files, timings))
        })
    }

    /// Lists paths with their figures, as `pathbuild list` does. Inputs are drawings, directories, and patterns for names of paths; without any
    /// inputs, all paths of the library are listed.
    ///
    /// # Errors
    /// If a pattern is invalid, or if the configured post-processor does not exist or has errors.
    pub fn paths(&self, inputs: &[&str]) -> Result<PathListing, Error> {
        self.paths_with(inputs, &ListOptions::new())
    }

    /// Like [`paths`](Self::paths), with options.
    ///
    /// # Errors
    /// If a pattern is invalid, or if the post-processor does not exist or has errors.
    pub fn paths_with(&self, inputs: &[&str], options: &ListOptions) -> Result<PathListing, Error> {
        let (inputs, options) = (to_inputs(inputs), options.clone());
        self.work(move |open| {
            let session = open.session(false);
            let workspace = session.workspace();
            let listed = list::Request { inputs: &inputs, post: options.post.as_deref() }.run(session);
            let listed = listed.map_err(Error::from_failure)?;
            let paths = listed.paths.into_iter().map(|path| PathSummary::new(workspace, path));
            let (paths, drawings) = (paths.collect(), listed.drawings);
            let found = workspace.findings(listed.diagnostics);
            let (findings, accepted) = Finding::reported_and_accepted(found);
            Ok(PathListing { paths, drawings, findings, accepted })
        })
    }

    /// Returns a path with its elements, their parameters, and the moves of its program. The name is that of the path, or of a drawing with no other
    /// path. Variables have the first of their values, as in `pathbuild check`; a path that embeds this path may give them other values. The moves
    /// are those of the native program, whatever post-processor is configured.
    ///
    /// # Errors
    /// If there is no such path, or if the configured post-processor does not exist or has errors. Errors in the path are in
    /// [`Path::findings`]; a path with errors has no statistics.
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
    /// If the drawing has no such path, or if the configured post-processor does not exist or has errors.
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
        let EmitReport { files, findings, .. } = self.emit(&[path], &options.clone().print())?;
        match files.into_iter().find_map(|file| Some((file.file, file.text?))) {
            Some((file, text)) => Ok(ProgramText { file, text, findings }),
            None => Err(Error::Findings(findings)),
        }
    }

    /// Writes the programs of drawings, paths and directories as `pathbuild emit` does. Without inputs, writes those of the paths that the
    /// configuration names.
    ///
    /// # Errors
    /// If the request is invalid, for example because a needed setting is missing, or if the post-processor does not exist or has errors. Errors in
    /// the drawings are in the report.
    pub fn emit(&self, inputs: &[&str], options: &EmitOptions) -> Result<EmitReport, Error> {
        let (inputs, options) = (to_inputs(inputs), options.clone());
        if let Some(text) = &options.request.post_arguments.date {
            date(text, Some(self.workspace.lang()))?;
        }
        let is_traced = self.workspace.caches_results() && options.request.uses_cache();
        self.work(move |open| {
            let session = open.session(is_traced);
            let emission = options.request.run(session, &inputs).map_err(Error::from_failure)?;
            Ok(EmitReport::new(session.workspace(), emission))
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
            let inputs = if inputs.inputs.is_empty() { whole_library(session.workspace()) } else { inputs };
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
        let mut options = options.clone();
        let baseline = std::mem::take(&mut options.baseline).resolve(&self.workspace)?;
        let (name, text) = options.text.take().unzip();
        let options = options.resolve(&self.workspace)?;
        self.ask(move |session| {
            let request = verify::Request { places: &places, text: name.as_deref().zip(text), options };
            let verification = request.run(session).map_err(Error::from_failure)?;
            VerifyReport::new(session.workspace(), verification, &baseline)
        })
    }

    /// Reports that a file has changed, appeared or disappeared. Its name is relative to the library's directory, or absolute.
    ///
    /// # Errors
    /// If an internal error occurs.
    pub fn changed(&self, file: &str) -> Result<(), Error> {
        let file = file.to_owned();
        self.ask(move |session| {
            let file = session.normalize(Utf8Path::new(&file));
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
        self.work(|open| {
            open.session = None;
            Ok(())
        })
    }

    /// Checks the library and, after each change of a drawing, everything that depends on it, until `seen` returns false for a report. If the
    /// configuration names no library, the directory is checked. Other requests wait meanwhile. Only a library on disk can be watched.
    ///
    /// # Errors
    /// If the system cannot report changes, or if the baseline has errors.
    pub fn watch(&self, seen: impl FnMut(WatchReport) -> bool + Send + 'static) -> Result<WatchEnd, Error> {
        self.work(move |open| {
            let workspace = open.workspace;
            let inputs = whole_library(workspace);
            let request = watch::Request { inputs: &inputs, emits: false, lists: false, polls: false };
            let end = request.run(&with_absolute_paths(workspace), &ReportForwarder::new(workspace, seen));
            // The session's results may be out of date.
            open.session = None;
            match end {
                watch::WatchEnd::Over => Ok(WatchEnd::Stopped),
                watch::WatchEnd::ConfigurationChanged => Ok(WatchEnd::ConfigurationChanged),
                watch::WatchEnd::DirectoriesChanged => Ok(WatchEnd::DirectoriesChanged),
                watch::WatchEnd::BadPost(found) | watch::WatchEnd::BadBaseline(found) => {
                    Err(Error::from_findings(workspace, found))
                }
                watch::WatchEnd::CannotWatch(reason) => Err(Error::Refused(reason)),
                watch::WatchEnd::NothingNamed | watch::WatchEnd::NoTargets => {
                    let [en, de] = ["there is nothing to watch", "es gibt nichts zu überwachen"];
                    Err(Error::Refused(workspace.choose(en, de).to_owned()))
                }
            }
        })
    }

    /// Opens the library of a workspace, and starts its thread. The session must stay in one thread, because it borrows its workspace, and its
    /// database works for one thread at a time.
    ///
    /// # Errors
    /// If the system cannot start the thread.
    #[doc(hidden)]
    pub fn of_workspace(workspace: Arc<Workspace>) -> Result<Self, Error> {
        let (requests, waiting) = channel::<Request>();
        let shared = Arc::clone(&workspace);
        let serve = move || {
            let mut open = OpenSession { workspace: &shared, session: None };
            for request in waiting {
                request(&mut open);
            }
        };
        let thread = thread::Builder::new().name("pathbuild".to_owned()).stack_size(STACK).spawn(serve);
        thread.map_err(|error| Error::Refused(error.to_string()))?;
        Ok(Self { workspace, requests })
    }

    /// Runs a closure on the session in the library's thread, and waits for its result. The session traces inputs if results are cached.
    fn ask<R: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Session<'_>) -> Result<R, Error> + Send + 'static,
    ) -> Result<R, Error> {
        let is_traced = self.workspace.caches_results();
        self.work(move |open| work(open.session(is_traced)))
    }

    fn work<R: Send + 'static>(
        &self,
        work: impl FnOnce(&mut OpenSession<'_>) -> Result<R, Error> + Send + 'static,
    ) -> Result<R, Error> {
        let (answer, answered) = channel();
        let request = move |open: &mut OpenSession<'_>| {
            let result =
                catch_bugs(|| work(open)).unwrap_or_else(|problem| Err(Error::internal_error(*problem)));
            // The receiver exists, because the caller waits for the result.
            _ = answer.send(result);
        };
        self.requests.send(Box::new(request)).map_err(|_| thread_ended_error())?;
        answered.recv().unwrap_or_else(|_| Err(thread_ended_error()))
    }
}

/// The session of a library, which the first request opens.
struct OpenSession<'w> {
    workspace: &'w Workspace,
    session: Option<Session<'w>>,
}

impl<'w> OpenSession<'w> {
    /// Returns the session. If inputs are to be traced and the open session does not trace them, opens another one.
    fn session(&mut self, is_traced: bool) -> &mut Session<'w> {
        self.session.take_if(|session| is_traced && !session.is_traced());
        self.session.get_or_insert_with(|| Session::open(self.workspace, is_traced))
    }
}

/// Creates the error for a thread that has ended, which only an internal error can cause.
fn thread_ended_error() -> Error {
    Error::internal_error(bug("the library's thread has ended"))
}

fn to_inputs(inputs: &[&str]) -> Inputs {
    Inputs { inputs: inputs.iter().map(|input| (*input).to_owned()).collect() }
}

/// Returns the inputs that stand for the configured library, or for the directory if none is configured.
fn whole_library(workspace: &Workspace) -> Inputs {
    let directory = (!workspace.has_library()).then_some(&workspace.working_directory);
    Inputs::of_files(directory)
}

fn revision_files<'w>(
    workspace: &'w Workspace,
    inputs: &Inputs,
    baseline: Option<&Utf8Path>,
    revision: &str,
) -> Result<RevisionFiles<'w>, Error> {
    // Git would look for a repository in the working directory of the process.
    if workspace.working_directory.as_str().is_empty() {
        let [en, de] = [
            "the library has no directory on disk, so it has no revisions",
            "die Bibliothek hat kein Verzeichnis auf dem Datenträger und deshalb keine Revisionen",
        ];
        return Err(Error::Refused(workspace.choose(en, de).to_owned()));
    }
    RevisionFiles::new(workspace, inputs, baseline, revision).map_err(Error::Refused)
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
