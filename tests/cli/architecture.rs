//! Tests that the files of a crate use each other in one direction. (ARCHITECTURE.md, "Crates")

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use regex::Regex;

use crate::book::files_below;
use crate::support::project;

/// Files by the paths of their modules, with the modules that they use.
type Uses = BTreeMap<String, BTreeSet<String>>;

/// The modules whose roots declare the types that their parts extend.
const EXCEPTIONS: [(&str, &str); 3] =
    [("pathbuild-gcode", "interpret"), ("pathbuild-path", "walk"), ("pathbuild-workspace", "machine")];

#[test]
fn files_of_a_crate_use_each_other_in_one_direction() {
    let mut circles = BTreeSet::new();
    for entry in fs::read_dir(project().join("crates")).unwrap() {
        let directory = entry.unwrap().path();
        let name = directory.file_name().unwrap().to_string_lossy().into_owned();
        let in_circle = in_circles(uses(&directory.join("src")));
        circles.extend(in_circle.into_iter().map(|module| (name.clone(), module)));
    }
    let is_excepted = |(name, module): &(String, String)| {
        EXCEPTIONS.iter().any(|(of, root)| of == name && module.split("::").next() == Some(root))
    };
    let unexplained: Vec<_> = circles.iter().filter(|circle| !is_excepted(circle)).collect();
    assert!(unexplained.is_empty(), "files that use each other: {unexplained:#?}");
    let architecture = fs::read_to_string(project().join("ARCHITECTURE.md")).unwrap();
    for (name, root) in EXCEPTIONS {
        assert!(circles.contains(&(name.to_owned(), root.to_owned())), "{root} has no circle any more");
        assert!(architecture.contains(&format!("`{root}`")), "{root}");
    }
}

/// Reads which modules of a crate use which others.
fn uses(sources: &Path) -> Uses {
    let files = files_below(sources);
    let files = files.iter().filter_map(|file| Some((file.strip_suffix(".rs")?, sources.join(file))));
    let texts: BTreeMap<String, String> =
        files.map(|(name, file)| (module(name), fs::read_to_string(file).unwrap())).collect();
    let is_module = |other: &str| texts.contains_key(other);
    texts.iter().map(|(module, text)| (module.clone(), used_modules(module, text, is_module))).collect()
}

/// Returns the path of the module in a file without its extension; empty for the root of the crate.
fn module(file: &str) -> String {
    let name = file.strip_suffix("/mod").unwrap_or(file);
    if ["lib", "main"].contains(&name) { String::new() } else { name.replace('/', "::") }
}

/// Returns the modules in files of their own that a module imports from, without its tests.
fn used_modules(module: &str, text: &str, is_module: impl Fn(&str) -> bool) -> BTreeSet<String> {
    let import = Regex::new(r"(?m)^ *(?:pub(?:\([^)]*\))? )?use ((?:crate|self|super)\b[^;]*);").unwrap();
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut used = BTreeSet::new();
    for import in import.captures_iter(text) {
        for path in imported_paths(&import[1].split_whitespace().collect::<String>()) {
            let mut path = absolute(module, &path);
            while !is_module(&path) {
                path = path.rsplit_once("::").map_or_else(String::new, |(parent, _)| parent.to_owned());
            }
            used.insert(path);
        }
    }
    used.remove(module);
    used
}

/// Returns the paths of an import like `a::{b,c::{d,e}}`.
fn imported_paths(tree: &str) -> Vec<String> {
    let Some((prefix, list)) = tree.strip_suffix('}').and_then(|tree| tree.split_once('{')) else {
        return vec![tree.to_owned()];
    };
    let mut depth = 0;
    let items = list.split(|character| {
        depth += i32::from(character == '{') - i32::from(character == '}');
        character == ',' && depth == 0
    });
    items.flat_map(imported_paths).map(|path| format!("{prefix}{path}")).collect()
}

fn absolute(module: &str, path: &str) -> String {
    let mut base: Vec<&str> = module.split("::").filter(|part| !part.is_empty()).collect();
    for part in path.split("::") {
        match part {
            "crate" => base.clear(),
            "self" => {}
            "super" => _ = base.pop(),
            part => base.push(part),
        }
    }
    base.join("::")
}

/// Returns the modules that remain when those are removed, again and again, that use no other or that no other uses.
fn in_circles(mut uses: Uses) -> Vec<String> {
    loop {
        let used: BTreeSet<String> = uses.values().flatten().cloned().collect();
        let count = uses.len();
        let rest: BTreeSet<String> = uses.keys().cloned().collect();
        uses.retain(|module, others| !others.is_disjoint(&rest) && used.contains(module));
        if uses.len() == count {
            return uses.into_keys().collect();
        }
    }
}
