//! Checks embeddings. (book: language/embedding; the order: book: reference/diagnostics)

use pathbuild_path::approx::coincide;
use pathbuild_path::{
    AllowedValues, Bindings, Definition, Letter, PartiallyBoundPath, Path, PathName, PathRole, PathSignature,
    ProxyLine, Segment, SegmentKind, Subpath, SubpathName, parse_number, walk,
};
use regex::Regex;

use super::{Drawing, Finding, Instance, Model, directory, stem};

/// Maximum depth of embedding below the checked path.
const MAX_EMBEDDING_DEPTH: usize = 10;

/// The most serious error of a path and everything that it embeds. It determines whether an embedding path reports an error of its own.
#[derive(Clone, PartialEq)]
pub(super) enum Errors {
    /// Neither the path nor anything that it embeds has errors.
    None,
    /// Embedding is too deep below the checked path.
    TooDeep,
    /// The path is part of a cycle that begins with the given path.
    Cycle(Instance),
    /// The path, or one that it embeds, has other errors.
    Own,
}

impl Errors {
    fn of(is_wrong: bool) -> Self {
        if is_wrong { Self::Own } else { Self::None }
    }

    fn and(self, other: Self) -> Self {
        let rank = |errors: &Self| match errors {
            Self::None => 0,
            Self::TooDeep => 1,
            Self::Cycle(_) => 2,
            Self::Own => 3,
        };
        if rank(&other) > rank(&self) { other } else { self }
    }
}

/// A traversal of everything that a path embeds.
struct Visit<'m> {
    model: &'m Model,
    /// The paths being visited, outermost first.
    open: Vec<Instance>,
    pub(super) found: Vec<Finding>,
}

