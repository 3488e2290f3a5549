//! A straightforward model of checking a library: every file is read, every name is examined, and each path is visited as often as it is
//! embedded, without a database, an index or caching. Reading, binding and walking are shared with the program; finding files, checking
//! embeddings and clamps are reimplemented here from the book, so that the program is not compared with itself.
//! (book: language/layers-and-names, book: language/variables, book: language/chains-and-passes, book: language/keep-outs,
//! book: reference/diagnostics)

mod clamps;
mod embedding;

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use pathbuild_diagnostic::{Diagnostic, ElementId, Lang};
use pathbuild_dxf::{Options, Units};
use pathbuild_path::{
    Bindings, KeepOut, KeepOuts, Language, LayerPattern, LineTypeAliases, PartiallyBoundPath, Path, PathName,
    PathPattern, ProxyLine, RawFile, RawPath, keep_outs, proxy_lines, raw_file, stray_findings,
};
use regex::Regex;

/// Files by their paths, with `/` between directories.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The part of the configuration that affects the model.
#[derive(Clone, Debug, Default)]
pub struct Rules {
    /// Directories that are searched for paths besides the drawing's own.
    pub search: Vec<String>,
    /// PARENT and CHILD of each `--restrict`.
    pub restrict: Vec<(String, String)>,
}

/// The model of a library: all its drawings, and the rules by which paths are found.
pub struct Model {
    drawings: Vec<Drawing>,
    language: Arc<Language>,
    rules: Rules,
}

struct Drawing {
    path: String,
    bytes: Vec<u8>,
    content: RawFile,
    clamps: Vec<KeepOut>,
    clamp_problems: Vec<Diagnostic>,
    /// Whether the outline or the height of a clamp is unclear, so that no path of the drawing becomes a program.
    has_unclear_clamps: bool,
}

/// A path with values: index of the drawing, index of the path in it, and the values.
type Instance = (usize, usize, Bindings);

/// Returns the default settings of the language, without any configuration.
pub fn language() -> Language {
    Language {
        path_pattern: PathPattern::default(),
        keep_out: LayerPattern::new("clamps").ok(),
        part: None,
        line_types: LineTypeAliases::default(),
        join_tolerance: 0.0,
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
    }
}

impl Model {
    /// Reads all drawings of a library.
    pub fn new(files: &Files, rules: &Rules) -> Self {
        let language = Arc::new(language());
        let drawings = files.iter().filter(|(path, _)| is_drawing(path));
        let drawings = drawings.map(|(path, bytes)| Drawing::read(path, bytes, &language)).collect();
        Self { drawings, language, rules: rules.clone() }
    }

    /// Returns the findings of checking the drawings in a directory and below.
    pub fn check(&self, directory: &str) -> Vec<Finding> {
        let wanted = |drawing: &&Drawing| drawing.path.starts_with(&format!("{directory}/"));
        let numbers: Vec<usize> =
            (0..self.drawings.len()).filter(|number| wanted(&&self.drawings[*number])).collect();
        let mut found = Vec::new();
        for number in &numbers {
            found.extend(self.drawings[*number].faults());
            for path in 0..self.drawings[*number].content.paths.len() {
                found.extend(self.check_path(*number, path));
            }
        }
        found.extend(self.q_projects(&numbers));
        found.extend(self.second_definitions(&numbers));
        without_duplicates(found)
    }

    /// Returns PB504 for each path that two of these drawings define, if a project beside one of them finds both. It is reported at the first of the
    /// drawings, once for each other one.
    fn second_definitions(&self, checked: &[usize]) -> Vec<Finding> {
        let paths = checked.iter().flat_map(|from| {
            self.drawings[*from].content.paths.iter().map(move |(raw, _)| (*from, &*raw.name))
        });
        let second_definition = |(from, name): (usize, &PathName)| {
            let mut defining = self.searched(from, name);
            defining.retain(|number| checked.contains(number) && self.defines(*number, name));
            defining.sort_by_key(|number| &self.drawings[*number].path);
            let mut files = defining.into_iter().map(|number| self.drawings[number].path.as_str());
            let first = files.next().unwrap_or_default();
            let finding = |second: &str| {
                let words = [name.as_str(), first, second].map(str::to_owned).to_vec();
                Finding { code: "PB504".to_owned(), file: first.to_owned(), words, ..Finding::default() }
            };
            files.map(finding).collect::<Vec<_>>()
        };
        paths.flat_map(second_definition).collect()
    }

