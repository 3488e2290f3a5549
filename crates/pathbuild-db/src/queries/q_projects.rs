//! Q-projects: `NAME_Q` embeds every path of `NAME` as its proxy lines say. (spec/20-paths-and-files.md, "Q-projects")

mod judge;
mod plan;

use std::collections::BTreeMap;

use pathbuild_path::{Bindings, Path, PathName, ProxyLine, RawPath, proxy_lines as read_proxy_lines};

use super::instance::{Instance, path};
use super::layers::read_layers;
use super::raw::{NameKey, path_names, raw_path};
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

pub use judge::q_project_findings;
pub use plan::{QProject, QProjectLine, q_project};

/// The proxy lines of a drawing. The drawing is read once more for that, with all its layers.
#[salsa::tracked]
fn proxy_lines(db: &dyn Db, file: SourceFile) -> Vec<ProxyLine> {
    let drawing = read_layers(db, file, &|_| true);
    read_proxy_lines(&drawing, Settings::get(db).language(db))
}

/// A component's paths as its proxy lines embed them.
struct Component<'db> {
    db: &'db dyn Db,
    file: SourceFile,
    names: &'db [PathName],
    proxies: BTreeMap<PathName, Vec<&'db ProxyLine>>,
}

impl<'db> Component<'db> {
    fn new(db: &'db dyn Db, file: SourceFile) -> Self {
        let language = Settings::get(db).language(db);
        let mut proxies: BTreeMap<PathName, Vec<&'db ProxyLine>> = BTreeMap::new();
        for proxy in proxy_lines(db, file) {
            if let Some(name) = proxy.name(language) {
                proxies.entry(name).or_default().push(proxy);
            }
        }
        Self { db, file, names: path_names(db, file), proxies }
    }

    fn raw(&self, name: &PathName) -> Option<&'db RawPath> {
        raw_path(self.db, self.file, NameKey::of(self.db, name))
    }

    /// A path with the values that a proxy line sets, and example values for what it leaves open; `None` where the path has errors.
    fn path(&self, name: &PathName, proxy: Option<&ProxyLine>) -> Option<&'db Path> {
        let key = NameKey::of(self.db, name);
        let raw = self.raw(name).filter(|raw| raw.is_sound())?;
        let instance = Instance::new(self.db, self.file, key, values(raw, proxy));
        path(self.db, instance).path.as_ref()
    }
}

/// The values of a path's variables: those that a proxy line sets and the path allows, else example values.
fn values(raw: &RawPath, proxy: Option<&ProxyLine>) -> Bindings {
    let examples = Bindings::check_values(&raw.definitions);
    let value = |definition: &pathbuild_path::Definition| {
        let given = proxy.and_then(|proxy| proxy.variables().find(|(name, _)| *name == definition.name));
        let given = given.map(|(_, value)| value).filter(|value| definition.allows(value));
        let value = given.or_else(|| examples.get(definition.name))?;
        Some((definition.name, value.into()))
    };
    Bindings::new(raw.definitions.iter().filter_map(value))
}
