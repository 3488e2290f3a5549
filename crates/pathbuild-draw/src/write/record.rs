use super::tickets::Tickets;
use crate::model::Pair;

/// The pairs from one group 0 to the next.
pub(crate) type Record = Vec<Pair>;

/// What the crate wrote, section by section.
#[derive(Debug, Default)]
pub(crate) struct Written {
    /// Header variables: the pair with the name, and those of its value.
    pub(crate) header: Vec<Record>,
    /// The records of all tables, without heads.
    pub(crate) tables: Vec<Record>,
    pub(crate) blocks: Vec<Record>,
    pub(crate) entities: Vec<Record>,
}

impl Written {
    /// Takes apart what the crate writes for a drawing. In memory it has no way to fail.
    pub(crate) fn of(drawing: &dxf::Drawing) -> Self {
        let mut text = Vec::new();
        _ = drawing.save(&mut text);
        let text = String::from_utf8_lossy(&text);
        let mut written = Self::default();
        let mut section = String::new();
        for record in records(&text) {
            match record[0].value.as_str() {
                "SECTION" => {
                    section = record.get(1).map(|name| name.value.clone()).unwrap_or_default();
                    if section == "HEADER" {
                        written.header = variables(&record[2..]);
                    }
                }
                "ENDSEC" | "EOF" | "TABLE" | "ENDTAB" => {}
                _ => match section.as_str() {
                    "TABLES" => written.tables.push(record),
                    "BLOCKS" => written.blocks.push(record),
                    "ENTITIES" => written.entities.push(record),
                    _ => {}
                },
            }
        }
        written
    }

    /// Puts the strings back in place of their tickets.
    pub(crate) fn redeem(&mut self, tickets: &Tickets) {
        let all = [&mut self.tables, &mut self.blocks, &mut self.entities];
        for pair in all.into_iter().flatten().flatten() {
            if let Some(string) = tickets.redeem(&pair.value) {
                pair.value = string.to_owned();
            }
        }
    }
}

fn records(text: &str) -> Vec<Record> {
    let mut lines = text.lines();
    let mut records: Vec<Record> = Vec::new();
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        let pair = Pair::new(code.trim().parse().unwrap_or_default(), value);
        match records.last_mut() {
            Some(record) if pair.code != 0 => record.push(pair),
            _ => records.push(vec![pair]),
        }
    }
    records
}

fn variables(pairs: &[Pair]) -> Vec<Record> {
    pairs.chunk_by(|_, next| next.code != 9).map(<[Pair]>::to_vec).collect()
}

/// The value of the first pair of a code.
pub(crate) fn value(record: &[Pair], code: i32) -> Option<&str> {
    record.iter().find(|pair| pair.code == code).map(|pair| pair.value.as_str())
}

/// Sets the first pair of a code, or adds one.
pub(crate) fn set(record: &mut Record, pair: Pair) {
    match record.iter_mut().find(|old| old.code == pair.code) {
        Some(old) => *old = pair,
        None => record.push(pair),
    }
}

/// Drops all pairs of some codes.
pub(crate) fn drop_codes(record: &mut Record, codes: &[i32]) {
    record.retain(|pair| !codes.contains(&pair.code));
}

/// Puts the handle, and the owner if there is one, behind group 0 in place of those the crate wrote.
pub(crate) fn identify(record: &mut Record, code: i32, handle: Option<u64>, owner: Option<u64>) {
    drop_codes(record, &[5, 105, 330]);
    let handle = handle.map(|handle| Pair::new(code, format!("{handle:X}")));
    let owner = owner.map(|owner| Pair::new(330, format!("{owner:X}")));
    record.splice(1..1, handle.into_iter().chain(owner));
}
