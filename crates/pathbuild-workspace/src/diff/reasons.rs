//! Reasons why the moves of a path changed: differences in its drawing, in the paths that it embeds, and in the settings that it uses.
//! (book: program/comparing)

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use pathbuild_db::{
    Database, Db, DrawnPath, Instance, Outcome, SourceFile, Target, closure, direct_embeddings, drawn_path,
    effective_parameters,
};
use pathbuild_diagnostic::{Sentence, Value, drawn_changes as texts};
use pathbuild_path::{
    Bindings, CaseSensitiveName, DrawnChange, DrawnSide, ElementParameters, PathName, Provider, drawn_changes,
};

use crate::config::{Settings, settings};

/// A reason why moves changed.
#[derive(Debug)]
pub enum Reason {
    /// An element was added, removed or changed in the drawing.
    Drawn(DrawnChange),
    /// The file contains the same elements in another order, which decides between equally good candidates for the next element. Nothing else has
    /// changed.
    Reordered,
    /// A variable of the path has another value.
    Variable(ValueChange),
    /// A key of the configuration has another value.
    Setting(ValueChange),
    /// An embedded path has changed.
    Embedded {
        /// Name of the embedded path.
        path: String,
        /// The changes in the embedded path; empty if an earlier reason already lists them.
        reasons: Vec<Reason>,
    },
}

/// A named value before and after the change; `None` on a side where it is not set.
#[derive(Debug, PartialEq, Eq)]
pub struct ValueChange {
    /// Name of the variable or of the key.
    pub name: String,
    /// The value on the old side.
    pub was: Option<String>,
    /// The value on the new side.
    pub now: Option<String>,
}

impl Reason {
    /// Returns the reason as a sentence, without the nested reasons.
    pub fn sentence(&self) -> Sentence {
        match self {
            Self::Drawn(change) => change.sentence(),
            Self::Reordered => Sentence::new(&texts::REORDERED),
            Self::Variable(change) => change.sentence(Sentence::new(&texts::VARIABLE)),
            Self::Setting(change) => change.sentence(Sentence::new(&texts::SETTING)),
            Self::Embedded { path, reasons } => {
                let text = if reasons.is_empty() { &texts::EMBEDDED_AGAIN } else { &texts::EMBEDDED };
                Sentence::new(text).quoting("path", path)
            }
        }
    }

    /// Returns the sentence of the reason when it is listed for the first time.
    fn first_sentence(&self) -> Sentence {
        match self {
            Self::Embedded { path, .. } => Sentence::new(&texts::EMBEDDED).quoting("path", path),
            _ => self.sentence(),
        }
    }

    /// Returns the nested reasons: the changes of an embedded path. Empty for other kinds.
    pub fn reasons(&self) -> &[Self] {
        match self {
            Self::Embedded { reasons, .. } => reasons,
            Self::Drawn(_) | Self::Reordered | Self::Variable(_) | Self::Setting(_) => &[],
        }
    }
}

impl ValueChange {
    fn sentence(&self, sentence: Sentence) -> Sentence {
        let value =
            |value: &Option<String>| value.as_ref().map_or(Value::Prose(&texts::NOT_SET), Value::quoted);
        sentence.quoting("name", &self.name).with("was", value(&self.was)).with("now", value(&self.now))
    }
}

/// One side of the comparison of a path: old or new.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    pub(super) db: &'a Database,
    pub(super) settings: &'a Settings,
    pub(super) target: Target,
}

/// Returns the reasons why the programs of a path differ; empty if neither the drawings nor the settings differ.
pub(super) fn reasons(old: Side<'_>, new: Side<'_>) -> Vec<Reason> {
    let (Some(was), Some(is)) = (closure(old.db, old.target).root, closure(new.db, new.target).root) else {
        return Vec::new();
    };
    let changed_settings = changed_settings(old.settings, new.settings);
    let mut explainer = Explainer {
        old: old.db,
        new: new.db,
        is_read_otherwise: changed_settings.keys().any(|name| READING_KEYS.contains(name)),
        known: HashMap::new(),
        listed: HashSet::new(),
        used_options: BTreeSet::new(),
        has_same_file: false,
        has_other_order: false,
    };
    let drawn = explainer.path_reasons(Versions { old: was, new: is }, true);
    let Explainer { used_options, has_same_file, has_other_order, .. } = explainer;
    let (used, others): (Vec<_>, Vec<_>) = changed_settings
        .into_iter()
        .partition(|(name, _)| used_options.contains(name) || has_same_file && READING_KEYS.contains(name));
    let settings = |changes: Vec<(&str, ValueChange)>| {
        changes.into_iter().map(|(_, change)| Reason::Setting(change)).collect::<Vec<_>>()
    };
    let mut reasons: Vec<Reason> = settings(used).into_iter().chain(drawn).collect();
    if reasons.is_empty() {
        reasons = settings(others.into_iter().filter(|(name, _)| WALK_KEYS.contains(name)).collect());
    }
    if reasons.is_empty() && has_other_order {
        reasons.push(Reason::Reordered);
    }
    reasons
}

