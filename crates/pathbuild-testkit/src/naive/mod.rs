//! A straightforward model of checking a library: every file is read, every name is examined, and each path is visited as often as it is
//! embedded, without a database, an index or caching. Reading, binding and walking are shared with the program; finding files, checking
//! embeddings and clamps are reimplemented here from the specification, so that the program is not compared with itself.
//! (book: language/layers-and-names, book: language/variables, book: language/chains-and-passes, book: language/keep-outs,
//! book: reference/diagnostics)

mod clamps;
mod embedding;
mod file_names;
mod finding;
mod names;
mod q_projects;

use std::collections::BTreeMap;
use std::sync::Arc;

use pathbuild_diagnostic::{Diagnostic, ElementId};
use pathbuild_dxf::{Options, Units};
use pathbuild_path::{
    Bindings, ExaminedPath, KeepOut, KeepOutPattern, KeepOuts, Language, LineTypeAliases, Path, PathName,
    PathPattern, ProxyLine, RawFile, RawPath, keep_outs, proxy_lines, raw_file, stray_findings,
};

pub use finding::{Finding, differences};

/// Files by their paths, with `/` between directories.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The relevant part of the configuration.
#[derive(Clone, Debug, Default)]
pub struct Rules {
    /// Directories that are searched for paths besides the drawing's own.
    pub search: Vec<String>,
    /// PARENT and CHILD of each `--restrict`.
    pub restrict: Vec<(String, String)>,
}

/// All drawings of a library.
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
    /// Whether none of its paths becomes a program because a clamp is unclear.
    has_unclear_clamps: bool,
}

/// A path with values: index of the drawing, index of the path in it, and the values.
type Instance = (usize, usize, Bindings);

/// The default settings of the language, without any configuration.
pub fn language() -> Language {
    Language {
        path_pattern: PathPattern::default(),
        keep_out: KeepOutPattern::new("clamps").ok(),
        line_types: LineTypeAliases::default(),
        join_tolerance: 0.0,
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
    }
}

impl Model {
    /// Reads every drawing.
    pub fn new(files: &Files, rules: &Rules) -> Self {
        let language = Arc::new(language());
        let drawings = files.iter().filter(|(path, _)| is_drawing(path));
        let drawings = drawings.map(|(path, bytes)| Drawing::read(path, bytes, &language)).collect();
        Self { drawings, language, rules: rules.clone() }
    }

    /// The findings of checking the drawings in a directory and below.
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
        finding::each_once(found)
    }

    /// The findings of checking a single path; none if the drawing does not exist.
    pub fn check_alone(&self, file: &str, name: &str) -> Vec<Finding> {
        let Some(number) = self.drawings.iter().position(|drawing| drawing.path == file) else {
            return Vec::new();
        };
        let path = self.drawings[number].content.paths.iter();
        let path = path.take_while(|(raw, _)| *raw.name != PathName::new(name)).count();
        let mut found = self.drawings[number].faults();
        found.extend(self.check_path(number, path));
        finding::each_once(found)
    }

    /// The paths of the drawings in a directory and below, as file and name.
    pub fn paths(&self, directory: &str) -> Vec<(String, String)> {
        let below = self.drawings.iter().filter(|drawing| drawing.path.starts_with(&format!("{directory}/")));
        let names = |drawing: &Drawing| {
            let names =
                drawing.content.paths.iter().map(|(raw, _)| (drawing.path.clone(), raw.name.to_string()));
            names.collect::<Vec<_>>()
        };
        below.flat_map(names).collect()
    }

    fn check_path(&self, drawing: usize, path: usize) -> Vec<Finding> {
        let (raw, _) = &self.drawings[drawing].content.paths[path];
        let values = Bindings::check_values(&raw.definitions);
        let mut visit = embedding::Visit::new(self);
        let instance = (drawing, path, values);
        if !visit.path(&instance) {
            visit.found.extend(self.entered_clamps(&instance));
        }
        visit.found
    }

    fn raw(&self, (drawing, path, _): &Instance) -> &RawPath {
        &self.drawings[*drawing].content.paths[*path].0
    }

    /// The bound path, unless its drawing or values have errors.
    fn sound(&self, instance: &Instance) -> Option<Path> {
        self.bound(instance).path.filter(|path| !path.has_faults())
    }

    /// The path as far as it is known, with the errors in its values.
    fn bound(&self, instance: &Instance) -> ExaminedPath {
        pathbuild_path::examine(self.raw(instance), &instance.2, &self.language)
    }
}

impl Drawing {
    fn read(path: &str, bytes: &[u8], language: &Language) -> Self {
        let mut content = raw_file(&drawn(bytes, &|layer| language.path_pattern.is_layer(layer)), language);
        content.diagnostics.extend(stray_findings(&drawn(bytes, &|_| true), language));
        let KeepOuts { all: clamps, problems: clamp_problems } =
            keep_outs(&drawn(bytes, &|layer| language.is_keep_out(layer)), language);
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

    /// Its proxy lines.
    fn proxies(&self, language: &Language) -> Vec<ProxyLine> {
        proxy_lines(&drawn(&self.bytes, &|_| true), language)
    }

    /// Findings about the drawing itself rather than its paths.
    fn faults(&self) -> Vec<Finding> {
        let own = self.content.diagnostics.iter().chain(&self.clamp_problems);
        let own = own.map(|found| Finding::shared(found, &self.path));
        own.chain(self.name_faults()).collect()
    }

    /// The handle of an element of a path.
    fn handle(&self, path: &PathName, element: ElementId) -> Option<String> {
        let (_, map) = self.content.paths.iter().find(|(raw, _)| *raw.name == *path)?;
        map.positions().get(element.0 as usize)?.handle.map(|handle| handle.to_string())
    }
}

fn drawn(bytes: &[u8], keep_layer: &dyn Fn(&str) -> bool) -> pathbuild_dxf::Drawing {
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
