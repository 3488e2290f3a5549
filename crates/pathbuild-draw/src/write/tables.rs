use std::collections::BTreeSet;

use super::record::{Record, drop_codes, identify, value};
use crate::model::{Layer, LayerState, Pair, Version};
use crate::sheet::Sheet;

/// The tables in the order in which CADs write them.
const TABLES: [&str; 9] =
    ["VPORT", "LTYPE", "LAYER", "STYLE", "VIEW", "UCS", "APPID", "DIMSTYLE", "BLOCK_RECORD"];

/// The handles of the block records, by block name.
pub(crate) type Owners = Vec<(String, u64)>;

/// What the tables section needs to know.
pub(crate) struct Tables<'a> {
    pub(crate) sheet: &'a Sheet,
    /// The handle of the plot style that layers refer to.
    pub(crate) plot_style: u64,
    /// The layouts of model and paper space.
    pub(crate) layouts: [u64; 2],
}

impl Tables<'_> {
    /// The pairs of the section, and the handles of the block records.
    pub(crate) fn pairs(
        &self,
        records: &[Record],
        next: &mut impl FnMut() -> Option<u64>,
    ) -> (Vec<Pair>, Owners) {
        let version = self.sheet.options().version;
        let mut pairs = Vec::new();
        let mut owners = Owners::new();
        let tables = TABLES.into_iter().filter(|name| version >= Version::R13 || *name != "BLOCK_RECORD");
        for name in tables {
            let own = self.listed(name, records);
            let head = next();
            pairs.extend(self.head(name, head, own.len()));
            for record in own {
                let mut record = record.clone();
                let handle = next();
                self.mend(name, &mut record);
                let owner = head.filter(|_| version >= Version::R2000);
                identify(&mut record, if name == "DIMSTYLE" { 105 } else { 5 }, handle, owner);
                if let (Some(handle), "BLOCK_RECORD") = (handle, name) {
                    owners.push((value(&record, 2).unwrap_or_default().to_owned(), handle));
                }
                pairs.extend(record);
            }
            pairs.push(Pair::new(0, "ENDTAB"));
        }
        (pairs, owners)
    }

    /// The records of a table, without unlisted layers and without names that the crate added because an entity spells them otherwise.
    fn listed<'r>(&self, table: &str, records: &'r [Record]) -> Vec<&'r Record> {
        let mut names = BTreeSet::new();
        let own = records.iter().filter(|record| record[0].value == table);
        let mut is_new = |record: &Record| names.insert(value(record, 2).unwrap_or_default().to_lowercase());
        own.filter(|record| is_new(record) && !self.is_unlisted(table, record)).collect()
    }

    fn head(&self, name: &str, handle: Option<u64>, count: usize) -> Record {
        let version = self.sheet.options().version;
        let mut head = vec![Pair::new(0, "TABLE"), Pair::new(2, name)];
        if version >= Version::R13 {
            head.extend(handle.map(|handle| Pair::new(5, format!("{handle:X}"))));
            head.extend((version >= Version::R2000).then(|| Pair::new(330, "0")));
            head.push(Pair::new(100, "AcDbSymbolTable"));
        }
        head.push(Pair::new(70, format!("{count:>6}")));
        if name == "DIMSTYLE" && version >= Version::R2000 {
            head.push(Pair::new(100, "AcDbDimStyleTable"));
        }
        head
    }

    fn layer(&self, record: &Record) -> Option<&Layer> {
        let name = value(record, 2)?;
        self.sheet.layers().iter().find(|layer| layer.name.eq_ignore_ascii_case(name))
    }

    fn is_unlisted(&self, table: &str, record: &Record) -> bool {
        table == "LAYER" && self.layer(record).is_some_and(|layer| layer.is(LayerState::Unlisted))
    }

    fn mend(&self, table: &str, record: &mut Record) {
        if self.sheet.options().version < Version::R13 {
            drop_codes(record, &[100, 290, 370, 390, 347, 348]);
        }
        match table {
            "LAYER" => self.mend_layer(record),
            "LTYPE" if self.sheet.options().version >= Version::R13 => mend_line_type(record),
            // Handles of styles and blocks that the crate leaves empty.
            "DIMSTYLE" => drop_codes(record, &[340, 341, 342, 343, 344, 345, 346, 347]),
            "BLOCK_RECORD" => self.mend_block_record(record),
            _ => {}
        }
    }

    /// The crate knows no layer flags and points at a plot style that does not exist.
    fn mend_layer(&self, record: &mut Record) {
        let Some(layer) = self.layer(record) else { return };
        let flags = i16::from(layer.is(LayerState::Frozen)) + 4 * i16::from(layer.is(LayerState::Locked));
        for pair in record.iter_mut() {
            match pair.code {
                70 => pair.value = format!("{flags:>6}"),
                390 => pair.value = format!("{:X}", self.plot_style),
                _ => {}
            }
        }
        drop_codes(record, &[347, 348]);
        record.retain(|pair| pair.code != 370);
    }

    fn mend_block_record(&self, record: &mut Record) {
        let layout = match value(record, 2) {
            Some("*Model_Space") => self.layouts[0],
            Some("*Paper_Space") => self.layouts[1],
            _ => 0,
        };
        for pair in record.iter_mut().filter(|pair| pair.code == 340) {
            pair.value = format!("{layout:X}");
        }
    }
}

/// Each dash is followed by its kind.
fn mend_line_type(record: &mut Record) {
    let kind = |pair: &Pair| (pair.code == 49).then(|| Pair::new(74, "     0"));
    *record = record.iter().flat_map(|pair| std::iter::once(pair.clone()).chain(kind(pair))).collect();
}