/// Keys that influence how a drawing is read.
const READING_KEYS: [&str; 4] = ["approximate-curves", "compatible", "line-types", "units"];

/// Keys that influence how drawn elements are connected. They count only if nothing else explains the moves.
const WALK_KEYS: [&str; 2] = ["compatible", "join-tolerance"];

/// Keys that give defaults for elements without a value in their texts.
const DEFAULT_KEYS: [&str; 3] = ["feed", "probe-feed", "sweep-height"];

/// Returns the keys that can change moves and have different values on the two sides.
fn changed_settings(old: &Settings, new: &Settings) -> BTreeMap<&'static str, ValueChange> {
    let can_move = |name: &str| [&READING_KEYS[..], &WALK_KEYS, &DEFAULT_KEYS].concat().contains(&name);
    let values = |all: &Settings| {
        let all = settings(all).filter(|(section, _)| section.is_empty());
        all.map(|(_, setting)| (setting.name, setting.value)).collect::<BTreeMap<_, _>>()
    };
    let mut old = values(old);
    let changed = values(new).into_iter().filter_map(|(name, now)| {
        let was = old.remove(name).flatten();
        let change = || (name, ValueChange { name: name.to_owned(), was: was.clone(), now: now.clone() });
        (was != now && can_move(name)).then(change)
    });
    changed.collect()
}

/// A collector of reasons, which compares paths and the paths that they embed.
struct Explainer<'o, 'n> {
    old: &'o Database,
    new: &'n Database,
    /// Whether the sides differ in a setting that influences how a drawing is read.
    is_read_otherwise: bool,
    /// Result for each pair of paths compared so far: whether the two differ.
    known: HashMap<(Instance<'o>, Instance<'n>), bool>,
    /// The names of embedded paths with the reasons that were listed for them, without nested ones: other values often have the same reasons.
    listed: HashSet<(String, Vec<Sentence>)>,
    /// The options that provide a value for any of the paths.
    used_options: BTreeSet<&'static str>,
    /// Whether two drawings with the same bytes were read differently.
    has_same_file: bool,
    /// Whether a file contains the same elements in another order.
    has_other_order: bool,
}

#[derive(Clone, Copy)]
struct Versions<'o, 'n> {
    old: Instance<'o>,
    new: Instance<'n>,
}

impl<'o, 'n> Explainer<'o, 'n> {
    /// Returns the changes in a path and in the paths that it embeds.
    fn path_reasons(&mut self, versions: Versions<'o, 'n>, is_root: bool) -> Vec<Reason> {
        let Versions { old, new } = versions;
        let variables = changed_variables(old.bindings(self.old), new.bindings(self.new));
        let drawn = self.drawn_reasons(versions, is_root);
        let embedded = self.embedded_reasons(versions);
        variables.into_iter().map(Reason::Variable).chain(drawn).chain(embedded).collect()
    }

    fn drawn_reasons(&mut self, Versions { old, new }: Versions<'o, 'n>, is_root: bool) -> Vec<Reason> {
        let was = DrawnInstance::of(self.old, old, is_root);
        let is = DrawnInstance::of(self.new, new, is_root);
        let (Some(was), Some(is)) = (was, is) else { return Vec::new() };
        self.used_options.extend(was.options().chain(is.options()));
        let changes = drawn_changes(was.side(), is.side());
        if self.is_read_otherwise && !changes.changes.is_empty() && self.is_same_file(was.file, is.file) {
            self.has_same_file = true;
            return Vec::new();
        }
        self.has_other_order |= changes.is_reordered;
        changes.changes.into_iter().map(Reason::Drawn).collect()
    }