    /// Returns the findings of checking a single path; none if the drawing does not exist.
    pub fn check_alone(&self, file: &str, name: &str) -> Vec<Finding> {
        let Some(number) = self.drawings.iter().position(|drawing| drawing.path == file) else {
            return Vec::new();
        };
        let path = self.drawings[number].content.paths.iter();
        let path = path.take_while(|(raw, _)| *raw.name != PathName::new(name)).count();
        let mut found = self.drawings[number].faults();
        found.extend(self.check_path(number, path));
        without_duplicates(found)
    }

    /// Returns the paths of the drawings in a directory and below, as file and name.
    pub fn paths(&self, directory: &str) -> Vec<(String, String)> {
        let below = self.drawings.iter().filter(|drawing| drawing.path.starts_with(&format!("{directory}/")));
        let names = |drawing: &Drawing| {
            let names =
                drawing.content.paths.iter().map(|(raw, _)| (drawing.path.clone(), raw.name.to_string()));
            names.collect::<Vec<_>>()
        };
        below.flat_map(names).collect()
    }

    fn raw(&self, (drawing, path, _): &Instance) -> &RawPath {
        &self.drawings[*drawing].content.paths[*path].0
    }

    /// Returns the bound path, unless its drawing or values have errors.
    fn sound_path(&self, instance: &Instance) -> Option<Path> {
        self.bind_known(instance).path.filter(|path| !path.has_faults())
    }

    /// Returns the path as far as it is known, with the errors in its values.
    fn bind_known(&self, instance: &Instance) -> PartiallyBoundPath {
        pathbuild_path::bind_leniently(self.raw(instance), &instance.2, &self.language)
    }
}

impl Drawing {
    fn read(path: &str, bytes: &[u8], language: &Language) -> Self {
        let mut content =
            raw_file(&read_drawing(bytes, &|layer| language.path_pattern.is_layer(layer)), language);
        content.diagnostics.extend(stray_findings(&read_drawing(bytes, &|_| true), language));
        let KeepOuts { all: clamps, problems: clamp_problems } =
            keep_outs(&read_drawing(bytes, &|layer| language.is_keep_out(layer)), language);
        let has_unclear_clamps = clamp_problems.iter().any(Diagnostic::is_error);
        Self {
            path: path.to_owned(),
            bytes: bytes.to_vec(),
            content,
            clamps,
            clamp_problems,
            has_unclear_clamps,
        }
    }

    fn proxies(&self, language: &Language) -> Vec<ProxyLine> {
        proxy_lines(&read_drawing(&self.bytes, &|_| true), language)
    }

    /// Returns the findings about the drawing itself rather than its paths.
    fn faults(&self) -> Vec<Finding> {
        let own = self.content.diagnostics.iter().chain(&self.clamp_problems);
        let own = own.map(|found| Finding::shared(found, &self.path));
        own.chain(self.name_faults()).collect()
    }

    /// Whether errors hide all paths of the drawing.
    fn is_unreadable(&self) -> bool {
        self.content.paths.is_empty()
            && self.content.diagnostics.iter().chain(&self.clamp_problems).any(Diagnostic::is_error)
    }

    fn handle(&self, path: &PathName, element: ElementId) -> Option<String> {
        let (_, map) = self.content.paths.iter().find(|(raw, _)| *raw.name == *path)?;
        map.positions().get(element.0 as usize)?.handle.map(|handle| handle.to_string())
    }
}