impl<'m> Visit<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        Self { model, open: Vec::new(), found: Vec::new() }
    }

    /// Visits a path and everything it embeds.
    pub(super) fn path(&mut self, instance: &Instance) -> Errors {
        let drawing = &self.model.drawings[instance.0];
        self.found.extend(drawing.faults());
        let raw = self.model.raw(instance);
        let PartiallyBoundPath { path, problems } = self.model.bind_known(instance);
        let mut is_wrong =
            self.report(instance, &raw.findings_except(&problems)) | drawing.has_unclear_clamps;
        is_wrong |= self.report(instance, &problems);
        let Some(path) = path else { return Errors::Own };
        is_wrong |= path.has_faults();
        if !path.has_faults() {
            let height = path.embedded_sweep_height();
            is_wrong |= self
                .report(instance, &PathSignature::of(&path).low_sweep_problems(height, PathRole::Embedded));
        }
        is_wrong |= self.report(instance, &walk(&path, self.model.language.join_tolerance).diagnostics);
        self.open.push(instance.clone());
        let mut errors = Errors::of(is_wrong);
        for segment in &path.segments {
            if let SegmentKind::Subpath(subpath) = &segment.kind {
                errors = errors.and(self.embedding(instance, &path, segment, subpath));
            }
        }
        self.open.pop();
        errors
    }

    /// Reports the findings in a path. Returns whether any is an error.
    fn report(&mut self, (drawing, ..): &Instance, found: &[pathbuild_diagnostic::Diagnostic]) -> bool {
        let drawing = &self.model.drawings[*drawing];
        for diagnostic in found {
            let mut finding = Finding::shared(diagnostic, &drawing.path);
            if let (Some(path), Some(element)) = (&diagnostic.path, diagnostic.place.element) {
                finding.handle = drawing.handle(&PathName::new(path), element);
            }
            self.found.push(finding);
        }
        found.iter().any(pathbuild_diagnostic::Diagnostic::is_error)
    }

    /// Checks an embedding and visits the embedded path.
    fn embedding(&mut self, outer: &Instance, path: &Path, segment: &Segment, subpath: &Subpath) -> Errors {
        let model = self.model;
        let drawing = &model.drawings[outer.0];
        let at = |code: &str, words: &[&str]| Finding {
            code: code.to_owned(),
            file: drawing.path.clone(),
            path: Some(path.name.to_string()),
            handle: drawing.handle(&path.name, path.origin(segment).id),
            words: words.iter().map(|word| (*word).to_owned()).collect(),
        };
        let name = match &subpath.name {
            SubpathName::Missing { .. } => return self.stop(at("PB501", &[])),
            SubpathName::Invalid { value } => return self.stop(at("PB502", &[value])),
            SubpathName::Found { name, whole_value: Some(value) } if has_more_words(value, name.as_str()) => {
                return self.stop(at("PB502", &[value]));
            }
            SubpathName::Found { name, whole_value } => {
                // Other characters beside the name are only a warning.
                self.found.extend(whole_value.as_ref().map(|value| at("PB502", &[value])));
                name
            }
        };
        if !self.is_allowed(path, name) {
            return self.stop(at("PB507", &[name.as_str()]));
        }
        if self.open.len() > MAX_EMBEDDING_DEPTH {
            self.found.push(at("PB508", &[]));
            return Errors::TooDeep;
        }
        match *model.defining_drawings(outer.0, name) {
            [] => {
                if let [only] = model.searched(outer.0, name)[..]
                    && model.drawings[only].is_unreadable()
                {
                    self.found.extend(model.drawings[only].faults());
                    return self.stop(at("PB511", &[name.as_str()]));
                }
                return self.stop(at("PB503", &[name.as_str()]));
            }
            [_] => {}
            [first, second, ..] => {
                let [first, second] = [first, second].map(|drawing| &*model.drawings[drawing].path);
                return self.stop(at("PB504", &[name.as_str(), first, second]));
            }
        }
        let Some(child) = model.child(outer, name, subpath) else { return Errors::Own };
        let raw = model.raw(&child);
        if raw.is_sound() {
            let before = self.found.len();
            for given in &subpath.values {
                let name = given.variable.map(String::from).unwrap_or_default();
                match raw.definitions.iter().find(|known| Some(known.name) == given.variable) {
                    None => self.found.push(at("PB303", &[&name])),
                    Some(known) if !allows(known, &given.value) => {
                        self.found.push(at("PB304", &[&format!("{name:?}"), &given.value]));
                    }
                    Some(_) => {}
                }
            }
            let is_missing = |known: &&Definition| child.2.get(known.name).is_none();
            for known in raw.definitions.iter().filter(is_missing) {
                self.found.push(at("PB302", &[&known.name.to_string()]));
            }
            if self.found.len() > before {
                return Errors::Own;
            }
        }
        if self.open.contains(&child) {
            self.found.push(at("PB509", &[name.as_str()]));
            return Errors::Cycle(child);
        }
        let is_place = |one: &Instance, other: &Instance| (one.0, one.1) == (other.0, other.1);
        match self.path(&child) {
            Errors::None => {}
            Errors::TooDeep => return Errors::TooDeep,
            Errors::Cycle(first) if self.open.iter().any(|open| is_place(open, &first)) => {
                return Errors::Cycle(first);
            }
            Errors::Cycle(_) | Errors::Own => return self.stop(at("PB511", &[raw.name.as_str()])),
        }
        let inner = model.sound_path(&child);
        let is_thinner = inner.as_ref().is_some_and(|inner| is_thinner_in_one_sheet(path, subpath, inner));
        let misfits = inner.map_or(Vec::new(), |inner| mismatches(path, subpath, &inner));
        for (code, word) in &misfits {
            self.found.push(at(code, &[word]));
        }
        self.found.extend(is_thinner.then(|| at("PB506", &["T"])));
        // If the path gives no M, the sheets may be different ones: that is a warning.
        Errors::of(!misfits.is_empty() || is_thinner && path.material.is_some())
    }

    fn stop(&mut self, finding: Finding) -> Errors {
        self.found.push(finding);
        Errors::Own
    }

    /// Whether E of the embedding path allows the name; without E, the first applicable `--restrict` decides.
    fn is_allowed(&self, path: &Path, name: &PathName) -> bool {
        let is_in = |rule: &str, name: &PathName| {
            Regex::new(&format!("(?i){rule}")).is_ok_and(|pattern| pattern.is_match(name.as_str()))
        };
        if let Some(rule) = &path.embeds_only {
            return is_in(rule, name);
        }
        let rule = self.model.rules.restrict.iter().find(|(parent, _)| is_in(parent, &path.name));
        rule.is_none_or(|(_, child)| is_in(child, name))
    }
}

