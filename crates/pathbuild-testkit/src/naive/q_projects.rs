//! Disagreements between Q-projects and their drawings. (book: language/q-projects)

use pathbuild_path::approx::coincide;
use pathbuild_path::{
    Bindings, Letter, Path, PathName, ProxyLine, Segment, SegmentKind, Subpath, SubpathName, parse_number,
};

use super::embedding::allows;
use super::names::{directory, stem};
use super::{Drawing, Finding, Model};

/// Tolerance in mm within which lengths are equal.
const LENGTH: f64 = 0.001;

impl Model {
    /// The findings for each pair among some drawings.
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
        let bound = |path: usize| self.sound(&(q_project, path, values(path)));
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
                    right.iter().map(|proxy| differing(subpath, proxy)).collect();
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

    /// The disagreements between a proxy line and its own path.
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
        if let Some(other) = joined(drawing, proxy, path) {
            return vec![at(&paths[other].0.name.to_string())];
        }
        let raw = &paths[path].0;
        let examples = Bindings::check_values(&raw.definitions);
        let values = raw.definitions.iter().filter_map(|definition| {
            let given = proxy.variables().find(|(name, _)| *name == definition.name).map(|(_, value)| value);
            let given = given.filter(|value| allows(definition, value));
            Some((definition.name, given.or_else(|| examples.get(definition.name))?.into()))
        });
        let Some(bound) = self.sound(&(number, path, Bindings::new(values))) else { return Vec::new() };
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
        if (proxy.curve.chord() - (bound.end - bound.start).norm()).abs() > LENGTH {
            found.push(at(""));
        }
        found
    }
}

/// The path whose ends a proxy line connects, if these are not the ends of the path that it names.
fn joined(drawing: &Drawing, proxy: &ProxyLine, named: usize) -> Option<usize> {
    let (start, end) = (proxy.curve.start(), proxy.curve.end());
    let joins = |path: &usize| {
        let raw = &drawing.content.paths[*path].0;
        let (Some(from), Some(to)) = (&raw.start, &raw.end) else { return false };
        coincide(from.at, start) && coincide(to.at, end) || coincide(from.at, end) && coincide(to.at, start)
    };
    let all: Vec<usize> = (0..drawing.content.paths.len()).filter(joins).collect();
    if all.contains(&named) { None } else { all.first().copied() }
}

/// Letters and variables in which a subpath differs from a proxy line.
fn differing(subpath: &Subpath, proxy: &ProxyLine) -> Vec<String> {
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
    let mut variables: Vec<char> = subpath.values.iter().filter_map(|given| given.variable).collect();
    variables.extend(proxy.variables().map(|(name, _)| name));
    variables.sort_unstable();
    variables.dedup();
    for variable in variables {
        let here = subpath.values.iter().find(|given| given.variable == Some(variable));
        let on_proxy = proxy.variables().find(|(name, _)| *name == variable);
        let agree = matches!((here, on_proxy), (Some(here), Some((_, there))) if is_same(&here.value, there));
        found.extend((!agree).then(|| format!(":{variable}")));
    }
    if ((subpath.end - subpath.start).norm() - proxy.curve.chord()).abs() > LENGTH {
        found.push(String::new());
    }
    found
}

/// Whether two values are equal; numbers may have a decimal point or a comma.
fn is_same(a: &str, b: &str) -> bool {
    let both = parse_number(a).zip(parse_number(b));
    a == b || both.is_some_and(|(a, b)| (a - b).abs() < 1e-6)
}
