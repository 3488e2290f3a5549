//! Computes the build identifier: cached results of other builds are ignored.

#![expect(clippy::disallowed_methods, reason = "this is how cargo talks to a build script")]

use std::fs;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-env=PATHBUILD_BUILD={:032x}", build_id());
}

/// Hashes everything that the program is built from: our own sources, the versions of dependencies, the compiler, the target and the
/// profile. In the workspace, version numbers do not suffice because they stay the same between changes. A published crate does not contain
/// the sources of the others, but its Cargo.toml pins their exact versions, and published versions never change.
fn build_id() -> u128 {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let has_sources = workspace.join("crates/pathbuild-workspace/build.rs").is_file();
    let files = if has_sources { workspace_files(&workspace) } else { Vec::new() };
    let mut hash = FNV_BASIS;
    for variable in [
        "CARGO_PKG_VERSION",
        "RUSTC",
        "TARGET",
        "PROFILE",
        "OPT_LEVEL",
        "CARGO_CFG_TARGET_FEATURE",
        "RUSTC_VERSION",
    ] {
        hash = add_to_hash(hash, std::env::var(variable).unwrap_or_default().as_bytes());
    }
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = std::process::Command::new(compiler).arg("-vV").output();
    hash = add_to_hash(hash, &version.map(|output| output.stdout).unwrap_or_default());
    for file in &files {
        let name = file.strip_prefix(&workspace).unwrap_or(file);
        hash = add_to_hash(hash, name.to_string_lossy().as_bytes());
        hash = add_to_hash(hash, &fs::read(file).unwrap_or_default());
    }
    hash
}

/// Lists the files of the workspace that results depend on, sorted.
fn workspace_files(workspace: &Path) -> Vec<PathBuf> {
    let mut files = vec![workspace.join("Cargo.lock"), workspace.join("Cargo.toml")];
    for name in CRATES {
        let directory = workspace.join("crates").join(name);
        files.push(directory.join("Cargo.toml"));
        add_files(&directory.join("src"), &mut files);
        println!("cargo:rerun-if-changed={}", directory.join("src").display());
    }
    // Setup sheets use these fonts.
    let fonts = workspace.join("crates/pathbuild-view/fonts");
    add_files(&fonts, &mut files);
    println!("cargo:rerun-if-changed={}", fonts.display());
    println!("cargo:rerun-if-changed={}", workspace.join("Cargo.lock").display());
    files.sort();
    files
}

/// The crates that results depend on.
const CRATES: [&str; 12] = [
    "pathbuild-cache",
    "pathbuild-db",
    "pathbuild-diagnostic",
    "pathbuild-dxf",
    "pathbuild-files",
    "pathbuild-gcode",
    "pathbuild-motion",
    "pathbuild-path",
    "pathbuild-post",
    "pathbuild-toolpath",
    "pathbuild-view",
    "pathbuild-workspace",
];

fn add_files(directory: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).into_iter().flatten().filter_map(Result::ok) {
        let path = entry.path();
        if path.is_dir() {
            add_files(&path, files);
        } else {
            files.push(path);
        }
    }
}

const FNV_BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const FNV_PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// Adds some bytes and their length to an FNV-1a hash. Collisions need not be prevented: an attacker could edit the cache itself.
fn add_to_hash(hash: u128, bytes: &[u8]) -> u128 {
    let length = bytes.len().to_le_bytes();
    bytes.iter().chain(&length).fold(hash, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(FNV_PRIME))
}
