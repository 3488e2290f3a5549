//! Updates the page from the watching thread.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use camino::Utf8PathBuf;
use pathbuild_db::{SourceFile, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use pathbuild_view::VisibleParts;
use pathbuild_workspace::emit::ShownText;
use pathbuild_workspace::list::{self, Row, Stats, drawing_json, path_json, stats_json};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::session::Session;
use pathbuild_workspace::watch::{FirstCheck, Listener, Update, WakeHandle};
use serde_json::{Value, json};

use super::hub::{AnswerForm, Hub, Question, Subject};
use crate::context::Context;

/// Listener of the watching thread that updates the page of a library.
pub(super) struct Page<'a> {
    context: &'a Context,
    hub: Arc<Hub>,
    library: RefCell<Library>,
}

/// The rows that have been published.
#[derive(Default)]
struct Library {
    rows: BTreeMap<Utf8PathBuf, Vec<Row>>,
    /// Drawings by their names in the list.
    by_file: HashMap<String, Utf8PathBuf>,
}

impl<'a> Page<'a> {
    pub(super) fn new(context: &'a Context, hub: Arc<Hub>) -> Self {
        Self { context, hub, library: RefCell::default() }
    }

    /// Returns the scene or picture of a drawing or path in the list. Other drawings are not accessible.
    fn drawing_answer(
        &self,
        session: &mut Session<'_>,
        file: &str,
        path: Option<&str>,
        form: AnswerForm,
    ) -> Option<String> {
        let drawing = self.library.borrow().by_file.get(file)?.clone();
        let scene = session.with_stable_files(|session| {
            let file = session.file(&drawing);
            let all = path_names(session.db(), file);
            let names: Vec<PathName> = match path {
                None => all.to_vec(),
                Some(path) => vec![all.iter().find(|name| name.as_str() == path)?.clone()],
            };
            let file_name = file.path(session.db()).as_str();
            let post_processor = PostProcessor::for_run(self.context, None, PostArguments::default());
            // If the post is invalid, show the native text: the error is already reported for the whole library.
            let text = post_processor
                .as_ref()
                .map_or(ShownText::Native, |post_processor| ShownText::Emitted(post_processor.as_ref()));
            Some(session.scene(file, &names, text).with_findings(self.context, file_name).0)
        })?;
        Some(match form {
            AnswerForm::Scene => scene.to_json(),
            AnswerForm::Picture => pathbuild_view::svg(&scene, VisibleParts::all(self.context.lang())),
        })
    }
}

impl Listener for Page<'_> {
    fn set_wake_handle(&self, bell: WakeHandle) {
        self.hub.begin(&bell);
    }

    fn drawings_found(&self, session: &mut Session<'_>, drawings: &[SourceFile], problems: &[Diagnostic]) {
        let db = session.db();
        let problems = self.context.findings(problems.to_vec());
        self.hub.publish(|state, revision| {
            state.set_problems(&problems.diagnostics);
            for file in drawings {
                let drawing = file.path(db);
                let name = self.context.file(drawing);
                let rows = path_names(db, *file).iter().map(|path| json!({ "path": path.as_str() }));
                state.publish_drawing(drawing, &name, Some(&rows.collect::<Value>().to_string()), revision);
                self.library.borrow_mut().by_file.insert(name, drawing.clone());
            }
        });
    }

    fn drawings_checked(
        &self,
        session: &mut Session<'_>,
        drawings: &[SourceFile],
        post_processor: Option<&PostProcessor>,
    ) {
        let mut listed = BTreeMap::<Utf8PathBuf, Vec<Row>>::new();
        for path in list::of_drawings(session, drawings, post_processor) {
            listed.entry(path.drawing.clone()).or_default().push(Row::new(self.context, path));
        }
        let mut library = self.library.borrow_mut();
        self.hub.publish(|state, revision| {
            for file in drawings {
                let drawing = file.path(session.db());
                let rows = listed.remove(drawing).unwrap_or_default();
                let name = self.context.file(drawing);
                let whole = drawing_json(&self.context.findings(check_file(session.db(), *file).to_vec()));
                let texts = whole.into_iter().chain(rows.iter().map(|row| path_json(&name, row)));
                let text = texts.collect::<Value>().to_string();
                state.publish_drawing(drawing, &name, Some(&text), revision);
                library.by_file.insert(name, drawing.clone());
                library.rows.insert(drawing.clone(), rows);
            }
            state.statistics = library.statistics();
        });
    }

    fn first_check_done(&self, check: &FirstCheck) {
        let problems = self.context.findings(check.problems.clone());
        self.hub.publish(|state, _| {
            state.set_problems(&problems.diagnostics);
            state.is_complete = true;
        });
    }

    fn batch_done(&self, Update { removed, has_other_problems, problems, .. }: &Update) {
        if removed.is_empty() && !has_other_problems {
            return;
        }
        let problems = has_other_problems.then(|| self.context.findings(problems.clone()));
        let mut library = self.library.borrow_mut();
        self.hub.publish(|state, revision| {
            if let Some(problems) = &problems {
                state.set_problems(&problems.diagnostics);
            }
            for drawing in removed {
                let name = self.context.file(drawing);
                state.publish_drawing(drawing, &name, None, revision);
                library.by_file.remove(&name);
                library.rows.remove(drawing);
            }
            state.statistics = library.statistics();
        });
    }

    fn woken(&self, session: &mut Session<'_>) {
        for Question { subject, answer } in self.hub.questions() {
            // Skip questions of clients that have disconnected.
            if answer.is_closed() {
                continue;
            }
            _ = answer.send(match subject {
                Subject::Drawing { file, path, form } => {
                    self.drawing_answer(session, &file, path.as_deref(), form)
                }
                Subject::Program(program) => Some(program.scene(session)),
            });
        }
    }
}

impl Library {
    fn statistics(&self) -> String {
        let rows = self.rows.values().flatten();
        stats_json(&Stats::of(rows, self.rows.len())).to_string()
    }
}

impl Drop for Page<'_> {
    fn drop(&mut self) {
        self.hub.drop_questions();
    }
}
