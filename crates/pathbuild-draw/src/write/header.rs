use super::record::{Pair, Record, kind as name};
use crate::model::{Part, Version};
use crate::sheet::Sheet;

/// A fixed date in 2025 as a Julian date, since the output must not depend on the time of writing.
const DATE: &str = "2460676.5";
const GUID: &str = "{00000000-0000-0000-0000-000000000000}";

/// Header variables that refer to objects that are not written.
const POINTERS: [&str; 4] = ["$DRAGVS", "$CMATERIAL", "$INTERFEREOBJVS", "$INTERFEREVPVS"];

/// The pairs of the header section: the output of the crate, with fixed values for everything it would make up.
pub(crate) fn pairs<'a>(sheet: &'a Sheet, mut variables: Vec<Record<'a>>, hand_seed: u64) -> Vec<Pair<'a>> {
    let options = sheet.options();
    variables.retain(|variable| !POINTERS.contains(&name(variable)));
    for variable in &mut variables {
        let Some(fixed) = fixed(name(variable), hand_seed) else { continue };
        variable.truncate(2);
        if let Some(pair) = variable.last_mut() {
            *pair = Pair::new(pair.code, fixed);
        }
    }
    let units = options.units.filter(|units| options.version >= Version::R2000 || *units != 4);
    change(&mut variables, "$INSUNITS", units.map(|units| Pair::integer(70, units.into())));
    let code_page = options.code_page.as_deref().filter(|_| options.version >= Version::R12);
    change(&mut variables, "$DWGCODEPAGE", code_page.map(|name| Pair::new(3, name)));
    if options.left_out.contains(&Part::Handles) {
        change(&mut variables, "$HANDLING", Some(Pair::integer(70, 0)));
    }
    for (name, pair) in &options.header {
        change(&mut variables, name, Some(pair.into()));
    }
    variables.into_iter().flatten().collect()
}

fn fixed(variable: &str, hand_seed: u64) -> Option<String> {
    Some(match variable {
        "$TDCREATE" | "$TDUCREATE" | "$TDUPDATE" | "$TDUUPDATE" => DATE.to_owned(),
        "$FINGERPRINTGUID" | "$VERSIONGUID" => GUID.to_owned(),
        "$HANDSEED" => format!("{hand_seed:X}"),
        "$MEASUREMENT" | "$HANDLING" => "     1".to_owned(),
        _ => return None,
    })
}

/// Sets a variable, adds it at the end, or removes it.
fn change<'a>(variables: &mut Vec<Record<'a>>, wanted: &'a str, value: Option<Pair<'a>>) {
    let at = variables.iter().position(|variable| name(variable) == wanted);
    match (at, value) {
        (Some(at), Some(value)) => variables[at] = vec![Pair::new(9, wanted), value],
        (None, Some(value)) => variables.push(vec![Pair::new(9, wanted), value]),
        (Some(at), None) => _ = variables.remove(at),
        (None, None) => {}
    }
}
