//! The TABLES section, of which only LAYER matters.

use pathbuild_diagnostic::Diagnostic;

use crate::encoding::Decoder;
use crate::faults::stopped;
use crate::fields::{Fields, Want};
use crate::layers::LayerTable;
use crate::pairs::{Pairs, Stop};

/// Reads the records of layers.
pub(crate) fn read_layers(
    pairs: Pairs<'_>,
    decoder: &mut Decoder<'_>,
) -> Result<LayerTable, Box<Diagnostic>> {
    read_records(pairs, decoder).map_err(|stop| stopped(stop, "TABLES"))
}

fn read_records<'a>(mut pairs: Pairs<'a>, decoder: &mut Decoder<'_>) -> Result<LayerTable, Stop<'a>> {
    let mut table = LayerTable::default();
    let mut fields = Fields::new();
    let mut head = pairs.next_zero()?;
    while !head.is("ENDSEC") {
        if head.is("LAYER") {
            (head, _) = fields.fill(&mut pairs, head.line, 0, |_| Want::Keep)?;
            table.add(&fields, decoder);
        } else {
            head = pairs.next_zero()?;
        }
    }
    Ok(table)
}
