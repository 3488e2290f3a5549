//! A session on the opened files, queried path by path.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, Listing, MemorySystem, ReadError, Stamp, WriteOutcome, clean};
use pathbuild_db::{
    Db as _, Role, SourceFile, System, Target, bug, check_file, file_index, path_names, time_limit_error,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use pathbuild_post::BUILT_IN;
use pathbuild_view::{Scene, VisibleParts};
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::emit::{SceneReport, ShownText, TargetPatterns, WrittenPrograms};
use pathbuild_workspace::list::{self, ListedPath, Row, Stats, drawing_json, path_json, stats_json};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::program_view::DroppedProgram;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::{Inputs, SilentReporter, Workspace};
use serde_json::{Value, json};

use crate::message::{AbortReason, AbortedItem, Answer, Options, Place, Question};

/// The files opened with one configuration.
#[derive(Debug)]
pub(crate) struct OpenedFiles {
    files: Arc<Files>,
    session: Session<'static>,
    post_processor: Option<PostProcessor>,
    lost: BTreeMap<Place, Diagnostic>,
    rows: BTreeMap<Place, Row>,
}

impl OpenedFiles {
    /// Opens the files. Returns the opened files, or `None` if the configuration or its post is invalid, and the JSON answer, which contains the
    /// problems.
    pub(crate) fn new(files: &Arc<Files>, options: Options, lost: Vec<AbortedItem>) -> (Option<Self>, Value) {
        let system: Arc<dyn System> = Arc::<Files>::clone(files);
        let Options { feed, sweep_height, rapid, probe_feed, post, lang } = options;
        let texts =
            [("feed", feed), ("sweep-height", sweep_height), ("rapid", rapid), ("probe-feed", probe_feed)];
        let settings = texts.into_iter().filter_map(|(name, text)| Some((name, vec![text?]))).collect();
        let given = Overrides { settings, ..Overrides::default() };
        let (settings, faults) = config::load(&system, &given, &Inputs::default(), Utf8Path::new(""));
        let workspace = Workspace {
            settings,
            system,
            own_lang: Some(lang),
            system_lang: None,
            working_directory: Utf8PathBuf::new(),
            // WebAssembly has a single thread.
            jobs: Some(1),
            cache: None,
            reporter: Arc::new(SilentReporter),
            is_date_decisive: Arc::default(),
        };
        // Leak the workspace, because it lives as long as the instance: to open other files, the page starts a new instance.
        let workspace: &'static Workspace = Box::leak(Box::new(workspace));
        let posts = BUILT_IN.iter().map(|post| json!({ "name": post.name, "for": post.description }));
        let posts: Value = posts.collect();
        let problems = |found: Vec<Diagnostic>| {
            json!(pathbuild_view::findings(&workspace.findings(found).diagnostics, ""))
        };
        let halted = |found| json!({ "halted": "", "problems": problems(found), "drawings": [], "posts": posts, "seconds": 0 });
        if !faults.is_empty() {
            return (None, halted(faults));
        }
        let post_processor =
            match PostProcessor::for_run(workspace, post.as_deref(), PostArguments::default()) {
                Ok(post_processor) => post_processor,
                Err(faults) => return (None, halted(faults)),
            };
        let session = Session::new(workspace);
        let (sources, found) = session.all_drawings();
        let drawings: Vec<String> = sources.iter().map(|file| file.path(session.db()).to_string()).collect();
        let limit = workspace.settings.limits.seconds_per_path.value;
        let answer = json!({
            "halted": null,
            "problems": problems(found),
            "drawings": drawings,
            "posts": posts,
            "seconds": limit.as_secs_f64(),
        });
        let problem = |why| match why {
            AbortReason::Time => time_limit_error(limit),
            AbortReason::Bug { reason } => bug(&reason),
        };
        let lost = lost.into_iter().map(|AbortedItem { place, why }| (place, problem(why))).collect();
        (
            Some(Self { files: Arc::clone(files), session, post_processor, lost, rows: BTreeMap::new() }),
            answer,
        )
    }

    fn reply(&mut self, question: Question, bytes: &[u8]) -> Answer {
        match question {
            Question::Index { file } => json!({ "rows": self.index(&file) }).into(),
            Question::Check(place) => json!({ "row": self.check(place) }).into(),
            Question::Statistics => json!({ "statistics": self.statistics() }).into(),
            Question::Scene(place) => {
                let bytes = self.scene(&place).map(|scene| scene.to_json().into_bytes());
                scene_answer(bytes)
            }
            Question::Picture(place) => {
                let lang = self.session.workspace().lang();
                let svg =
                    self.scene(&place).map(|scene| pathbuild_view::svg(&scene, VisibleParts::all(lang)));
                scene_answer(svg.map(String::into_bytes))
            }
            Question::Emit { places } => self.emit(&places),
            Question::Program { name, assumptions } => {
                let program = DroppedProgram { name, text: bytes.to_vec(), assumptions };
                scene_answer(Some(program.scene(&mut self.session).into_bytes()))
            }
            Question::Put { .. } | Question::Open { .. } => Answer::default(),
        }
    }

    fn file(&self, file: &str) -> SourceFile {
        self.session.db().file(&clean(Utf8Path::new(file)))
    }

    /// Finds a path by its name; `None` if the drawing has no such path, or the path was lost.
    fn path(&self, place: &Place) -> Option<(SourceFile, PathName)> {
        if self.lost.contains_key(place) {
            return None;
        }
        let (file, wanted) = (self.file(&place.file), place.path.as_deref()?);
        let name = path_names(self.session.db(), file).iter().find(|name| name.as_str() == wanted)?;
        Some((file, name.clone()))
    }

    /// Returns the rows of a drawing, without the states of its paths.
    fn index(&self, file: &str) -> Vec<Value> {
        let whole = Place { file: file.to_owned(), path: None };
        if let Some(problem) = self.lost.get(&whole) {
            return self.drawing_row(vec![problem.clone()]).into_iter().collect();
        }
        let (db, file) = (self.session.db(), self.file(file));
        let whole = self.drawing_row(check_file(db, file).to_vec());
        let mut targets = TargetPatterns::new(&self.session.workspace().settings);
        let rows = path_names(db, file).iter().map(
            |name| json!({ "path": name.as_str(), "emitted": self.is_emitted(&mut targets, file, name) }),
        );
        whole.into_iter().chain(rows).collect()
    }

    /// Returns the row of a drawing whose own diagnostics include errors; `None` if they do not.
    fn drawing_row(&self, found: Vec<Diagnostic>) -> Option<Value> {
        drawing_json(&self.session.workspace().findings(found))
    }

    /// Whether "write all" includes a path: either the configuration lists it, or the configuration lists none and the path needs no values for
    /// variables.
    fn is_emitted(&self, targets: &mut TargetPatterns<'_>, file: SourceFile, name: &PathName) -> bool {
        if !self.session.workspace().settings.emit.targets.value.is_empty() {
            return targets.matches(name.as_str());
        }
        let index = file_index(self.session.db(), file).path(name);
        index.is_some_and(|path| path.header.definitions.is_empty())
    }

    /// Checks a path and returns its row with its state.
    fn check(&mut self, place: Place) -> Option<Value> {
        let path = if let Some(problem) = self.lost.get(&place) {
            let name = PathName::new(place.path.as_deref()?);
            ListedPath::unknown(name, self.session.normalize(Utf8Path::new(&place.file)), problem.clone())
        } else {
            let (file, name) = self.path(&place)?;
            list::of_path(&mut self.session, file, &name, self.post_processor.as_ref()).pop()?
        };
        let row = Row::new(self.session.workspace(), path);
        let json = path_json(&place.file, &row);
        self.rows.insert(place, row);
        Some(json)
    }

    fn statistics(&self) -> Value {
        let drawings = self.session.all_drawings().0.len();
        stats_json(&Stats::of(self.rows.values(), drawings))
    }

    /// Returns the scene of a path or drawing; `None` if it does not exist.
    fn scene(&mut self, place: &Place) -> Option<Scene> {
        let workspace = self.session.workspace();
        if let Some(problem) = self.lost.get(place) {
            let scene = Scene::new(place.path.as_deref().unwrap_or(&place.file));
            let problem = problem.clone().in_file(Utf8Path::new(&place.file));
            return Some(
                SceneReport { scene, diagnostics: vec![problem], refusals: Vec::new() }
                    .with_findings(workspace, &place.file)
                    .0,
            );
        }
        let (file, names) = if place.path.is_some() {
            let (file, name) = self.path(place)?;
            (file, vec![name])
        } else {
            let file = self.file(&place.file);
            (file, path_names(self.session.db(), file).to_vec())
        };
        let text = ShownText::Emitted(self.post_processor.as_ref());
        let seen = self.session.with_stable_files(|session| session.scene(file, &names, text));
        Some(seen.with_findings(workspace, &place.file).0)
    }

    /// Writes the programs of paths and returns them as files, with the problems of the paths.
    fn emit(&mut self, places: &[Place]) -> Answer {
        let workspace = self.session.workspace();
        let found: Vec<(SourceFile, PathName)> = places.iter().filter_map(|place| self.path(place)).collect();
        let target = |(file, name): &(SourceFile, PathName)| {
            self.session.db().target(*file, name.as_str(), Role::Emitted)
        };
        let targets: Vec<Target> = found.iter().map(target).collect();
        let post_processor = self.post_processor.as_ref();
        let drawings: Vec<SourceFile> = found.iter().map(|(file, _)| *file).collect();
        let mut programs = WrittenPrograms::default();
        let outcomes = match programs.write(&mut self.session, post_processor, &drawings, &targets) {
            (Ok(outcomes), _) => outcomes,
            (Err(refusal), _) => {
                return json!({ "refused": refusal, "problems": [], "files": [] }).into();
            }
        };
        let (mut files, mut bytes) = (Vec::new(), Vec::new());
        for delivered in &outcomes {
            for (path, _) in delivered.files.iter().filter(|(path, _)| delivered.has_written(path)) {
                let text = self.files.take(path);
                files.push(json!({ "name": path.as_str(), "size": text.len() }));
                bytes.extend(text);
            }
        }
        // Writing reports no errors in drawings, so they are added here.
        let checked = self.session.check(&targets).into_iter().flat_map(|checked| checked.diagnostics);
        let clashes = programs.leave_out_clashes(&self.session);
        let problems = checked.chain(programs.problems(&self.session)).chain(clashes);
        let found = workspace.findings(problems.collect());
        let problems = pathbuild_view::findings(&found.diagnostics, "");
        Answer { head: json!({ "refused": null, "problems": problems, "files": files }), bytes }
    }
}

fn scene_answer(bytes: Option<Vec<u8>>) -> Answer {
    match bytes {
        Some(bytes) => Answer { head: json!({ "seen": true }), bytes },
        None => json!({ "seen": false }).into(),
    }
}

/// The compiler for a page: it answers the page's messages.
#[derive(Debug, Default)]
pub struct Compiler {
    files: Arc<Files>,
    opened: Option<OpenedFiles>,
}

impl Compiler {
    /// Answers a message: a line of JSON ([`Question`]) followed by bytes. The reply to a malformed message is `{ wrong }`.
    pub fn answer(&mut self, message: &[u8]) -> Vec<u8> {
        let end = message.iter().position(|byte| *byte == b'\n').unwrap_or(message.len());
        let (line, bytes) = (&message[..end], message.get(end + 1..).unwrap_or_default());
        let answer = match serde_json::from_slice(line) {
            Ok(question) => self.reply(question, bytes),
            Err(error) => Answer::from(json!({ "wrong": error.to_string() })),
        };
        answer.message()
    }

    fn reply(&mut self, question: Question, bytes: &[u8]) -> Answer {
        let question = match question {
            Question::Put { file } => {
                self.files.put(clean(&Utf8PathBuf::from(file)), bytes);
                return Answer::default();
            }
            Question::Open { options, lost } => {
                let (opened, answer) = OpenedFiles::new(&self.files, options, lost);
                self.opened = opened;
                return answer.into();
            }
            question => question,
        };
        match &mut self.opened {
            Some(opened) => opened.reply(question, bytes),
            None => json!({ "wrong": "nothing is open" }).into(),
        }
    }
}

/// The files of a page: those that it added, and those that were written but not yet handed over. The added files are never modified, so that the
/// state of a program reflects the visitor's disk.
#[derive(Debug)]
pub(crate) struct Files {
    given: MemorySystem,
    written: MemorySystem,
}

impl Default for Files {
    fn default() -> Self {
        Self { given: MemorySystem::without_clock(), written: MemorySystem::without_clock() }
    }
}

impl Files {
    fn put(&self, path: Utf8PathBuf, bytes: &[u8]) {
        self.given.put(path, bytes);
    }

    /// Returns the bytes of a file that was written or added, and forgets a written one.
    pub(crate) fn take(&self, path: &Utf8Path) -> Vec<u8> {
        let bytes = self.read(path, u64::MAX).unwrap_or_default();
        _ = self.written.remove(path);
        bytes
    }

    fn layer_of(&self, path: &Utf8Path) -> &MemorySystem {
        if self.written.kind(path) == FileKind::File { &self.written } else { &self.given }
    }
}

impl System for Files {
    fn read_into(&self, path: &Utf8Path, limit: u64, room: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.layer_of(path).read_into(path, limit, room)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.given.list(directory)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.layer_of(path).kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        path.to_owned()
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, pathbuild_diagnostic::Value> {
        if self.read(path, u64::MAX).is_ok_and(|present| present == bytes) {
            return Ok(WriteOutcome::Unchanged);
        }
        self.written.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), pathbuild_diagnostic::Value> {
        self.written.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        None
    }
}
