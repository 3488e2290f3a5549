//! Clipping boundaries of insertions (XCLIP). OBJECTS is read only if an insertion that draws on a wanted layer has an extension dictionary.
//! (book: reference/dxf)

use std::collections::HashSet;

use pathbuild_diagnostic::Handle;

use crate::fields::handle;
use crate::number::whole_number;
use crate::pairs::{Pairs, Stop};

/// Returns the extension dictionaries of insertions that show only a part of their block. Such a dictionary contains another one, `ACAD_FILTER`,
/// which contains a `SPATIAL_FILTER` that is switched on.
pub(crate) fn clipping_dictionaries<'a>(entities: &Pairs<'a>) -> Result<HashSet<Handle>, Stop<'a>> {
    let Some((_, mut objects)) = entities.next_section(&["OBJECTS"]) else { return Ok(HashSet::new()) };
    let (mut filters, mut entries) = (HashSet::new(), Vec::new());
    let mut record = objects.next()?;
    while !record.is("ENDSEC") {
        let (is_filter, is_dictionary) = (record.is("SPATIAL_FILTER"), record.is("DICTIONARY"));
        let (mut own, mut is_on) = (None, true);
        record = loop {
            let pair = objects.next()?;
            match pair.code {
                0 => break pair,
                5 => own = handle(pair.value),
                71 => is_on = !whole_number(pair.value).is_ok_and(|flag| flag == 0),
                350 | 360 if is_dictionary => entries.extend(own.zip(handle(pair.value))),
                _ => {}
            }
        };
        filters.extend(own.filter(|_| is_filter && is_on));
    }
    let holders = |contents: &HashSet<Handle>| {
        let holding = entries.iter().filter(|(_, entry)| contents.contains(entry));
        holding.map(|(dictionary, _)| *dictionary).collect()
    };
    Ok(holders(&holders(&filters)))
}
