use super::record::Record;
use crate::model::{Pair, Part, Version};
use crate::sheet::Sheet;

/// A day of 2025, as a Julian date: files do not tell when they were written.
const DATE: &str = "2460676.5";
const GUID: &str = "{00000000-0000-0000-0000-000000000000}";

/// The header section's pairs: what the crate writes, with everything set that it would make up.
pub(crate) fn pairs(sheet: &Sheet, mut variables: Vec<Record>, hand_seed: u64) -> Vec<Pair> {
    let options = sheet.options();
    for variable in &mut variables {
        let fixed = match variable[0].value.as_str() {
            "$TDCREATE" | "$TDUCREATE" | "$TDUPDATE" | "$TDUUPDATE" => DATE.to_owned(),
            "$FINGERPRINTGUID" | "$VERSIONGUID" => GUID.to_owned(),
            "$HANDSEED" => format!("{hand_seed:X}"),
            "$MEASUREMENT" | "$HANDLING" => "     1".to_owned(),
            _ => continue,
        };
        variable[1].value = fixed;
    }
    // Pointers to objects that are not written.
    variables.retain(|variable| {
        !matches!(variable[0].value.as_str(), "$DRAGVS" | "$CMATERIAL" | "$INTERFEREOBJVS")
    });
    variables.retain(|variable| variable[0].value != "$INTERFEREVPVS");
    let known_units = options.version >= Version::R2000;
    let units = options.units.filter(|units| known_units || *units != 4);
    change(&mut variables, "$INSUNITS", units.map(|units| Pair::new(70, format!("{units:>6}"))));
    let known_code_page = options.version >= Version::R12;
    let code_page = options.code_page.as_deref().filter(|_| known_code_page);
    change(&mut variables, "$DWGCODEPAGE", code_page.map(|name| Pair::new(3, name)));
    if options.left_out.contains(&Part::Handles) {
        change(&mut variables, "$HANDLING", Some(Pair::new(70, "     0")));
    }
    for (name, pair) in &options.header {
        change(&mut variables, name, Some(pair.clone()));
    }
    variables.into_iter().flatten().collect()
}

/// Sets a variable, adds it at the end, or takes it out.
fn change(variables: &mut Vec<Record>, name: &str, value: Option<Pair>) {
    let at = variables.iter().position(|variable| variable[0].value == name);
    match (at, value) {
        (Some(at), Some(value)) => variables[at] = vec![Pair::new(9, name), value],
        (None, Some(value)) => variables.push(vec![Pair::new(9, name), value]),
        (Some(at), None) => _ = variables.remove(at),
        (None, None) => {}
    }
}
