//! Tests generated libraries, and the frames, title blocks and dimensions around drawings.

use pathbuild_path::{
    Bindings, FilePattern, Path, PathKey, PathPattern, RawPath, SegmentKind, SubpathName, Xy, bind, raw_file,
    walk,
};
use pathbuild_testkit::generate::{Library, library};
use pathbuild_testkit::{Sheet, Version, sheet};

use crate::reader::{drawing, language};

#[test]
fn a_library_has_components_projects_and_variable_projects() {
    let library = Library::new(150, 7);
    assert_eq!(library.len(), 150 + 15 + 2 * 3);
    let names: Vec<String> = (0..library.len()).map(|index| library.drawing(index).0).collect();
    let in_directory = |directory: &str| names.iter().filter(|name| name.starts_with(directory)).count();
    assert_eq!((in_directory("components/1000/"), in_directory("projects/")), (150, 21));
    let mut unique = names.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), names.len());
    assert!(names.iter().any(|name| name.contains("P.dxf") && name.contains('-')), "some hold several paths");
    assert_eq!(library.directories(), ["components/1000", "projects"]);
    assert_eq!(Library::new(10_000, 7).directories().len(), 8);
    assert!(Library::new(0, 7).is_empty());
}

#[test]
fn the_same_seed_gives_the_same_bytes_in_any_order() {
    let in_turn: Vec<_> = library(40, 3).map(|(name, sheet)| (name, sheet.to_dxf())).collect();
    let again = Library::new(40, 3);
    for index in (0..again.len()).rev() {
        let (name, sheet) = again.drawing(index);
        assert_eq!((name, sheet.to_dxf()), in_turn[index]);
    }
    let other = Library::new(40, 4).drawing(5).1.to_dxf();
    assert_ne!(other, in_turn[5].1);
}

/// Returns the paths of a drawing, with example values for their variables, after checking that none has findings.
fn paths(name: &str, sheet: &Sheet) -> Vec<Path> {
    let file = raw_file(&drawing(&sheet.to_dxf()), &language());
    assert_eq!(file.diagnostics, [], "{name}");
    let bound = |raw: &RawPath| {
        assert_eq!(raw.diagnostics, [], "{name}");
        let (path, problems) = bind(raw, &Bindings::check_values(&raw.definitions), &language());
        assert_eq!(problems, [], "{name}");
        path.unwrap()
    };
    file.paths.iter().map(|(raw, _)| bound(raw)).collect()
}

#[test]
fn every_path_walks_to_its_end_and_lies_in_a_file_of_its_name() {
    let mut count = 0;
    for (name, sheet) in library(50, 11) {
        let stem = name.rsplit('/').next().unwrap().strip_suffix(".dxf").unwrap();
        let ranges = FilePattern::default().ranges(stem);
        for path in paths(&name, &sheet) {
            let key = PathKey::new(path.name.as_str(), &PathPattern::default()).unwrap();
            assert!(
                ranges.iter().any(|range| range.holds(&key)),
                "{name} does not hold {}",
                path.name.as_str()
            );
            assert_eq!(walk(&path, 0.0).diagnostics, [], "{name}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn what_is_embedded_is_there_and_agrees() {
    let all: Vec<Path> = library(50, 12).flat_map(|(name, sheet)| paths(&name, &sheet)).collect();
    let mut count = 0;
    for (path, segment) in
        all.iter().flat_map(|path| path.segments.iter().map(move |segment| (path, segment)))
    {
        let SegmentKind::Subpath(subpath) = &segment.kind else { continue };
        let SubpathName::Found { name, whole_value: None, .. } = &subpath.name else { panic!("{subpath:?}") };
        let embedded = all.iter().find(|path| path.name == *name).unwrap();
        assert_eq!((subpath.tool, subpath.thickness), (embedded.tool, embedded.thickness));
        assert_eq!(subpath.material, embedded.material);
        assert!(path.thickness >= subpath.thickness);
        let length = |a: Xy, b: Xy| libm::hypot(b.x - a.x, b.y - a.y);
        let (drawn, own) = (length(subpath.start, subpath.end), length(embedded.start, embedded.end));
        assert!((drawn - own).abs() < 1e-6, "{drawn} {own}");
        count += 1;
    }
    assert_eq!(count, 5 * 10 + 3 + 1);
}

#[test]
fn drawings_are_of_the_size_that_cads_make_them() {
    let mut sizes: Vec<(usize, String)> =
        library(50, 5).map(|(name, sheet)| (sheet.to_dxf().len(), name)).collect();
    sizes.sort();
    assert!(sizes[0].0 >= 36_000, "{:?}", sizes[0]);
    assert!(sizes[sizes.len() - 1].0 <= 52_000, "{:?}", sizes[sizes.len() - 1]);
    let empty = sheet("furniture 3").unwrap().to_dxf().len();
    assert!((36_000..50_000).contains(&empty), "{empty}");
}

#[test]
fn furniture_is_on_no_path_layer_and_changes_nothing_on_one() {
    let part = crate::placement::PART;
    for version in Version::ALL {
        for seed in 0..2 {
            let version = version.name();
            let plain = sheet(&format!("version {version}\nunits mm\n{part}")).unwrap();
            let furnished = sheet(&format!("version {version}\nfurniture {seed}\n{part}")).unwrap();
            assert_eq!(furnished.entities(), plain.entities());
            let paths = |sheet: &Sheet| -> Vec<_> {
                let file = raw_file(&drawing(&sheet.to_dxf()), &language());
                assert_eq!(file.diagnostics, [], "{version}");
                file.paths.into_iter().map(|(path, _)| path).collect()
            };
            assert_eq!(paths(&furnished), paths(&plain), "{version} {seed}");
        }
    }
}

#[test]
fn furniture_follows_from_its_seed() {
    let bytes = |seed: u64| sheet(&format!("furniture {seed}\nline 0,0 1,1")).unwrap().to_dxf();
    assert_eq!(bytes(1), bytes(1));
    let mut different: Vec<Vec<u8>> = (0..20).map(bytes).collect();
    different.sort();
    different.dedup();
    assert!(different.len() > 10, "{}", different.len());
}
