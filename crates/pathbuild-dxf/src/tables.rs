//! The TABLES section, of which only LAYER matters.

use crate::encoding::Decoder;
use crate::faults::{Fatal, stopped};
use crate::fields::{Fields, Want};
use crate::groups::Groups;
use crate::layers::LayerTable;
use crate::pairs::{Pairs, Stop};

/// Reads the records of layers.
pub(crate) fn read_layers(pairs: Pairs<'_>, decoder: &mut Decoder<'_>) -> Result<LayerTable, Fatal> {
    read_records(pairs, decoder).map_err(|stop| stopped(stop, "TABLES"))
}

fn read_records<'a>(mut pairs: Pairs<'a>, decoder: &mut Decoder<'_>) -> Result<LayerTable, Stop<'a>> {
    let mut table = LayerTable::default();
    let mut fields = Fields::new(0);
    while let Some(mut head) = pairs.find("0", "LAYER") {
        let mut groups = Groups::new(pairs);
        while head.is("LAYER") {
            (head, _) = fields.fill(&mut groups, head.line, 0, |_| Want::Keep)?;
            table.add(&fields, decoder);
        }
        pairs = groups.pairs();
    }
    Ok(table)
}
