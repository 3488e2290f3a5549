//! What the thread that watches and the server know of each other.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::{Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::watch::Bell;
use tokio::sync::{oneshot, watch};

/// What is published, and what is asked.
#[derive(Default)]
pub(super) struct Hub {
    state: Mutex<State>,
    news: watch::Sender<u64>,
}

/// What is published.
#[derive(Default)]
pub(super) struct State {
    /// Grows by one each time.
    revision: u64,
    /// Who knows nothing later than this knows nothing that still counts.
    base: u64,
    drawings: BTreeMap<Utf8PathBuf, Published>,
    /// What all paths add up to, in JSON.
    pub(super) statistics: String,
    /// What is wrong with the configuration or with directories, in JSON.
    problems: String,
    /// Whether everything has been checked once.
    pub(super) is_complete: bool,
    /// Why nothing is checked before somebody puts that right, in JSON; empty: it is.
    halted: String,
    bell: Option<Bell>,
    questions: Vec<Question>,
    is_over: bool,
}

/// What is known of a drawing.
struct Published {
    revision: u64,
    /// In JSON.
    text: String,
}

/// What a page wants to see.
pub(super) struct Question {
    /// The drawing, as it is listed.
    pub(super) file: String,
    /// The path; `None`: all of the drawing.
    pub(super) path: Option<String>,
    /// As what.
    pub(super) form: Form,
    /// Where the answer goes; `None`: there is no such path.
    pub(super) answer: oneshot::Sender<Option<String>>,
}

/// As what something is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// As data.
    Scene,
    /// As SVG.
    Picture,
}

impl Hub {
    /// Begins anew: nothing is known, and this bell wakes who knows.
    pub(super) fn begin(&self, bell: &Bell) {
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

    /// Nothing is checked for that reason.
    pub(super) fn halt(&self, problems: &[Diagnostic], reason: &str) {
        self.publish(|state, _| {
            state.halted = serde_json::Value::from(reason).to_string();
            state.set_problems(problems);
        });
        self.leave();
    }

    /// Nobody answers any more.
    pub(super) fn leave(&self) {
        let mut state = self.state();
        state.bell = None;
        state.questions.clear();
    }

    /// Changes what is published; the number of the change is handed in.
    pub(super) fn publish<R>(&self, change: impl FnOnce(&mut State, u64) -> R) -> R {
        let mut state = self.state();
        state.revision += 1;
        let revision = state.revision;
        let result = change(&mut state, revision);
        drop(state);
        self.news.send_replace(revision);
        result
    }

    /// The number of the last change, each time there is a new one.
    pub(super) fn news(&self) -> watch::Receiver<u64> {
        self.news.subscribe()
    }

    /// What came after a change, in JSON; of drawings so many at most.
    pub(super) fn library(&self, since: u64, most: usize) -> String {
        self.state().to_json(since, most)
    }

    /// Asks for something to see. No answer comes where nobody is there to give one.
    pub(super) fn ask(
        &self,
        file: String,
        path: Option<String>,
        form: Form,
    ) -> oneshot::Receiver<Option<String>> {
        let (answer, answered) = oneshot::channel();
        let mut state = self.state();
        if let Some(bell) = state.bell.clone() {
            state.questions.push(Question { file, path, form, answer });
            bell.ring();
        }
        answered
    }

    /// What was asked.
    pub(super) fn questions(&self) -> Vec<Question> {
        std::mem::take(&mut self.state().questions)
    }

    /// Ends watching.
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
    /// Publishes a drawing's rows, in JSON; `None`: it is gone.
    pub(super) fn set(&mut self, drawing: &Utf8Path, file: &str, rows: Option<&str>, revision: u64) {
        let name = serde_json::Value::from(file);
        let text = format!("{{\"file\":{name},\"rows\":{}}}", rows.unwrap_or("null"));
        self.drawings.insert(drawing.to_owned(), Published { revision, text });
    }

    pub(super) fn set_problems(&mut self, problems: &[Diagnostic]) {
        let problems = pathbuild_view::findings(problems, "");
        // Only maps with keys that are no text can fail to become JSON.
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
        let mut wanted = self.drawings.values().filter(|drawing| is_all || drawing.revision > since);
        for (index, drawing) in wanted.by_ref().take(most).enumerate() {
            let comma = if index == 0 { "" } else { "," };
            _ = write!(text, "{comma}{}", drawing.text);
        }
        let is_more = wanted.next().is_some();
        _ = write!(text, "],\"more\":{is_more}}}");
        text
    }
}
