//! Writes a library of drawings: `cargo run --locked --release -p pathbuild-testkit --example library -- DIRECTORY COMPONENTS [SEED]`

use std::error::Error;
use std::path::Path;

use pathbuild_testkit::generate::Library;
use rayon::prelude::*;

#[expect(clippy::disallowed_methods, reason = "the example's purpose")]
fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [directory, components, seed @ ..] = arguments.as_slice() else {
        return Err("usage: library DIRECTORY COMPONENTS [SEED]".into());
    };
    let seed = seed.first().map_or(Ok(1), |seed| seed.parse())?;
    let library = Library::new(components.parse()?, seed);
    let directory = Path::new(directory);
    for name in library.directories() {
        std::fs::create_dir_all(directory.join(name))?;
    }
    std::fs::write(directory.join("pathbuild.toml"), library.configuration())?;
    (0..library.len()).into_par_iter().try_for_each(|index| {
        let (name, sheet) = library.drawing(index);
        std::fs::write(directory.join(name), sheet.to_dxf())
    })?;
    Ok(())
}
