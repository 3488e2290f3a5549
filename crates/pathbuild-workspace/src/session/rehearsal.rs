//! Working while directories are being listed. To list a directory of ten thousand drawings takes longer than to make the program of a project
//! out of ten of them. So the work begins as if each path were in the drawing of its name; once the names are known, all of it is asked again,
//! and what still holds, which is nearly everything nearly always, is there at once.

use std::thread::Builder;
use std::time::{Duration, Instant};

use camino::Utf8PathBuf;
use pathbuild_db::{Insight, Lister, SourceFile, has_subpaths, likely_file, search_directories};

use super::Session;
use crate::inputs::{Input, Inputs};

/// What takes so long gains nothing from what is known a little earlier, and may be given up for taking too long: once is enough.
const LONG: Duration = Duration::from_millis(200);

impl Session<'_> {
    /// Does some work in advance that asks for a single drawing or path, if names of drawings will be needed for it. Where paths are is
    /// guessed by their names; if nothing comes of that, once more with the names of drawings as they come. What comes of it is only a guess:
    /// whoever wants to use it must ask for the same again.
    pub fn rehearse<R>(&mut self, inputs: &Inputs, work: impl Fn(&Self) -> Option<R>) -> Option<R> {
        let input = self.single_input(inputs)?;
        let drawing = self.likely_drawing(input)?;
        let directories = search_directories(&self.db, drawing);
        self.targets.get_or_insert_default();
        self.list_ahead(&directories);
        // What embeds nothing needs no names, unless it was itself looked for by name.
        let needs_names = matches!(input, Input::Name(_)) || has_subpaths(&self.db, drawing);
        let begun = Instant::now();
        let mut guessed = if needs_names { work(self) } else { None };
        if needs_names && guessed.is_none() && begun.elapsed() < LONG {
            self.set_insight(&directories, Insight::Coming);
            guessed = work(self);
        }
        self.set_insight(&directories, Insight::Listed);
        guessed
    }

    /// The one thing that is asked for; `None` where it is not one, or nobody would gain.
    fn single_input<'i>(&self, inputs: &'i Inputs) -> Option<Input<'i>> {
        // Who asks again and again has listed before; who wants to know where the time goes wants to see everything done once.
        if self.targets.is_some() || self.timings.is_on() || self.context.jobs == Some(1) {
            return None;
        }
        let mut inputs = inputs.iter();
        inputs.next().filter(|_| inputs.next().is_none())
    }

    /// Lists directories while one goes on working. It is not waited for, but by whoever wants to know the names; where the system has no thread
    /// left, they must list for themselves.
    fn list_ahead(&mut self, directories: &[Utf8PathBuf]) {
        let listers: Vec<Lister> =
            directories.iter().map(|directory| self.db.begin_guessing(directory)).collect();
        let list = move || listers.into_iter().for_each(Lister::run);
        _ = Builder::new().name("listing".into()).spawn(list);
    }

    fn likely_drawing(&self, input: Input<'_>) -> Option<SourceFile> {
        match input {
            Input::Place(place) => Self::is_drawing(place).then(|| self.file(place)),
            // A library is walked through for its directories, which lists them.
            Input::Name(_) if self.has_library() => None,
            Input::Name(name) => likely_file(&self.db, &Utf8PathBuf::new(), name),
        }
    }

    fn set_insight(&mut self, directories: &[Utf8PathBuf], insight: Insight) {
        for directory in directories {
            self.db.set_insight(directory, insight);
        }
    }
}
