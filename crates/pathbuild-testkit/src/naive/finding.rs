use pathbuild_diagnostic::{Diagnostic, Lang};

/// Something that is found, so far as the model knows it. What the program says of it must have all the words in it.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// Such as `PB503`.
    pub code: String,
    /// The file.
    pub file: String,
    /// The path.
    pub path: Option<String>,
    /// The handle of the element.
    pub handle: Option<String>,
    /// The message, or parts of it.
    pub words: Vec<String>,
}

impl Finding {
    /// Of a diagnostic that is about a drawing, located.
    pub fn of(diagnostic: &Diagnostic) -> Self {
        Self {
            code: diagnostic.code().to_string(),
            file: diagnostic.file.as_ref().map(ToString::to_string).unwrap_or_default(),
            path: diagnostic.path.as_ref().map(ToString::to_string),
            handle: diagnostic.place.handle.map(|handle| handle.to_string()),
            words: vec![diagnostic.text(Lang::En)],
        }
    }

    /// Of a diagnostic of reading, binding or walking.
    pub(super) fn shared(diagnostic: &Diagnostic, file: &str) -> Self {
        Self { file: file.to_owned(), ..Self::of(diagnostic) }
    }

    /// Where a cycle closes is found on every way that leads there: it is one finding.
    fn without_chain(mut self) -> Self {
        if self.code == "PB509" {
            self.words.clear();
        }
        self
    }

    /// Whether the program means the same.
    fn is_meant_by(&self, program: &Self) -> bool {
        let place = |it: &Self| (it.code.clone(), it.file.clone(), it.path.clone(), it.handle.clone());
        place(self) == place(program)
            && self.words.iter().all(|word| program.words.iter().any(|message| message.contains(&**word)))
    }
}

/// In order, each once.
pub(super) fn each_once(mut found: Vec<Finding>) -> Vec<Finding> {
    found.sort();
    found.dedup();
    found
}

/// What only one of both finds.
pub fn differences(model: &[Finding], program: &[Finding]) -> Vec<String> {
    let mut open: Vec<Finding> = model.iter().cloned().map(Finding::without_chain).collect();
    open = each_once(open);
    let mut program: Vec<Finding> = program.to_vec();
    for found in program.iter_mut().filter(|found| found.code == "PB509") {
        found.words.clear();
    }
    let mut differences = Vec::new();
    for found in each_once(program) {
        // The one that says most: others may mean what says less.
        let meant = (0..open.len()).filter(|place| open[*place].is_meant_by(&found));
        match meant.max_by_key(|place| open[*place].words.concat().len()) {
            Some(place) => _ = open.remove(place),
            None => differences.push(format!("only the program: {found:?}")),
        }
    }
    differences.extend(open.iter().map(|found| format!("only the model: {found:?}")));
    differences
}
