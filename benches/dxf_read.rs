//! Speed of reading drawings: bytes consumed, up to the end of ENTITIES, per second on one core.
//!
//! `splitter` merely splits the same bytes into lines and pairs and is the yardstick for `read`, which should reach 0.6 of its speed and
//! 500 MB/s; `path layers` is the typical use in a library, where hardly any layer is wanted; `crate dxf` is for comparison.
//!
//! Files: the corpus in `/work/shared` if available (ASCII files that all readers accept), otherwise generated drawings.

#![expect(clippy::disallowed_methods, reason = "the corpus is not where System could find it")]

use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pathbuild_dxf::{Drawing, Options, Units, read};
use regex::Regex;

criterion_group!(benches, dxf_read);
criterion_main!(benches);

fn dxf_read(criterion: &mut Criterion) {
    let files = files();
    let consumed: usize = files.iter().map(|file| split(file)).sum();
    let path_layer = Regex::new("^(?i:([0-9]{4})[._]([0-9]+)([A-Z]))(~[A-Z]*)?$").expect("a regex");
    let is_path_layer = |name: &str| path_layer.is_match(name);

    let mut group = criterion.benchmark_group(format!("dxf_read, {} files", files.len()));
    group.throughput(Throughput::Bytes(consumed as u64));
    group.bench_function("splitter", |bencher| bencher.iter(|| each(&files, split)));
    group.bench_function("read", |bencher| bencher.iter(|| each(&files, |file| read_with(file, &|_| true))));
    group.bench_function("read path layers", |bencher| {
        bencher.iter(|| each(&files, |file| read_with(file, &is_path_layer)));
    });
    group.sample_size(10);
    group.bench_function("crate dxf", |bencher| bencher.iter(|| each(&files, read_with_dxf)));
    group.finish();
}

fn each<T>(files: &[Vec<u8>], read: impl Fn(&[u8]) -> T) {
    for file in files {
        black_box(read(black_box(file)));
    }
}

fn read_with(file: &[u8], keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    let options = Options {
        keep_layer,
        note_text: None,
        units: Units::Millimetres,
        approximate_curves: 0.0,
        max_entities: 2_000_000,
        max_text: 65_536,
        compatible: false,
    };
    read(file, &options)
}

fn read_with_dxf(mut file: &[u8]) -> Option<dxf::Drawing> {
    dxf::Drawing::load(&mut file).ok()
}

/// Splits a file into pairs up to the end of ENTITIES, with one `memchr` per line. Returns the number of bytes.
fn split(file: &[u8]) -> usize {
    let mut at = 0;
    let mut is_entities = false;
    let mut codes = 0_u32;
    while let Some((code, value)) = line(file, &mut at).zip(line(file, &mut at)) {
        let code = code
            .iter()
            .filter(|byte| byte.is_ascii_digit())
            .fold(0, |code, digit| code * 10 + u32::from(digit - b'0'));
        codes = codes.wrapping_add(code);
        match (code, value) {
            (2, b"ENTITIES") => is_entities = true,
            (0, b"ENDSEC") if is_entities => break,
            _ => {}
        }
    }
    black_box(codes);
    at
}

fn line<'a>(file: &'a [u8], at: &mut usize) -> Option<&'a [u8]> {
    let rest = &file[*at..];
    let length = memchr::memchr(b'\n', rest)?;
    *at += length + 1;
    Some(rest[..length].strip_suffix(b"\r").unwrap_or(&rest[..length]))
}

/// The ASCII files of the corpus that all readers accept, or generated ones.
fn files() -> Vec<Vec<u8>> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpus/files");
    let Ok(directory) = std::fs::read_dir(corpus) else { return (1..=20).map(made).collect() };
    let mut paths: Vec<_> = directory.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    let files = paths.iter().filter_map(|path| std::fs::read(path).ok());
    files.filter(|file| is_accepted(file)).collect()
}

fn is_accepted(file: &[u8]) -> bool {
    let is_ascii = !file.starts_with(b"AutoCAD Binary DXF");
    is_ascii
        && read_with(file, &|_| true).diagnostics.iter().all(|it| !it.is_error())
        && read_with_dxf(file).is_some()
}

/// A drawing with several hundred lines and arcs on path layers and other layers.
fn made(number: u32) -> Vec<u8> {
    let mut text = String::from(
        "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n",
    );
    for index in 0..200 * number {
        let layer = if index % 3 == 0 { "1234.1P" } else { "DIMENSIONS" };
        let [x, y] = [f64::from(index) * 1.37, f64::from(index % 17) * 2.11];
        _ = write!(
            text,
            "  0\nLINE\n  5\n{index:X}\n  8\n{layer}\n 10\n{x:.6}\n 20\n{y:.6}\n 11\n{:.6}\n 21\n{:.6}\n\
             0\nARC\n  5\n{index:X}\n  8\n{layer}\n 10\n{x:.6}\n 20\n{y:.6}\n 40\n2.5\n 50\n0.0\n 51\n90.0\n",
            x + 1.0,
            y + 1.0
        );
    }
    text.push_str("  0\nENDSEC\n  0\nEOF\n");
    text.into_bytes()
}
