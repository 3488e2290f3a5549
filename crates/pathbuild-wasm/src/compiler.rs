use std::sync::Arc;

use camino::Utf8PathBuf;
use pathbuild_db::system::clean;
use serde_json::json;

use crate::files::Files;
use crate::message::{Answer, Question};
use crate::opened::OpenedFiles;

/// Answers the messages of a page.
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
            Some(opened) => opened.reply(question),
            None => json!({ "wrong": "nothing is open" }).into(),
        }
    }
}
