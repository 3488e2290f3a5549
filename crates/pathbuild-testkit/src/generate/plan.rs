use crate::random::Random;
use pathbuild_draw::model::Point;

/// The composition of a library. Every drawing follows from it independently of the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    components: usize,
    seed: u64,
}

/// Properties of a path that matter for embedding it.
#[derive(Clone, Debug)]
pub(super) struct PathPlan {
    pub(super) name: String,
    pub(super) signature: Signature,
    /// The range of its variable B, if it has one.
    pub(super) variable: Option<(f64, f64)>,
}

/// Properties of a path that the embedding segment must match.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signature {
    pub(super) thickness: f64,
    pub(super) cutter: f64,
    pub(super) material: &'static str,
    /// The vector from the start to the end of the path.
    pub(super) chord: Point,
}

/// First number of component drawings; projects have the numbers 8000 to 8999.
const FIRST: usize = 1000;
const NUMBERS: usize = 7000;
const PROJECTS: usize = 1000;

/// Offsets of the random number streams.
const SIGNATURE: u64 = 1 << 32;
const SHAPE: u64 = 2 << 32;
const PROJECT: u64 = 3 << 32;

impl Plan {
    pub(super) fn new(components: usize, seed: u64) -> Self {
        Self { components, seed }
    }

    /// The random numbers for the paths of a component.
    pub(super) fn random(&self, index: usize) -> Random {
        Random::new(self.seed, SHAPE + index as u64)
    }

    /// The random numbers for a project.
    pub(super) fn project_random(&self, index: usize) -> Random {
        Random::new(self.seed, PROJECT + index as u64)
    }

    pub(super) fn components(&self) -> usize {
        self.components
    }

    /// The paths of a component drawing: one, or in some drawings three or four.
    pub(super) fn paths(&self, index: usize) -> Vec<PathPlan> {
        let mut random = self.random(index);
        let count = if random.once_in(10) { 3 + random.below(2) } else { 1 };
        let first = 1 + 10 * (index / NUMBERS);
        let has_variable = count == 1 && random.once_in(12);
        let path = |offset: usize| PathPlan {
            name: format!("{}.{}P", number(index), first + offset),
            signature: self.signature(index, offset),
            variable: has_variable.then_some((-0.2, 0.5)),
        };
        (0..count).map(path).collect()
    }

    /// The signature of a path. Pairs of neighbours share it, so that a fixture project can embed either of them.
    fn signature(&self, index: usize, path: usize) -> Signature {
        let mut random = Random::new(self.seed, SIGNATURE + (index / 2 * 8 + path) as u64);
        Signature {
            thickness: random.pick(&[2.0, 3.0, 4.0, 5.0, 6.5, 8.0]),
            cutter: random.pick(&[1.0, 1.5, 2.0, 3.0, 4.0]),
            material: random.pick(&["M20x2", "MPappel", "MPVC", "MAl5", "MMs2"]),
            chord: Point::new(random.between(60.0, 140.0, 2.5), random.between(-10.0, 10.0, 0.5)),
        }
    }

    /// The file name of a component, derived from the paths it contains.
    pub(super) fn file(&self, index: usize) -> String {
        let paths = self.paths(index);
        let (first, last) = (&paths[0].name, &paths[paths.len() - 1].name);
        let directory = number(index) / 1000 * 1000;
        if first == last {
            format!("components/{directory}/{first}.dxf")
        } else {
            let from = first.strip_suffix('P').unwrap_or(first);
            format!("components/{directory}/{from}-{last}.dxf")
        }
    }

    pub(super) fn directories(&self) -> Vec<String> {
        let last = FIRST + self.components.clamp(1, NUMBERS) - 1;
        let directory = |thousand: usize| format!("components/{}", thousand * 1000);
        let mut directories: Vec<String> = (1..=last / 1000).map(directory).collect();
        directories.push("projects".to_owned());
        directories
    }
}

fn number(index: usize) -> usize {
    FIRST + index % NUMBERS
}

/// The name of the project's path with this index: 8000.1P, 8001.1P, ... 8999.1P, 8000.11P, ...
pub(super) fn project_name(index: usize, path: usize) -> String {
    format!("{}.{}P", 8000 + index % PROJECTS, path + 10 * (index / PROJECTS))
}

/// A number with a decimal comma, as common in these drawings.
pub(super) fn comma(number: f64) -> String {
    number.to_string().replace('.', ",")
}