impl Model {
    /// Returns the findings of a path and all that it embeds.
    pub(super) fn check_path(&self, drawing: usize, path: usize) -> Vec<Finding> {
        let (raw, _) = &self.drawings[drawing].content.paths[path];
        let values = Bindings::check_values(&raw.definitions);
        let mut visit = Visit::new(self);
        let instance = (drawing, path, values);
        if visit.path(&instance) == Errors::None {
            visit.found.extend(self.entered_clamps(&instance));
        }
        visit.found
    }

    /// Returns the path that a subpath embeds, from its own drawing or else from the first that defines it; `None` if no drawing does.
    pub(super) fn child(&self, outer: &Instance, name: &PathName, subpath: &Subpath) -> Option<Instance> {
        let holder = *self.defining_drawings(outer.0, name).first()?;
        let paths = &self.drawings[holder].content.paths;
        let number = paths.iter().take_while(|(raw, _)| *raw.name != *name).count();
        let values = subpath.values.iter().filter_map(|given| Some((given.variable?, given.value.clone())));
        Some((holder, number, Bindings::new(values)))
    }
}

/// Whether the text after `>` has a letter or digit beside the name.
fn has_more_words(value: &str, name: &str) -> bool {
    let at = value.find(name).unwrap_or_default();
    value[..at].chars().chain(value[at + name.len()..].chars()).any(char::is_alphanumeric)
}

fn allows(definition: &Definition, value: &str) -> bool {
    match &definition.values {
        AllowedValues::Range { from, to, .. } => {
            parse_number(value).is_some_and(|number| *from <= number && number <= *to)
        }
        AllowedValues::List(values) => values.iter().any(|known| known == value),
        AllowedValues::Characters(all) => all.iter().any(|known| value == known.to_string()),
    }
}

/// Whether a path is drawn for a thinner sheet than the path that embeds it, and nothing says that it lies in a sheet of its own.
fn is_thinner_in_one_sheet(path: &Path, subpath: &Subpath, inner: &Path) -> bool {
    let letters = [Letter::T, Letter::M, Letter::H];
    let is_known = !letters.into_iter().any(|letter| path.hides(letter) || subpath.hides(letter));
    let [outer, segment] =
        [&path.material, &subpath.material].map(|name| name.as_deref().map(str::to_lowercase));
    let is_one_sheet =
        subpath.height <= 0.0 && subpath.material.is_some() && (outer.is_none() || outer == segment);
    let is_of_component = (subpath.thickness - inner.thickness).abs() <= LENGTH_TOLERANCE;
    is_known && is_one_sheet && is_of_component && path.thickness > inner.thickness + LENGTH_TOLERANCE
}

/// Returns the mismatches in M, T, O and the length, each with its code and its letter.
fn mismatches(path: &Path, subpath: &Subpath, inner: &Path) -> Vec<(&'static str, String)> {
    let differs = |a: f64, b: f64| (a - b).abs() > LENGTH_TOLERANCE;
    let mut found = Vec::new();
    for (letter, here, there) in [("T", subpath.thickness, inner.thickness), ("O", subpath.tool, inner.tool)]
    {
        let is_known = Letter::new(letter.chars().next().unwrap_or_default())
            .is_some_and(|letter| !subpath.hides(letter));
        found.extend((is_known && differs(here, there)).then(|| ("PB506", letter.to_owned())));
    }
    if !differs(subpath.tool, inner.tool) && differs(path.tool, inner.tool) {
        found.push(("PB506", "O".to_owned()));
    }
    match (&subpath.material, &inner.material) {
        (Some(here), Some(there)) => found.extend((here != there).then(|| ("PB506", "M".to_owned()))),
        _ if subpath.hides(Letter::M) => {}
        _ => found.push(("PB201", "M".to_owned())),
    }
    let is_thickness_known = !subpath.hides(Letter::T) && !path.hides(Letter::T);
    if is_thickness_known && path.thickness < subpath.thickness - LENGTH_TOLERANCE {
        found.push(("PB510", String::new()));
    }
    let length = |from: pathbuild_path::Xy, to: pathbuild_path::Xy| (to - from).norm();
    if differs(length(subpath.start, subpath.end), length(inner.start, inner.end)) {
        found.push(("PB505", String::new()));
    }
    found
}