fn read_drawing(bytes: &[u8], keep_layer: &dyn Fn(&str) -> bool) -> pathbuild_dxf::Drawing {
    let options = Options {
        keep_layer,
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 2_000_000,
        max_text: 65_536,
        compatible: false,
    };
    pathbuild_dxf::read(bytes, &options)
}

fn is_drawing(path: &str) -> bool {
    path.to_ascii_lowercase().ends_with(".dxf")
}

/// A finding as far as the model knows it. The program's message must contain all its words.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// The code, for example `PB503`.
    pub code: String,
    /// File path of the drawing.
    pub file: String,
    /// Name of the path, if the finding is about one.
    pub path: Option<String>,
    /// The handle of the element, if the finding is about one.
    pub handle: Option<String>,
    /// Words that the program's message must contain.
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

    /// Removes the names of the paths in a cycle: each embedding that leads into the cycle finds it again, starting with another path, but
    /// it is reported once.
    fn without_chain(mut self) -> Self {
        if self.code == "PB509" {
            self.words.clear();
        }
        self
    }

    /// Whether a finding of the program agrees with this one.
    fn agrees_with(&self, program: &Self) -> bool {
        let place = |finding: &Self| {
            (finding.code.clone(), finding.file.clone(), finding.path.clone(), finding.handle.clone())
        };
        place(self) == place(program)
            && self.words.iter().all(|word| program.words.iter().any(|message| message.contains(&**word)))
    }
}

/// Sorts findings and removes duplicates.
fn without_duplicates(mut found: Vec<Finding>) -> Vec<Finding> {
    found.sort();
    found.dedup();
    found
}

/// Returns the findings of the model that the program does not report, and the reverse.
pub fn differences(model: &[Finding], program: &[Finding]) -> Vec<String> {
    let mut open: Vec<Finding> = model.iter().cloned().map(Finding::without_chain).collect();
    open = without_duplicates(open);
    let mut program: Vec<Finding> = program.to_vec();
    for found in program.iter_mut().filter(|found| found.code == "PB509") {
        found.words.clear();
    }
    let mut differences = Vec::new();
    for found in without_duplicates(program) {
        // Choose the most specific match, since other findings may match the less specific ones.
        let meant = (0..open.len()).filter(|place| open[*place].agrees_with(&found));
        match meant.max_by_key(|place| open[*place].words.concat().len()) {
            Some(place) => _ = open.remove(place),
            None => differences.push(format!("only the program: {found:?}")),
        }
    }
    differences.extend(open.iter().map(|found| format!("only the model: {found:?}")));
    differences
}

// Finds the files of paths by comparing file names with path names. (book: language/layers-and-names)

static PATH: LazyLock<Regex> = LazyLock::new(|| pattern("(?i)^([0-9]{4})[.]([0-9]+)([A-Z])$"));
static PART: LazyLock<Regex> = LazyLock::new(|| pattern(r"([0-9]{4})(?:[.]([0-9]+))?"));
static RANGE: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"([0-9]{4})(?:[.]([0-9]+))?-([0-9]{4})(?:[.]([0-9]+))?"));

pub(super) fn pattern(text: &str) -> Regex {
    Regex::new(text).expect("a regular expression of the model's own")
}

impl Model {
    /// Returns the drawings that define a path to which the drawing `from` refers.
    pub(super) fn defining_drawings(&self, from: usize, name: &PathName) -> Vec<usize> {
        let others = self.searched(from, name).into_iter().filter(|number| *number != from);
        std::iter::once(from).chain(others).filter(|number| self.defines(*number, name)).collect()
    }

    /// Returns the drawings that may define a path to which the drawing `from` refers, according to their names.
    pub(super) fn searched(&self, from: usize, name: &PathName) -> Vec<usize> {
        let own = directory(&self.drawings[from].path);
        let is_searched = |at: &str| at == own || self.rules.search.iter().any(|searched| searched == at);
        let may_hold = |number: &usize| {
            let path = &self.drawings[*number].path;
            is_searched(directory(path)) && may_hold(stem(path), name.as_str())
        };
        (0..self.drawings.len()).filter(may_hold).collect()
    }

