//! State shared by the watching thread and the server.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::{Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::program_view::DroppedProgram;
use pathbuild_workspace::watch::WakeHandle;
use tokio::sync::{oneshot, watch};

/// The published state, and the pending questions of pages.
#[derive(Default)]
pub(super) struct Hub {
    state: Mutex<State>,
    revisions: watch::Sender<u64>,
}

/// The state that pages show.
#[derive(Default)]
pub(super) struct State {
    /// Number of the last change.
    revision: u64,
    /// First revision after which all changes are known: clients that only know an older one must reload everything.
    base: u64,
    drawings: BTreeMap<Utf8PathBuf, PublishedDrawing>,
    /// Totals of all paths, as JSON.
    pub(super) statistics: String,
    /// Diagnostics of the configuration and of directories, as JSON.
    problems: String,
    /// Whether all drawings have been checked once.
    pub(super) is_complete: bool,
    /// Reason why nothing is checked until the user fixes an error, as JSON; empty while checks run.
    halted: String,
    bell: Option<WakeHandle>,
    questions: Vec<Question>,
    is_over: bool,
}

struct PublishedDrawing {
    revision: u64,
    /// Rows of the drawing in the list, as JSON.
    text: String,
}

/// A request of a page, which the watching thread answers with a scene or a picture.
pub(super) struct Question {
    pub(super) subject: Subject,
    /// Channel to which the answer is sent; `None` means that there is no such path.
    pub(super) answer: oneshot::Sender<Option<String>>,
}

pub(super) enum Subject {
    /// A drawing of the library, or one of its paths.
    Drawing {
        /// Name of the drawing in the list.
        file: String,
        /// Name of the path; `None` for the whole drawing.
        path: Option<String>,
        form: AnswerForm,
    },
    /// A program that was dropped on the page.
    Program(DroppedProgram),
}

/// The form of an answer about a drawing or path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AnswerForm {
    /// A scene as JSON.
    Scene,
    /// A picture as SVG.
    Picture,
}

impl Hub {
    /// Restarts with an empty state. `bell` wakes the watching thread.
    pub(super) fn begin(&self, bell: &WakeHandle) {
        let is_over = self.publish(|state, revision| {
            *state = State {
                revision,
                base: revision,
                bell: Some(bell.clone()),
                is_over: state.is_over,
                ..State::default()
            };
            state.is_over
        });
        if is_over {
            bell.end();
        }
    }

    /// Publishes the reason why nothing is checked any more.
    pub(super) fn halt(&self, problems: &[Diagnostic], reason: &str) {
        self.publish(|state, _| {
            state.halted = serde_json::Value::from(reason).to_string();
            state.set_problems(problems);
        });
        self.drop_questions();
    }

    /// Drops pending questions, because the watching thread will not answer them any more.
    pub(super) fn drop_questions(&self) {
        let mut state = self.state();
        state.bell = None;
        state.questions.clear();
    }

    /// Changes the published state. The closure gets the number of the new change.
    pub(super) fn publish<R>(&self, change: impl FnOnce(&mut State, u64) -> R) -> R {
        let mut state = self.state();
        state.revision += 1;
        let revision = state.revision;
        let result = change(&mut state, revision);
        drop(state);
        self.revisions.send_replace(revision);
        result
    }

    /// Returns a receiver that is notified of new changes by their numbers.
    pub(super) fn revisions(&self) -> watch::Receiver<u64> {
        self.revisions.subscribe()
    }

    /// Returns the changes since a revision as JSON, with at most `most` drawings.
    pub(super) fn library(&self, since: u64, most: usize) -> String {
        self.state().to_json(since, most)
    }

    /// Asks the watching thread for a scene or picture. If no such thread is running, the returned channel is closed.
    pub(super) fn ask(&self, subject: Subject) -> oneshot::Receiver<Option<String>> {
        let (answer, answered) = oneshot::channel();
        let mut state = self.state();
        if let Some(bell) = state.bell.clone() {
            state.questions.push(Question { subject, answer });
            bell.wake();
        }
        answered
    }

    /// Removes and returns the pending questions.
    pub(super) fn questions(&self) -> Vec<Question> {
        std::mem::take(&mut self.state().questions)
    }

    /// Asks the watching thread to end.
    pub(super) fn end(&self) {
        let mut state = self.state();
        state.is_over = true;
        if let Some(bell) = &state.bell {
            bell.end();
        }
    }

    pub(super) fn is_over(&self) -> bool {
        self.state().is_over
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// Publishes a drawing's rows as JSON; `None` removes the drawing.
    pub(super) fn publish_drawing(
        &mut self,
        drawing: &Utf8Path,
        file: &str,
        rows: Option<&str>,
        revision: u64,
    ) {
        let name = serde_json::Value::from(file);
        let text = format!("{{\"file\":{name},\"rows\":{}}}", rows.unwrap_or("null"));
        self.drawings.insert(drawing.to_owned(), PublishedDrawing { revision, text });
    }

    pub(super) fn set_problems(&mut self, problems: &[Diagnostic]) {
        let problems = pathbuild_view::findings(problems, "");
        // Serialization fails only for maps with keys that are not strings.
        self.problems = serde_json::to_string(&problems).unwrap_or_default();
    }

    fn to_json(&self, since: u64, most: usize) -> String {
        let is_all = since < self.base || since > self.revision;
        let or = |text: &str, other: &str| if text.is_empty() { other.to_owned() } else { text.to_owned() };
        let mut text = format!(
            "{{\"revision\":{},\"all\":{is_all},\"complete\":{},\"halted\":{},\"problems\":{},\"statistics\":{},\"drawings\":[",
            self.revision,
            self.is_complete,
            or(&self.halted, "null"),
            or(&self.problems, "[]"),
            or(&self.statistics, "null"),
        );
        let mut drawings = self.drawings.values().filter(|drawing| is_all || drawing.revision > since);
        for (index, drawing) in drawings.by_ref().take(most).enumerate() {
            let comma = if index == 0 { "" } else { "," };
            _ = write!(text, "{comma}{}", drawing.text);
        }
        let is_more = drawings.next().is_some();
        _ = write!(text, "],\"more\":{is_more}}}");
        text
    }
}
