//! Prints the length that each path cuts at each feed: `cargo run --example feeds -- DIRECTORY`.
#![expect(clippy::print_stdout, reason = "printing is what this program is for")]

use std::collections::BTreeMap;

use pathbuild_api::{Error, Library};

fn main() -> Result<(), Error> {
    let directory = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let library = Library::open(directory)?;
    for listed in library.paths(&[])?.paths {
        // Several drawings may have a path with this name, so the drawing is given as well.
        let path = library.path_in(&listed.file, &listed.name)?;
        let mut lengths: BTreeMap<u64, f64> = BTreeMap::new();
        for it in path.moves.iter().filter(|it| it.kind.cuts()) {
            *lengths.entry(it.feed.unwrap_or_default().to_bits()).or_default() += it.length;
        }
        let material = path.material.as_deref().unwrap_or("-");
        println!("{} ({}), M {material}", path.name, path.file);
        for (feed, length) in lengths {
            println!("  {length:8.1} mm at {} mm/min", f64::from_bits(feed));
        }
    }
    Ok(())
}