    fn defines(&self, drawing: usize, name: &PathName) -> bool {
        self.drawings[drawing].content.paths.iter().any(|(raw, _)| *raw.name == *name)
    }
}

pub(super) fn directory(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(directory, _)| directory)
}

pub(super) fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or_default();
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Whether a file with this stem may define a path, by the default patterns.
fn may_hold(stem: &str, path: &str) -> bool {
    let Some(path) = PATH.captures(path) else { return false };
    let path: Vec<&str> = (1..=3).map(|group| &path[group]).collect();
    let end = |found: &regex::Captures<'_>, first: usize| -> Vec<String> {
        let group =
            |number: usize| found.get(number).map_or(String::new(), |group| group.as_str().to_owned());
        vec![group(first), group(first + 1)]
    };
    let mut ranges = RANGE.captures_iter(stem).map(|found| (end(&found, 1), end(&found, 3)));
    let mut parts = PART.captures_iter(stem).map(|found| end(&found, 1));
    ranges.any(|(from, to)| compare(&from, &path).is_le() && compare(&to, &path).is_ge())
        || parts.any(|part| compare(&part, &path).is_eq())
}

/// Compares a part of a file name with a path name.
fn compare(file: &[String], path: &[&str]) -> Ordering {
    for (file, path) in file.iter().zip(path) {
        if file.is_empty() {
            // A file name that gives only the first parts of a path's name covers every path with a name that continues them.
            return Ordering::Equal;
        }
        let order = match (file.parse::<u64>(), path.parse::<u64>()) {
            (Ok(file), Ok(path)) => file.cmp(&path),
            _ => file.to_uppercase().cmp(&path.to_uppercase()),
        };
        if order.is_ne() {
            return order;
        }
    }
    Ordering::Equal
}

// Compares the path names in file names with the paths that the drawings contain. (book: language/layers-and-names)

static FULL: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"(?i)\b([0-9]{4})[.]([0-9]+)([A-Z])(?:[^0-9A-Z]|$)"));
static END: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"(?i)[0-9]{4}(?:[.][0-9]+)?[A-Z]? *[-\u{2013}] *[0-9]{4}(?:[.][0-9]+)?[A-Z]?"));

impl Drawing {
    fn name_faults(&self) -> Vec<Finding> {
        let stem = stem(&self.path);
        if stem.to_lowercase().ends_with("_q") || self.content.diagnostics.iter().any(Diagnostic::is_error) {
            return Vec::new();
        }
        let held: Vec<String> =
            self.content.paths.iter().map(|(raw, _)| raw.name.to_string().to_uppercase()).collect();
        // Commas keep the parts before and after a range separate.
        let singles = END.replace_all(stem, ",");
        let finding = |code: &str, name: &str, path: Option<String>| Finding {
            code: code.to_owned(),
            file: self.path.clone(),
            path,
            words: vec![name.to_owned()],
            ..Finding::default()
        };
        let mut found = Vec::new();
        for promised in FULL.captures_iter(&singles) {
            let same = |name: &String| {
                let number = |text: &str| text.trim_start_matches('0').to_owned();
                let Some((first, rest)) = name.split_once('.') else { return false };
                let (second, letter) = rest.split_at(rest.len() - 1);
                first == &promised[1]
                    && number(second) == number(&promised[2])
                    && letter == promised[3].to_uppercase()
            };
            if !held.iter().any(same) {
                let name = format!("{}.{}{}", &promised[1], &promised[2], &promised[3]);
                found.push(finding("PB519", &name, None));
            }
        }
        for (raw, _) in &self.content.paths {
            if !may_hold(stem, raw.name.as_str()) {
                found.push(finding("PB521", raw.name.as_str(), Some(raw.name.to_string())));
            }
        }
        found
    }
}
