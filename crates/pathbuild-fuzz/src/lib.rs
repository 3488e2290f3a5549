//! What fuzz targets do with their bytes. A target is a function that panics where pathbuild is wrong: it panics itself, hangs, says PB006, or
//! contradicts itself. The tests of this crate hand them the corpora in `fuzz/corpus`, and inputs made of those by chance.

mod drawing;
mod drawn;
mod program;
mod settings;

/// A target by its name.
pub type Target = (&'static str, fn(&[u8]));

/// All targets, named like their corpora in `fuzz/corpus`.
pub const TARGETS: [Target; 8] = [
    ("dxf", drawing::dxf),
    ("texts", drawing::texts),
    ("walk", drawing::walk),
    ("post", program::post),
    ("gcode", program::gcode),
    ("values", program::values),
    ("config", settings::config),
    ("cache", settings::cache),
];

/// Runs a target on some bytes.
///
/// # Panics
/// Where pathbuild is wrong, and where there is no such target.
pub fn run(name: &str, data: &[u8]) {
    let target = TARGETS.iter().find(|(it, _)| *it == name);
    assert!(target.is_some(), "there is no target {name}");
    if let Some((_, run)) = target {
        run(data);
    }
}
