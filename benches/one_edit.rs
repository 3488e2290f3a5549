//! A single edit in a library that is in memory: from the change of a component to the programs of the project that embeds it, queried as
//! `watch` does, through the reverse index. The cost must not grow with the library. (benches/README.md)

use std::fmt::Write;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use camino::Utf8Path;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pathbuild_db::system::MemorySystem;
use pathbuild_db::{Database, Db, Limits, Reading, Role, Settings, Target, closure, program, trace};
use pathbuild_dxf::Units;
use pathbuild_path::{FilePattern, Language, LineTypeAliases, PathOptions, PathPattern};
use pathbuild_testkit::sheet;

criterion_group!(benches, one_edit);
criterion_main!(benches);

/// Number of components that a project embeds.
const EMBEDDED: usize = 10;

fn one_edit(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("one_edit");
    group.sample_size(20);
    for components in [1_000, 10_000, 100_000] {
        let mut library = Library::new(components);
        let mut depth = 0;
        group.bench_function(BenchmarkId::from_parameter(components), |bencher| {
            bencher.iter(|| {
                depth = (depth + 1) % 4;
                library.edit(depth)
            });
        });
    }
}

/// A library in which everything was queried once.
struct Library {
    db: Database,
    system: Arc<MemorySystem>,
    component: Target,
    project: Target,
}

impl Library {
    fn new(components: usize) -> Self {
        let system = Arc::new(MemorySystem::default());
        let names: Vec<String> = (0..components).map(name).collect();
        let template = component(0);
        for name in &names {
            system.put(format!("parts/{name}.dxf"), renamed(&template, name));
        }
        let mut db = Database::new(system.clone());
        settings(&mut db);
        let checked =
            |file: &str, name: &str, role| Target::new(&db, db.file(Utf8Path::new(file)), name.into(), role);
        let all: Vec<Target> =
            names.iter().map(|name| checked(&format!("parts/{name}.dxf"), name, Role::Checked)).collect();
        let projects = names.chunks(EMBEDDED).enumerate().map(|(index, embedded)| {
            let name = format!("9{:03}.{}P", index % 1000, index / 1000 + 1);
            let file = format!("projects/{name}.dxf");
            system.put(file.clone(), project(&name, embedded));
            checked(&file, &name, Role::Emitted)
        });
        let projects: Vec<Target> = projects.collect();
        for target in all.iter().chain(&projects) {
            let found = &closure(&db, *target).diagnostics;
            assert!(found.is_empty(), "the library is right: {found:?}");
            trace(&db, *target);
        }
        Self { component: all[0], project: projects[0], db, system }
    }

    /// Changes the depth of the first component.
    fn edit(&mut self, depth: usize) -> usize {
        let path = format!("parts/{}.dxf", name(0));
        self.system.put(path.clone(), renamed(&component(depth), &name(0)));
        self.db.touch_file(Utf8Path::new(&path));
        black_box(&closure(&self.db, self.component).diagnostics);
        black_box(trace(&self.db, self.project));
        program(&self.db, self.project).as_ref().map_or(0, |program| program.steps.len())
    }
}

fn settings(db: &mut Database) {
    let language = Language {
        path_pattern: PathPattern::default(),
        keep_out: None,
        part: None,
        line_types: LineTypeAliases::default(),
        join_tolerance: 0.0,
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
    };
    let (files, search) = (FilePattern::default(), vec!["parts".into()]);
    let fold = PathOptions { feed: Some(150.0), sweep_height: Some(20.0), ..PathOptions::default() };
    let reading = Reading {
        units: Units::Header,
        approximate_curves: 0.0,
        file_size: 1 << 28,
        entities: 1 << 20,
        text_length: 65_536,
        walk_time: Duration::from_mins(1),
        is_hashed: false,
        compatible: false,
    };
    let limits = Limits { moves: 1 << 25, memory: 1 << 30, paths: 1 << 16 };
    _ = Settings::new(db, reading, Arc::new(language), files, search, Vec::new(), fold, limits);
}

/// Four-digit names below those of projects.
fn name(index: usize) -> String {
    format!("{}.{}P", 1000 + index % 8000, index / 8000 + 1)
}

const PLACEHOLDER: &str = "1000.1P";

fn component(depth: usize) -> String {
    let elements = "mill 0,0 20,10 20,30 \"B0\"\nsweep to 40,30\nmill to 50,10 40,0";
    let text = format!(
        "layer {PLACEHOLDER}\nstart 0,0 \"T5 O2 I1 F200 B0 MPlate\"\n{elements} \"B0,{depth}\"\nend 40,0\n"
    );
    dxf(&text)
}

fn project(name: &str, embedded: &[String]) -> String {
    let mut text = format!("layer {name}\nstart 0,0 \"T5 O2 MPlate\"\n");
    for (index, embedded) in embedded.iter().enumerate() {
        _ = writeln!(text, "subpath {},0 {},0 \">{embedded}\"", 40 * index, 40 * index + 40);
    }
    _ = writeln!(text, "end {},0", 40 * embedded.len());
    dxf(&text)
}

fn dxf(text: &str) -> String {
    String::from_utf8_lossy(&sheet(text).expect("a drawing").to_dxf()).into_owned()
}

fn renamed(drawing: &str, name: &str) -> Vec<u8> {
    drawing.replace(PLACEHOLDER, name).into_bytes()
}