// Disagreements between Q-projects and their drawings. (book: language/q-projects)

/// Tolerance in mm within which lengths are equal.
const LENGTH_TOLERANCE: f64 = 0.001;

impl Model {
    /// Returns the findings about each pair of a drawing and its Q-project among these drawings.
    pub(super) fn q_projects(&self, numbers: &[usize]) -> Vec<Finding> {
        let mut found = Vec::new();
        for drawing in numbers {
            for q_project in numbers {
                let [here, there] = [drawing, q_project].map(|number| &*self.drawings[*number].path);
                let is_pair = directory(here) == directory(there)
                    && [format!("{}_Q", stem(here)), format!("{}_q", stem(here))]
                        .contains(&stem(there).to_owned());
                if is_pair {
                    found.extend(self.pair(*drawing, *q_project));
                }
            }
        }
        found
    }

    fn pair(&self, drawing: usize, q_project: usize) -> Vec<Finding> {
        let (component, project) = (&self.drawings[drawing], &self.drawings[q_project]);
        let mut found: Vec<Finding> = Vec::new();
        let proxies = component.proxies(&self.language);
        for proxy in &proxies {
            found.extend(self.proxy_faults(drawing, proxy));
        }
        let values = |path: usize| Bindings::check_values(&project.content.paths[path].0.definitions);
        let bound = |path: usize| self.sound_path(&(q_project, path, values(path)));
        let paths: Option<Vec<Path>> = (0..project.content.paths.len()).map(bound).collect();
        let Some(paths) =
            paths.filter(|_| project.content.diagnostics.iter().all(|problem| !problem.is_error()))
        else {
            return found;
        };
        let subpaths = paths.iter().flat_map(|path| path.segments.iter().map(move |segment| (path, segment)));
        let named: Vec<(&Path, &Segment, &Subpath, &PathName)> = subpaths
            .filter_map(|(path, segment)| match &segment.kind {
                SegmentKind::Subpath(subpath) => match &subpath.name {
                    SubpathName::Found { name, .. } => Some((path, segment, &**subpath, &**name)),
                    _ => None,
                },
                _ => None,
            })
            .collect();
        for (raw, _) in &component.content.paths {
            let embedded = named.iter().filter(|(.., name)| **name == *raw.name);
            if embedded.clone().count() == 0 {
                found.push(Finding {
                    code: "PB515".to_owned(),
                    file: project.path.clone(),
                    words: vec![raw.name.to_string()],
                    ..Finding::default()
                });
            }
            let of_path = |proxy: &&ProxyLine| {
                proxy.name(&self.language).is_some_and(|name| name == *raw.name)
                    && self.proxy_faults(drawing, proxy).is_empty()
            };
            let right: Vec<&ProxyLine> = proxies.iter().filter(of_path).collect();
            for (path, segment, subpath, _) in embedded {
                let mut compared: Vec<Vec<String>> =
                    right.iter().map(|proxy| differing_letters(subpath, proxy)).collect();
                if compared.is_empty() || compared.iter().any(Vec::is_empty) {
                    continue;
                }
                found.extend(compared.swap_remove(0).into_iter().map(|what| Finding {
                    code: "PB516".to_owned(),
                    file: project.path.clone(),
                    path: Some(path.name.to_string()),
                    handle: project.handle(&path.name, path.origin(segment).id),
                    words: vec![what],
                }));
            }
        }
        found
    }

