//! The functions behind the fuzz targets. A target panics if pathbuild misbehaves: if it panics, hangs, reports PB006, or contradicts
//! itself. The tests of this crate run all targets on the corpora in `fuzz/corpus` and on random mutations of them.

mod drawing;
mod drawn;
mod program;
mod settings;

/// A target with its name.
pub type Target = (&'static str, fn(&[u8]));

/// All targets, named after their corpora in `fuzz/corpus`.
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

/// Runs a target.
///
/// # Panics
/// If pathbuild misbehaves, or there is no such target.
pub fn run(name: &str, data: &[u8]) {
    let target = TARGETS.iter().find(|(known, _)| *known == name);
    assert!(target.is_some(), "there is no target {name}");
    if let Some((_, run)) = target {
        run(data);
    }
}
