//! The TABLES section, of which only LAYER matters.

use crate::encoding::Decoder;
use crate::faults::{Fatal, stopped};
use crate::fields::{Fields, Want};
use crate::groups::Groups;
use crate::layer_table::LayerTable;
use crate::pairs::{Pairs, Stop};
use crate::sections::LAYER;

/// Reads the records of layers.
pub(crate) fn read_layers<'a>(
    pairs: Pairs<'a>,
    fields: &mut Fields<'a>,
    decoder: &mut Decoder<'_>,
) -> Result<LayerTable<'a>, Fatal> {
    read_records(pairs, fields, decoder).map_err(|stop| stopped(stop, "TABLES"))
}

fn read_records<'a>(
    mut pairs: Pairs<'a>,
    fields: &mut Fields<'a>,
    decoder: &mut Decoder<'_>,
) -> Result<LayerTable<'a>, Stop<'a>> {
    let mut layers = LayerTable::new();
    while let Some(mut head) = pairs.find("0", &LAYER) {
        let mut groups = Groups::new(pairs);
        while head.is("LAYER") {
            (head, _) = fields.fill(&mut groups, head.line, 0, |_| Want::Keep)?;
            layers.add(fields, decoder);
        }
        pairs = groups.pairs();
    }
    Ok(layers)
}