    /// Returns the disagreements between a proxy line and its own path.
    fn proxy_faults(&self, number: usize, proxy: &ProxyLine) -> Vec<Finding> {
        let drawing = &self.drawings[number];
        let at = |word: &str| Finding {
            code: "PB517".to_owned(),
            file: drawing.path.clone(),
            path: None,
            handle: proxy.position.handle.map(|handle| handle.to_string()),
            words: vec![word.to_owned()],
        };
        let Some((written, _)) = proxy.value(Letter::Embed) else { return Vec::new() };
        let paths = &drawing.content.paths;
        let named = proxy.name(&self.language);
        let Some(path) = paths.iter().position(|(raw, _)| Some(&*raw.name) == named.as_ref()) else {
            return vec![at(written)];
        };
        if let Some(other) = other_connected_path(drawing, proxy, path) {
            return vec![at(&paths[other].0.name.to_string())];
        }
        let raw = &paths[path].0;
        let examples = Bindings::check_values(&raw.definitions);
        let values = raw.definitions.iter().filter_map(|definition| {
            let given =
                proxy.variables().find(|(name, ..)| *name == definition.name).map(|(_, value, _)| value);
            let given = given.filter(|value| allows(definition, value));
            Some((definition.name, given.or_else(|| examples.get(definition.name))?.into()))
        });
        let Some(bound) = self.sound_path(&(number, path, Bindings::new(values))) else { return Vec::new() };
        let is = |letter: Letter, there: f64| {
            proxy.value(letter).is_none_or(|(here, _)| is_same(here, &there.to_string()))
        };
        let material = proxy.value(Letter::M).map(|(here, _)| here.to_owned());
        let mut found = Vec::new();
        for (letter, agrees) in [("T", is(Letter::T, bound.thickness)), ("O", is(Letter::O, bound.tool))] {
            found.extend((!agrees).then(|| at(letter)));
        }
        if material.is_some_and(|here| bound.material.as_deref() != Some(&*here)) {
            found.push(at("M"));
        }
        for (variable, value, _) in proxy.variables() {
            let is_allowed =
                raw.definitions.iter().any(|known| known.name == variable && allows(known, value));
            found.extend((!is_allowed).then(|| at(&variable.to_string())));
        }
        if (proxy.curve.chord() - (bound.end - bound.start).norm()).abs() > LENGTH_TOLERANCE {
            found.push(at(""));
        }
        found
    }
}

/// Returns the index of the path with the ends that a proxy line connects, if the named path has other ends.
fn other_connected_path(drawing: &Drawing, proxy: &ProxyLine, named: usize) -> Option<usize> {
    let (start, end) = (proxy.curve.start(), proxy.curve.end());
    let joins = |path: &usize| {
        let raw = &drawing.content.paths[*path].0;
        let (Some(from), Some(to)) = (&raw.start, &raw.end) else { return false };
        coincide(from.at, start) && coincide(to.at, end) || coincide(from.at, end) && coincide(to.at, start)
    };
    let all: Vec<usize> = (0..drawing.content.paths.len()).filter(joins).collect();
    if all.contains(&named) { None } else { all.first().copied() }
}

/// Returns the letters and variables in which a subpath differs from a proxy line.
fn differing_letters(subpath: &Subpath, proxy: &ProxyLine) -> Vec<String> {
    let mut found = Vec::new();
    for (letter, name, here) in [(Letter::T, "T", subpath.thickness), (Letter::O, "O", subpath.tool)] {
        let on_proxy = proxy.value(letter);
        found.extend(
            on_proxy.filter(|(there, _)| !is_same(there, &here.to_string())).map(|_| name.to_owned()),
        );
    }
    if proxy.value(Letter::M).is_some_and(|(there, _)| subpath.material.as_deref() != Some(there)) {
        found.push("M".to_owned());
    }
    let height = proxy.value(Letter::H).map_or("0", |(there, _)| there);
    if !is_same(height, &subpath.height.to_string()) {
        found.push("H".to_owned());
    }
    for (variable, there, _) in proxy.variables() {
        let here = subpath.values.iter().find(|given| given.variable == Some(variable));
        let agree = here.is_some_and(|here| is_same(&here.value, there));
        found.extend((!agree).then(|| format!(":{variable}")));
    }
    if ((subpath.end - subpath.start).norm() - proxy.curve.chord()).abs() > LENGTH_TOLERANCE {
        found.push(String::new());
    }
    found
}

/// Whether two values are equal; numbers may have a decimal point or a comma.
fn is_same(a: &str, b: &str) -> bool {
    let both = parse_number(a).zip(parse_number(b));
    a == b || both.is_some_and(|(a, b)| (a - b).abs() < 1e-6)
}
