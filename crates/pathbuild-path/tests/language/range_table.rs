//! The table of name ranges gives the same results as scanning all ranges.

use pathbuild_path::{FilePattern, NameRange, PathKey, PathPattern, RangeTable};
use proptest::prelude::*;

/// Returns the name ranges of some files, each with the number of its file.
fn ranges(pattern: &FilePattern, stems: &[String]) -> Vec<(NameRange, u32)> {
    let of_file = |(number, stem): (u32, &String)| {
        pattern.ranges(stem).into_iter().map(move |range| (range, number)).collect::<Vec<_>>()
    };
    (0..).zip(stems).flat_map(of_file).collect()
}

fn table(entries: &[(NameRange, u32)]) -> RangeTable {
    entries.iter().cloned().collect()
}

fn scan(entries: &[(NameRange, u32)], path: &PathKey) -> Vec<u32> {
    let mut files: Vec<u32> =
        entries.iter().filter(|(range, _)| range.holds(path)).map(|(_, file)| *file).collect();
    files.dedup();
    files
}

fn check(file: &str, path: &str, stems: &[String], names: &[String]) -> Result<(), TestCaseError> {
    let pattern = PathPattern::new(path).unwrap();
    let entries = ranges(&FilePattern::new(file).unwrap(), stems);
    let table = table(&entries);
    for name in names {
        let Some(key) = PathKey::new(name, &pattern) else { continue };
        prop_assert_eq!(table.files(&key), scan(&entries, &key), "{} in {:?}", name, stems);
    }
    Ok(())
}

/// Generates a part of a file name by the default pattern. There are few different numbers, so that ranges overlap.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        (1000..1006_u32).prop_map(|group| group.to_string()),
        (1000..1006_u32, 0..12_u32).prop_map(|(group, part)| format!("{group}.{part}")),
        (1000..1006_u32, 0..12_u32).prop_map(|(group, part)| format!("{group}.0{part}")),
    ]
}

fn stem(part: impl Strategy<Value = String> + Clone) -> impl Strategy<Value = String> {
    let name = prop_oneof![part.clone(), (part.clone(), part).prop_map(|(from, to)| format!("{from}-{to}"))];
    prop::collection::vec(name, 0..4).prop_map(|names| names.join(","))
}

fn unusual() -> impl Strategy<Value = String> {
    let group = prop_oneof![
        Just("1".to_owned()),
        Just("01".to_owned()),
        Just("4294967293".to_owned()),
        Just("4294967294".to_owned()),
        Just("4294967295".to_owned()),
        Just("4294967296".to_owned()),
        Just("99999999999999999999999".to_owned()),
    ];
    (group.clone(), prop::option::of(group)).prop_map(|(first, second)| match second {
        Some(second) => format!("{first}.{second}"),
        None => first,
    })
}

/// Generates a name for a pattern whose groups are integers, texts, or empty.
fn mixed() -> impl Strategy<Value = String> + Clone {
    "([0-9]{1,2}|[A-C]{1,2})?([.]([0-9]|[A-B]))?"
}

/// Generates digits and letters in any order: integers, and texts that are sorted between them.
fn spelt() -> impl Strategy<Value = String> + Clone {
    "[0-2][0-2A]{0,2}"
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_table_says_what_the_scan_says(
        stems in prop::collection::vec(stem(number().boxed()), 0..12),
        names in prop::collection::vec((999..1007_u32, 0..13_u32), 1..8),
    ) {
        let names: Vec<String> = names.into_iter().map(|(group, part)| format!("{group}.{part}A")).collect();
        check(FilePattern::DEFAULT, PathPattern::DEFAULT, &stems, &names)?;
    }

    /// The numbers are too large for the fast representation, or the second group of a path is missing or a text.
    #[test]
    fn the_table_says_what_the_scan_says_of_unusual_numbers(
        stems in prop::collection::vec(stem(unusual().boxed()), 0..6),
        names in prop::collection::vec(unusual(), 1..8),
    ) {
        let path = "([0-9]+)(?:[.]([0-9]+|[A-Z]+))?";
        check("([0-9]+)(?:[.]([0-9]+))?", path, &stems, &names)?;
        let texts: Vec<String> = names.iter().map(|name| name.replace('1', "A")).collect();
        check("([0-9]+)(?:[.]([0-9]+))?", path, &stems, &texts)?;
    }

    /// Groups that are integers in some names and texts in others have no order, and may be missing anywhere.
    #[test]
    fn the_table_says_what_the_scan_says_where_there_is_no_order(
        stems in prop::collection::vec(stem(mixed()), 0..8),
        names in prop::collection::vec(mixed(), 1..8),
    ) {
        let pattern = "([0-9]+|[A-Z]+)(?:[.]([0-9]+|[A-Z]+))?|[.]([0-9]+|[A-Z]+)";
        check(pattern, pattern, &stems, &names)?;
    }

    #[test]
    fn the_table_says_what_the_scan_says_of_digits_with_letters(
        stems in prop::collection::vec(stem(spelt()), 1..8),
        names in prop::collection::vec(spelt(), 1..8),
    ) {
        check("([0-9A]+)", "([0-9A]+)", &stems, &names)?;
    }
}

/// A file is listed once, even if several of its ranges contain the path, and files are in order.
#[test]
fn each_file_is_found_once_and_in_order() {
    let stems = ["1001-1003,1002".to_owned(), "1002".to_owned(), "1000-1009".to_owned()];
    let entries = ranges(&FilePattern::default(), &stems);
    let key = PathKey::new("1002.1A", &PathPattern::default()).unwrap();
    assert_eq!(table(&entries).files(&key), [0, 1, 2]);
}
