//! Turns a drawing in text form into DXF: `cargo run --locked -p pathbuild-testkit --example draw -- FILE.draw > FILE.dxf`

use std::error::Error;
use std::io::Write as _;

use pathbuild_testkit::sheet;

#[expect(clippy::disallowed_methods, reason = "the example's purpose")]
fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: draw FILE.draw > FILE.dxf")?;
    let text = std::fs::read_to_string(&file)?;
    let sheet = sheet(&text).map_err(|errors| {
        let lines: Vec<String> = errors.iter().map(|error| format!("{file}: {error}")).collect();
        lines.join("\n")
    })?;
    std::io::stdout().write_all(&sheet.to_dxf())?;
    Ok(())
}
