//! Splits a DXF file into records, using nothing but its line structure.

/// The pairs of code and value from one group 0 to the next.
pub(crate) type Record = Vec<(i32, String)>;

/// Returns the records of ASCII DXF encoded in UTF-8.
pub(crate) fn records(bytes: &[u8]) -> Vec<Record> {
    let text = std::str::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let mut records: Vec<Record> = Vec::new();
    for pair in lines.chunks(2) {
        let (code, value) = (pair[0].trim().parse().unwrap(), pair[1].to_owned());
        if code == 0 {
            records.push(Vec::new());
        }
        records.last_mut().unwrap().push((code, value));
    }
    records
}

pub(crate) fn section(records: &[Record], name: &str) -> Vec<Record> {
    let begin = records.iter().position(|record| record[0].1 == "SECTION" && record[1].1 == name).unwrap();
    let rest = records[begin + 1..].iter();
    rest.take_while(|record| record[0].1 != "ENDSEC").cloned().collect()
}

/// Returns the first value of a code.
pub(crate) fn value(record: &Record, code: i32) -> Option<&str> {
    record.iter().find(|pair| pair.0 == code).map(|pair| pair.1.as_str())
}

/// Returns the first value of a code as a number.
pub(crate) fn number(record: &Record, code: i32) -> f64 {
    value(record, code).unwrap().trim().parse().unwrap()
}

pub(crate) fn entities(text: &str) -> Vec<Record> {
    section(&records(&dxf(text)), "ENTITIES")
}

pub(crate) fn dxf(text: &str) -> Vec<u8> {
    pathbuild_testkit::sheet(text).unwrap().to_dxf()
}
