//! The recorded cases, and their command lines translated for pathbuild.

use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// A recorded run of `PathDxf2GCode` or `PathGCodeAdjustZ`.
pub(crate) struct Run {
    /// The folder of the case, with its drawings, `case.json` and the expected files.
    pub(crate) case: PathBuf,
    /// Number of the run within the case.
    pub(crate) number: usize,
    pub(crate) what: What,
    pub(crate) form: Form,
    /// The reason why the expected result differs from the recorded one.
    by_specification: Option<String>,
}

/// The kind of expected results.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// The results of the original program, which `--compatible` reproduces.
    Recorded,
    /// The results that pathbuild specifies, without that option.
    Default,
}

impl Form {
    /// Returns the folder of a case's expected results.
    pub(crate) fn folder(self) -> &'static str {
        match self {
            Self::Recorded => "expected",
            Self::Default => "default",
        }
    }
}

/// The action of a run.
pub(crate) enum What {
    /// Arguments of `check` or `emit`.
    Compile(Vec<String>),
    /// `adjust` with this value of --max-correction.
    Adjust(f64),
}

#[derive(Deserialize)]
struct CaseFile {
    #[serde(default)]
    runs: Vec<Vec<String>>,
    max_correction: Option<f64>,
}

impl Run {
    pub(crate) fn name(&self) -> String {
        format!("{}/{}", self.case.file_name().unwrap().to_str().unwrap(), self.number)
    }
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())?;
        match &self.what {
            What::Compile(arguments) => write!(f, " (pathbuild {})", arguments.join(" "))?,
            What::Adjust(_) => write!(f, " (pathbuild adjust)")?,
        }
        if self.form == Form::Default {
            f.write_str(" (without --compatible)")?;
        }
        match &self.by_specification {
            Some(reason) => write!(f, " (by the specification: {reason})"),
            None => Ok(()),
        }
    }
}

/// Returns the runs in these folders that can be translated, ordered by case and number.
pub(crate) fn runs(folders: &[PathBuf]) -> Vec<Run> {
    folders.iter().flat_map(|folder| runs_in(folder)).collect()
}

fn runs_in(folder: &Path) -> Vec<Run> {
    let reasons = fs::read_to_string(folder.join("by-specification.json"));
    let reasons: BTreeMap<String, String> =
        reasons.map(|text| serde_json::from_str(&text).unwrap()).unwrap_or_default();
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut cases: Vec<PathBuf> = entries.filter(|case| case.join("case.json").exists()).collect();
    cases.sort();
    let mut runs: Vec<Run> = cases.iter().flat_map(|case| runs_of(case)).collect();
    for run in &mut runs {
        run.by_specification = reasons.get(&run.name()).cloned();
    }
    runs
}

fn runs_of(case: &Path) -> Vec<Run> {
    let text = fs::read_to_string(case.join("case.json")).unwrap();
    let file: CaseFile = serde_json::from_str(&text).unwrap();
    let run = |number, what, form| Run { case: case.to_owned(), number, what, form, by_specification: None };
    let adjusts = file.max_correction.map(|rate| run(0, What::Adjust(rate), Form::Recorded));
    let compiles = file.runs.iter().enumerate().flat_map(|(number, arguments)| {
        let forms = [Form::Recorded, Form::Default].into_iter();
        let forms = forms.filter(move |form| case.join(form.folder()).join(number.to_string()).exists());
        forms.filter_map(move |form| Some(run(number, What::Compile(translate(arguments)?), form)))
    });
    adjusts.into_iter().chain(compiles).collect()
}

/// Translates a recorded command line; `None` if it has no counterpart: help, `/x`, `/k`.
fn translate(recorded: &[String]) -> Option<Vec<String>> {
    let (mut command, mut options, mut files) = ("emit", Vec::new(), Vec::new());
    let mut rest = recorded.iter().map(String::as_str);
    while let Some(argument) = rest.next() {
        let Some(option) = argument.strip_prefix('/') else {
            files.push(argument.to_owned());
            continue;
        };
        let letter = option.chars().next();
        match (option, letter) {
            ("c", _) => command = "check",
            ("h" | "?", _) | (_, Some('x' | 'k')) => return None,
            _ => match letter.and_then(option_name) {
                // A value follows its option, with or without a space.
                Some(name) => {
                    let value = if option.len() > 1 { &option[1..] } else { rest.next().unwrap_or_default() };
                    options.push(format!("{name}={value}"));
                }
                None => files.push(argument.to_owned()),
            },
        }
    }
    Some([vec![command.to_owned()], options, files].concat())
}

fn option_name(letter: char) -> Option<&'static str> {
    Some(match letter {
        'f' => "--feed",
        'v' => "--rapid",
        's' => "--sweep-height",
        'z' => "--probe-feed",
        'd' => "--search",
        'n' => "--path-pattern",
        'p' => "--file-pattern",
        'e' => "--restrict",
        'l' => "--lang",
        _ => return None,
    })
}
