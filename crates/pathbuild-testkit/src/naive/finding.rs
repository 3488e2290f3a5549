use pathbuild_diagnostic::{Diagnostic, Lang};

/// A finding as far as the model knows it. The program's message must contain all its words.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// The code, for example `PB503`.
    pub code: String,
    /// The file.
    pub file: String,
    /// The path.
    pub path: Option<String>,
    /// The handle of the element.
    pub handle: Option<String>,
    /// Words of the message.
    pub words: Vec<String>,
}

impl Finding {
    /// Converts a located diagnostic about a drawing.
    pub fn of(diagnostic: &Diagnostic) -> Self {
        Self {
            code: diagnostic.code().to_string(),
            file: diagnostic.file.as_ref().map(ToString::to_string).unwrap_or_default(),
            path: diagnostic.path.as_ref().map(ToString::to_string),
            handle: diagnostic.place.handle.map(|handle| handle.to_string()),
            words: vec![diagnostic.text(Lang::En)],
        }
    }

    /// Converts a diagnostic of reading, binding or walking.
    pub(super) fn shared(diagnostic: &Diagnostic, file: &str) -> Self {
        Self { file: file.to_owned(), ..Self::of(diagnostic) }
    }

    /// Removes the chain of a cycle: it is found on every way that leads to it, but counts once.
    fn without_chain(mut self) -> Self {
        if self.code == "PB509" {
            self.words.clear();
        }
        self
    }

    /// Whether a finding of the program is the same.
    fn is_meant_by(&self, program: &Self) -> bool {
        let place = |finding: &Self| {
            (finding.code.clone(), finding.file.clone(), finding.path.clone(), finding.handle.clone())
        };
        place(self) == place(program)
            && self.words.iter().all(|word| program.words.iter().any(|message| message.contains(&**word)))
    }
}

/// Sorts findings and removes duplicates.
pub(super) fn each_once(mut found: Vec<Finding>) -> Vec<Finding> {
    found.sort();
    found.dedup();
    found
}

/// Findings that only one of both sides has.
pub fn differences(model: &[Finding], program: &[Finding]) -> Vec<String> {
    let mut open: Vec<Finding> = model.iter().cloned().map(Finding::without_chain).collect();
    open = each_once(open);
    let mut program: Vec<Finding> = program.to_vec();
    for found in program.iter_mut().filter(|found| found.code == "PB509") {
        found.words.clear();
    }
    let mut differences = Vec::new();
    for found in each_once(program) {
        // Choose the most specific match, since other findings may match the less specific ones.
        let meant = (0..open.len()).filter(|place| open[*place].is_meant_by(&found));
        match meant.max_by_key(|place| open[*place].words.concat().len()) {
            Some(place) => _ = open.remove(place),
            None => differences.push(format!("only the program: {found:?}")),
        }
    }
    differences.extend(open.iter().map(|found| format!("only the model: {found:?}")));
    differences
}
