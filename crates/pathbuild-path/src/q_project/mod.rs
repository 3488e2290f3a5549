//! Q-projects: `NAME_Q` embeds every path of `NAME` as given by its proxy lines. (book: language/q-projects)

mod judge;
mod plan;

use std::collections::BTreeMap;

use crate::bind::bind;
use crate::definition::Definition;
use crate::names::PathName;
use crate::path::Path;
use crate::raw::{Language, RawPath};
use crate::read::ProxyLine;
use crate::variables::Bindings;

pub use judge::{QProjectFindings, judge_q_project};
pub use plan::{QProject, QProjectLine, plan_q_project};

/// A component: the paths of a drawing, with their proxy lines.
#[derive(Debug)]
pub struct Component<'a> {
    /// The paths in order of first appearance.
    paths: Vec<&'a RawPath>,
    proxies: &'a [ProxyLine],
    language: &'a Language,
    by_name: BTreeMap<PathName, Vec<&'a ProxyLine>>,
}

impl<'a> Component<'a> {
    /// Groups the proxy lines of a drawing by its paths.
    pub fn new(
        paths: impl Iterator<Item = &'a RawPath>,
        proxies: &'a [ProxyLine],
        language: &'a Language,
    ) -> Self {
        let mut by_name: BTreeMap<PathName, Vec<&ProxyLine>> = BTreeMap::new();
        for proxy in proxies {
            if let Some(name) = proxy.name(language) {
                by_name.entry(name).or_default().push(proxy);
            }
        }
        Self { paths: paths.collect(), proxies, language, by_name }
    }

    fn names(&self) -> impl Iterator<Item = &'a PathName> {
        self.paths.iter().map(|path| &*path.name)
    }

    fn raw(&self, name: &PathName) -> Option<&'a RawPath> {
        self.paths.iter().copied().find(|path| *path.name == *name)
    }

    /// The proxy lines of a path.
    fn proxies(&self, name: &PathName) -> &[&'a ProxyLine] {
        self.by_name.get(name).map_or(&[], Vec::as_slice)
    }

    /// A path bound to the values that a proxy line sets, and to example values for its other variables; `None` if the path has errors.
    fn path(&self, raw: &RawPath, proxy: Option<&ProxyLine>) -> Option<Path> {
        raw.is_sound().then(|| bind(raw, &values(raw, proxy), self.language).0)?
    }
}

/// The values for a path's variables: those that a proxy line sets and the path permits, otherwise example values.
fn values(raw: &RawPath, proxy: Option<&ProxyLine>) -> Bindings {
    let examples = Bindings::check_values(&raw.definitions);
    let value = |definition: &Definition| {
        let given = proxy.and_then(|proxy| proxy.variables().find(|(name, _)| *name == definition.name));
        let given = given.map(|(_, value)| value).filter(|value| definition.allows(value));
        let value = given.or_else(|| examples.get(definition.name))?;
        Some((definition.name, value.into()))
    };
    Bindings::new(raw.definitions.iter().filter_map(value))
}