    fn embedded_reasons(&mut self, Versions { old, new }: Versions<'o, 'n>) -> Vec<Reason> {
        let mut were = children(self.old, old);
        let mut reasons = Vec::new();
        // First pair the paths with the same values on both sides, then pair the remaining ones by name.
        let (alike, others): (Vec<_>, Vec<_>) =
            children(self.new, new).into_iter().partition(|child| were.iter().any(|was| was.is_same(child)));
        for child in alike.iter().chain(&others) {
            let has_same_name = |was: &Child<'_>| was.name == child.name;
            let place = were
                .iter()
                .position(|was| was.is_same(child))
                .or_else(|| were.iter().position(has_same_name));
            let Some(was) = place.map(|place| were.remove(place)) else { continue };
            let Some((path, below)) = self.child_reasons(&was, child) else { continue };
            let is_listed_here =
                |reason: &Reason| matches!(reason, Reason::Embedded { path: other, .. } if *other == path);
            if !below.is_empty() || !reasons.iter().any(is_listed_here) {
                reasons.push(Reason::Embedded { path, reasons: below });
            }
        }
        reasons
    }

    /// Returns the name of an embedded path, and the reasons that are not listed yet; `None` if it has not changed.
    fn child_reasons(&mut self, old: &Child<'o>, new: &Child<'n>) -> Option<(String, Vec<Reason>)> {
        let path = new.name.as_str().to_owned();
        let key = (old.instance, new.instance);
        if let Some(is_changed) = self.known.get(&key) {
            return is_changed.then(|| (path, Vec::new()));
        }
        let reasons = self.path_reasons(Versions { old: old.instance, new: new.instance }, false);
        self.known.insert(key, !reasons.is_empty());
        if reasons.is_empty() {
            return None;
        }
        let is_new = self.listed.insert((path.clone(), reasons.iter().map(Reason::first_sentence).collect()));
        Some((path, if is_new { reasons } else { Vec::new() }))
    }

    fn is_same_file(&self, old: SourceFile, new: SourceFile) -> bool {
        let read = |db: &Database, file: SourceFile| db.system().read(file.path(db), u64::MAX).ok();
        read(self.old, old).is_some_and(|bytes| read(self.new, new) == Some(bytes))
    }
}

struct Child<'db> {
    name: CaseSensitiveName,
    instance: Instance<'db>,
    bindings: Bindings,
}

impl Child<'_> {
    fn is_same(&self, other: &Child<'_>) -> bool {
        (&self.name, &self.bindings) == (&other.name, &other.bindings)
    }
}

/// Returns the paths that a path embeds, without duplicates.
fn children<'db>(db: &'db Database, instance: Instance<'db>) -> Vec<Child<'db>> {
    let mut children: Vec<Child<'db>> = Vec::new();
    let mut seen = HashSet::new();
    for embedding in direct_embeddings(db, instance) {
        let (Some(name), Outcome::Found { child, .. }) = (&embedding.name, &embedding.outcome) else {
            continue;
        };
        if seen.insert(*child) {
            children.push(Child {
                name: name.clone(),
                instance: *child,
                bindings: child.bindings(db).clone(),
            });
        }
    }
    children
}

struct DrawnInstance<'db> {
    file: SourceFile,
    drawn: DrawnPath<'db>,
    in_force: Vec<ElementParameters>,
}

impl<'db> DrawnInstance<'db> {
    fn of(db: &'db Database, instance: Instance<'db>, is_root: bool) -> Option<Self> {
        let (file, name) = (instance.file(db), PathName::new(instance.name(db).folded(db)));
        let in_force = effective_parameters(db, file, &name, instance.bindings(db), is_root);
        Some(Self { file, drawn: drawn_path(db, file, &name)?, in_force })
    }

    fn side(&self) -> DrawnSide<'_> {
        DrawnSide { raw: self.drawn.raw, positions: self.drawn.positions, parameters: &self.in_force }
    }

    /// Returns the names of the options that provide values for the elements.
    fn options(&self) -> impl Iterator<Item = &'static str> {
        let parameters = self.in_force.iter().flat_map(|row| &*row.parameters);
        parameters.filter_map(|parameter| match parameter.from {
            Provider::Option(name) => Some(name),
            _ => None,
        })
    }
}

fn changed_variables(old: &Bindings, new: &Bindings) -> Vec<ValueChange> {
    let names: BTreeSet<char> = old.iter().chain(new.iter()).map(|(name, _)| name).collect();
    let change = |name: char| {
        let value = |bindings: &Bindings| bindings.get(name).map(str::to_owned);
        ValueChange { name: name.to_string(), was: value(old), now: value(new) }
    };
    names.into_iter().map(change).filter(|change| change.was != change.now).collect()
}
