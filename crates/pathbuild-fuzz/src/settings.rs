//! Targets for the configuration and cached results.

use camino::Utf8Path;
use pathbuild_cache::decode;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_workspace::config;

/// A pathbuild.toml.
pub(crate) fn config(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for fault in config::faults(Utf8Path::new("pathbuild.toml"), text) {
        let text = fault.text(Lang::En) + &fault.text(Lang::De);
        assert!(!text.contains(pathbuild_diagnostic::shown::acts), "{text:?}");
    }
}

/// Cached findings.
pub(crate) fn cache(data: &[u8]) {
    if let Ok(found) = decode::<Diagnostic>(data) {
        _ = (found.text(Lang::En), found.help(Lang::De));
    }
}
