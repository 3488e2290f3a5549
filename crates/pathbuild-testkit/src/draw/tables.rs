//! The sections of tables and objects.

use std::collections::BTreeSet;

use pathbuild_draw::pairs::{Pair, Record, drop_codes, identify, kind, value};

use super::draft::Sheet;
use super::model::{Layer, LayerState, Version};

/// The tables in the order in which CAD programs write them.
const TABLES: [&str; 9] =
    ["VPORT", "LTYPE", "LAYER", "STYLE", "VIEW", "UCS", "APPID", "DIMSTYLE", "BLOCK_RECORD"];

/// The handles of the block records, by block name.
pub(crate) type Owners = Vec<(String, u64)>;

/// Input for the tables section.
pub(crate) struct Tables<'a> {
    pub(crate) sheet: &'a Sheet,
    /// The handle of the plot style that layers refer to.
    pub(crate) plot_style: u64,
    /// The layouts of model and paper space.
    pub(crate) layouts: [u64; 2],
}

impl Tables<'_> {
    /// The pairs of the section, and the handles of the block records.
    pub(crate) fn pairs<'r>(
        &self,
        records: Vec<Record<'r>>,
        next: &mut impl FnMut() -> Option<u64>,
    ) -> (Vec<Pair<'r>>, Owners) {
        let version = self.sheet.options().version;
        let mut of_table: Vec<Vec<Record<'r>>> = TABLES.iter().map(|_| Vec::new()).collect();
        for record in records {
            if let Some(table) = TABLES.iter().position(|name| *name == kind(&record)) {
                of_table[table].push(record);
            }
        }
        let mut pairs = Vec::new();
        let mut owners = Owners::new();
        let tables = TABLES.into_iter().zip(of_table);
        for (name, records) in tables.filter(|(name, _)| version >= Version::R13 || *name != "BLOCK_RECORD") {
            let listed = self.listed(name, records);
            let head = next();
            pairs.extend(self.head(name, head, listed.len()));
            let owner = head.filter(|_| version >= Version::R2000);
            for mut record in listed {
                let handle = next();
                self.mend(name, &mut record);
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

    /// The records of a table, without unlisted layers and without names that the crate added because an entity spells them differently.
    fn listed<'r>(&self, table: &str, mut records: Vec<Record<'r>>) -> Vec<Record<'r>> {
        let mut names = BTreeSet::new();
        records.retain(|record| {
            let is_new = names.insert(value(record, 2).unwrap_or_default().to_lowercase());
            is_new && !self.is_unlisted(table, record)
        });
        records
    }

    fn head(&self, name: &'static str, handle: Option<u64>, count: usize) -> Record<'static> {
        let version = self.sheet.options().version;
        let mut head = vec![Pair::new(0, "TABLE"), Pair::new(2, name)];
        if version >= Version::R13 {
            head.extend(handle.map(|handle| Pair::handle(5, handle)));
            head.extend((version >= Version::R2000).then(|| Pair::new(330, "0")));
            head.push(Pair::new(100, "AcDbSymbolTable"));
        }
        head.push(Pair::integer(70, i64::try_from(count).unwrap_or_default()));
        if name == "DIMSTYLE" && version >= Version::R2000 {
            head.push(Pair::new(100, "AcDbDimStyleTable"));
        }
        head
    }

    fn layer(&self, record: &Record<'_>) -> Option<&Layer> {
        let name = value(record, 2)?;
        self.sheet.layers().iter().find(|layer| layer.name.eq_ignore_ascii_case(name))
    }

    fn is_unlisted(&self, table: &str, record: &Record<'_>) -> bool {
        table == "LAYER" && self.layer(record).is_some_and(|layer| layer.is(LayerState::Unlisted))
    }

    fn mend(&self, table: &str, record: &mut Record<'_>) {
        let version = self.sheet.options().version;
        if version < Version::R13 {
            drop_codes(record, &[100, 290, 370, 390, 347, 348]);
        }
        match table {
            "LAYER" => self.mend_layer(record),
            "LTYPE" if version >= Version::R13 => mend_line_type(record),
            // Handles of styles and blocks, which the crate leaves empty.
            "DIMSTYLE" => drop_codes(record, &[340, 341, 342, 343, 344, 345, 346, 347]),
            "BLOCK_RECORD" => self.mend_block_record(record),
            _ => {}
        }
    }

    /// Adds layer flags, which the crate does not know, and removes its pointer to a plot style that does not exist.
    fn mend_layer(&self, record: &mut Record<'_>) {
        let Some(layer) = self.layer(record) else { return };
        let flags = i64::from(layer.is(LayerState::Frozen)) + 4 * i64::from(layer.is(LayerState::Locked));
        drop_codes(record, &[347, 348, 370]);
        for pair in record {
            match pair.code {
                70 => *pair = Pair::integer(70, flags),
                390 => *pair = Pair::handle(390, self.plot_style),
                _ => {}
            }
        }
    }

    fn mend_block_record(&self, record: &mut Record<'_>) {
        let layout = match value(record, 2) {
            Some("*Model_Space") => self.layouts[0],
            Some("*Paper_Space") => self.layouts[1],
            _ => 0,
        };
        for pair in record.iter_mut().filter(|pair| pair.code == 340) {
            *pair = Pair::handle(340, layout);
        }
    }
}

/// Inserts the type after each dash.
fn mend_line_type(record: &mut Record<'_>) {
    let kind = |pair: &Pair<'_>| (pair.code == 49).then(|| Pair::new(74, "     0"));
    let pairs = std::mem::take(record).into_iter();
    record.extend(pairs.flat_map(|pair| {
        let kind = kind(&pair);
        std::iter::once(pair).chain(kind)
    }));
}

/// The objects section, with handles that other sections refer to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Objects {
    first: u64,
}

/// The objects of every CAD drawing. `#n` is the handle of object n; `#m` and `#p` are the block records of model and paper space.
const R2000: &str = include_str!("objects_r2000.txt");
const R13: &str = include_str!("objects_r13.txt");

/// Number of handles that the objects occupy.
const COUNT: u64 = 16;
const LAYOUTS: [u64; 2] = [4, 5];
const PLOT_STYLE: u64 = 10;

impl Objects {
    /// Creates the objects with handles from `first` on.
    pub(crate) fn from(first: u64) -> Self {
        Self { first }
    }

    /// The first handle after those of the objects.
    pub(crate) fn end(self) -> u64 {
        self.first + COUNT
    }

    pub(crate) fn layouts(self) -> [u64; 2] {
        LAYOUTS.map(|number| self.first + number)
    }

    pub(crate) fn plot_style(self) -> u64 {
        self.first + PLOT_STYLE
    }

    /// The pairs of the section.
    pub(crate) fn pairs(self, version: Version, spaces: [u64; 2]) -> Vec<Pair<'static>> {
        let text = if version >= Version::R2000 { R2000 } else { R13 };
        let mut lines = text.lines();
        let mut pairs = Vec::new();
        while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
            let code = code.trim().parse().unwrap_or_default();
            pairs.push(self.resolve(code, value, spaces));
        }
        pairs
    }

    fn resolve(self, code: i32, value: &'static str, spaces: [u64; 2]) -> Pair<'static> {
        match value.strip_prefix('#') {
            Some("m") => Pair::handle(code, spaces[0]),
            Some("p") => Pair::handle(code, spaces[1]),
            Some(number) => Pair::handle(code, self.first + number.parse::<u64>().unwrap_or_default()),
            None => Pair::new(code, value),
        }
    }
}
