//! Reads the LAYER records of the tables, either all of them or only those in question.

use memchr::memmem::Finder;

use crate::encoding::Decoder;
use crate::entities::Records;
use crate::fields::{Fields, Want};
use crate::layer_table::KnownLayers;
use crate::names::Name;
use crate::pairs::{Pair, Pairs, Stop};
use crate::sections::LAYER;

/// What reading the records needs.
pub(crate) struct Reading<'r, 'a, 'd> {
    pub(crate) fields: &'r mut Fields<'a>,
    pub(crate) decoder: &'r mut Decoder<'d>,
}

impl<'a> Reading<'_, 'a, '_> {
    /// Reads all layers of these tables.
    pub(crate) fn all(&mut self, mut tables: Pairs<'a>) -> Result<KnownLayers<'a>, Stop<'a>> {
        let mut layers = KnownLayers::default();
        while let Some(head) = tables.place("0", &LAYER) {
            tables.jump_to(head);
            let mut records = Records::new(tables)?;
            while !is_end_of_table(&records.head) {
                self.record(&mut records, &mut layers)?;
            }
            tables = records.groups.pairs();
        }
        Ok(layers)
    }

    /// Reads the records that contain a text, and possibly others, up to the record with this name. From a match on, the table is read pair
    /// by pair from the start of the record, so that no broken record is overlooked.
    pub(crate) fn some(
        &mut self,
        mut tables: Pairs<'a>,
        written: &[u8],
        wanted: &Name<'_>,
    ) -> Result<KnownLayers<'a>, Stop<'a>> {
        let mut layers = KnownLayers::default();
        let mut records = None;
        let begin = tables.consumed();
        for at in Finder::new(written).find_iter(&tables.bytes()[begin..]).map(|at| begin + at) {
            let last = tables.last_place("0", "LAYER", at);
            // Everything before the first record is skipped at once.
            let head = if records.is_none() { last.or_else(|| tables.place("0", &LAYER)) } else { last };
            if let Some(head) = head {
                tables.jump_to(head);
                records = Some(Records::new(tables)?);
            }
            let Some(row) = &mut records else { break };
            while row.groups.pairs().consumed() <= at && !is_end_of_table(&row.head) {
                self.record(row, &mut layers)?;
            }
            if layers.last_name() == Some(wanted) {
                break;
            }
            tables = row.groups.pairs();
            records = records.filter(|row| !is_end_of_table(&row.head));
        }
        Ok(layers)
    }

    /// Reads the head record if it is a LAYER.
    fn record(&mut self, records: &mut Records<'a>, layers: &mut KnownLayers<'a>) -> Result<(), Stop<'a>> {
        let is_layer = records.head.is("LAYER");
        (records.head, _) = self.fields.fill(&mut records.groups, records.head.line, 0, |_| Want::Keep)?;
        if is_layer {
            layers.add(self.fields, self.decoder);
        }
        Ok(())
    }
}

/// Whether the table ends here. A record whose start is damaged does not end the table, so that the damage is reported.
fn is_end_of_table(head: &Pair<'_>) -> bool {
    ["ENDTAB", "TABLE", "ENDSEC"].iter().any(|keyword| head.is(keyword))
}
