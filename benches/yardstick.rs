//! Yardsticks for a check: programs that read the same files on the same threads and do less with them.
//!
//! `yardstick lines DIRECTORY [THREADS]` counts line ends; `yardstick dxf DIRECTORY [THREADS]` reads the path layers of drawings with
//! pathbuild-dxf and discards them. Both print a number, so that nothing can be optimised away. (benches/README.md)

#![expect(clippy::disallowed_methods, reason = "it measures without System")]
#![expect(clippy::print_stdout, reason = "its result")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use pathbuild_dxf::{Options, Units};
use pathbuild_path::PathPattern;
use rayon::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [task, directory, threads @ ..] = arguments.as_slice() else {
        return Err("usage: yardstick lines|dxf DIRECTORY [THREADS]".into());
    };
    let threads = threads.first().map_or(Ok(0), |threads| threads.parse())?;
    let work: fn(&Path) -> usize = match &**task {
        "lines" => count_lines,
        "dxf" => read_dxf,
        other => return Err(format!("`{other}` is neither lines nor dxf").into()),
    };
    let mut drawings = Vec::new();
    find(Path::new(directory), &mut drawings)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let sum: usize = pool.install(|| drawings.par_iter().map(|drawing| work(drawing)).sum());
    println!("{} drawings, {sum} {task}", drawings.len());
    Ok(())
}

fn find(directory: &Path, drawings: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            find(&path, drawings)?;
        } else if path.extension().is_some_and(|extension| extension == "dxf") {
            drawings.push(path);
        }
    }
    Ok(())
}

fn count_lines(drawing: &Path) -> usize {
    let bytes = fs::read(drawing).unwrap_or_default();
    memchr::memchr_iter(b'\n', &bytes).count()
}

/// The number of entities on path layers.
fn read_dxf(drawing: &Path) -> usize {
    let bytes = fs::read(drawing).unwrap_or_default();
    let pattern = PathPattern::default();
    let options = Options {
        keep_layer: &|layer| pattern.layer(layer).is_some(),
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 2_000_000,
        max_text: 65_536,
        compatible: false,
    };
    pathbuild_dxf::read(&bytes, &options).entities.len()
}
