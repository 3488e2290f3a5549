//! Prints the moves of a path as CSV: `cargo run --example moves_csv -- DIRECTORY PATH`.
#![expect(clippy::print_stdout, reason = "printing is what this program is for")]

use pathbuild_api::{Error, Library};

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let (Some(directory), Some(name)) = (arguments.next(), arguments.next()) else {
        return Err(Error::Refused("give a directory and the name of a path".to_owned()));
    };
    let path = Library::open(directory)?.path(&name)?;
    if path.moves.is_empty() {
        return Err(Error::Findings(path.findings));
    }
    println!("kind,x,y,z,feed,length,element");
    for it in &path.moves {
        let [x, y, z] = it.to.map(number);
        let element = it.element.map(|element| path.elements[element].handle.clone().unwrap_or_default());
        println!(
            "{:?},{x},{y},{z},{},{:.3},{}",
            it.kind,
            number(it.feed),
            it.length,
            element.unwrap_or_default()
        );
    }
    Ok(())
}

/// Formats a number. An unknown number becomes an empty cell.
fn number(number: Option<f64>) -> String {
    number.map(|number| format!("{number:.3}")).unwrap_or_default()
}
