//! Speed of reading G-code, and of reading and interpreting it, in bytes per second. Target: reading at 200 MB/s or more.

use std::fmt::Write;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret_each};
use pathbuild_gcode::read::BlockReader;

/// A typical program of pathbuild: chains, half circles, retractions; `formula` is appended to every cutting Z.
fn program(formula: &str) -> String {
    let mut text =
        "%\nF150\nG17 G21 G40 G49 G54 G80 G90 G94\nT1\nG00 Z20.000\nG00 X0.000 Y0.000\n".to_owned();
    for number in 0..40_000_u32 {
        let (x, y) = (f64::from(number % 300) * 0.917, f64::from(number / 300) * 1.133 - 70.0);
        let _ = write!(
            text,
            "G00 X{x:.3} Y{y:.3}\nG00 Z5.000{formula}\nG01 Z4.250{formula}\nG01 F150.000 X{:.3} Y{y:.3} Z4.250{formula}\n\
             G02 F150.000 I0 J1.200 X{:.3} Y{:.3} Z-0.450{formula}\n(Pass {number})\nG00 Z20.000\n",
            x + 7.331,
            x + 7.331,
            y + 2.4,
        );
    }
    text.push_str("M30\n%\n");
    text
}

fn read(text: &[u8], dialect: Dialect) -> usize {
    let mut reader = BlockReader::new(text, dialect.rules());
    let mut words = 0;
    while let Some(block) = reader.next_block() {
        words += block.words.len();
    }
    words
}

fn interpret(text: &[u8], dialect: Dialect) -> u64 {
    let mut steps = 0;
    interpret_each(text, dialect, &Options::default(), &mut |_| steps += 1);
    steps
}

fn bench(criterion: &mut Criterion) {
    let formula = "(=1.000+0.441*[#51-2.000]+0.395*[#52-2.000]+0.164*[#53-2.000])";
    for (name, text) in [("plain", program("")), ("formulas", program(formula))] {
        let mut group = criterion.benchmark_group(format!("gcode_read/{name}"));
        group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(20);
        group.bench_function("read", |bencher| {
            bencher.iter(|| read(black_box(text.as_bytes()), Dialect::Native));
        });
        group.bench_function("read and interpret", |bencher| {
            bencher.iter(|| interpret(black_box(text.as_bytes()), Dialect::Native));
        });
        group.finish();
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
