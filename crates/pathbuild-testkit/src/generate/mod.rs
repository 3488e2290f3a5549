//! Generates realistic libraries of drawings for benchmarks and property tests: any number of components, projects that embed them, fixture
//! projects and variable projects. All of them compile without errors, and the same seed gives the same bytes.

mod component;
mod features;
mod pen;
mod plan;
mod project;

use pathbuild_draw::Sheet;
use plan::Plan;

/// A library: `components` component drawings, `components / 10` projects with ten embeddings each, and `components / 50` variable projects
/// with as many fixture projects. Drawings are generated on demand, on any thread.
#[derive(Clone, Copy, Debug)]
pub struct Library {
    plan: Plan,
}

/// The drawings of a library, in order: names relative to its directory, and sheets.
pub fn library(components: usize, seed: u64) -> impl Iterator<Item = (String, Sheet)> {
    let library = Library::new(components, seed);
    (0..library.len()).map(move |index| library.drawing(index))
}

impl Library {
    /// Creates a library with this number of components.
    pub fn new(components: usize, seed: u64) -> Self {
        Self { plan: Plan::new(components, seed) }
    }

    /// The number of drawings.
    pub fn len(&self) -> usize {
        self.plan.components() + self.projects() + 2 * self.variable_projects()
    }

    /// Whether there are no drawings.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn projects(&self) -> usize {
        self.plan.components() / 10
    }

    fn variable_projects(&self) -> usize {
        self.plan.components() / 50
    }

    /// A drawing with its name relative to the library's directory: first components, then projects, then fixture and variable projects
    /// alternating. Indices beyond the end wrap around.
    pub fn drawing(&self, index: usize) -> (String, Sheet) {
        let index = index.checked_rem(self.len()).unwrap_or_default();
        let Some(behind) = index.checked_sub(self.plan.components()) else {
            return component::drawing(&self.plan, index);
        };
        match behind.checked_sub(self.projects()) {
            None => project::drawing(&self.plan, behind),
            Some(pair) if pair % 2 == 0 => project::fixture(&self.plan, pair / 2),
            Some(pair) => project::variable(&self.plan, pair / 2),
        }
    }

    /// The directories of the drawings, in search order.
    pub fn directories(&self) -> Vec<String> {
        self.plan.directories()
    }

    /// A pathbuild.toml for the library.
    pub fn configuration(&self) -> String {
        let names: Vec<String> = self.directories().iter().map(|name| format!("{name:?}")).collect();
        let names = names.join(", ");
        format!("feed = 200\nrapid = 1000\nsweep-height = 40\nlibrary = [{names}]\nsearch = [{names}]\n")
    }
}
